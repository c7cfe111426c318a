"""What rows deliver and pick up, in the dimensions of the request."""

from collections.abc import Sequence
from typing import Any

from app.formats.sheets.columns import Column
from app.formats.sheets.readers import PICKUP
from app.formats.sheets.rows import Row


def dimensions(columns: Sequence[Column]) -> list[Column]:
    """Return the columns that tell the amounts: those delivered, and pickups of another kind."""
    amounts = [column for column in columns if column.meaning == "demand"]
    pickups = [column for column in columns if column.meaning == "pickup"]
    places = _places(amounts, pickups)
    return [*amounts, *(column for column, place in zip(pickups, places, strict=True)
                        if place >= len(amounts))]


def amounts_of(row: Row, amounts: Sequence[Column], pickups: Sequence[Column]) -> dict[str, Any]:
    """Return a customer's `demand`, and `pickup` if there is any."""
    places = _places(amounts, pickups)
    count = max([len(amounts), *(place + 1 for place in places)]) or 1
    demand, taken = [0.0] * count, [0.0] * count
    if not amounts and not pickups:
        demand = [1.0]
    for place, amount in enumerate(row.get("demand") or ()):
        demand[place] = amount or 0.0
    for place, amount in zip(places, row.get("pickup") or (), strict=False):
        taken[place] += amount or 0.0
    if row.get("kind") == PICKUP and not any(taken):
        demand, taken = [0.0] * count, demand
    return {"demand": demand} | ({"pickup": taken} if any(taken) else {})


def _places(amounts: Sequence[Column], pickups: Sequence[Column]) -> list[int]:
    """Return the dimension of each column of pickups: the first in its unit, else a new one."""
    places: list[int] = []
    for column in pickups:
        free = [place for place in range(len(amounts)) if place not in places]
        same = [place for place in free if amounts[place].unit == column.unit]
        alike = same or [place for place in free if None in (amounts[place].unit, column.unit)]
        new = max([len(amounts) - 1, *places]) + 1
        places.append(alike[0] if alike else new)
    return places
