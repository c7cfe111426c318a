"""Tests of departures: as late as costs nothing."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, read_decision, schedule
from model.engine.instance import pack
from model.problem import Problem
from model.simulation.actions import DRIVE, LAUNCH, OPEN, RETURN, encode_action
from model.policy.extract import extract
from model.solution import Route, Solution, Stop, Visit
from tests.model.mask_oracle import MINUTE, costs_nothing
from tests.model.rollouts import random_problems, roll
from tests.model.tiny import draw_tiny
from tests.seeds import often, seeds

pytestmark = pytest.mark.slow


def planned(problem: Problem, seed: int) -> Iterator[tuple[Route, RouteDecision]]:
    """Yield the routes of a random rollout and the decisions they state."""
    rollout = roll([problem], seed).rollouts[0]
    for route in extract(problem, pack([problem]), rollout.actions).routes:
        kind = problem.vehicle_types[route.vehicle_type]
        trips = tuple(read_decision(trip, kind) for trip in route.trips)
        yield route, RouteDecision(route.vehicle_type, route.vehicle, trips)


def begun_at(problem: Problem, decision: RouteDecision, starts: list[int | None]) -> Route:
    """Time the route with other starts of its trips; None is as soon as possible."""
    trips = tuple(replace(trip, start=start)
                  for trip, start in zip(decision.trips, starts, strict=True))
    return schedule(problem, replace(decision, trips=trips))


def working_duration(problem: Problem, route: Route) -> int:
    return check(problem, Solution((route,))).routes[0].working_duration


def lateness(problem: Problem, route: Route) -> list[int]:
    halts: list[Stop | Visit] = [stop for trip in route.trips for stop in trip.stops[1:-1]]
    halts += [visit for trip in route.trips for sortie in trip.sorties for visit in sortie.visits]
    return [max(0, halt.arrival - problem.customer_at(halt.node).latest) for halt in halts]


@pytest.mark.parametrize("drone_share", [0.0, 1.0])
def test_each_trip_begins_at_the_latest_start_that_costs_nothing(drone_share: float) -> None:
    num_later = 0
    for seed in seeds(200):
        problem = draw_tiny(np.random.default_rng(seed), drone_share)
        if any(kind.speed_profile for kind in problem.vehicle_types):
            continue  # the latest start need not be a whole minute
        for route, decision in planned(problem, seed):
            starts: list[int | None] = [None] * len(route.trips)
            for number, trip in enumerate(route.trips):
                before = begun_at(problem, decision, starts)
                soonest = before.trips[number].stops[0].arrival
                latest = soonest
                for start in range(soonest, before.trips[-1].stops[-1].departure + 1, MINUTE):
                    starts[number] = start
                    if costs_nothing(problem, before, begun_at(problem, decision, starts)):
                        latest = start
                assert trip.stops[0].arrival == latest, f"seed {seed}"
                starts[number] = latest
                num_later += latest > soonest
    assert num_later > often(50)


def test_no_other_departure_shortens_the_working_duration_without_lateness() -> None:
    for seed in seeds(200):
        problem = draw_tiny(np.random.default_rng(seed), drone_share=0.0)
        if any(kind.speed_profile for kind in problem.vehicle_types):
            continue
        for route, decision in planned(problem, seed):
            later: list[int | None] = [None] * (len(route.trips) - 1)
            soon = begun_at(problem, decision, [None, *later])
            end = soon.trips[-1].stops[-1].departure
            assert route.trips[-1].stops[-1].departure == end
            assert lateness(problem, route) <= lateness(problem, soon)
            shortest = working_duration(problem, route)
            for start in range(soon.trips[0].stops[0].arrival, end, MINUTE):
                other = begun_at(problem, decision, [start, *later])
                late = np.subtract(lateness(problem, other), lateness(problem, soon))
                assert working_duration(problem, other) >= shortest or (late > 0).any()


@pytest.mark.thorough
def test_leaving_later_is_never_worse_with_drones_and_rush_hours() -> None:
    problems = random_problems(seed=41, count=often(300))
    problems += [draw_tiny(np.random.default_rng(seed), 0.7) for seed in seeds(250)]
    for seed, problem in enumerate(problems):
        for route, decision in planned(problem, seed):
            soon = begun_at(problem, decision, [None] * len(route.trips))
            chosen = check(problem, Solution((route,)))
            soonest = check(problem, Solution((soon,)))
            assert chosen.cost.total <= soonest.cost.total + 1e-9
            assert chosen.routes[0].working_duration <= soonest.routes[0].working_duration
            assert chosen.makespan <= soonest.makespan
            assert {v.code for v in chosen.violations} <= {"MISSING"}
            assert (np.array(lateness(problem, route)) <= lateness(problem, soon)).all()


def test_every_trip_leaves_just_in_time(tiny_problem, customers, truck) -> None:
    first = replace(customers[0], earliest=60 * MINUTE, early_cost_per_hour=6.0)
    second = replace(customers[1], earliest=120 * MINUTE, early_cost_per_hour=6.0)
    truck = replace(truck, max_trips=2, reload_duration=10 * MINUTE)
    problem = tiny_problem(first, second, truck=truck)
    actions = [encode_action(kind, target) for kind, target in (
        (OPEN, 0), (DRIVE, 1), (RETURN, 0), (DRIVE, 2), (RETURN, 0))]
    solution = extract(problem, pack([problem]), actions)
    starts = [trip.stops[0].arrival // MINUTE for trip in solution.routes[0].trips]
    ends = [trip.stops[-1].departure // MINUTE for trip in solution.routes[0].trips]
    # The first trip may end late as well: reloading ends just in time for the second.
    assert ends == [106, 129]
    assert starts == [97, 116]
    assert check(problem, solution).cost.earliness == 0


def test_recoveries_that_take_no_time_never_hold_up_one_another(
        tiny_problem, customers, truck, drones) -> None:
    a, b, c, d = customers
    problem = tiny_problem(
        replace(a, earliest=15 * MINUTE),
        replace(b, latest=17 * MINUTE, service_duration=10 * MINUTE), c,
        replace(d, earliest=100 * MINUTE),
        truck=replace(truck, drones=replace(drones, count=2, launch_duration=0,
                                            recovery_duration=0)))
    solution = extract(problem, pack([problem]), [encode_action(kind, target) for kind, target in (
        (OPEN, 0), (LAUNCH, 1), (LAUNCH, 2), (DRIVE, 3), (DRIVE, 4), (RETURN, 0))])
    (trip,) = solution.routes[0].trips
    assert trip.stops[0].arrival == 15 * MINUTE  # the window of b allows no later start
    # Begun at once, b's drone would have been back at c first; now it is a's.
    assert [sortie.recovery_start // MINUTE for sortie in trip.sorties] == [23, 28]
    assert check(problem, solution).violations == ()


def test_recoveries_that_take_no_time_never_wait_for_launches_that_take_none(
        tiny_problem, customers, truck, drones) -> None:
    a, b, c, d = customers
    problem = tiny_problem(
        replace(a, earliest=12 * MINUTE, service_duration=MINUTE),
        replace(b, service_duration=8 * MINUTE),
        replace(c, earliest=18 * MINUTE, service_duration=7 * MINUTE),
        replace(d, earliest=21 * MINUTE, service_duration=7 * MINUTE),
        truck=replace(truck, drones=replace(drones, count=4, launch_duration=0,
                                            recovery_duration=0, endurance=15 * MINUTE)))
    solution = extract(problem, pack([problem]), [encode_action(kind, target) for kind, target in (
        (OPEN, 0), (LAUNCH, 1), (LAUNCH, 2), (LAUNCH, 3), (LAUNCH, 4), (RETURN, 0))])
    (trip,) = solution.routes[0].trips
    # Begun at once, b's drone would be back at 12, c's launch held back until 13, a's drone be back
    # at 14, and d's launch held back until 17, which lets all begin 5 minutes later.
    assert [(sortie.launch_time // MINUTE, sortie.recovery_start // MINUTE)
            for sortie in trip.sorties] == [(5, 14), (5, 17), (17, 30), (17, 32)]
    assert check(problem, solution).violations == ()
