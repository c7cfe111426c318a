"""Plans to and from the routes of a search."""

from collections.abc import Sequence

import numpy as np

from model.engine.alarm import Alarm
from model.engine.library import call
from model.engine.plans import numbers_of, told
from model.problem import Problem
from model.search.route.room import room_for
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.solution import Route, Solution, renumbered


def make_searcher(problem: Problem, data: ProblemData, solution: Solution,
                  seed: np.random.SeedSequence) -> Searcher:
    """Begin a search from a plan; routes that it can't read are left to be planned anew."""
    searcher = Searcher(data, room_for(problem, data, solution), seed)
    call("tandem_begin", data, searcher, numbers_of(solution.routes))
    return searcher


def left_out(data: ProblemData, searcher: Searcher) -> tuple[int, ...]:
    """Return the customers that the best plan leaves out, all ends of a shipment."""
    missing = searcher.best_missing[: searcher.count.best_missing].tolist()
    if len(data.pair):
        # Who stands for a shipment has all others of it behind.
        is_end, unit = data.pair["partner"] >= 0, data.pair["unit"]
        missing += np.flatnonzero(
            is_end & np.isin(unit, missing) & (unit != np.arange(len(unit)))).tolist()
    return tuple(sorted(missing))


def read_routes(data: ProblemData, searcher: Searcher) -> tuple[Route, ...]:
    """Return the routes of the best plan found, each trip begun as late as costs nothing.

    That has its time however late it is: routes as they were searched for may begin too soon.
    """
    return told("tandem_tell_best", data._replace(deadline=Alarm().setting), searcher)


def best_plan(data: ProblemData, searcher: Searcher, node: Sequence[int]) -> Solution:
    """Return a search's best plan by the problem's numbers, which `node` has by the search's."""
    plan = Solution(read_routes(data, searcher), left_out(data, searcher))
    return renumbered(plan, node.__getitem__)
