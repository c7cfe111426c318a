"""Random problems with shipments, planned and planned on, also as vehicles break down with some."""

from dataclasses import replace

import numpy as np
import pytest

from model.planner import Planner
from model.problem import Problem, Relation, RelationKind, Shipment
from model.replanning.replan import Replanning, Terms
from model.solution import Solution, Vehicle
from tests.model.replanning.test_replan_random import (
    OPTIONS, assert_unchanged, begun, instants, lost, nobody, replan_later, something_happens,
)
from tests.model.street import ONE, TWO, A, B, C, D, planned, replan, route_of
from tests.model.street import served as served_on
from tests.model.tiny import draw_tiny
from tests.model.tiny_shipments import with_shipments


def parts_of(problem: Problem, plan: Solution) -> dict[int, tuple[Vehicle, int]]:
    """Return on which vehicle's trip ends of shipments are served."""
    return {stop.node: (route.driven_by, number)
            for route in plan.routes for number, trip in enumerate(route.trips)
            for stop in trip.stops if stop.node in problem.shipment_at}


def fetched_at(problem: Problem, plan: Solution) -> int | None:
    """Return when the first shipment that a plan brings has been fetched; None: it brings none."""
    return min((stop.departure for route in plan.routes for trip in route.trips
                for stop in trip.customer_stops if stop.node in problem.shipment_at), default=None)


@pytest.mark.thorough_after(10)
@pytest.mark.parametrize("seed", [
    *range(0, 60, 2), 11, 17, 27, 53, 59, 93, 137, 183, 203, 213, 283, 295])
def test_tiny_plans_with_shipments_go_on(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((seed, 16))
    problem = with_shipments(rng, draw_tiny(rng))
    plan = planner.plan(problem, OPTIONS, start=nobody(problem)).solution
    if not plan.routes:
        return
    times = instants(plan)
    now = int(rng.choice(times))
    problem = something_happens(rng, problem, max(times))
    broken: frozenset[Vehicle] = frozenset()
    if seed % 2:
        now = fetched_at(problem, plan) or now
        broken = frozenset(route.driven_by for route in plan.routes
                           if rng.random() < 0.7)
    terms = Terms(plan, now, unavailable=broken, grounded=lost(rng, problem))
    replanning = Replanning(problem, terms)
    result = replanning.plan(planner, OPTIONS)
    assert replanning.check(result.solution).violations == ()
    assert_unchanged(problem, plan, result.solution, now, broken)
    stays, before = parts_of(problem, result.solution), parts_of(problem, plan)
    for route in plan.routes:
        vehicle = route.driven_by
        if vehicle in broken:
            continue
        for number, _, _ in begun(problem, route, now):
            for node in (node for node, part in before.items() if part == (vehicle, number)):
                assert stays[node] == (vehicle, number)
    for node in result.solution.unassigned:
        assert len(replanning.reasons(result.solution, node)) == len(problem.vehicle_types)
    replan_later(planner, problem, result.solution, now + (max(times) - now) // 2, broken)


@pytest.mark.parametrize(("kind", "served"), [("together", {D, C}), ("apart", {D})])
def test_who_goes_with_a_shipment_does_so_with_whoever_delivers_it_now(
        planner: Planner, street: Problem, kind: RelationKind, served: set[int]) -> None:
    """The first truck breaks down once it has fetched at A what is brought to D."""
    customers = tuple([replace(each, demand=(0,), unassigned_cost=10.0 if node == C else 100.0)
                       for node, each in enumerate(street.customers, 1)])
    problem = replace(street, customers=customers, shipments=(Shipment("s", A, D, (1000,)),),
                      relations=(Relation(kind, (A, C)),))
    plan = planned(problem, ((A, D),))
    now = plan.routes[0].trips[0].stops[1].departure
    found = replan(planner, problem, Terms(plan, now, unavailable=frozenset({ONE})))
    assert served_on(route_of(found, TWO)) - {B} == served
