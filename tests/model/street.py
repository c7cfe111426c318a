"""Plans on a street, their times in minutes, and how they go on."""

from dataclasses import replace
from typing import Any

from model.judge.timing import RouteDecision, TripDecision, schedule
from model.planner import Planner, PlanOptions
from model.problem import Problem
from model.replanning.replan import Replanning, Terms
from model.solution import Route, Solution, Trip, Vehicle

MINUTE = 60_000
ONE, TWO = Vehicle(0, 0), Vehicle(0, 1)
A, B, C, D = 1, 2, 3, 4

OPTIONS = PlanOptions("any", time_limit=60.0, search_iterations=50)
NO_POLICY: dict[str, Any] = {"any": None}
"""A plan is always given, so that no policy is asked."""


def replan(planner: Planner, problem: Problem, terms: Terms,
           options: PlanOptions = OPTIONS) -> Solution:
    """Replan, and hold the result against the checker."""
    replanning = Replanning(problem, terms)
    result = replanning.plan(planner, options)
    assert result.start == "given"
    assert replanning.check(result.solution).violations == ()
    assert result.final_cost == result.evaluation.cost.total <= result.decoded_cost
    return result.solution


def planned(problem: Problem, *routes: tuple[tuple[int, ...], ...]) -> Solution:
    """Return the plan in which trucks 1, 2, … visit these nodes, a tuple a trip."""
    decisions = [RouteDecision(0, number, tuple(TripDecision((0, *trip, 0)) for trip in trips))
                 for number, trips in enumerate(routes)]
    return solution_of(problem, *decisions)


def solution_of(problem: Problem, *decisions: RouteDecision) -> Solution:
    """Return the plan of these decisions; who isn't in them is left out."""
    routes = tuple(schedule(problem, decision) for decision in decisions)
    nodes = range(problem.num_depots, problem.num_nodes)
    return Solution(routes, tuple(node for node in nodes if node not in served(*routes)))


def served(*routes: Route) -> set[int]:
    """Return whom routes serve."""
    return {node for route in routes for trip in route.trips
            for node in (*(stop.node for stop in trip.stops[1:-1]),
                         *(visit.node for sortie in trip.sorties for visit in sortie.visits))}


def minutes(trip: Trip) -> list[tuple[int, float, float]]:
    """Return a trip's stops: node, arrival and departure in minutes."""
    return [(stop.node, stop.arrival / MINUTE, stop.departure / MINUTE) for stop in trip.stops]


def route_of(solution: Solution, vehicle: Vehicle) -> Route:
    """Return a vehicle's route."""
    return next(route for route in solution.routes
                if route.driven_by == vehicle)


def with_customer(problem: Problem, node: int, **changes: object) -> Problem:
    """Return a problem in which one customer is another."""
    customers = list(problem.customers)
    customers[node - 1] = replace(customers[node - 1], **changes)
    return replace(problem, customers=tuple(customers))


def with_trucks(problem: Problem, **changes: Any) -> Problem:
    """Return a problem whose trucks are others."""
    return replace(problem, vehicle_types=tuple(replace(kind, **changes)
                                                for kind in problem.vehicle_types))
