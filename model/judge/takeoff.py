"""When drones take off: held back for windows, for storms, or until their batteries are charged.

A `path` is where a sortie is launched, its customers, and where it is recovered, as nodes.
"""

from collections.abc import Sequence
from itertools import pairwise

from model.judge.clock import opening
from model.judge.energy import (
    Rest, charge_after, flight_energies, least_energy, longest_hold, time_charged,
)
from model.problem import UNLIMITED, DroneType, Problem, VehicleType, barred, zones_of
from model.solution import Visit

Path = tuple[int, ...]


def _legs(problem: Problem, drones: DroneType, path: Path) -> tuple[list[int], list[int]]:
    """Return how long the legs of a sortie take, setups included, and services."""
    duration = problem.travel[drones.travel].duration
    legs = [duration.item(*leg) for leg in pairwise(path)]
    for index, leg in enumerate(pairwise(path[:-1])):
        legs[index] += problem.setup_between(*leg)
    return legs, [drones.service_at(problem.customer_at(node)) for node in path[1:-1]]


def held_takeoff(problem: Problem, drones: DroneType, path: Path, soonest: int) -> int:
    """Return when a drone takes off that can from `soonest` on.

    As early as the windows that it then meets let it be back within its endurance, and a full
    battery if it hovers before them, with no storm and no zone closed meanwhile; at once where the
    flight is too long in any case, or a storm doesn't end, since holding it back wouldn't help.
    """
    takeoff, held = soonest, _held_until(problem, drones, path, soonest)
    while held > takeoff:
        takeoff, held = held, _held_until(problem, drones, path, held)
    return takeoff


def _held_until(problem: Problem, drones: DroneType, path: Path, takeoff: int) -> int:
    """Return when what is met from `takeoff` on lets a drone be back within its limits."""
    legs, services = _legs(problem, drones, path)
    time, back = takeoff, 0
    for node, leg, service in zip(path[1:-1], legs, services, strict=False):
        opens = opening(problem.customer_at(node), time + leg)
        time = max(time + leg, opens) + service
        back = max(back + leg, opens) + service
    limit = drones.endurance
    if drones.energy is not None:
        hold = longest_hold(problem, drones.energy, path[1:-1], legs, services)
        limit = limit if hold is None else min(limit, hold)
    if sum(legs) + sum(services) <= limit and back + legs[-1] - limit > takeoff:
        return back + legs[-1] - limit
    storm = storm_met(drones, zones_of(problem, path), takeoff, time + legs[-1])
    return takeoff if storm is None or storm[1] >= UNLIMITED else storm[1]


def storm_met(flyer: DroneType | VehicleType, zones: int, takeoff: int,
              end: int) -> tuple[int, int] | None:
    """Return from and until when it first storms, or a zone is closed, while one is in the air.

    `zones` are those with hours to which it flies; None if it meets none.
    """
    return next((storm for storm in barred(flyer.storms, flyer.closings, zones)
                 if takeoff < storm[1] and storm[0] < end), None)


def closing_met(flyer: DroneType | VehicleType, zones: int, takeoff: int, end: int) -> bool:
    """Tell whether one is in the air while any of the zones to which it flies is closed."""
    return any(closed & zones and takeoff < until and begin < end
               for begin, until, closed in flyer.closings)


def charged_launch(problem: Problem, drones: DroneType, path: Path, rest: Rest | None) -> int:
    """Return when the launch may begin of a drone that came aboard so: at once, or once charged.

    With what the flight takes if nobody waits. `rest` is None if nothing is charged aboard.
    """
    energy = drones.energy
    if energy is None or rest is None:
        return 0
    needed = least_energy(problem, energy, path[1:-1], *_legs(problem, drones, path))
    return time_charged(energy, rest, needed)


def rest_after(problem: Problem, drones: DroneType, rest: Rest | None, path: Path,
               visits: Sequence[Visit], launch_time: int, recovery_start: int) -> Rest | None:
    """Return how a drone comes aboard after a sortie before which it came aboard as `rest` says.

    None if nothing is charged aboard.
    """
    energy = drones.energy
    if energy is None or rest is None:
        return None
    begun = launch_time - drones.launch_duration
    taken = sum(flight_energies(problem, drones, energy, path, visits, launch_time,
                                recovery_start))
    return Rest(charge_after(energy, rest, begun) - taken,
                recovery_start + drones.recovery_duration)
