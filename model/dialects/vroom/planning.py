"""Plans a VROOM request in a limited time: by VROOM's objective, one stage after another.

VROOM maximises the sum of the priorities of jobs served, then their number, then minimises cost.
Where not all can be served, a stage of its own chooses whom, by what leaving each job out costs.
What the planner can't be told of VROOM's rules it is told more strictly, and VROOM's judge each
route.
"""

import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter

from model.dialects.vroom.checking import drive, route_faults
from model.dialects.vroom.convert import Converter
from model.dialects.vroom.exact import best_routes, is_few
from model.dialects.vroom.models import Model, Routes
from model.dialects.vroom.places import Sites
from model.dialects.vroom.prices import leave_out_by_priority
from model.dialects.vroom.request import Request
from model.dialects.vroom.work import UNHURRIED, LegLimit, VroomWork, attempt_seconds, model_seconds
from model.judge.check import check
from model.planner import PlanCheckError, PlanOptions, PlanResult
from model.problem import Problem
from model.solution import Solution

logger = logging.getLogger(__name__)

LEAST_SECONDS = 0.01
"""Shortest time limit of a stage."""

FIRST_LOOK = 0.1
"""Share of the time for learning whether all jobs can be served."""

CHOOSING_JOBS = 0.7
"""Share of the rest for choosing whom to serve, if not; the remainder is for the routes."""

FEW_SECONDS = 2.0
"""For how long the best plan for few jobs is sought, however little time is stated."""

SPARE = 3.0
"""Stages pay while there is time for so many problems to be built and planned."""

Plan = Callable[[Problem, PlanOptions, Solution], PlanResult]
"""Plans a problem from a plan to improve."""


@dataclass(frozen=True, eq=False)
class VroomPlan:
    """A plan for a request."""

    routes: Routes
    served: frozenset[int]  # jobs
    value: tuple[int, int, int]  # priorities served, jobs served, and minus the cost


class Planning:
    """Plans one request.

    Raises
    ------
    RefusedError
        If the request asks for what the planner can't do, or for too much.
    """

    def __init__(self, request: Request, places: Sites, plan: Plan, options: PlanOptions,
                 max_legs: LegLimit, preparing: VroomWork = UNHURRIED) -> None:
        self._plan = plan
        self._options = options
        self._request = request
        self._places = places
        self._converter = Converter(request, places, max_legs)
        self.kinds = self._converter.kinds
        self._priorities = [job.priority for job in request.jobs]
        self._costs: dict[tuple[int, tuple[int, ...]], int | None] = {}
        self._preparing = preparing
        self._has_tried = False
        self.refused = 0  # plans on the way that broke a rule: errors of the planner

    def find(self, deadline: float, start: Routes) -> VroomPlan:
        """Return the best plan found until `deadline`, on `time.perf_counter`.

        Parameters
        ----------
        start
            Feasible routes to begin with; may be empty.
        """
        jobs = range(len(self._request.jobs))
        model = self._converter.model(jobs, self._preparing)
        best = self._best_of_few(jobs, deadline)
        if best is not None:
            return best
        servable = model.servable()
        if not servable:
            return self._judged(start)
        price = self._price(model)
        if len(servable) < len(model.nodes.jobs) and self._left(deadline) > SPARE * price:
            model = self._converter.model(servable)
        if len({self._priorities[job] for job in servable}) == 1:
            return self._improve(model, self._left(deadline), start)
        if self._left(deadline) < SPARE * price:
            everyone = leave_out_by_priority(model, self._priorities)
            return self._improve(everyone, self._left(deadline), start)
        found = self._improve(model, FIRST_LOOK * self._left(deadline), start)
        if len(found.served) < len(servable):
            everyone = leave_out_by_priority(model, self._priorities)
            found = self._improve(everyone, CHOOSING_JOBS * self._left(deadline), found.routes)
            if not found.served or self._left(deadline) < price:
                return found
            model = self._converter.model(sorted(found.served))
        return self._improve(model, self._left(deadline), found.routes)

    def _best_of_few(self, jobs: Sequence[int], deadline: float) -> VroomPlan | None:
        """Return the best plan for few jobs; None for more, or where it isn't found in time."""
        breaks = max(len(kind.stated.breaks) for kind in self.kinds)
        if not is_few(len(jobs), len(self.kinds), breaks):
            return None
        until = max(deadline, time.perf_counter() + FEW_SECONDS)
        vehicles = [number for number, kind in enumerate(self.kinds)
                    for _ in kind.vehicles[:len(jobs)]]
        routes = best_routes(self._request, self._places, self.kinds, jobs, vehicles,
                             lambda: self._left(until) <= 0)
        return None if routes is None else self._judged(routes)

    def _left(self, deadline: float) -> float:
        """Return the seconds left, none once nobody waits for more."""
        return 0.0 if self._preparing.should_stop() else deadline - time.perf_counter()

    def _price(self, model: Model) -> float:
        """Return about how long it takes to build a model again and to plan it, without search."""
        nodes, each = model.problem.num_nodes, len(model.problem.travel)
        return model_seconds(nodes, each) + attempt_seconds(nodes, each)

    def _improve(self, model: Model, seconds: float, start: Routes) -> VroomPlan:
        """Plan a problem, if there is time or no plan yet; return no worse than `start`."""
        deadline, best = time.perf_counter() + seconds, self._judged(start)
        if self._has_tried and seconds < _price_of(model.problem):
            return best
        self._has_tried = True
        given = self._given(model, start)
        options = replace(self._options, time_limit=max(LEAST_SECONDS, self._left(deadline)))
        found = self._sound(model.routes(self._plan(model.problem, options, given).solution))
        return max(best, found, key=attrgetter("value"))

    def _given(self, model: Model, start: Routes) -> Solution:
        """Return routes as a plan for a model; nothing, if they break its rules.

        What keeps VROOM's may break those of a stricter problem. With nothing the search begins by
        insertion, not by the policy.
        """
        given = model.solution(start)
        return model.solution({}) if check(model.problem, given).violations else given

    def _judged(self, routes: Routes) -> VroomPlan:
        """Return routes with their value.

        Raises
        ------
        PlanCheckError
            If one breaks a rule.
        """
        costs = [self._route_cost(kind, tuple(jobs))
                 for kind, its_routes in routes.items() for jobs in its_routes]
        if None in costs:
            raise PlanCheckError(" ".join(
                fault for kind, its_routes in routes.items() for jobs in its_routes
                for fault in route_faults(self._request, self._places,
                                          self.kinds[kind].vehicles[0], jobs)))
        served = [job for its_routes in routes.values() for jobs in its_routes for job in jobs]
        return VroomPlan(routes, frozenset(served),
                         (sum(self._priorities[job] for job in served), len(served),
                          -sum(cost for cost in costs if cost is not None)))

    def _sound(self, routes: Routes) -> VroomPlan:
        """Return those routes that keep all rules, as all should, with their value; counts where
        they don't. In place.
        """
        sound = {kind: [jobs for jobs in its_routes
                        if self._route_cost(kind, tuple(jobs)) is not None]
                 for kind, its_routes in routes.items()}
        plan = self._judged({kind: its_routes for kind, its_routes in sound.items() if its_routes})
        if len(plan.served) < sum(len(jobs) for its in routes.values() for jobs in its):
            self.refused += 1
            logger.error("plan refused: a route breaks a rule of VROOM's")
        return plan

    def _route_cost(self, kind: int, jobs: tuple[int, ...]) -> int | None:
        """Return the cost of a route, None if it breaks a rule; each is looked at once."""
        key = (kind, jobs)
        if key not in self._costs:
            vehicle = self.kinds[kind].vehicles[0]
            faults = route_faults(self._request, self._places, vehicle, jobs)
            self._costs[key] = (None if any(faults)
                                else drive(self._request, self._places, vehicle, jobs).cost)
        return self._costs[key]


def _price_of(problem: Problem) -> float:
    return attempt_seconds(problem.num_nodes, len(problem.travel))
