"""Vehicles of a type told apart, where customers name single ones: groups of equal vehicles."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from app.requests.conversion.names import number_in
from app.schemas.customer import CustomerInput
from app.schemas.launch_site import LaunchSiteInput
from app.schemas.vehicle import VehicleTypeInput
from model.problem import BoolArray, VehicleType

MOST_NAMED = 3
"""Vehicles of a group that its name tells."""

Place = tuple[int, int | None]
"""Index of a vehicle type, and number of a vehicle of it from 0; None: all of them."""


class Group(NamedTuple):
    """Vehicles of a type whom all customers, and all launch sites, treat alike."""

    type: int  # index in the fleet
    numbers: tuple[int, ...] | None  # from 0, ascending; None: all of the type
    is_named: bool  # customers name them: one more vehicle of the type would be none of them
    serves: BoolArray  # (customer,), then (launch site,)


class Roster:
    """Types and vehicles by name."""

    def __init__(self, fleet: Sequence[VehicleTypeInput]) -> None:
        self._types = {kind.id: (index, kind.count) for index, kind in enumerate(fleet)}

    def find(self, name: str) -> Place | None:
        """Return the type that a name means, else the vehicle; None if there is none."""
        if name in self._types:
            return self._types[name][0], None
        stem = name.rpartition("-")[0]
        index, count = self._types.get(stem, (0, 0))
        number = number_in(f"{stem}-", name)
        return None if number is None or number >= count else (index, number)


def groups_of(fleet: Sequence[VehicleTypeInput],
              customers: Sequence[CustomerInput | LaunchSiteInput]) -> Iterator[Group]:
    """Yield vehicles by whom they may serve, as few groups as need be; none if anybody anyone.

    Launch sites come behind customers. What they name is there. A type's groups follow one another,
    unnamed vehicles first.
    """
    choosy = [(column, customer.vehicles) for column, customer in enumerate(customers)
              if customer.vehicles is not None and customer.vehicles.names]
    if not choosy:
        return
    roster = Roster(fleet)
    places = {name: roster.find(name)
              for name in {name for _, vehicles in choosy for name in vehicles.names}}
    usual: BoolArray = np.ones((len(fleet), len(customers)), np.bool_)
    unusual: list[dict[int, list[int]]] = [defaultdict(list) for _ in fleet]
    for column, vehicles in choosy:
        is_allowed = vehicles.allowed is not None
        named = {place for name in vehicles.names if (place := places[name]) is not None}
        usual[:, column] = not is_allowed
        usual[[kind for kind, number in named if number is None], column] = is_allowed
        for kind, number in named:
            if number is not None and usual[kind, column] != is_allowed:
                unusual[kind][number].append(column)
    for kind, stated in enumerate(fleet):
        yield from _groups(kind, stated.count, usual[kind], unusual[kind])


def _groups(kind: int, count: int, usual: BoolArray,
            unusual: Mapping[int, Sequence[int]]) -> Iterator[Group]:
    """Yield a type's groups by the customers whom single vehicles don't treat as usual."""
    alike: dict[tuple[int, ...], list[int]] = defaultdict(list)
    for number in sorted(unusual):
        alike[tuple(unusual[number])].append(number)
    if not alike:
        yield Group(kind, None, False, usual)
    elif len(unusual) < count:
        rest = tuple([number for number in range(count) if number not in unusual])
        yield Group(kind, rest, False, usual)
    for columns, numbers in alike.items():
        serves = usual.copy()
        serves[list(columns)] ^= True
        yield Group(kind, tuple(numbers), True, serves)


def part_of(kind: VehicleType, group: Group) -> VehicleType:
    """Return a type with the vehicles of a group alone."""
    if group.numbers is None:
        return kind
    return replace(kind, id=_label(kind.id, group), count=len(group.numbers), part_of=kind.id,
                   numbers=group.numbers)


def _label(name: str, group: Group) -> str:
    """Return how people call a group."""
    numbers = group.numbers or ()
    if not group.is_named:
        return name
    told = ", ".join(f"{name}-{number + 1}" for number in numbers[:MOST_NAMED])
    more = len(numbers) - MOST_NAMED
    return f"{told} and {more} more" if more > 0 else told
