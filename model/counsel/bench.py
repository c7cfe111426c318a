"""A plan without one customer, or one shipment, that is put at places of it by way of trial.

All others stay where they are, in their order. Each trial is a whole plan that was judged.
"""

import math
from collections.abc import Collection, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace

from model.counsel.priced import Offer, legal_offers
from model.counsel.screening import Guess, Screen, Wanted, of_any
from model.counsel.shipment_screening import ShipmentScreen
from model.judge.check import Evaluation, JudgedRoute, check, judge_route
from model.judge.clock import with_all_setups
from model.judge.ends import with_ends
from model.judge.lags import Awaited, soonest_across
from model.judge.launch_sites import without_idle_stops
from model.judge.metrics import unassigned_cost
from model.judge.past import EVERYTHING_OPEN, Past
from model.judge.places import (
    Found, Means, Place, changed, find_place, find_shipment, route_with, routes_without,
)
from model.judge.retiming import TimedRoute, read_route, time_route
from model.judge.rules import Violation
from model.judge.timing import RouteDecision
from model.problem import Problem, Shipment
from model.search.driven import driven_by_search
from model.solution import Solution, Vehicle


MOST_LEGS = 5_000_000
"""Legs of a problem up to which the search is asked: to open it takes 0.04 s for a million."""


@dataclass(frozen=True)
class Trial:
    """A customer or shipment at a place, or left out, and what the judge says of the whole plan."""

    place: Place | None
    solution: Solution
    evaluation: Evaluation

    @property
    def rank(self) -> tuple[int, float]:
        """What is smaller for a better plan: fewest broken rules, then lowest cost."""
        return len(self.evaluation.violations), self.evaluation.cost.total


@dataclass(frozen=True)
class Setting:
    """What a plan is judged by beside the problem: what has happened, and what that broke."""

    past: Past = EVERYTHING_OPEN
    excused: Collection[Violation] = ()

    def judge(self, problem: Problem, solution: Solution,
              known: Mapping[int, JudgedRoute]) -> Evaluation:
        """Judge a plan, some of whose routes were judged before."""
        evaluation = check(problem, solution, self.past, known)
        if not self.excused:
            return evaluation
        return replace(evaluation, violations=tuple(
            [each for each in evaluation.violations if each not in self.excused]))

    def judge_routes(self, problem: Problem, solution: Solution) -> dict[int, JudgedRoute]:
        """Judge each route alone."""
        return {index: judge_route(problem, route, f"routes[{index}]", self.past)
                for index, route in enumerate(solution.routes)}


class Bench:
    """Tries one customer, or all ends of a shipment, at places of a plan that leaves them out.

    Parameters
    ----------
    problem
        What the plan is for.
    solution
        A plan without broken rules.
    node
        The customer; of a shipment the first of its ends.
    setting
        What else it is judged by.
    judged
        Its routes, judged by `setting`; None: they aren't yet.
    shipment
        What is moved as one; None: the customer alone.
    """

    def __init__(self, problem: Problem, solution: Solution, node: int,
                 setting: Setting | None = None,
                 judged: Mapping[int, JudgedRoute] | None = None,
                 shipment: Shipment | None = None) -> None:
        self.problem = problem
        self.node = node
        self.shipment = shipment
        self.nodes = (node,) if shipment is None else shipment.nodes
        self.setting = setting or Setting()
        self.found: Found | None = (find_place(solution, node) if shipment is None
                                    else find_shipment(solution, shipment))
        self.done_by = self._done_by()
        judged = self.setting.judge_routes(problem, solution) if judged is None else judged
        solution = with_all_setups(problem, solution)
        self.plan = Trial(None if self.found is None else self.found.place, solution,
                          self.setting.judge(problem, solution, judged))
        self.left_out, self.judged = self._leave_out(judged)

    def _done_by(self) -> Vehicle | None:
        """Return who has served the customer already; None: nobody."""
        if self.found is None or self.setting.past.served().isdisjoint(self.nodes):
            return None
        return self.found.place.vehicle

    def _leave_out(self, judged: Mapping[int, JudgedRoute]
                   ) -> tuple[Trial, Mapping[int, JudgedRoute]]:
        """Return the plan that leaves the customer out, and its routes as judged."""
        left_out = self.plan
        for node in self.nodes:
            left_out, judged = self._without(left_out, node, judged)
        return left_out, judged

    def _without(self, trial: Trial, node: int, judged: Mapping[int, JudgedRoute]
                 ) -> tuple[Trial, Mapping[int, JudgedRoute]]:
        """Return a plan without one node, and its routes as judged."""
        solution, found = trial.solution, find_place(trial.solution, node)
        if found is None:
            return trial, judged
        index = found.route
        decision = read_route(self.problem, solution.routes[index])
        unassigned = (*solution.unassigned, node)
        ways = [*routes_without(decision, found)]
        if decision.driven_by not in self.setting.past.trips:
            ways = [without_idle_stops(self.problem, way) for way in ways]
        if all(not way.trips for way in ways):
            plan = changed(solution, index, None, unassigned)
            judged = self.setting.judge_routes(self.problem, plan)
        else:
            kind = self.problem.vehicle_types[decision.vehicle_type]
            ways = [way if len(way.trips) == len(decision.trips)
                    else replace(way, trips=with_ends(kind, way.trips)) for way in ways]
            timed = self._best(self.problem, ways, index)
            plan = changed(solution, index, timed.route, unassigned)
            judged = {**judged, index: timed.judged}
        return Trial(None, plan, self.setting.judge(self.problem, plan, judged)), judged

    @property
    def last(self) -> int:
        """The customer's node; of a shipment that of its delivery."""
        return self.node if self.shipment is None else self.shipment.delivery

    def under(self, problem: Problem) -> "Bench":
        """Return what tries the customer, whom the plan leaves out, under other rules of his."""
        other = copy(self)
        other.problem = problem
        return other

    def at_place(self, place: int) -> "Bench":
        """Return what tries the customer at another of his places, of the plan without him."""
        solution = self.left_out.solution
        own = self.problem.places_of(self.node)
        others = [node for node in solution.unassigned if node not in own]
        return Bench(self.problem, replace(solution, unassigned=(*others, place)), place,
                     self.setting, self.judged)

    def _best(self, problem: Problem, ways: Sequence[RouteDecision], index: int) -> TimedRoute:
        """Return the best of several ways to go on with a route."""
        return min([time_route(problem, way, f"routes[{index}]", self.setting.past)
                    for way in ways], key=lambda timed: timed.rank)

    @property
    def without(self) -> float:
        """What the plan costs without the customer, nothing being counted for leaving him out."""
        cost = self.left_out.evaluation.cost
        own = [self.problem.first_place(node) for node in self.nodes]
        return cost.total - unassigned_cost(self.problem, own)

    def guesses(self, problem: Problem | None = None, until: float = math.inf,
                wanted: Wanted = of_any) -> dict[tuple[Vehicle, Means], list[Guess]]:
        """Return the places of each vehicle and means that may be tried, the likeliest first.

        Those that are found until an instant, on `time.perf_counter`; of vehicles `wanted` alone.
        """
        problem, solution = problem or self.problem, self.left_out.solution
        past = self.setting.past
        if self.shipment is None:
            return Screen(problem, solution, self.node, past, wanted=wanted).guesses(until)
        return ShipmentScreen(problem, solution, self.shipment, past, wanted).guesses(until)

    def offers(self, until: float = math.inf) -> dict[tuple[Vehicle, Means], list[Offer]] | None:
        """Return the places of vehicles in use that the search finds legal, the cheapest first.

        None where the search isn't asked, as it doesn't know what has happened, prices routes
        alone where the plan as a whole costs something, and takes long to open where there are
        many legs; or if that would end after an instant.
        """
        legs = self.problem.num_nodes**2 * len(self.problem.travel)
        if (self.setting.past != EVERYTHING_OPEN or self.problem.fairness.is_stated
                or legs > MOST_LEGS):
            return None
        return legal_offers(self.problem, self.left_out.solution, self.nodes, until)

    def decide(self, place: Place, problem: Problem | None = None) -> tuple[int, RouteDecision]:
        """Return the index of a route, and it with the customer at a place, without times."""
        problem = problem or self.problem
        routes = self.left_out.solution.routes
        index = next((index for index, route in enumerate(routes)
                      if route.driven_by == place.vehicle), len(routes))
        kind = problem.vehicle_types[place.vehicle.type]
        decision = (read_route(problem, routes[index]) if index < len(routes)
                    else RouteDecision(place.vehicle.type, place.vehicle.number, ()))
        decision = route_with(decision, place, self.node, (kind.begins_at, kind.ends_at))
        if place.own_trip:
            decision = replace(decision, trips=with_ends(kind, decision.trips))
        return index, decision

    def draft(self, place: Place, problem: Problem | None = None) -> "Drafted":
        """Return the route with the customer at a place; `problem` as in `finish`."""
        problem = problem or self.problem
        index, decision = self.decide(place, problem)
        routes = self.left_out.solution.routes
        before = self.judged[index].cost.total if index < len(routes) else 0.0
        others = [route for number, route in enumerate(routes) if number != index]
        for node in self.nodes:
            if node in problem.lags_across:
                until = soonest_across(problem, others, node)
                decision = replace(decision, trips=tuple([
                    replace(trip, awaited=(*trip.awaited, Awaited(node, until)))
                    for trip in decision.trips]))
        timed = self._best(problem, [decision], index)
        return Drafted(place, index, timed, timed.judged.cost.total - before)

    def as_searched(self, draft: "Drafted") -> "Drafted":
        """Return a route by the times that the search finds for it, where these are better."""
        route = driven_by_search(self.problem, draft.timed.route)
        if route is None:
            return draft
        judged = judge_route(self.problem, route, f"routes[{draft.index}]", self.setting.past)
        more = judged.cost.total - draft.timed.judged.cost.total
        return min(draft, replace(draft, timed=TimedRoute(route, judged), added=draft.added + more),
                   key=lambda each: each.rank)

    def finish(self, draft: "Drafted", problem: Problem | None = None,
               judged: Mapping[int, JudgedRoute] | None = None) -> Trial:
        """Judge the plan with a route.

        Parameters
        ----------
        draft
            The route.
        problem
            What it is judged by; None: the problem as it is.
        judged
            The other routes as `problem` has them judged; None: as the problem as it is does.
        """
        problem, solution = problem or self.problem, self.left_out.solution
        others = tuple([node for node in solution.unassigned if node not in self.nodes])
        plan = changed(solution, draft.index, draft.timed.route, others)
        known = {**(self.judged if judged is None else judged), draft.index: draft.timed.judged}
        return Trial(draft.place, plan, self.setting.judge(problem, plan, known))

    def put(self, place: Place) -> Trial:
        """Return the plan with the customer at a place."""
        return self.finish(self.draft(place))


@dataclass(frozen=True)
class Drafted:
    """A customer at a place, the rest of the plan not being looked at."""

    place: Place
    index: int  # of the route
    timed: TimedRoute
    added: float  # cost of the route, less what it costs without him

    @property
    def rank(self) -> tuple[int, float]:
        """What is smaller for a better place: fewest broken rules, then what it adds."""
        return len(self.timed.judged.violations), self.added
