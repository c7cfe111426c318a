"""Names of vehicles and drones: those of their type or truck, and a number from 1."""

import re


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
