"""Names of vehicles and drones: those of their type or truck, and a number from 1."""

import re
from collections.abc import Collection, Sequence
from typing import NamedTuple

from app.schemas.vehicle import VehicleTypeInput


def drones_of(vehicle_type: str, drone_type: str | None) -> str:
    """Return the name of the drones, of a type that is told if there is a list of them."""
    return f"{vehicle_type}/{drone_type or 'drone'}"


def number_in(prefix: str, name: str) -> int | None:
    """Return the 0-based number at the end of a name; None if it is none with that prefix."""
    match = re.fullmatch(re.escape(prefix) + "([1-9][0-9]{0,8})", name)
    return None if match is None else int(match[1]) - 1


def drone_number(name: str) -> int | None:
    """Return the 0-based number of a drone on its truck, at the end of its name."""
    return number_in("", name.rpartition("-")[2])


def called(fleet: Sequence[VehicleTypeInput], vehicle: str) -> str:
    """Return what people call a vehicle: its name if it has one, its type's if it is the only one.

    Of what no type has, it is the name in the plan.
    """
    for kind in fleet:
        number = number_in(f"{kind.id}-", vehicle)
        if number is not None and number < kind.count:
            names = kind.names or ([kind.id] if kind.count == 1 else [])
            return names[number] if number < len(names) else vehicle
    return vehicle


class Named(NamedTuple):
    """A vehicle of the fleet, or one of its drones."""

    vehicle_type: str
    number: int  # from 0
    drone: int | None  # from 0; None: the vehicle itself


def read_name(name: str, types: Collection[str]) -> Named | None:
    """Return what a name such as `truck-2` or `truck-2/drone-1` means; None: no type is so called.
    """
    for type_id in types:
        number = number_in(f"{type_id}-", name)
        if number is not None:
            return Named(type_id, number, None)
    vehicle, _, ending = name.rpartition("/drone-")
    truck, drone = read_name(vehicle, types) if vehicle else None, number_in("", ending)
    if truck is None or truck.drone is not None or drone is None:
        return None
    return truck._replace(drone=drone)
