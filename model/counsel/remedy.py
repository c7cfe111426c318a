"""What would have to be otherwise for somebody to be served: as data, and in words made of it."""

from collections.abc import Callable
from dataclasses import dataclass
from decimal import Decimal
from typing import NamedTuple

from model.judge.clock import MS_PER_MINUTE
from model.judge.rules import decimal
from model.problem import MAX_QUANTITY, MM_PER_KM, Problem
from model.problem.limits import LIMITS, StatedLimit

LAST_WINDOW = -1

THOUSANDTHS = 3


class Change(NamedTuple):
    """One limit that would have to be another."""

    limit: str  # as `CLAUSES` has it
    of: str = ""  # whose it is in words, where that has to be said
    quantity: float = 0  # how much more of it, or how much of it at least: ms, mm, or a number
    amounts: tuple[Decimal, ...] = ()  # in the client's unit
    names: tuple[str, ...] = ()  # of skills, or of vehicles that are to be allowed
    window: int = 0  # from 1, of several; `LAST_WINDOW`: the last of them; 0: the only one


Part = tuple[Change, ...]
"""Changes that one rule asks for; none if it isn't known what would keep it."""


@dataclass(frozen=True)
class Remedy:
    """Changes that suffice together, by the rules that ask for them."""

    parts: tuple[Part, ...]

    @property
    def changes(self) -> tuple[Change, ...]:
        """All changes."""
        return tuple([change for part in self.parts for change in part])

    def with_changes(self, change: Callable[[Change], Change]) -> "Remedy":
        """Return a remedy whose changes are told otherwise."""
        return Remedy(tuple([tuple(map(change, part)) for part in self.parts]))

    def __str__(self) -> str:
        """All of it in words."""
        begin = BEGINNINGS.get(self.changes[0].limit, "fits")
        return f"{begin} {' and '.join(map(_clause, self.parts))}"


def remedy_of(limit: str, of: str = "", quantity: float = 0) -> Remedy:
    """Return the remedy that changes one limit."""
    return Remedy(((Change(limit, of, quantity),),))


def if_stated(change: Change, quantity: int) -> Part:
    """Return a change if a request can state the quantity that it asks for, else none."""
    return (change,) if quantity <= MAX_QUANTITY else ()


def in_units(problem: Problem, load: tuple[int, ...]) -> tuple[Decimal, ...]:
    """Return amounts in the client's unit."""
    return tuple([Decimal(amount).scaleb(-places) for amount, places
                  in zip(load, problem.amount_decimals, strict=True)])


def in_minutes(duration: float) -> str:
    """Return a duration for people."""
    number = decimal(int(duration) * 1000 // MS_PER_MINUTE)
    return "1 minute" if number == "1" else f"{number} minutes"


def in_km(distance: float) -> str:
    """Return a distance for people."""
    return f"{decimal(int(distance) * 1000 // MM_PER_KM)} km"


def _clause(part: Part) -> str:
    first, *others = [CLAUSES[change.limit](change) for change in part]
    return " and ".join([first, *[other.removeprefix("if ") for other in others]])


def _amounts(change: Change) -> str:
    return ", ".join([f"{amount.normalize():f}" for amount in change.amounts])


def _flyers(change: Change) -> str:
    """Say of which type drones are, where several are told apart."""
    return f" of {change.of}" if change.of else ""


def _drones(change: Change) -> str:
    return f" of {change.names[0]}" if change.names else ""


def _window(change: Change) -> str:
    names = {0: "window", LAST_WINDOW: "last window"}
    return names.get(change.window, f"window {change.window}")


def _wider(change: Change) -> str:
    where = f" at {change.of}" if change.of else ""
    return f"if its {_window(change)}{where} closed {in_minutes(change.quantity)} later"


BEGINNINGS = {"unassigned_cost": "served", "own_unassigned_cost": "served", "buffer": "lies"}

IN_WORDS: dict[str, Callable[[float], str]] = {
    "minute": in_minutes, "km": in_km, "unit": lambda number: f"{number:g}"}
"""A number of a limit, by what people count it in."""


def _stated(limit: StatedLimit) -> Callable[[Change], str]:
    """Return what tells in words how much of a limit suffices."""
    of = _flyers if limit.whose == "flyer" else lambda change: change.of
    return lambda change: limit.words.format(
        of=of(change), quantity=IN_WORDS[limit.step.name](change.quantity),
        s="" if change.quantity == 1 else "s")


CLAUSES: dict[str, Callable[[Change], str]] = {
    **{name: _stated(limit) for name, limit in LIMITS.items() if limit.words},
    "vehicles": lambda change: f"if {' and '.join(change.names)} may serve it",
    "by_truck": lambda _: "if a truck may serve it",
    "by_drone": lambda _: "if a drone may serve it",
    "skills": lambda change: f"if {change.of} had {', '.join(change.names)}",
    "capacity": lambda change: f"if capacity were at least {_amounts(change)}",
    "drone_capacity": lambda change:
        f"if the drone capacity{_flyers(change)} were at least {_amounts(change)}",
    "pickups": lambda change: f"if {change.of} may pick up at any time",
    "window": _wider,
    "end_window": lambda change: f"if the {_window(change)} of its {change.of} closed "
                                 f"{in_minutes(change.quantity)} later",
    "detour": lambda change:
        f"if max_detour were at least {decimal(int(change.quantity), THOUSANDTHS)}",
    "lag": lambda change: f"if max_lag of its orders were at least {in_minutes(change.quantity)}",
    "relations": lambda _: "without its relations",
    "wind": lambda change: f"without max_wind_kmh{_flyers(change)}",
    "battery": lambda change:
        f"with a battery{_flyers(change)} of {decimal(int(change.quantity), 1)} Wh more",
    "batteries_aboard": lambda change: f"if {change.of} carried 1 battery{_drones(change)}",
    "launch": lambda change: f"if drones may take off at {change.of}",
    "depot_hours": lambda change: f"if {change.of} closed {in_minutes(change.quantity)} later",
    "rests_in_flight": lambda change: f"if {change.of}'s drivers may rest while drones fly",
    "break_load": lambda change: f"if break {change.of} allowed {_amounts(change)} aboard",
    "break_start": lambda change:
        f"if break {change.of} could begin {in_minutes(change.quantity)} later",
    "break": lambda change: f"without break {change.of}",
    "trips": lambda change: f"if {change.of} could make another trip",
    "count": lambda change: f"with one more vehicle{_flyers(change)}",
    "hub_batteries": lambda change: f"with one more battery at {change.of}",
    "hub_chargers": lambda change: f"with one more charger at {change.of}",
    "unassigned_cost": lambda change: f"if unassigned_cost were above {change.quantity:.2f}",
    "own_unassigned_cost": lambda change:
        f"if its unassigned_cost were above {change.quantity:.2f}",
    "buffer": lambda change: f"far enough away with airspace.buffer {change.quantity}",
}
"""What a limit would have to be, in words, by its name."""
