"""Plans chosen against the lateness that is to be expected, where that has a price.

The search knows no chances. Round by round, some windows that are likely to be missed end sooner
for it, and it goes on from the best plan so far. Where that is cheaper with the lateness to be
expected, by the windows as they are stated, plan and windows stay.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from model.counsel.lateness.drawn import Spread
from model.counsel.lateness.outlook import expectations, late_hours
from model.judge.check import Evaluation, judge_route
from model.judge.retiming import read_route
from model.judge.timing import schedule
from model.planner import Listener, PlanCheckError, Planner, PlanOptions, PlanResult
from model.problem import Problem
from model.replanning.amend import repaired_route
from model.replanning.refusing import SettledPartError
from model.replanning.replan import Replanning, Terms
from model.solution import Route, Solution

FIRST_SHARE = 0.4
"""Of the time limit, for the plan by the windows as they are."""

TRIED = tuple((share, buffer) for share in (1.0, 0.3, 0.1) for buffer in (0.5, 1.0, 1.6))
"""How many of the customers with the most lateness to be expected have windows that end sooner, and
by how many standard deviations of their start of service, round by round."""

LEAST_ROUND = 0.15
"""Seconds that a round has at least: the fewer there are."""

COOLED = 0.6
"""Of the search's cooling, from the second plan on."""

REFUSED = (PlanCheckError, SettledPartError, ValueError)
"""What comes of windows by which what has happened, or anything at all, can't be."""

Plan = Callable[[PlanOptions, Listener], PlanResult]
Further = Callable[[Problem, Solution, PlanOptions, Listener], PlanResult]
"""Plans a problem with other windows, from a plan on."""


@dataclass(frozen=True)
class Priced:
    """A judged plan, and what it costs with the lateness to be expected."""

    result: PlanResult
    cost: float


@dataclass(frozen=True)
class RiskSearch:
    """Searches for a plan.

    Parameters
    ----------
    stated, judged
        The problem, and as plans of it are judged.
    spread, cost_per_hour
        How far times are off, and the price of an hour of lateness.
    now
        When what has happened ends, in ms.
    check
        Judges a plan.
    """

    stated: Problem
    judged: Problem
    spread: Spread
    cost_per_hour: float
    now: int
    check: Callable[[Solution], Evaluation]

    def find(self, options: PlanOptions, listener: Listener, plan: Plan,
             further: Further) -> PlanResult:
        """Return the cheapest plan; raises as `plan` does."""
        results = [plan(_part(options, FIRST_SHARE), listener)]
        best, sooner = self._priced(results[0]), dict[int, int]()
        quiet = Listener(listener.should_stop)
        rounds = self._rounds(options)
        share = (1 - FIRST_SHARE) / len(rounds)
        for number, (among, buffer) in enumerate(rounds, 1):
            if not best.cost > best.result.evaluation.cost.total or listener.should_stop():
                break
            tried = sooner | self._buffers(best.result.solution, among, buffer)
            until = replace(_part(options, FIRST_SHARE + number * share, share), cooled=COOLED)
            other = self._other(best.result, self._ending(tried), until, quiet, further)
            if other is not None:
                results.append(other.result)
                if other.cost < best.cost:
                    best, sooner = other, tried
        return replace(best.result,
                       search_iterations=sum(each.search_iterations for each in results),
                       deterministic=all(each.deterministic for each in results),
                       decoded_cost=results[0].decoded_cost, start=results[0].start)

    def _rounds(self, options: PlanOptions) -> Sequence[tuple[float, float]]:
        if options.search_iterations is not None:
            return TRIED
        room = int((1 - FIRST_SHARE) * options.time_limit / LEAST_ROUND)
        return TRIED[::max(1, len(TRIED) // max(1, room))]

    def _other(self, best: PlanResult, problem: Problem, options: PlanOptions,
               listener: Listener, further: Further) -> Priced | None:
        """Return a plan by windows that end sooner; None: there is none that is legal."""
        try:
            result = further(problem, best.solution, options, listener)
        except REFUSED:
            return None
        evaluation = self.check(result.solution)
        if evaluation.violations:
            return None
        return self._priced(replace(result, evaluation=evaluation,
                                    final_cost=evaluation.cost.total))

    def _priced(self, result: PlanResult) -> Priced:
        late = late_hours(self.judged, result.solution, self.spread, self.now)
        return Priced(result, result.evaluation.cost.total + late * self.cost_per_hour)

    def _buffers(self, plan: Solution, among: float, buffer: float) -> dict[int, int]:
        """Return by how many ms some customers' windows are to end sooner, by their nodes."""
        late = sorted([(each.expected, node, each.deviation) for node, each in expectations(
            self.judged, plan, self.spread, self.now) if each.expected > 0], reverse=True)
        return {node: round(buffer * deviation)
                for _, node, deviation in late[:math.ceil(among * len(late))]}

    def _ending(self, sooner: Mapping[int, int]) -> Problem:
        """Return the problem with windows that end sooner, but not before they begin."""
        first, customers = self.stated.num_depots, list(self.stated.customers)
        for node, by in sooner.items():
            if node - first < len(customers):
                each = customers[node - first]
                customers[node - first] = replace(
                    each, latest=max(each.openings[-1], each.latest - by))
        return replace(self.stated, customers=tuple(customers))


def further(planner: Planner, received_at: float, terms: Terms | None) -> Further:
    """Return what plans on: as a plan given goes on by some terms, or from nothing."""
    def plan_on(problem: Problem, plan: Solution, options: PlanOptions,
                listener: Listener) -> PlanResult:
        if terms is None:
            begun = without_late(problem, plan)
            return planner.plan(problem, options, received_at, listener, begun)
        return Replanning(problem, terms).plan(planner, options, received_at, listener, plan)

    return plan_on


def without_late(problem: Problem, plan: Solution) -> Solution:
    """Return a plan of another problem without those for whom it breaks rules there."""
    routes = []
    for route in plan.routes:
        mended: Route | None = route
        if judge_route(problem, route, "").violations:
            mended = repaired_route(problem, read_route(problem, route), (),
                                    [partial(schedule, problem)])
        if mended is not None:
            routes.append(mended)
    served = {node for route in routes for trip in route.trips for node in (
        *(stop.node for stop in trip.customer_stops),
        *(node for sortie in trip.sorties for node in sortie.nodes))}
    return Solution(tuple(routes), tuple(problem.left_out(served)))


def _part(options: PlanOptions, until: float, share: float | None = None) -> PlanOptions:
    """Return options for a search that ends after a share of the time, with that of iterations."""
    iterations = options.search_iterations
    return replace(options, time_limit=until * options.time_limit,
                   search_iterations=None if iterations is None
                   else round((until if share is None else share) * iterations))
