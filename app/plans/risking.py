"""Plans chosen against the lateness that is to be expected, where that has a price.

The search knows no chances. Round by round, one or some of the windows that are likely to be missed
end sooner for it, and it goes on from the best plan so far. Where that is cheaper with the lateness
to be expected, by the windows as they are stated, plan and windows stay; else others are next.
"""

import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial

from model.counsel.lateness.drawn import Spread
from model.counsel.lateness.outlook import expectations, late_hours
from model.judge.check import Evaluation, judge_route
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import read_route, time_route
from model.judge.timing import RouteDecision
from model.planner import Listener, PlanCheckError, Planner, PlanOptions, PlanResult
from model.problem import Problem
from model.problem.altered import with_customers
from model.replanning.amend import repaired_route
from model.replanning.handover import complete
from model.replanning.refusing import SettledPartError
from model.replanning.replan import Replanning, Terms
from model.solution import Route, Solution

FIRST_SHARE = 0.5
"""Of the time limit, for the plan without a price."""

ROUNDS, LEAST_ROUND = 20, 0.1
"""How many there are at most, and the seconds that each has at least."""

TOGETHER = (1, 3)
"""How many windows end sooner at once, round by round in turns."""

BUFFER = 1.3
"""By how many standard deviations of the start of service."""

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
        began = time.perf_counter()
        results = [plan(_part(options, FIRST_SHARE), listener)]
        # What a round may take, which is more than its share where all is begun anew each time.
        longest = time.perf_counter() - began - FIRST_SHARE * options.time_limit
        best, sooner, passed = self._priced(results[0]), dict[int, int](), 0
        quiet, rounds = Listener(listener.should_stop), self._rounds(options)
        share = (1 - FIRST_SHARE) / rounds
        for number in range(rounds):
            buffers = self._buffers(best.result.solution)
            since = time.perf_counter()
            if listener.should_stop() or since - began + longest > options.time_limit:
                break
            # Where nobody is late, what is left of the time is for the costs alone.
            lasting = 1 if buffers else rounds - number
            first = passed % max(1, len(buffers))
            tried = sooner | dict(buffers[first:first + TOGETHER[number % len(TOGETHER)]])
            until = _part(options, FIRST_SHARE + (number + lasting) * share, lasting * share)
            other = self._other(best.result, self._ending(tried), until, quiet, further)
            passed, longest = passed + 1, max(longest, time.perf_counter() - since)
            if other is not None:
                results.append(other.result)
                if other.cost < best.cost:
                    best, sooner, passed = other, tried, 0
            if not buffers:
                break
        return replace(best.result,
                       search_iterations=sum(each.search_iterations for each in results),
                       deterministic=all(each.deterministic for each in results),
                       decoded_cost=results[0].decoded_cost, start=results[0].start)

    def _rounds(self, options: PlanOptions) -> int:
        if options.search_iterations is not None:
            return ROUNDS
        return max(1, min(ROUNDS, int((1 - FIRST_SHARE) * options.time_limit / LEAST_ROUND)))

    def _other(self, best: PlanResult, problem: Problem, options: PlanOptions,
               listener: Listener, further: Further) -> Priced | None:
        """Return a plan by windows that end sooner; None: there is none that is legal."""
        try:
            result = further(problem, best.solution, replace(options, cooled=COOLED), listener)
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

    def _buffers(self, plan: Solution) -> list[tuple[int, int]]:
        """Return by how many ms windows might end sooner, by nodes, the most lateness first."""
        late = sorted([(each.expected, node, each.deviation) for node, each in expectations(
            self.judged, plan, self.spread, self.now) if each.expected > 0], reverse=True)
        return [(node, round(BUFFER * deviation)) for _, node, deviation in late
                if node < self.stated.num_nodes]

    def _ending(self, sooner: Mapping[int, int]) -> Problem:
        """Return the problem with windows that end sooner, but not before they begin."""
        ending = {node: (self.stated.customer_at(node), by) for node, by in sooner.items()}
        return with_customers(self.stated, {
            node: replace(each, latest=max(each.openings[-1], each.latest - by))
            for node, (each, by) in ending.items()})


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
    return complete(problem, tuple(_mended(problem, plan)))


def _mended(problem: Problem, plan: Solution) -> Iterator[Route]:
    for route in plan.routes:
        mended: Route | None = route
        if judge_route(problem, route, "").violations:
            free = read_route(problem, route)
            free = replace(free, trips=tuple([
                replace(trip, operations=None, start=None) for trip in free.trips]))
            mended = repaired_route(problem, free, (), [partial(_timed, problem)])
        if mended is not None:
            yield mended


def _timed(problem: Problem, decision: RouteDecision) -> Route:
    return time_route(problem, decision, "", EVERYTHING_OPEN).route


def _part(options: PlanOptions, until: float, share: float | None = None) -> PlanOptions:
    """Return options for a search that ends after a share of the time, with that of iterations."""
    iterations = options.search_iterations
    return replace(options, time_limit=until * options.time_limit,
                   search_iterations=None if iterations is None
                   else round((until if share is None else share) * iterations))
