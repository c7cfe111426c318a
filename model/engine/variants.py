"""What differs by who comes: tables of nodes by how long service takes and what weighs, legs by who
sets up.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from model.engine.asked import has_setups
from model.engine.pausing import Pause, matrix_blocks
from model.engine.records import Records
from model.problem import DroneType, IntArray, Problem, VehicleType
from model.problem.quantities import LONGEST_NARROW


Variant = tuple[bytes, int | None]
"""How long service at each customer takes; for drones that a battery limits, which dimension of
load weighs."""


class Variation(NamedTuple):
    """Legs of one travel, to whose durations setups, launches and recoveries are added or not."""

    travel: int  # index into Problem.travel
    sets_up: bool
    launch: int = 0  # ms more from depots, of who flies by itself
    recovery: int = 0  # ms more to depots


def durations_of(problem: Problem) -> dict[Variant, IntArray]:
    """Return how long service at each customer takes, in all ways that differ, their own first."""
    own = np.array([customer.service_duration for customer in problem.customers], np.int64)
    found: dict[Variant, IntArray] = {(own.tobytes(), None): own}
    for kind in problem.vehicle_types:
        servers: tuple[VehicleType | DroneType, ...] = (kind, *kind.drone_types)
        for served in servers:
            if _has_own_table(served):
                each = _served_by(served, problem)
                found.setdefault((each.tobytes(), _weighs(served)), each)
        if kind.energy is not None:
            each = _served_by(kind, problem)
            found.setdefault((each.tobytes(), kind.energy.dimension), each)
    return found


def _has_own_table(kind: VehicleType | DroneType) -> bool:
    """Tell whether service may last otherwise than customers say, or some of a load weighs."""
    return bool(kind.service_durations) or _weighs(kind) is not None or (
        isinstance(kind, DroneType) and kind.service_duration is not None)


def _weighs(kind: VehicleType | DroneType) -> int | None:
    """Return which dimension of load weighs, if a battery limits drones."""
    if isinstance(kind, DroneType) and kind.energy is not None:
        return kind.energy.dimension
    return None


def _served_by(kind: VehicleType | DroneType, problem: Problem) -> IntArray:
    return np.array([kind.service_at(customer) for customer in problem.customers], np.int64)


def variant_of(kind: VehicleType | DroneType | None, problem: Problem,
               durations: dict[Variant, IntArray]) -> int:
    """Return the number of the table of nodes as trucks, or drones, of a type meet them."""
    if kind is None or not _has_own_table(kind):
        return 0
    return list(durations).index((_served_by(kind, problem).tobytes(), _weighs(kind)))


def weighed_variant_of(kind: VehicleType, problem: Problem,
                       durations: dict[Variant, IntArray]) -> int:
    """Return the number of the table by which the battery of who flies by itself is limited."""
    if kind.energy is None:
        return 0
    return list(durations).index((_served_by(kind, problem).tobytes(), kind.energy.dimension))


def way_of(kind: VehicleType, sets_up: bool) -> Variation:
    """Return the legs by which vehicles of a type travel, with setups where any are told apart."""
    return Variation(kind.travel, sets_up and kind.speed_profile is None, kind.launch_duration,
                     kind.recovery_duration)


def ways_of(problem: Problem) -> list[Variation]:
    """Return all ways to travel that legs are needed of."""
    if not has_setups(problem):
        plain = dict.fromkeys(Variation(travel, False) for travel in range(len(problem.travel)))
        return list(plain | dict.fromkeys(way_of(kind, False) for kind in problem.vehicle_types))
    ways: dict[Variation, None] = {}
    for kind in problem.vehicle_types:
        ways[way_of(kind, True)] = None
        if kind.limited is not None:
            ways[Variation(kind.limited, False)] = None
        if kind.max_range is not None:
            ways[Variation(kind.straight, False)] = None
        for drones in kind.drone_types:
            ways |= {Variation(drones.travel, True): None, Variation(drones.travel, False): None}
            if drones.max_range is not None:
                ways[Variation(drones.straight, False)] = None
    return list(ways)


def are_stated(problem: Problem, ways: Sequence[Variation]) -> bool:
    """Tell whether no leg is computed where it is looked up, and all fit 32 bits with setups."""
    setup = max([customer.setup_duration for customer in problem.customers], default=0)
    for way in ways:
        travel = problem.travel[way.travel]
        more = way.launch + way.recovery + (setup if way.sets_up else 0)
        if travel.narrow() is None or (more and travel.longest()[0] + more > LONGEST_NARROW):
            return False
    return True


def index_of(ways: Sequence[Variation], way: Variation) -> int:
    """Return which legs are those of a way, with setups if any are told apart."""
    return ways.index(way if way in ways else way._replace(sets_up=False))


def write_legs(problem: Problem, ways: Sequence[Variation], setup: Records, duration: IntArray,
               distance: IntArray, pause: Pause) -> None:
    """Write the legs of all ways, (way, origin, to); `setup` has those at nodes. In place."""
    nodes = problem.num_nodes
    for index, way in enumerate(ways):
        travel = problem.travel[way.travel]
        for part in matrix_blocks(nodes, pause):
            duration[index, part, :nodes] = travel.duration[part]
            distance[index, part, :nodes] = travel.distance[part]
            if way.sets_up:
                elsewhere = setup["site"][part, None] != setup["site"][:nodes]
                duration[index, part, :nodes] += elsewhere * setup["setup_duration"][:nodes]
        duration[index, :problem.num_depots, :nodes] += way.launch
        duration[index, :nodes, :problem.num_depots] += way.recovery
