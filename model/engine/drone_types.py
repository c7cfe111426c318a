"""Types of drones on one truck: rows of vehicle types, as if the truck had these drones alone.

A truck with drones of one type is told by its own row. One with several has a row more for each of
them, behind those of all trucks, which follow one another by their `drone_row`; in its own, what is
said of drones holds for the most that any of them can, and all are counted.
"""

from dataclasses import replace

from model.engine.records import Records
from model.problem import BoolArray, Problem, VehicleType

NO_ROW = -1

Kind = tuple[VehicleType, int, int]
"""A type of vehicles as its row has it, the index of its type and the row that `drone_row` names.
"""


def all_kinds(problem: Problem) -> list[Kind]:
    """Return the types of vehicles, as their rows have them, then those of their drones apart."""
    kinds: list[Kind] = []
    apart: list[Kind] = []
    for index, kind in enumerate(problem.vehicle_types):
        first, number = len(problem.vehicle_types) + len(apart), len(kind.drone_types)
        if number < 2:
            kinds.append((kind, index, NO_ROW))
            continue
        kinds.append((_with_most(kind), index, first))
        apart += [
            (replace(kind, drones=drones, more_drones=(), charge_left=(), max_sorties=None), index,
             first + place + 1 if place + 1 < number else NO_ROW)
            for place, drones in enumerate(kind.drone_types)]
    return kinds + apart


def _with_most(kind: VehicleType) -> VehicleType:
    """Return a truck whose drones can what any of them can, by no battery's leave."""
    types = kind.drone_types
    most = replace(
        types[0], count=kind.num_drones,
        capacity=tuple([max(amounts) for amounts in zip(*(drones.capacity for drones in types),
                                                        strict=True)]),
        endurance=max(drones.endurance for drones in types), energy=None, batteries=None, storms=(),
        closings=(),
        service_duration=None, service_durations={},
        swap_duration=max(drones.swap_duration for drones in types),
        recovery_duration=max(drones.recovery_duration for drones in types),
        max_customers_per_sortie=max(drones.max_customers_per_sortie for drones in types))
    return replace(kind, drones=most, more_drones=())


def any_aboard(types: Records, marked: BoolArray) -> BoolArray:
    """Mark the rows that are marked, and trucks that carry drones whose row is."""
    any_marked = marked.copy()
    for k in range(len(types) - 1, -1, -1):
        any_marked[k] |= types[k].drone_row >= 0 and any_marked[types[k].drone_row]
    return any_marked
