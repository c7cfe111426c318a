"""Tandem as one of the solvers compared: its search, from nothing."""

import time
from functools import lru_cache
from importlib.metadata import version

from benchmarks.peers.answers import PeerAnswer
from benchmarks.peers.published import Published, to_problem
from model.engine.instance import pack
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.solution import Route, Solution

VERSION = version("tandem-planner")


@lru_cache(maxsize=1)
def problem_of(instance: Published) -> Problem:
    """Return the instance as the planner takes it, which is made before the clock runs."""
    return to_problem(instance)


def plan_to_answer(solution: Solution, seconds: float) -> PeerAnswer:
    """Return a plan as other solvers state theirs."""
    routes = [(route.vehicle_type, _trips(route)) for route in solution.routes]
    return PeerAnswer(routes, seconds, VERSION)


def _trips(route: Route) -> list[list[int]]:
    return [[stop.node for stop in trip.stops[1:-1]] for trip in route.trips]


def solve(instance: Published, seconds: float, seed: int, threads: int) -> PeerAnswer:
    """Plan an instance within `seconds`, all of the search's preparations included."""
    problem = problem_of(instance)
    nothing = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    began = time.perf_counter()
    improved = improve(problem, pack([problem], legs=False), nothing,
                       SearchConfig(seed, threads), began + seconds)
    return plan_to_answer(improved.solution, time.perf_counter() - began)
