"""What each sortie saves against serving its customers by truck, all others staying as they are."""

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from model.counsel.bench import Bench, Setting, Trial
from model.counsel.screening import BY_TRUCK, Screen, best_first
from model.judge.check import JudgedRoute
from model.problem import Problem
from model.solution import Solution

TRIES, MORE_TRIES = 4, 12
"""Stops that are tried of the best of all trucks; and more if none is legal."""


@dataclass(frozen=True)
class Worth:
    """What a sortie saves; None: its customers can't be served by trucks at places tried."""

    route: int
    trip: int
    sortie: int
    saves: float | None
    is_tried: bool = True  # there was time for it


def sorties_worth(problem: Problem, solution: Solution, setting: Setting | None = None,
                  until: float = math.inf,
                  judged: Mapping[int, JudgedRoute] | None = None) -> Iterator[Worth]:
    """Yield what each sortie of a plan saves, as far as is found by an instant.

    `until` is on `time.perf_counter`; `judged` are the plan's routes, if known.
    """
    setting = setting or Setting()
    judged = setting.judge_routes(problem, solution) if judged is None else judged
    cost = setting.judge(problem, solution, judged).cost.total
    for index, route in enumerate(solution.routes):
        for number, trip in enumerate(route.trips):
            for flight, sortie in enumerate(trip.sorties):
                if time.perf_counter() >= until:
                    yield Worth(index, number, flight, None, is_tried=False)
                    continue
                nodes = [visit.node for visit in sortie.visits]
                driven = drive(problem, solution, nodes, setting, judged)
                yield Worth(index, number, flight,
                            None if driven is None else driven.evaluation.cost.total - cost)


def drive(problem: Problem, solution: Solution, nodes: Sequence[int], setting: Setting,
          judged: Mapping[int, JudgedRoute] | None = None) -> Trial | None:
    """Return a plan in which trucks serve some customers, each at the cheapest place tried.

    None: one of them can't be served at any of these. `judged` are the plan's routes, if known.
    """
    best: Trial | None = None
    for node in nodes:
        bench = Bench(problem, solution, node, setting, judged)
        best, judged = _best_by_truck(bench) if bench.done_by is None else None, None
        if best is None:
            return None
        solution = best.solution
    return best


def _best_by_truck(bench: Bench) -> Trial | None:
    """Return the cheapest legal plan that has a truck serve the customer."""
    screen = Screen(bench.problem, bench.left_out.solution, bench.node, bench.setting.past,
                    BY_TRUCK)
    legal: list[Trial] = []
    for turn, guess in enumerate(best_first(screen.guesses())[:MORE_TRIES]):
        if turn < TRIES or not legal:
            trial = bench.put(guess.place)
            legal += [trial] if trial.evaluation.is_feasible else []
    return min(legal, key=lambda trial: trial.rank, default=None)
