"""Searches of what is left of a plan, and what they come to as a whole."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from model.judge.check import Evaluation, check
from model.judge.past import Past
from model.planner import (
    Completed, Elapsed, Listener, Planner, PlanOptions, PlanResult, Progress, complete_plan,
)
from model.problem import Problem
from model.replanning.handover import take_back
from model.replanning.kept import Kept
from model.replanning.order import in_order
from model.replanning.remainder import Remainder
from model.replanning.undoing import take_back_changes
from model.solution import Solution, Vehicle

TAKING_BACK = 0.1
"""Share of the time limit in which changes are taken back, after each of two searches."""


@dataclass(frozen=True)
class Bridge:
    """From plans of what is left to plans of the whole."""

    problem: Problem
    past: Past
    plan: Solution  # given
    kept: Mapping[Vehicle, Kept]
    left: Remainder

    def whole(self, found: Solution) -> Solution:
        """Return the plan of the whole."""
        return take_back(self.problem, self.past, self.plan, self.kept, self.left, found)


def begin(left: Remainder, begun: Solution, options: PlanOptions,
          should_stop: Callable[[], bool], has_orders: bool) -> Completed:
    """Return what is left of the plan given; if no search follows, with those whom it lacks.

    They are inserted where that costs least, as a search does at its beginning. Where some keep
    their places in the order, windows leave it little room to do so later.
    """
    searches = options.time_limit > 0 and options.search_iterations != 0 and not has_orders
    if searches or not begun.unassigned:
        return Completed(begun, True)
    filled = complete_plan(left.problem, begun, options.seed, should_stop)
    before, after = check(left.problem, begun), check(left.problem, filled.solution)
    if after.is_feasible and after.cost.total <= before.cost.total:
        return filled
    return filled._replace(solution=begun)


def relayed(listener: Listener, first_cost: float, bridge: Bridge) -> Listener:
    """Return a listener to the plan of what is left, whose first plan costs so much as a whole."""
    apart: list[float] = []

    def relay(progress: Progress) -> None:
        if not apart:
            apart.append(first_cost - progress.cost)
        listener.on_progress(replace(progress, cost=progress.cost + apart[0],
                                     plan=lambda: bridge.whole(progress.plan())))

    return Listener(listener.should_stop, relay)


def joined(results: Sequence[PlanResult], known: tuple[Solution, Evaluation], first_cost: float,
            whole: bool, began: float) -> PlanResult:
    """Return the result of some searches, the cheapest plan of the whole being known."""
    solution, evaluation = known
    search, checked = (sum([getattr(each.elapsed, phase) for each in results])
                       for phase in ("search", "check"))
    return replace(
        results[-1], solution=solution, evaluation=evaluation, start="given",
        decoded_cost=first_cost, final_cost=evaluation.cost.total,
        search_iterations=sum([each.search_iterations for each in results]),
        deterministic=whole and all(each.deterministic for each in results),
        elapsed=Elapsed(time.perf_counter() - began - search - checked, search, checked),
        refused=sum([each.refused for each in results]))


@dataclass(frozen=True)
class SearchOfRest:
    """One search of what is left."""

    left: Remainder
    problem: Problem  # that of what is left, or one with narrower windows
    options: PlanOptions
    takes_back: float | None = None
    """Seconds of the time limit by which changes are taken back afterwards; None: none are."""

    def find(self, planner: Planner, received_at: float, listener: Listener, handed: Solution,
             first: Solution, cost: Callable[[Solution], float]) -> PlanResult:
        """Search from a first plan.

        Parameters
        ----------
        planner, received_at, listener
            As for `Planner.plan`.
        handed
            What is left of the plan given.
        first
            The plan to begin with.
        cost
            Told of each plan; returns what it costs as a whole, infinite if it is illegal.
        """
        result = planner.plan(self.problem, self.options, received_at, listener, first)
        if self.takes_back is None:
            cost(result.solution)
        else:
            take_back_changes(self.left.problem, handed, result.solution, cost,
                              received_at + self.takes_back)
        return result


def searches(left: Remainder, past: Past, first: Solution,
             options: PlanOptions) -> Iterator[SearchOfRest]:
    """Yield the searches of what is left.

    What places and promised times cost no search knows. So one keeps all at theirs, and new ones
    come between; the next is free. Behind each, changes are taken back; the cheapest plan counts.
    """
    limit, turns, here = options.time_limit, options.search_iterations, left.numbers
    if past.orders:
        pinned = {here[node] for node, vehicle in past.pinned.items()
                  if node in here and vehicle in past.orders}
        orders = [[here[node] for node in order if node in here]
                  for order in past.orders.values()]
        yield SearchOfRest(left, in_order(left.problem, first, pinned, orders), options)
    elif past.earlier is None or not past.earlier.prices.by_place or limit == 0 or turns == 0:
        yield SearchOfRest(left, left.problem, options)
    else:
        for share, problem in ((0.5, in_order(left.problem, first, here.values())),
                               (1.0, left.problem)):
            yield SearchOfRest(left, problem, replace(
                options, time_limit=(share - TAKING_BACK) * limit,
                search_iterations=None if turns is None else turns // 2), share * limit)
