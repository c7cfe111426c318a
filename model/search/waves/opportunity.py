"""What an order that isn't accepted yet takes from orders to come, or rides along with."""

import math
import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from model.problem import Customer, FloatArray
from model.problem.altered import with_copies
from model.search.waves.decide import WaveConfig, plan_future
from model.search.waves.detours import detours
from model.search.waves.future import Coming, Forecast, Wave, future_of
from model.solution import Solution, renumbered


def future_costs(wave: Wave, node: int, slots: Sequence[Customer], forecast: Forecast,
                 config: WaveConfig) -> FloatArray:
    """Return what serving a customer costs more, as he would be in each slot, for what may come.

    Parameters
    ----------
    wave
        Open orders and departures, without the customer.
    node
        The place of the customer.
    slots
        The customer, as he would be.
    forecast
        Draws what may come.
    config
        How many futures are planned, and how long.

    Returns
    -------
    (slot,) what he adds to plans of futures, on the mean, less what he adds to that of the orders
    known. Negative: he rides along. Infinite or NaN: no truck comes there in time.
    """
    due = time.perf_counter() + config.seconds
    known = _added(wave, node, slots, (), config, 0, due)
    found = [_added(wave, node, slots, forecast(np.random.default_rng((config.seed, number))),
                    config, number, due) for number in range(1, 1 + config.futures)]
    with np.errstate(invalid="ignore"):
        costs: FloatArray = np.mean(found, axis=0) - known
    return costs


def _added(wave: Wave, node: int, slots: Sequence[Customer], coming: Sequence[Coming],
           config: WaveConfig, number: int, due: float) -> FloatArray:
    """Return what the customer adds to a plan of open orders and those that came, (slot,)."""
    future = future_of(wave, coming)
    left = config.futures + 1 - number
    seconds = (due - time.perf_counter()) / left if math.isfinite(due) else math.inf
    plan = plan_future(future.problem, config, config.turns, number, seconds)
    first = wave.problem.num_nodes
    asked = future_of(replace(wave, problem=with_copies(wave.problem, node, slots), open=(
        *wave.open, *range(first, first + len(slots)))), coming)
    behind = future.open.stop
    whole: Solution = renumbered(plan, lambda own: own if own < behind else own + len(slots))
    return detours(asked, whole.routes, range(len(asked.problem.vehicle_types)))[len(wave.open):]
