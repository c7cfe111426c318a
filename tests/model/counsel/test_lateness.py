"""Chances of being late: against closed forms, and day by day against the judge."""

import math
import time
from collections.abc import Callable
from dataclasses import replace
from statistics import NormalDist
from typing import Any

import numpy as np
import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, read_decision, schedule
from model.counsel.lateness.drawn import DAYS, DrawnDays, Spread, Times
from model.counsel.lateness.outlook import late_hours, outlook
from model.counsel.lateness.simulation import drive_route
from model.problem import UNLIMITED, UNREACHABLE, Customer, Problem, Travel, VehicleType
from model.planner import complete_plan
from model.solution import Route
from model.together.pulling import nobody_served
from tests.model.street import MINUTE, planned
from tests.model.tiny import draw_tiny, with_drones, with_gaps, with_setups
from tests.seeds import often, seeds

DAY = Spread(travel=0.3, service=0.4)


def log_normal(share: float, spread: float) -> float:
    """Return the chance that what lasts 1 in the mean lasts more than `share`."""
    variance = math.log1p(spread ** 2)
    return 1 - NormalDist(-variance / 2, math.sqrt(variance)).cdf(math.log(share))


@pytest.mark.parametrize("late_by", [-1, 0, 1])
def test_one_stop_is_late_as_its_drive_is(
        tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...],
        truck: VehicleType, late_by: int) -> None:
    latest = (10 - late_by) * MINUTE
    problem = tiny_problem(replace(customers[0], latest=latest), truck=truck, places=[0, 5])

    [[trip]] = [outlook(problem, route, Spread(travel=0.25), number=number)
                for number, route in enumerate(planned(problem, ((1,),)).routes)]

    chance = log_normal(1 - late_by / 10, 0.25)
    assert trip.stops[0].chance == pytest.approx(chance, abs=4 * math.sqrt(chance / DAYS))
    variance = math.log1p(0.25 ** 2)
    for told, share in ((trip.stops[0].early, 0.1), (trip.stops[0].late, 0.9)):
        expected = 10 * math.exp(math.sqrt(variance) * NormalDist().inv_cdf(share) - variance / 2)
        assert told / MINUTE == pytest.approx(expected, rel=0.04)


def test_waiting_for_a_window_takes_lateness_up(
        tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...],
        truck: VehicleType) -> None:
    first, second = customers[:2]
    problem = tiny_problem(replace(first, earliest=60 * MINUTE),
                           replace(second, latest=68 * MINUTE), truck=truck)

    [trip] = outlook(problem, planned(problem, ((1, 2),)).routes[0], Spread(travel=0.3))

    # An hour of room before the first; a leg of 2 minutes and one more of room behind it.
    assert trip.stops[0].chance is None
    assert trip.stops[1].chance == pytest.approx(log_normal(1.5, 0.3), abs=0.03)


def test_what_has_happened_is_certain(
        tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...],
        truck: VehicleType) -> None:
    problem = tiny_problem(*[replace(each, latest=16 * MINUTE) for each in customers[:3]],
                           truck=truck)
    plan = planned(problem, ((1, 2, 3),))
    route = plan.routes[0]
    now = route.trips[0].stops[2].departure

    [trip] = outlook(problem, route, DAY, now)

    assert [each.chance for each in trip.stops[:2]] == [0.0, 0.0]
    assert trip.stops[1].early == trip.stops[1].late == route.trips[0].stops[2].arrival
    assert 0.2 < (trip.stops[2].chance or 0) < 0.6
    assert late_hours(problem, plan, DAY, now) == pytest.approx(
        trip.stops[2].expected / MINUTE / 60)


class SlowDays(DrawnDays):
    """Days on which all drives last by one factor, and all services by another."""

    travel = np.array([1.0, 0.6, 1.3, 2.0, 1.0, 0.8])
    service = np.array([1.0, 1.7, 0.5, 1.0, 3.0, 0.7])

    def at(self, time: int) -> Times:
        return np.full(len(self.travel), float(time))

    def _factors(self, spread: float) -> Times:
        return self.travel if spread == DAY.travel else self.service


def slowed(problem: Problem, travel: float, service: float) -> Problem:
    """Return a problem in which all lasts longer."""
    def slow(value: int) -> int:
        return round(value * service)

    def slow_type(kind: VehicleType) -> VehicleType:
        return with_drones(kind, lambda drones: replace(
            drones, service_duration=None if drones.service_duration is None
            else slow(drones.service_duration)))

    return replace(
        problem, vehicle_types=tuple(map(slow_type, problem.vehicle_types)),
        customers=tuple([replace(each, service_duration=slow(each.service_duration))
                         for each in problem.customers]),
        travel=tuple([Travel(_scaled(np.asarray(each.duration), travel),
                             each.distance) for each in problem.travel]))


def _scaled(legs: Any, factor: float) -> Any:
    return np.where(legs == UNREACHABLE, legs, np.rint(legs * factor)).astype(np.int64)


def by_judge(problem: Problem, route: Route) -> Route:
    """Return a route as the judge times its decisions, trips but the first as soon as possible."""
    kind = problem.vehicle_types[route.vehicle_type]
    decisions = []
    for index, trip in enumerate(route.trips):
        decision = read_decision(trip, kind)
        decisions.append(replace(decision, start=None) if index else decision)
    return schedule(problem, RouteDecision(route.vehicle_type, route.vehicle, tuple(decisions)))


def starts_of(route: Route) -> list[int]:
    """Return when service begins, by truck and then by drone on each trip."""
    return [start for trip in route.trips
            for start in (*(stop.service_start for stop in trip.customer_stops),
                          *(visit.service_start for sortie in trip.sorties
                            for visit in sortie.visits))]


@pytest.mark.thorough
def test_days_are_as_the_judge_times_them() -> None:
    compared = flown = 0
    for seed in seeds(300):
        rng = np.random.default_rng(seed)
        problem = with_setups(rng, with_gaps(rng, draw_tiny(rng, drone_share=0.9), 0.3))
        problem = replace(problem, vehicle_types=tuple([
            with_drones(replace(kind, max_working_duration=None, latest=UNLIMITED),
                        lambda drones: replace(drones, endurance=UNLIMITED))
            for kind in problem.vehicle_types]))
        plan = complete_plan(problem, nobody_served(problem), seed, lambda: False).solution
        assert check(problem, plan).is_feasible
        for route in plan.routes:
            kind = problem.vehicle_types[route.vehicle_type]
            trips = drive_route(problem, route, DAY, SlowDays((0,), 0, kind.speed_profile))
            if by_judge(problem, route) != route:
                continue  # a later trip begins later than it could, for a reason of its own
            starts = np.stack([met.starts for trip in trips for met in trip])
            for day, (travel, service) in enumerate(
                    zip(SlowDays.travel, SlowDays.service, strict=True)):
                expected = starts_of(by_judge(slowed(problem, travel, service), route))
                assert starts[:, day] == pytest.approx(expected, abs=20), (seed, day)
            compared += len(starts)
            flown += sum(len(trip.sorties) for trip in trips)
    assert compared > often(500)
    assert flown > often(100)


def test_a_hundred_customers_take_some_ms(
        tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...],
        truck: VehicleType) -> None:
    many = [replace(customers[0], id=str(number), latest=20 * number * MINUTE)
            for number in range(1, 101)]
    problem = tiny_problem(*many, truck=replace(truck, capacity=(1_000_000,)))
    [route] = planned(problem, (tuple(range(1, 101)),)).routes

    took = []
    for _ in range(5):
        began = time.perf_counter()
        outlook(problem, route, DAY)
        took.append(time.perf_counter() - began)

    assert min(took) < 0.1



def test_a_decision_keeps_its_trip(tiny_problem: Callable[..., Problem],
                                   customers: tuple[Customer, ...], truck: VehicleType) -> None:
    problem = tiny_problem(*customers, truck=replace(truck, max_trips=2, reload_duration=MINUTE))
    route = schedule(problem, RouteDecision(0, 0, (TripDecision((0, 1, 0)),
                                                   TripDecision((0, 4, 0)))))

    first, second = outlook(problem, route, DAY)

    # What the first trip takes longer the second begins later.
    assert second.stops[0].deviation > first.stops[0].deviation
