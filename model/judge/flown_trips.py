"""Trips of vehicles that fly by themselves: how long they last and what they take of a battery."""

from collections.abc import Sequence
from itertools import pairwise

from model.judge.energy import (
    Rest, charge_after, first_rest, flight_energies, least_energy, power_at, time_charged,
    weights_aboard,
)
from model.judge.freshness import most_excess
from model.judge.lags import excess_of_lags
from model.judge.takeoff import storm_met
from model.problem import UNLIMITED, Energy, Problem, VehicleType, zones_of
from model.solution import Trip


def airborne(trip: Trip) -> int:
    """Return how long a trip lasts from take-off to landing."""
    return trip.stops[-1].arrival - trip.stops[0].departure


def trip_energy(problem: Problem, kind: VehicleType, trip: Trip) -> int | None:
    """Return what a trip takes; None where it is not known what flying takes."""
    return None if kind.energy is None else sum(trip_energies(problem, kind, kind.energy, trip))


def trip_energies(problem: Problem, kind: VehicleType, energy: Energy, trip: Trip) -> list[int]:
    """Return what a trip takes from stop to stop, as `flight_energies` does."""
    path = [stop.node for stop in trip.stops]
    return flight_energies(problem, kind, energy, path, trip.stops[1:-1],
                           trip.stops[0].departure, trip.stops[-1].arrival)


def trip_charges(problem: Problem, kind: VehicleType, trips: Sequence[Trip]) -> list[int]:
    """Return what each trip may take, by the battery as its launch begins; none without one."""
    energy = kind.energy
    if energy is None:
        return []
    found, rest = [], first_rest(kind, energy, 0)
    for trip in trips:
        found.append(charge_after(energy, rest, trip.stops[0].arrival))
        taken = trip_energy(problem, kind, trip) or 0
        rest = Rest(found[-1] - taken, trip.stops[-1].departure)
    return found


def _rest_after(problem: Problem, kind: VehicleType, energy: Energy,
                 before: Sequence[Trip]) -> Rest:
    """Return what there is of a battery after some trips, and since when it is charged."""
    if not before:
        return first_rest(kind, energy, 0)
    there = trip_charges(problem, kind, before)[-1]
    taken = trip_energy(problem, kind, before[-1]) or 0
    return Rest(there - taken, before[-1].stops[-1].departure)


def charged_between(problem: Problem, kind: VehicleType, before: Sequence[Trip],
                    time: int) -> tuple[int, ...]:
    """Return what there is of a battery at an instant after some trips, if it is charged then."""
    energy = kind.energy
    if energy is None or not energy.charge:
        return ()
    return (charge_after(energy, _rest_after(problem, kind, energy, before), time),)


def charged_start(problem: Problem, kind: VehicleType, before: Sequence[Trip],
                  nodes: Sequence[int]) -> int:
    """Return when a trip may begin, for all that the battery lacks after those before.

    With what it takes if nobody waits; at once where it never has so much. `nodes` are its stops.
    """
    energy = kind.energy
    if energy is None or not energy.charge:
        return 0
    rest = _rest_after(problem, kind, energy, before)
    duration = problem.travel[kind.travel].duration
    legs = [duration.item(*leg) + problem.setup_between(*leg) for leg in pairwise(nodes)]
    services = [kind.service_at(problem.customer_at(node)) for node in nodes[1:-1]]
    return time_charged(energy, rest, least_energy(problem, energy, nodes[1:-1], legs, services))


def excess_in_air(problem: Problem, kind: VehicleType, trip: Trip) -> int:
    """Return by how much later a trip would have to begin to wait less in the air; 0: it may be.

    However late it begins, it takes what it does without waiting.
    """
    excess = max(0, airborne(trip) - kind.endurance)
    energy = kind.energy
    if energy is None or energy.lands:
        return excess
    over = (trip_energy(problem, kind, trip) or 0) - energy.available
    most = max(power_at(energy, energy.hover, weight) for weight in weights_aboard(
        problem, energy, [stop.node for stop in trip.stops[1:-1]]))
    return max(excess, -(-over // most)) if most else excess


def storm_of(problem: Problem, kind: VehicleType, trip: Trip) -> tuple[int, int] | None:
    """Return from and until when it first storms while a trip is in the air, if ever.

    A zone to which it flies and that is closed counts as a storm.
    """
    zones = zones_of(problem, [stop.node for stop in trip.stops])
    return storm_met(kind, zones, trip.stops[0].departure, trip.stops[-1].arrival)


def wait_for_calm(problem: Problem, kind: VehicleType, trip: Trip) -> int:
    """Return how much later a trip would have to begin that meets a storm; 0: that doesn't help.
    """
    storm = storm_of(problem, kind, trip)
    return 0 if storm is None or storm[1] >= UNLIMITED else storm[1] - trip.stops[0].departure


def excess_of(problem: Problem, kind: VehicleType, trip: Trip) -> int:
    """Return by how much a trip lasts too long, that may do less if it begins later; 0: it doesn't.
    """
    excess = max(most_excess(problem, kind, trip), excess_of_lags(problem, trip))
    return max(excess, excess_in_air(problem, kind, trip)) if kind.flies else excess
