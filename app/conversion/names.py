"""Names of vehicles and drones: those of their type or truck, and a number from 1."""

import re


def drones_of(vehicle_type: str) -> str:
    """Return the name of the drones that ride on the trucks of a type."""
    return f"{vehicle_type}/drone"


def number_in(prefix: str, name: str) -> int | None:
    """Return the 0-based number at the end of a name; None if it is none with that prefix."""
    match = re.fullmatch(re.escape(prefix) + "([1-9][0-9]{0,8})", name)
    return None if match is None else int(match[1]) - 1
