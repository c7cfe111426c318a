"""Batteries that are charged aboard, worked out by hand."""

from dataclasses import replace

import pytest

from model.judge.check import check
from model.judge.energy import charges
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import DroneType, Energy, Problem
from model.solution import Route, Solution, Trip

MINUTE = 60_000
WATT = 1000
WATT_MINUTES = 60_000_000
"""µJ that a power of a watt takes in a minute."""

BATTERY = Energy(
    available=10_000 * WATT_MINUTES, usable_share=0.8, weights=(0, 1000),
    cruise=(100 * WATT, 100 * WATT), hover=(0, 0), climb=(0, 0), descent=(0, 0))

LOOPS = SortieDecision((3,), 1, 1), SortieDecision((2,), 1, 1)


@pytest.fixture
def three(tiny_problem, customers, truck) -> Problem:
    return tiny_problem(*customers[:3], truck=truck)


def flown(problem: Problem, drones: DroneType, energy: Energy | None,
          *sorties: SortieDecision, start: int | None = None) -> tuple[Problem, Trip]:
    """Return the problem with such drones, and a trip to the first customer with two flights."""
    kind, = problem.vehicle_types
    problem = replace(problem, vehicle_types=(
        replace(kind, drones=replace(drones, energy=energy)),))
    decision = TripDecision((0, 1, 0), sorties or LOOPS, start=start)
    return problem, schedule(problem, RouteDecision(0, 0, (decision,))).trips[0]


def in_the_air(trip: Trip, drones: DroneType) -> tuple[int, ...]:
    """Return how many minutes each sortie flies that nobody waits for, services left out."""
    return tuple((sortie.recovery_start - sortie.launch_time
                  - sum(visit.departure - visit.arrival for visit in sortie.visits)) // MINUTE
                 for sortie in trip.sorties)


def broken(problem: Problem, trip: Trip) -> set[str]:
    evaluation = check(problem, Solution((Route(0, 0, (trip,)),)))
    return {violation.code for violation in evaluation.violations} - {"MISSING"}


@pytest.mark.parametrize("spare", [0, 1, 1000])
def test_a_launch_is_held_back_until_its_sortie_can_be_flown(three, drones, spare):
    _, free = flown(three, drones, None)
    first, second = in_the_air(free, drones)
    available = (max(first, second) * 100 + spare) * WATT_MINUTES
    problem, trip = flown(three, drones, replace(BATTERY, available=available, charge=25 * WATT))
    missing = max(0, first * 100 + second * 100 - available // WATT_MINUTES)
    landed, again = trip.sorties[0].recovery_time, trip.sorties[1].launch_time
    assert trip.sorties[0] == free.sorties[0]
    assert again - drones.launch_duration - landed == missing * MINUTE // 25
    assert trip.stops[1].departure == trip.sorties[1].recovery_time
    assert broken(problem, trip) == set()


def test_what_charging_brings_is_no_more_than_the_battery_holds(three, drones):
    energy = replace(BATTERY, available=2000 * WATT_MINUTES, charge=1000 * WATT)
    late = replace(three.customers[1], earliest=300 * MINUTE)
    problem = replace(three, customers=(three.customers[0], late, three.customers[2]))
    problem, trip = flown(problem, replace(drones, endurance=60 * MINUTE), energy)
    assert trip.sorties[1].launch_time > 200 * MINUTE
    assert charges(problem, problem.vehicle_types[0], trip) == [
        2000 * WATT_MINUTES] * 2


def test_another_drone_has_a_battery_of_its_own_and_a_further_trip_a_full_one(three, drones):
    _, free = flown(three, replace(drones, count=2), None, LOOPS[0],
                    replace(LOOPS[1], drone=1))
    most = max(in_the_air(free, drones)) * 100 * WATT_MINUTES
    energy = replace(BATTERY, available=most, charge=1)
    problem, trip = flown(three, replace(drones, count=2), energy, LOOPS[0],
                          replace(LOOPS[1], drone=1))
    assert trip == free
    kind, = problem.vehicle_types
    problem = replace(problem, vehicle_types=(replace(kind, max_trips=2),))
    route = schedule(problem, RouteDecision(0, 0, tuple(
        TripDecision((0, 0), (replace(loop, launch_stop=0, recovery_stop=0),)) for loop in LOOPS)))
    begin = route.trips[1].sorties[0].launch_time - drones.launch_duration
    assert begin == route.trips[1].stops[0].arrival


@pytest.mark.parametrize(("charge", "codes"), [(0, set()), (1, {"ENERGY"}), (1000 * WATT, set())])
def test_who_hovers_for_longer_than_was_charged_breaks_a_rule(charge, codes, three, drones):
    late = replace(three.customers[1], earliest=300 * MINUTE)
    problem = replace(three, customers=(three.customers[0], late, three.customers[2]))
    energy = replace(BATTERY, hover=(100 * WATT, 100 * WATT), lands=False, charge=charge)
    # A launch is held back for a window by what a full battery has.
    assert broken(*flown(problem, drones, energy)) == codes


def test_on_a_trip_under_way_drones_have_what_is_left(three, drones):
    energy = replace(BATTERY, available=3000 * WATT_MINUTES, charge=10 * WATT)
    _, free = flown(three, drones, None, LOOPS[0])
    flight, = in_the_air(free, drones)
    kind, = three.vehicle_types
    kind = replace(kind, earliest=5 * MINUTE, drones=drones, charge_left=(0,))
    problem, trip = flown(replace(three, vehicle_types=(kind,)), drones, energy, LOOPS[0])
    assert trip.sorties[0].launch_time - drones.launch_duration == (5 + 10 * flight) * MINUTE
    assert broken(problem, trip) == set()
