"""Customers left out, pulled into a plan by a search that may break limits for a while."""

import math
import time
from collections.abc import Callable, Collection, Sequence
from itertools import islice

import numpy as np

from model.judge.check import check, judge_route
from model.engine.instance import pack
from model.engine.pausing import EndedError, pausing
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.search.regions.part import RegionProblem, part_of
from model.search.regions.region import Region
from model.solution import Solution, Vehicle
from model.together.filling import Filling
from model.together.joint import Joint
from model.together.relaxed import relaxed

GROUPS = (1, 2, 3, 5, 8, 13)
"""So many customers are pulled in at once."""

TURNS, TURNS_FOR_ALL = 60, 1000
"""Turns for each customer, and where all are pulled in."""

SHARE_FOR_ALL = 0.4
"""Most of the time left that the search for all takes."""

MOST_LEGS = 2_500_000
"""For so many legs of all types' vehicles it takes a second at most to see where these may go."""

COOLED = 0.5
"""Share of the cooling that is left out, so that much of the plan stays."""


def nobody_served(problem: Problem) -> Solution:
    """Return the plan that serves no customer."""
    return Solution((), problem.left_out(()))


class Pulling:
    """Pulls customers into plans.

    Parameters
    ----------
    problem
        The problem planned.
    joint
        Where its trucks may go.
    should_stop
        Asked while plans are searched and mended.
    deadline
        On `time.perf_counter`; infinite: turns alone count.
    """

    def __init__(self, problem: Problem, joint: Joint, should_stop: Callable[[], bool],
                 deadline: float, rng: np.random.Generator) -> None:
        self._problem = problem
        self._joint = joint
        self._should_stop = should_stop
        self._deadline = deadline
        self._rng = rng
        self._afresh = True

    def pull(self, plan: Solution, everybody: bool) -> Solution:
        """Return a plan that costs less, with some more customers or with all; or the same."""
        chosen = [*plan.unassigned] if everybody else self._some_of(plan.unassigned)
        region = self._region(plan, chosen)
        if not region.vehicles:
            return plan
        part = part_of(self._problem, region)
        if len(part.problem.vehicle_types) * part.problem.num_nodes**2 > MOST_LEGS:
            return plan
        joint = Joint(part.problem, True)
        soft = relaxed(part.problem, joint)
        if soft is None:
            return plan
        mended = self._mended(part, joint, self._searched(soft, part.inward(region.plan),
                                                          everybody))
        kept = [route for route in plan.routes if route not in region.plan.routes]
        rest = set(plan.unassigned).difference(chosen)
        better = Solution((*kept, *part.outward(mended).routes),
                          tuple(sorted(rest.union(part.outward(mended).unassigned))))
        return better if self._cost(better) < self._cost(plan) - 1e-9 else plan

    def _searched(self, soft: Problem, begun: Solution, everybody: bool) -> Solution:
        """Return a plan that may break limits."""
        turns = (TURNS_FOR_ALL if everybody else TURNS) * soft.num_customers
        until = None
        if self._deadline < math.inf:
            now = time.perf_counter()
            until = now + (self._deadline - now) * (SHARE_FOR_ALL if everybody else 1.0)
        cooled = COOLED
        if everybody:
            # In turn from nothing, which comes to other plans.
            self._afresh = not self._afresh
            if self._afresh:
                begun, cooled = nobody_served(soft), 0.0
        config = SearchConfig(int(self._rng.integers(2**32)), turns=turns, cooled=cooled)
        try:
            instance = pack([soft], False, pausing(self._should_stop, self._deadline))
        except EndedError:
            return begun
        return improve(soft, instance, begun, config, until, self._should_stop).solution

    def _cost(self, plan: Solution) -> float:
        return check(self._problem, plan).cost.total

    def _some_of(self, left_out: Sequence[int]) -> list[int]:
        """Draw one who is left out and those nearest to it of them, on the way there or on."""
        first = left_out[int(self._rng.integers(len(left_out)))]
        size = min(len(left_out), int(self._rng.choice(GROUPS)))
        duration = self._problem.travel[self._problem.vehicle_types[0].travel].duration
        others = np.array(left_out)
        away = np.minimum(duration[first, others], duration[others, first])
        return [*others[np.argsort(away, kind="stable")[:size]].tolist()]

    def _region(self, plan: Solution, chosen: Collection[int]) -> Region:
        """Return the routes without flights, with vehicles to spare and some of those left out."""
        routes = tuple([route for route in plan.routes
                        if not any(trip.sorties for trip in route.trips)])
        used = {route.driven_by for route in plan.routes}
        spare: list[Vehicle] = []
        for kind, vehicles in enumerate(self._problem.vehicle_types):
            free = (Vehicle(kind, number) for number in range(vehicles.count)
                    if (kind, number) not in used)
            spare += islice(free, len(chosen))
        return Region(Solution(routes, tuple(sorted(chosen))), tuple(spare))

    def _mended(self, part: RegionProblem, joint: Joint, found: Solution) -> Solution:
        """Return the routes that keep all limits, and what can be kept of the others."""
        problem = part.problem
        judged = [(route, judge_route(problem, route, "")) for route in found.routes]
        kept = tuple([route for route, verdict in judged if not verdict.violations])
        served = {node for route in kept for node in route.served}
        left_out = [node for node in range(problem.num_depots, problem.num_nodes)
                    if node not in served]
        filling = Filling(problem, Solution(kept, tuple(left_out)), joint, self._should_stop,
                          self._rng)
        for route, verdict in judged:
            if verdict.violations:
                filling.put(route.driven_by, verdict.nodes)
        filling.fill(0)
        return filling.plan
