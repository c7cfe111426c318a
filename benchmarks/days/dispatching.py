"""What dispatching wave by wave costs more than knowing all orders beforehand.

`python -m benchmarks.days.dispatching ../shared/data/dynamic_euro_neurips --seconds 5` replays the
days of the EURO meets NeurIPS competition of 2022 by one thread. Epochs are limited by processor
time, so that what else a machine does counts for nothing.
"""

import statistics
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from benchmarks.clock import count_processor_time
from benchmarks.days.waves import Day, Deciding, Request, Routes, published, read_day, replay
from benchmarks.results import gap_percent
from benchmarks.rows import appended
from model.problem import Customer, Depot, Problem, Travel, VehicleType
from model.search.waves.decide import WaveConfig, decide
from model.search.waves.future import Coming, Forecast, Wave

UNIT = 1000  # milliseconds, millimetres and thousandths per unit
VEHICLES = 200  # as many as are ever needed
LEFT_OUT = 1e6


class Method(StrEnum):
    """How it is decided who leaves."""

    GREEDY = "greedy"  # everybody
    LAZY = "lazy"  # who must
    FUTURES = "futures"


@dataclass(frozen=True)
class Outcome:
    """A day that was replayed."""

    instance: str
    method: str
    seconds: float  # allowed for an epoch
    seed: int
    cost: int
    hindsight: float  # as published
    gap_percent: float
    cpu_s: float  # of an epoch, on the mean


def wave_of(day: Day, epoch: int, waiting: Sequence[Request], look_ahead: int) -> Wave:
    """Return what is to be decided in an epoch: places first, then the orders that are open."""
    places = len(day.legs)
    at = np.array([*range(places), *(each.node for each in waiting)])
    legs = day.legs[np.ix_(at, at)] * UNIT
    customers = (*(Customer(f"place {node}", (0,)) for node in range(1, places)),
                 *map(_customer, waiting))
    truck = VehicleType("truck", VEHICLES, (day.capacity * UNIT,), 0, cost_per_km=1.0,
                        latest=int(day.window[0, 1]) * UNIT)
    problem = Problem((Depot("depot"),), customers, (truck,), (Travel(legs, legs),),
                      np.zeros((len(at), 2)), unassigned_cost=LEFT_OUT)
    last = min(day.epochs[-1], epoch + look_ahead)
    return Wave(problem, tuple(range(places, len(at))),
                tuple([day.departure(each) * UNIT for each in range(epoch, last + 1)]),
                goes_on=last < day.epochs[-1])


def _customer(request: Request) -> Customer:
    return Customer(str(request.number), (request.demand * UNIT,), request.service * UNIT,
                    request.earliest * UNIT, request.latest * UNIT)


def forecast_of(day: Day, epoch: int, look_ahead: int) -> Forecast:
    """Return what draws the orders of the next epochs as the competition does."""
    def draw(rng: np.random.Generator) -> list[Coming]:
        return [Coming(request.node, _customer(request), day.departure(ahead) * UNIT)
                for ahead in range(epoch + 1, min(day.epochs[-1], epoch + look_ahead) + 1)
                for request in day.drawn(ahead, rng)]
    return draw


def deciding(method: Method, config: WaveConfig, look_ahead: int) -> Deciding:
    """Return how a method decides."""
    def routes(day: Day, epoch: int, waiting: Sequence[Request]) -> Routes:
        wave = wave_of(day, epoch, waiting, look_ahead)
        if method is Method.GREEDY:
            wave = replace(wave, departures=wave.departures[:1])
        forecast = forecast_of(day, epoch, look_ahead) if method is Method.FUTURES else None
        plan = decide(wave, forecast, replace(config, seed=config.seed + epoch)).plan
        return [[waiting[stop.node - len(day.legs)] for stop in trip.customer_stops]
                for route in plan.routes for trip in route.trips]
    return routes


def run(folder: Path, names: Sequence[str], method: Method, config: WaveConfig,
        look_ahead: int) -> Iterator[Outcome]:
    """Yield what each day costs."""
    table: Mapping[str, Mapping[str, str]] = published(folder)
    for name in names or table:
        day, began = read_day(folder, name), time.process_time()
        cost = replay(day, deciding(method, config, look_ahead))
        hindsight = float(table[name]["hindsight_published"])
        yield Outcome(name, method, config.seconds, config.seed, cost, hindsight,
                      gap_percent(cost, hindsight),
                      (time.process_time() - began) / len(day.epochs))


def main(
    folder: Path,
    method: Annotated[Method, typer.Option()] = Method.FUTURES,
    seconds: Annotated[float, typer.Option(help="For an epoch.")] = 5.0,
    futures: Annotated[int, typer.Option(help="At most.")] = WaveConfig.futures,
    turns: Annotated[int, typer.Option(help="In a future.")] = WaveConfig.turns,
    look_ahead: Annotated[int, typer.Option(help="Departures.")] = 2,
    seed: Annotated[int, typer.Option()] = 1,
    every: Annotated[int, typer.Option(help="So many instances, one is replayed.")] = 1,
    first: Annotated[int, typer.Option(help="Instance, from 0.")] = 0,
    out: Annotated[Path, typer.Option()] = Path("build/dispatching.csv"),
) -> None:
    """Replay days, and print how much dearer each was than hindsight."""
    count_processor_time()
    names = list(published(folder))[first::every]
    config = WaveConfig(futures, turns, seconds=seconds, seed=seed)
    gaps = []
    for row in appended(out, Outcome, run(folder, names, method, config, look_ahead)):
        gaps.append(row.gap_percent)
        print(f"{row.instance} {row.method} {row.cost} {row.gap_percent:.2f} % {row.cpu_s:.2f} s",
              flush=True)
    print(f"mean {statistics.mean(gaps):.2f} % of {len(gaps)}")


if __name__ == "__main__":
    typer.run(main)
