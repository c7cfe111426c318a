"""Vehicles of a type told apart, where customers name single ones: groups of equal vehicles."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from app.requests.conversion.names import number_in
from app.schemas.customer import CustomerInput, VehiclesInput
from app.schemas.launch_site import LaunchSiteInput
from app.schemas.vehicle import VehicleTypeInput
from model.problem import BoolArray, FloatArray, VehicleType

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
    costs: FloatArray  # likewise, of serving; none if nobody states any


class Roster:
    """Types and vehicles by name."""

    def __init__(self, fleet: Sequence[VehicleTypeInput]) -> None:
        self._types = {kind.id: (index, kind.count) for index, kind in enumerate(fleet)}
        self._found: dict[str, Place | None] = {}  # thousands may name the same thousand

    def find(self, name: str) -> Place | None:
        """Return the type that a name means, else the vehicle; None if there is none."""
        if name not in self._found:
            self._found[name] = self._look_up(name)
        return self._found[name]

    def _look_up(self, name: str) -> Place | None:
        if name in self._types:
            return self._types[name][0], None
        stem = name.rpartition("-")[0]
        index, count = self._types.get(stem, (0, 0))
        number = number_in(f"{stem}-", name)
        return None if number is None or number >= count else (index, number)


class _Terms(NamedTuple):
    """How vehicles are treated, by type: most of them, and those that aren't treated so."""

    serves: BoolArray  # (type, customer)
    costs: FloatArray  # likewise
    barred: list[dict[int, list[int]]]  # by vehicle: who treats it otherwise than `serves` says
    priced: list[dict[int, list[tuple[int, float]]]]  # by vehicle: who states another cost


def groups_of(fleet: Sequence[VehicleTypeInput],
              customers: Sequence[CustomerInput | LaunchSiteInput]) -> Iterator[Group]:
    """Yield vehicles by whom they may serve at what cost, as few groups as need be.

    None if anybody serves anyone at none. Launch sites come behind customers. What they name is
    there. A type's groups follow one another, unnamed vehicles first.
    """
    choosy = [(column, customer.vehicles) for column, customer in enumerate(customers)
              if customer.vehicles is not None and customer.vehicles.names]
    priced = [(column, customer.vehicle_costs) for column, customer in enumerate(customers)
              if isinstance(customer, CustomerInput) and customer.vehicle_costs]
    if not choosy and not priced:
        return
    roster = Roster(fleet)
    width = len(customers)
    terms = _Terms(np.ones((len(fleet), width), np.bool_),
                   np.zeros((len(fleet), width if priced else 0)),
                   [defaultdict(list) for _ in fleet], [defaultdict(list) for _ in fleet])
    _let_serve(terms, roster, choosy)
    _let_cost(terms, roster, priced)
    for kind, stated in enumerate(fleet):
        yield from _groups(kind, stated.count, terms)


def _let_serve(terms: _Terms, roster: Roster,
               choosy: Sequence[tuple[int, VehiclesInput]]) -> None:
    """Note who lets only some vehicles serve him. In place."""
    for column, vehicles in choosy:
        is_allowed = vehicles.allowed is not None
        named = set(filter(None, map(roster.find, vehicles.names)))
        terms.serves[:, column] = not is_allowed
        terms.serves[[kind for kind, number in named if number is None], column] = is_allowed
        for kind, number in named:
            if number is not None and terms.serves[kind, column] != is_allowed:
                terms.barred[kind][number].append(column)


def _let_cost(terms: _Terms, roster: Roster,
              priced: Sequence[tuple[int, Mapping[str, float]]]) -> None:
    """Note who costs more by some vehicles. In place."""
    for column, costs in priced:
        places = {place: cost for name, cost in costs.items()
                  if (place := roster.find(name)) is not None}
        for (kind, number), cost in places.items():
            if number is None:
                terms.costs[kind, column] = cost
        for (kind, number), cost in places.items():
            if number is not None and terms.costs[kind, column] != cost:
                terms.priced[kind][number].append((column, cost))


def _groups(kind: int, count: int, terms: _Terms) -> Iterator[Group]:
    """Yield a type's groups by the customers who don't treat single vehicles as usual."""
    alike: dict[tuple[tuple[int, ...], tuple[tuple[int, float], ...]], list[int]]
    alike = defaultdict(list)
    usual, cost = terms.serves[kind], terms.costs[kind]
    barred, priced = terms.barred[kind], terms.priced[kind]
    unusual = barred.keys() | priced.keys()
    for number in sorted(unusual):
        alike[tuple(barred.get(number, ())), tuple(priced.get(number, ()))].append(number)
    if not alike:
        yield Group(kind, None, False, usual, cost)
    elif len(unusual) < count:
        rest = tuple([number for number in range(count) if number not in unusual])
        yield Group(kind, rest, False, usual, cost)
    for (columns, prices), numbers in alike.items():
        serves, costs = usual.copy(), cost.copy()
        serves[list(columns)] ^= True
        for column, price in prices:
            costs[column] = price
        yield Group(kind, tuple(numbers), True, serves, costs)


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
