"""What flights take of a drone's battery. Energies in µJ, plain Python integers."""

from bisect import bisect_right
from collections.abc import Sequence
from typing import NamedTuple

from model.judge.launches import launch_begins
from model.judge.pairs import change_aboard, fetched_before, flown_out
from model.problem import DroneType, Energy, Problem, VehicleType
from model.solution import Sortie, Stop, Trip, Visit


class Rest(NamedTuple):
    """What a drone has in its battery, beside the reserve, as it comes aboard, and when."""

    left: int
    since: int


def first_rest(kind: VehicleType, energy: Energy, drone: int) -> Rest:
    """Return what a truck's drone has before the first sortie of a trip."""
    left = kind.charge_left[drone] if drone < len(kind.charge_left) else energy.available
    return Rest(left, kind.earliest)


def charge_after(energy: Energy, rest: Rest, time: int) -> int:
    """Return what a drone that rests aboard has at an instant; each time all where none is charged.
    """
    if not energy.charge:
        return energy.available
    return min(energy.available, rest.left + energy.charge * max(0, time - rest.since))


def time_charged(energy: Energy, rest: Rest, needed: int) -> int:
    """Return when a drone that rests aboard has so much; at once if it never has."""
    if not rest.left < needed <= energy.available:
        return rest.since
    return rest.since - (rest.left - needed) // energy.charge


def power_at(energy: Energy, powers: Sequence[int], weight: int) -> int:
    """Return a power in mW with so much aboard, rounded down; none is negative."""
    weights = energy.weights
    upper = min(bisect_right(weights, weight), len(weights) - 1)
    lower = upper - 1
    rise = (powers[upper] - powers[lower]) * (weight - weights[lower])
    return max(0, powers[lower] + rise // (weights[upper] - weights[lower]))


def leg_energy(energy: Energy, duration: int, weight: int) -> int:
    """Return what a leg takes, climb and descent included, with so much aboard."""
    flight = max(0, duration - energy.climb_duration - energy.descent_duration)
    return (power_at(energy, energy.climb, weight) * energy.climb_duration
            + power_at(energy, energy.cruise, weight) * flight
            + power_at(energy, energy.descent, weight) * energy.descent_duration)


def hover_energy(energy: Energy, duration: int, weight: int) -> int:
    """Return what hovering takes with so much aboard."""
    return power_at(energy, energy.hover, weight) * duration


def weights_aboard(problem: Problem, energy: Energy, nodes: Sequence[int]) -> list[int]:
    """Return what is aboard on each leg of a flight to some customers, the way home last."""
    customers = [problem.customer_at(node) for node in nodes]
    # A truck's drone has from there what it delivers.
    within = fetched_before(problem, nodes) if problem.shipments else ()
    weights = [sum([(customer.demand if node in within else flown_out(problem, node))[
        energy.dimension] for node, customer in zip(nodes, customers, strict=True)])]
    for node, customer in zip(nodes, customers, strict=True):
        change = change_aboard(problem, node) or customer.taken_in
        weights.append(weights[-1] - customer.demand[energy.dimension] + change[energy.dimension])
    return weights


def sortie_energy(problem: Problem, drones: DroneType, energy: Energy, trip: Trip,
                  sortie: Sortie) -> int:
    """Return what a sortie takes: its legs, and the time that it waits in the air."""
    return sum(sortie_energies(problem, drones, energy, trip, sortie))


def sortie_energies(problem: Problem, drones: DroneType, energy: Energy, trip: Trip,
                    sortie: Sortie) -> list[int]:
    """Return what a sortie takes from place to place, as `flight_energies` does."""
    nodes = [visit.node for visit in sortie.visits]
    path = (trip.stops[sortie.launch_stop].node, *nodes, trip.stops[sortie.recovery_stop].node)
    return flight_energies(problem, drones, energy, path, sortie.visits, sortie.launch_time,
                           sortie.recovery_start)


def flight_energies(problem: Problem, flyer: DroneType | VehicleType, energy: Energy,
                    path: Sequence[int], visits: Sequence[Visit | Stop], launch_time: int,
                    recovery_start: int) -> list[int]:
    """Return what a flight takes until it leaves each customer, and then until it ends.

    Each from the place before on; `path` is the nodes where it begins, comes and ends.
    """
    duration = problem.travel[flyer.travel].duration
    aboard = weights_aboard(problem, energy, path[1:-1])
    node, time, energies = path[0], launch_time, []
    for visit, weight in zip(visits, aboard, strict=False):
        taken = leg_energy(energy, duration.item(node, visit.node) + visit.setup, weight)
        if not energy.lands:
            taken += hover_energy(energy, visit.departure - visit.ready, weight)
        energies.append(taken)
        node, time = visit.node, visit.departure
    home = duration.item(node, path[-1])
    energies.append(leg_energy(energy, home, aboard[-1])
                    + hover_energy(energy, recovery_start - time - home, aboard[-1]))
    return energies


def least_energy(problem: Problem, energy: Energy, nodes: Sequence[int], legs: Sequence[int],
                 services: Sequence[int]) -> int:
    """Return what a flight takes if nobody waits; `legs` and `services` are the durations."""
    aboard = weights_aboard(problem, energy, nodes)
    taken = sum([leg_energy(energy, leg, weight)
                 for leg, weight in zip(legs, aboard, strict=True)])
    if energy.lands:
        return taken
    return taken + sum([hover_energy(energy, service, weight)
                        for service, weight in zip(services, aboard, strict=False)])


def longest_hold(problem: Problem, energy: Energy, nodes: Sequence[int], legs: Sequence[int],
                 services: Sequence[int]) -> int | None:
    """Return in how long windows may let a sortie be back, by what it takes to hover for them.

    That is reckoned with the most that is aboard at a customer; `legs` and `services` are the
    durations. None if waiting for windows takes nothing, or the flight itself too much.
    """
    aboard = weights_aboard(problem, energy, nodes)
    most = power_at(energy, energy.hover, max(aboard))
    if energy.lands or most == 0:
        return None
    taken = least_energy(problem, energy, nodes, legs, services)
    if taken > energy.available:
        return None
    return sum(legs) + sum(services) + (energy.available - taken) // most


def charges(problem: Problem, kind: VehicleType, trip: Trip) -> list[int]:
    """Return what each sortie of a trip may take, by the battery as its launch begins.

    0 for those of drones that no battery limits.
    """
    batteries = [kind.drone_type(sortie.drone).energy for sortie in trip.sorties]
    found = [0 if energy is None else energy.available for energy in batteries]
    if any(energy is not None and energy.charge for energy in batteries):
        _charge(problem, kind, trip, found)
    return found


def charges_at(problem: Problem, kind: VehicleType, trip: Trip, time: int) -> tuple[int, ...]:
    """Return what each drone has at an instant after all sorties of a trip; 0 without a battery."""
    rests = _charge(problem, kind, trip, [0 for _ in trip.sorties])
    energies = [kind.drone_type(drone).energy for drone in range(kind.num_drones)]
    return tuple([0 if energy is None else max(0, charge_after(
        energy, rests.get(drone, first_rest(kind, energy, drone)), time))
        for drone, energy in enumerate(energies)])


def _charge(problem: Problem, kind: VehicleType, trip: Trip, found: list[int]) -> dict[int, Rest]:
    """Write what sorties may take; return how drones came aboard after their last ones."""
    rests: dict[int, Rest] = {}
    begins = launch_begins(trip.sorties, kind)
    for index in sorted(range(len(found)), key=lambda i: (trip.sorties[i].launch_stop, begins[i])):
        sortie = trip.sorties[index]
        drones = kind.drone_type(sortie.drone)
        if drones.energy is None:
            continue
        rest = rests.get(sortie.drone, first_rest(kind, drones.energy, sortie.drone))
        found[index] = charge_after(drones.energy, rest, begins[index])
        taken = sortie_energy(problem, drones, drones.energy, trip, sortie)
        rests[sortie.drone] = Rest(found[index] - taken, sortie.recovery_time)
    return rests
