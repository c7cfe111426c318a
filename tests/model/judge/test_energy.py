"""Energies of sorties, worked out by hand."""

from dataclasses import replace

import pytest

from model.counsel.explain import explain
from model.judge.check import check
from model.judge.energy import leg_energy, power_at, sortie_energy, weights_aboard
from model.judge.rules import watt_hours
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import MICROJOULES_PER_WH, DroneType, Energy, Part, Problem, Shipment
from model.solution import Solution, Trip
from tests.model.remedies import applied

MINUTE = 60_000
MINUTES = 60_000_000
"""µJ that a power of a watt takes in a minute."""

BATTERY = Energy(
    available=10_000 * MINUTES, usable_share=0.8, weights=(0, 1000), cruise=(100_000, 160_000),
    hover=(120_000, 200_000), climb=(0, 0), descent=(0, 0))


def flown(problem: Problem, drones: DroneType, energy: Energy,
          *sorties: SortieDecision, nodes: tuple[int, ...] = (0, 1, 2, 0)) -> tuple[Problem, Trip]:
    """Return the problem with such drones, and a trip that begins as soon as possible."""
    kind, = problem.vehicle_types
    kind = replace(kind, drones=replace(drones, energy=energy))
    problem = replace(problem, vehicle_types=(kind,))
    decision = RouteDecision(0, 0, (TripDecision(nodes, sorties),))
    return problem, schedule(problem, decision).trips[0]


def energy_of(problem: Problem, trip: Trip) -> float:
    """Return what the first sortie takes, in watts times minutes."""
    drones = problem.vehicle_types[0].drones
    assert drones is not None
    assert drones.energy is not None
    return sortie_energy(problem, drones, drones.energy, trip, trip.sorties[0]) / MINUTES


def codes(problem: Problem, trip: Trip) -> set[str]:
    route = schedule(problem, RouteDecision(0, 0, (TripDecision(
        tuple(stop.node for stop in trip.stops),
        tuple(SortieDecision(tuple(v.node for v in s.visits), s.launch_stop, s.recovery_stop)
              for s in trip.sorties)),)))
    violations = check(problem, Solution((route,))).violations
    return {violation.code for violation in violations} - {"MISSING"}


@pytest.fixture
def three(tiny_problem, customers, truck) -> Problem:
    return tiny_problem(*customers[:3], truck=truck)


@pytest.mark.parametrize(("weight", "power"), [(0, 10), (1, 13), (2, 16), (3, 19), (4, 20),
                                               (6, 22), (8, 24)])
def test_power_is_linear_between_the_weights_where_it_is_stated(weight, power):
    energy = replace(BATTERY, weights=(0, 3, 5), cruise=(10, 19, 21), hover=(0, 0, 0),
                     climb=(0, 0, 0), descent=(0, 0, 0))
    assert power_at(energy, energy.cruise, weight) == power


def test_a_leg_is_climb_and_flight_and_descent():
    energy = replace(BATTERY, climb=(300_000, 300_000), descent=(50_000, 50_000),
                     climb_duration=10_000, descent_duration=20_000)
    # 10 s at 300 W, 30 at 130, 20 at 50
    assert leg_energy(energy, MINUTE, 500) == (10 * 300 + 30 * 130 + 20 * 50) * 1_000_000
    assert leg_energy(energy, 5_000, 500) == (10 * 300 + 20 * 50) * 1_000_000


def test_a_drone_flies_out_loaded_comes_back_empty_and_hovers_until_it_is_met(three, drones):
    # Launched at a by minute 3, at c from 5 to 5, and at b by 6, where the truck comes by 9.
    problem, trip = flown(three, replace(drones, service_duration=0), BATTERY,
                          SortieDecision((3,), 1, 2))
    weight = problem.customers[2].demand[0]
    loaded = 100 + 0.06 * weight
    assert energy_of(problem, trip) == pytest.approx(2 * loaded + 1 * 100 + 3 * 120)


@pytest.mark.parametrize("lands", [True, False])
def test_waiting_and_serving_at_a_customer_take_energy_unless_it_lands(
        lands, three, drones):
    late = replace(three.customers[2], earliest=11 * MINUTE)
    problem = replace(three, customers=(*three.customers[:2], late))
    energy = replace(BATTERY, lands=lands, hover=(120_000, 120_000))
    problem, trip = flown(problem, drones, energy, SortieDecision((3,), 1, 2))
    sortie, = trip.sorties
    visit, = sortie.visits
    loaded = 100 + 0.06 * late.demand[0]
    at_customer = (visit.departure - visit.arrival) / MINUTE
    assert at_customer == 11
    assert energy_of(problem, trip) == pytest.approx(
        2 * loaded + 100 + (0 if lands else at_customer * 120))


def test_a_sortie_may_take_all_that_the_battery_holds_and_no_more(three, drones):
    problem, trip = flown(three, drones, BATTERY, SortieDecision((3,), 1, 2))
    taken = round(energy_of(problem, trip) * MINUTES)
    for available, broken in ((taken, set()), (taken - 1, {"ENERGY"})):
        limited, _ = flown(three, drones, replace(BATTERY, available=available))
        assert codes(limited, trip) == broken


def test_a_launch_is_held_back_as_long_as_the_drone_would_hover_too_long(three, drones):
    late = replace(three.customers[2], earliest=60 * MINUTE)
    problem = replace(three, customers=(*three.customers[:2], late))
    energy = replace(BATTERY, lands=False, cruise=(0, 0), hover=(100_000, 100_000))
    # It hovers for 5 minutes to serve, and may for 4 before that.
    for available, waited in ((900, 4), (900 * 1000, 56)):
        _, trip = flown(problem, drones, replace(energy, available=available * MINUTES),
                        SortieDecision((3,), 0, 0), nodes=(0, 0))
        visit, = trip.sorties[0].visits
        assert visit.service_start - visit.arrival == waited * MINUTE
    _, landing = flown(problem, drones, replace(energy, lands=True, available=0),
                       SortieDecision((3,), 0, 0), nodes=(0, 0))
    assert landing.sorties[0].launch_time == drones.launch_duration


@pytest.mark.parametrize(("energy", "words"), [
    (52 * MICROJOULES_PER_WH // 3, "17.33 Wh"), (97_130 * MICROJOULES_PER_WH, "97130 Wh")])
def test_energies_are_told_without_powers_of_ten(energy: int, words: str) -> None:
    assert watt_hours(energy) == words


def test_who_is_too_far_for_the_battery_is_told_how_much_more_it_takes(
        tiny_problem, customers, truck, drones):
    *others, d = customers
    d = replace(d, served_by="drone")
    energy = replace(BATTERY, available=200 * MINUTES)
    kind = replace(truck, drones=replace(drones, energy=energy))
    problem = tiny_problem(*others, d, truck=kind)
    reason, = explain(problem, Solution((), (1, 2, 3, 4)), 4)
    # 4 minutes out at 160 W, 4 back at 100 W: 14 Wh are missing, of which 0.8 may be taken.
    assert reason.message == (
        "A flight from the depot and back takes 17.33 Wh, and 3.333 Wh may be taken.")
    assert (reason.code, reason.remedy) == ("RANGE", "fits with a battery of 17.5 Wh more")
    changed = explain(applied(problem, reason, 4), Solution((), (1, 2, 3, 4)), 4)
    assert changed[0].code == "SEARCH"


def test_what_a_vehicle_fetches_in_parts_itself_weighs_from_there_on(three) -> None:
    """Though a truck's drone would have it from the truck."""
    nobody = [replace(each, demand=(0,)) for each in three.customers]
    parts = Shipment("parts", 1, 3, (1,), more=(Part(2, (4,)),))
    problem = replace(three, customers=tuple(nobody), shipments=(parts,))
    assert weights_aboard(problem, BATTERY, (1, 2, 3)) == [0, 1, 5, 0]
    assert weights_aboard(problem, BATTERY, (3,)) == [5, 0]
