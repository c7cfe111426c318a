"""Which open orders leave now, by what it would cost to serve them later in drawn futures.

In each future, open orders and those that came are planned together, each with the departure that
suits it. What an order costs there on the routes that leave later, on the mean, is the price of
leaving it out of those that leave now: who leaves is then settled with the routes.

References
----------
Lan, van Doorn, Wouda, Rijal and Bhulai (2023), an iterative sample scenario approach for the
dynamic dispatch waves problem, arXiv 2308.14476.
Baty, Jungel, Klein, Parmentier and Schiffer (2024), combinatorial optimization-enriched machine
learning to solve the dynamic vehicle routing problem with time windows, Transportation Science.
"""

import math
import time
from collections import Counter
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, replace

import numpy as np

from model.engine.instance import pack
from model.problem import FloatArray, Problem
from model.search.improve import SearchConfig, improve
from model.search.waves.detours import detours
from model.search.waves.future import Forecast, Wave, future_of
from model.solution import Solution, renumbered

LOOKING = 0.8
"""Share of the time in which futures are looked at; the rest is for the routes that leave."""

FEWEST, LEAST_SECONDS = 2, 0.03
"""Futures that are looked at however little time there is, and how long at least."""


@dataclass(frozen=True)
class WaveConfig:
    """How much is looked at."""

    futures: int = 30  # as far as there is time
    turns: int = 3000  # of the search in each future
    last_turns: int = 60_000  # of that for the routes that leave; in a limited time, until it ends
    seconds: float = math.inf
    price_share: float = 0.8
    """Of what leaving later costs in futures, where departures follow that they don't look at."""
    seed: int = 0


@dataclass(frozen=True, slots=True)
class Outlook:
    """Why an open order leaves now, or waits."""

    node: int
    leaves: bool
    must: bool  # no later departure serves it in time
    futures: int  # that were looked at; 0: none is forecast
    later_in: int  # of these it leaves later
    departure: int | None  # ms, with which it leaves in most of these
    saved: float | None  # by what is decided, on the mean, as detours tell; None: unknown


@dataclass(frozen=True)
class WaveDecision:
    """What leaves now, by which routes, and why."""

    plan: Solution  # in the wave's problem; `unassigned`: who must leave, but can't be taken
    outlooks: tuple[Outlook, ...]  # of each open order


@dataclass(frozen=True, eq=False)
class _Seen:
    """A future, as it was planned."""

    costs: FloatArray  # (open order,) of leaving later
    departures: dict[int, int]  # by open order's node: the number of that with which it leaves


def must_leave(wave: Wave) -> frozenset[int]:
    """Return the open orders that can leave now, but can't with the next departure.

    That is whoever a plan by all rules leaves out in which all leave then, as far as a first plan
    tells.
    """
    now = future_of(replace(wave, departures=wave.departures[:1]), ()).problem.may_serve
    if not wave.open or now is None:
        return frozenset()
    may_leave = {wave.open[index] for index in np.flatnonzero(now.any(axis=0)).tolist()}
    if len(wave.departures) == 1:
        return frozenset(may_leave)
    soon = future_of(replace(wave, departures=wave.departures[1:2]), ())
    plan = plan_future(soon.problem, WaveConfig(), 0, 0, math.inf)
    return frozenset(map(soon.node_of, plan.unassigned)) & may_leave


def decide(wave: Wave, forecast: Forecast | None, config: WaveConfig) -> WaveDecision:
    """Decide which open orders leave now, and by which routes.

    Parameters
    ----------
    wave
        Open orders and departures.
    forecast
        Draws what may come; None: orders leave as late as is safe.
    config
        Without a time limit, the same seed gives the same decision.

    Returns
    -------
    The decision. Its plan isn't judged yet.
    """
    due, must = time.perf_counter() + config.seconds, must_leave(wave)
    seen = list[_Seen]()
    if forecast is not None and len(must) < len(wave.open):
        seen = _look_ahead(wave, forecast, config)
    prices = _prices(wave, seen, config)
    plan = _collect(wave, must, prices, config, due - time.perf_counter())
    return WaveDecision(plan, _outlooks(wave, must, plan, prices, seen))


def _look_ahead(wave: Wave, forecast: Forecast, config: WaveConfig) -> list[_Seen]:
    """Plan as many futures as there is time for, each in as much of it."""
    seen, seconds = list[_Seen](), LOOKING * config.seconds
    due, count = time.perf_counter() + seconds, config.futures
    if seconds < math.inf:
        count = min(count, max(FEWEST, int(seconds / LEAST_SECONDS)))
    for number in range(count):
        each = (due - time.perf_counter()) / (count - number)
        seen.append(_look(wave, forecast, config, number, each))
    return seen


def _look(wave: Wave, forecast: Forecast, config: WaveConfig, number: int,
          seconds: float) -> _Seen:
    """Plan a future in which open orders leave when that costs least."""
    due = time.perf_counter() + seconds
    rng = np.random.default_rng((config.seed, number))
    future = future_of(wave, forecast(rng))
    plan = plan_future(future.problem, config, config.turns, number, due - time.perf_counter())
    routes = [route for route in plan.routes if route.vehicle_type in future.later_types]
    leaves = {node: future.departure_of(route.vehicle_type) for route in plan.routes
              for node in route.served}
    return _Seen(detours(future, routes, future.later_types),
                 {future.node_of(node): leaves[node] for node in future.open if node in leaves})


def _prices(wave: Wave, seen: Sequence[_Seen], config: WaveConfig) -> dict[int, float]:
    """Return the price of each open order that leaves later; none where none is known."""
    if not seen:
        return {}
    share = config.price_share if wave.goes_on else 1.0
    costs = share * np.mean([each.costs for each in seen], axis=0)
    # A detour may be a way that is shorter.
    return dict(zip(wave.open, np.maximum(costs, 0.0).tolist(), strict=True))


def _collect(wave: Wave, must: Set[int], prices: Mapping[int, float], config: WaveConfig,
             seconds: float) -> Solution:
    """Return the routes that leave now: of all that must, and of others that cost less now."""
    going = tuple([node for node in wave.open if node in must or node in prices])
    if not going:
        return Solution(())
    future = future_of(Wave(wave.problem, going, wave.departures[:1]), ())
    customers = tuple([
        customer if node in must or prices[node] == math.inf
        else replace(customer, unassigned_cost=prices[node])
        for node, customer in zip(going, future.problem.customers, strict=True)])
    priced = replace(future.problem, customers=customers)
    plan = renumbered(plan_future(priced, config, config.last_turns, 0, seconds), future.node_of)
    return replace(plan, unassigned=tuple([node for node in plan.unassigned if node in must]))


def plan_future(problem: Problem, config: WaveConfig, turns: int, number: int,
                seconds: float) -> Solution:
    """Plan from nothing, by turns, or until a time is over if it is limited."""
    limited = seconds < math.inf
    deadline = time.perf_counter() + seconds if limited else None
    nothing = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    setting = SearchConfig(config.seed + number, turns=None if limited else turns)
    return improve(problem, pack([problem], legs=False), nothing, setting, deadline).solution


def _outlooks(wave: Wave, must: Set[int], plan: Solution, prices: Mapping[int, float],
              seen: Sequence[_Seen]) -> tuple[Outlook, ...]:
    """Tell of each open order why it leaves or waits."""
    if not wave.open:
        return ()
    whole = future_of(wave, ())
    here = {node: index for index, node in zip(whole.open, wave.open, strict=True)}
    routes = renumbered(plan, lambda node: here.get(node, node)).routes
    costs_now = detours(whole, routes, range(wave.num_types)).tolist()
    gone = plan.served
    found = []
    for node, cost in zip(wave.open, costs_now, strict=True):
        departures = Counter([each.departures[node] for each in seen if node in each.departures])
        later_in = len(seen) - departures.pop(0, 0)
        saved = (prices.get(node, math.inf) - cost) * (1 if node in gone else -1)
        found.append(Outlook(
            node, node in gone, node in must, len(seen), later_in,
            wave.departures[max(departures, key=departures.__getitem__)] if departures else None,
            saved if math.isfinite(saved) else None))
    return tuple(found)
