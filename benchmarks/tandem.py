"""Tandem as one of the solvers compared: its search, from nothing."""

import time
from functools import lru_cache

from benchmarks.peers import PeerAnswer
from benchmarks.published import Published, to_problem
from model.instance import pack
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.solution import Route, Solution

VERSION = "0.2.0"


@lru_cache(maxsize=1)
def _problem(instance: Published) -> Problem:
    return to_problem(instance)


def _trips(route: Route) -> list[list[int]]:
    return [[stop.node for stop in trip.stops[1:-1]] for trip in route.trips]


def solve(instance: Published, seconds: float, seed: int, threads: int) -> PeerAnswer:
    """Plan an instance within `seconds`, all of the search's preparations included."""
    problem = _problem(instance)
    nothing = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    began = time.perf_counter()
    improved = improve(problem, pack([problem], neighbours=False), nothing,
                       SearchConfig(seed, threads), began + seconds)
    routes = [(route.vehicle_type, _trips(route)) for route in improved.solution.routes]
    return PeerAnswer(routes, time.perf_counter() - began, VERSION)
