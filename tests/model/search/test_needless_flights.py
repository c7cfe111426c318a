"""Nobody is flown to who may as well be driven to, where that never costs more."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import Instance, pack
from model.problem import Problem, Travel
from model.search.needless_flights import without_needless_flights
from model.search.problem_data import make_data
from model.search.strategy import ALL_MOVES
from tests.model.search.stated_rules import RULES, with_customers, with_vehicles
from tests.model.search.test_optimum import (
    DRONES, TRUCK, missed_seeds, plain_customers, street_problem,
)
from training.instances import generate


def table1() -> Problem:
    """Return a problem in which a kilometre costs as much by air, and some are flown to alone."""
    problem = generate(np.random.default_rng(0), 20, "table1")
    return with_drones(cost_per_km=1.0)(problem)


def with_drones(**stated: object) -> Callable[[Problem], Problem]:
    """Return what lets the drones of all vehicles state something."""
    return lambda problem: replace(problem, vehicle_types=tuple(
        replace(kind, drones=kind.drones and replace(kind.drones, **stated))
        for kind in problem.vehicle_types))


def with_longer_way(problem: Problem) -> Problem:
    """Let a leg be a metre longer by road one way."""
    road, *others = problem.travel
    distance = road.distance[:]
    distance[1, 2] += 1000
    return replace(problem, travel=(Travel(road.duration[:], distance), *others))


def with_detours(problem: Problem) -> Problem:
    """Let a leg be longer by road, both ways, than by way of the depot."""
    road, *others = problem.travel
    distance = road.distance[:]
    distance[1, 2] = distance[2, 1] = distance[1, 0] + distance[0, 2] + 1_000_000
    return replace(problem, travel=(Travel(road.duration[:], distance), *others))


def cleared(problem: Problem) -> tuple[Instance, Instance]:
    """Return a problem as it is packed, and without needless flights."""
    packed = pack([problem])
    return packed, without_needless_flights(problem, packed, ALL_MOVES)[0]


@pytest.mark.parametrize("rule", [
    lambda problem: problem, with_vehicles(fixed_cost=10.0), with_vehicles(max_trips=2),
    with_vehicles(skills=frozenset({"ice"})), with_customers(unassigned_cost=3.0),
    with_drones(count=2), with_drones(cost_per_km=2.0), RULES["goods that must not go together"]])
def test_whom_a_truck_may_serve_no_drone_flies_to(rule: Callable[[Problem], Problem]) -> None:
    packed, told = cleared(rule(table1()))
    either = packed.can_drive & packed.can_fly
    assert either.any()
    assert (told.can_fly == (packed.can_fly & ~either)).all()
    assert told.can_fly.any()


@pytest.mark.parametrize("rule", [
    with_drones(cost_per_km=0.99), with_longer_way, with_detours, with_vehicles(max_stops=5),
    with_vehicles(cost_per_stop=1.0), with_vehicles(max_trip_distance=10**8),
    with_vehicles(latest=10**8), with_customers(pickup=(1,)), with_customers(latest=10**8),
    *(RULES[name] for name in (
        "working time costs", "working time is limited", "overtime costs", "lateness costs",
        "what is aboard costs", "parcels come later", "setups", "time aboard is limited",
        "speed changes", "drivers have breaks"))])
def test_flights_stay_where_anything_else_counts(rule: Callable[[Problem], Problem]) -> None:
    packed, told = cleared(rule(table1()))
    assert told is packed


def test_no_trip_is_split_anew_then() -> None:
    problem = table1()
    assert not make_data(problem, pack([problem])).strategy.resplit
    dearer = with_vehicles(cost_per_hour=1.0)(problem)
    assert make_data(dearer, pack([dearer])).strategy.resplit


def test_search_finds_the_cheapest_plan_all_the_same() -> None:
    def draw(rng: np.random.Generator) -> Problem:
        truck = replace(TRUCK, count=2, capacity=(7000,),
                        drones=replace(DRONES, travel=0, cost_per_km=1.0))
        first, *others = plain_customers(rng, 4)
        return street_problem(rng, (replace(first, served_by="drone"), *others), truck)

    assert missed_seeds(draw, range(2)) == []
