"""Trips held until nothing lasts too long."""

from collections.abc import Callable
from dataclasses import replace

from model.judge import holding
from model.judge.holding import held, time_to_turn
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import FULL_SPEED, Customer, Problem, SpeedProfile, VehicleType
from model.solution import Trip

MINUTE = 60_000


def changing(truck: VehicleType, changes: int) -> VehicleType:
    """Return a truck whose speed changes each minute."""
    return replace(truck, speed_profile=SpeedProfile(
        tuple(MINUTE * (change + 1) for change in range(changes)),
        tuple(FULL_SPEED - change % 2 for change in range(changes + 1))))


def test_holding_is_given_up_where_speeds_change_again_and_again(
        tiny_problem: Callable[..., Problem], truck: VehicleType,
        customers: tuple[Customer, ...]) -> None:
    problem = tiny_problem(*customers, truck=changing(truck, 3000))
    kind, begun = problem.vehicle_types[0], list[int]()

    def begun_at(start: int) -> Trip:
        begun.append(start)
        decision = RouteDecision(0, 0, (TripDecision((0, 1, 2, 0), start=start),))
        return schedule(problem, decision).trips[0]

    trip, helps = held(problem, kind, begun_at(0), begun_at, lambda trip: 1)
    assert not helps
    assert trip == begun_at(0)
    assert len(begun) <= holding.MOST_STOPS_TIMED_ANEW // 4 + 2


def test_a_trip_turns_when_it_meets_the_next_speed_or_window(
        tiny_problem: Callable[..., Problem], truck: VehicleType,
        customers: tuple[Customer, ...]) -> None:
    problem = tiny_problem(*customers, truck=changing(truck, 500))
    decision = RouteDecision(0, 0, (TripDecision((0, 1, 2, 3, 0), start=7),))
    trip = schedule(problem, decision).trips[0]
    changes = problem.vehicle_types[0].speed_profile.times  # type: ignore[union-attr]
    opens = [(stop.arrival, problem.customer_at(stop.node).earliest) for stop in trip.stops[1:-1]]
    times = [time for stop in trip.stops for time in (stop.arrival, stop.departure)]
    expected = min([change - time for time in times for change in changes if change > time]
                   + [opening - arrival for arrival, opening in opens if opening > arrival])
    assert time_to_turn(problem, problem.vehicle_types[0], trip) == 7 + expected
