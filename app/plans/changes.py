"""Remedies as changes of the request: where, as errors tell it, and by or to what."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, cast

from pydantic import BaseModel

from app.schemas.customer import place_name
from app.schemas.errors import json_path
from app.schemas.fields import MAX_AMOUNT
from app.schemas.relation import RelationInput
from app.schemas.request import PlanRequest
from app.schemas.shipment import EndKind, ShipmentInput, end_name
from app.schemas.times import Written
from app.schemas.written import length_like
from model.counsel.remedy import Change, Remedy
from model.problem.limits import LIMITS, ONE, StatedLimit, Whose

Data = dict[str, Any]
Keys = tuple[str | int, ...]
Found = list[tuple[Keys, Data]]
"""Places of a request, and `by` or `to` what each changes."""

CENT = 0.01

MOST_RELATED = 500
"""Customers in all relations up to which a remedy repeats these: each repeats them all."""

THOUSANDTHS = 1000
"""Of a second, a metre or a factor, in which problems count."""


class NowhereError(Exception):
    """The request states nothing of that kind, or could not state so much."""


@dataclass(frozen=True)
class Stated:
    """A request, and where it states whom: worked out once, for thousands who are left out."""

    request: PlanRequest

    @cached_property
    def customers(self) -> dict[str, Keys]:
        """Where customers are, their other places, and ends of shipments, by name."""
        customers = [*enumerate(self.request.customers)]
        return {
            **{place_name(each.id, place.id): ("customers", number, "alternatives", index)
               for number, each in customers for index, place in enumerate(each.alternatives)},
            **{each.id: ("customers", number) for number, each in customers},
            # Ends are among customers, too.
            **{name: ("shipments", number, *parsed(where))
               for number, each in enumerate(self.request.shipments)
               for name, where in each.named_ends()}}

    @cached_property
    def shipments(self) -> dict[str, Keys]:
        """Where shipments are."""
        return {each.id: ("shipments", number)
                for number, each in enumerate(self.request.shipments)}

    @cached_property
    def units(self) -> dict[str, str]:
        """The shipment of each end, by the end's name."""
        return {name: each.id for each in self.request.shipments for name, _ in each.named_ends()}


@dataclass(frozen=True)
class Changing:
    """The request, the vehicle type whose remedy it is, and who is left out: where, and his id."""

    stated: Stated
    type: Keys = ()
    subject: Keys = ()
    name: str = ""

    @classmethod
    def of(cls, stated: Stated, kind: str, left_out: str, is_shipment: bool) -> "Changing":
        """Return it by ids of the vehicle type, and of the customer or shipment."""
        places = stated.shipments if is_shipment else stated.customers
        type_at: Keys = ("fleet", _index(stated.request.fleet, kind))
        return cls(stated, type_at, places[left_out], left_out)

    @property
    def request(self) -> PlanRequest:
        """The request."""
        return self.stated.request

    def changes(self, remedy: Remedy) -> list[Data]:
        """Return all changes of a remedy; none if the request has no place for one of them.

        On a day under way, what is left to do is not always stated by itself.
        """
        try:
            return [{"path": json_path(keys), **value} for change in remedy.changes
                    for keys, value in CHANGES[change.limit](self, change)]
        except NowhereError:
            return []

    @property
    def place(self) -> Keys:
        """Return where it is said how he is served: of a shipment that is fetched, its delivery."""
        is_shipment = isinstance(self.at(self.subject), ShipmentInput)
        return (*self.subject, "delivery") if is_shipment else self.subject

    def who(self, change: Change) -> str | None:
        """Return the id of whom a change is about, None for the whole request."""
        whose = WHOSE.get(change.limit, "type")
        if whose == "request":
            return None
        if whose == "subject":
            return change.of or self.name
        if whose == "end":
            end, _, part = change.of.partition(" ")
            return end_name(self.name, cast("EndKind", end), part or None)
        drones = "".join(change.names) if change.limit == "batteries_aboard" else change.of
        name = {"drones": drones, "named": change.of}.get(whose)
        return name or str(self.at(self.type).id)

    def at(self, keys: Keys) -> Any:
        """Return what the request states at a place."""
        value: Any = self.request
        for key in keys:
            if isinstance(key, str) and not hasattr(value, key):
                raise NowhereError
            value = getattr(value, key) if isinstance(key, str) else value[key]
        return value

    def written(self, keys: Keys, seconds: float, is_instant: bool = False) -> str | float:
        """Return seconds as the request writes the time that stands at a place."""
        value, seconds, day = self.at(keys), round(seconds, 3), self.request.day
        if not isinstance(value, Written):
            return seconds
        if not is_instant or value.is_length or day is None:
            return length_like(value.text, seconds)
        return day.iso(seconds) if value.is_dated else day.clock(seconds)

    def more(self, keys: Keys, more: float, is_instant: bool = False) -> Found:
        """Return that a number grows: `to` what, where it isn't stated as a number."""
        *holder, name = keys
        value, stated = self.at(keys), self.at(tuple(holder)).model_fields_set
        if value is None or value + more > MAX_AMOUNT:
            raise NowhereError
        if name in stated and not isinstance(value, Written):
            return [(keys, {"by": more})]
        return [(keys, {"to": self.written(keys, value + more, is_instant)})]

    def flyer(self, of: str) -> Keys:
        """Return where drones are stated, of several types those of an id."""
        kind = self.at(self.type)
        if kind.flies:
            return self.type
        path = next((path for path, drones in kind.drones_by_path if (drones.id or "") == of), None)
        if path is None:
            raise NowhereError
        return *self.type, *path

    def named(self, all_of: str, name: str, *keys: str) -> Keys:
        """Return the place of a depot, or a break of the vehicle type, and what of it is meant."""
        holder = self.type if all_of == "breaks" else ()
        return *holder, all_of, _index(self.at((*holder, all_of)), name), *keys


def _index(stated: list[Any], name: str) -> int:
    for index, each in enumerate(stated):
        if each.id == name:
            return index
    raise NowhereError


def parsed(path: str) -> Keys:
    """Return names and numbers of a path, such as `pickups[1].time_window`."""
    return tuple([int(index) if index else name
                  for name, index in re.findall(r"(\w+)|\[(-?\d+)]", path)])


def as_written(value: Any) -> Any:
    """Return a part of a request as JSON, as it was sent."""
    if isinstance(value, BaseModel):
        return {name: as_written(getattr(value, name)) for name in type(value).model_fields
                if name in value.model_fields_set}
    if isinstance(value, list):
        return list(map(as_written, value))
    return value.text if isinstance(value, Written) else value


def _vehicles(of: Changing, change: Change) -> Found:
    keys = (*of.subject, "vehicles")
    vehicles = of.at(keys)
    if vehicles is None:
        raise NowhereError  # on a day under way, another vehicle has it aboard
    if vehicles.allowed is not None:
        return [((*keys, "allowed"), {"to": [*vehicles.allowed, *change.names]})]
    left = [name for name in vehicles.forbidden if name not in change.names]
    return [((*keys, "forbidden"), {"to": left})] if left else [(keys, {"to": None})]


def _window(of: Changing, change: Change) -> Found:
    keys = of.place
    if change.of:
        customer = of.at(keys)
        keys = (*keys, "alternatives",
                _index(customer.alternatives, change.of.removeprefix(f"{customer.id}/")))
    return _closing(of, keys, change)


def _end_window(of: Changing, change: Change) -> Found:
    end, _, part = change.of.partition(" ")
    if part:
        return _closing(of, (*of.subject, "pickups",
                             _index(of.at((*of.subject, "pickups")), part)), change)
    return _closing(of, (*of.subject, end), change)


def _closing(of: Changing, keys: Keys, change: Change) -> Found:
    """Return that a window closes later, though before the next opens."""
    windows, more = of.at((*keys, "time_windows")), change.quantity / THOUSANDTHS
    if windows is None:
        return _later(of, (*keys, "time_window"), more)
    number = change.window - 1 if change.window > 0 else len(windows) - 1
    if number + 1 < len(windows):
        # Windows don't touch: a millisecond lies between.
        more = min(more, windows[number + 1].earliest - 0.001 - windows[number].latest)
    return _later(of, (*keys, "time_windows", number), round(more, 3))


def _later(of: Changing, window: Keys, more: float) -> Found:
    found = of.more((*window, "latest"), more, is_instant=True)
    earliest = of.at((*window, "earliest"))
    if isinstance(earliest, Written) and earliest.is_moved:
        # Of a night that follows it stays, though its end is written otherwise.
        found.append(((*window, "earliest"),
                      {"to": of.written((*window, "earliest"), earliest, is_instant=True)}))
    return found


def _lags(of: Changing, change: Change) -> Found:
    names, least = _names(of), change.quantity / THOUSANDTHS
    return [(keys, {"to": of.written(keys, least)})
            for number, each in enumerate(of.request.relations)
            for keys in [("relations", number, "max_lag")]
            if each.max_lag is not None and each.max_lag < least and names & {*each.customers}]


def _names(of: Changing) -> set[str]:
    """Return how relations name who is left out."""
    left_out = of.at(of.subject)
    if isinstance(left_out, ShipmentInput):
        return {name for name, _ in left_out.named_ends()}
    return {of.name}


def unrelated(of: Changing) -> Found:
    """Return that relations bind somebody no longer; of one alone nothing is left."""
    names, relations = _names(of), of.request.relations
    if sum(len(each.customers) for each in relations) > MOST_RELATED:
        raise NowhereError

    def is_left(each: RelationInput, others: list[str]) -> bool:
        # Ends of one shipment go together anyhow.
        units = {of.stated.units.get(name, f"customer {name}") for name in others}
        return len(others) > 1 and (each.kind == "before" or len(units) > 1)

    left = []
    for each in relations:
        others = [name for name in each.customers if name not in names]
        if is_left(each, others):
            left.append({**as_written(each), "customers": others})
    return [(("relations",), {"to": left})]


def _to(value: object, *keys: str) -> Callable[[Changing, Change], Found]:
    """Return what sets a field of the vehicle type."""
    return lambda of, _: [((*of.type, *keys), {"to": value})]


def _stated(limit: StatedLimit) -> Callable[[Changing, Change], Found]:
    """Return what changes a number where the request states it."""
    owners: dict[Whose, Callable[[Changing, Change], Keys]] = {
        "customer": lambda of, _: of.subject, "shipment": lambda of, _: of.subject,
        "vehicle_type": lambda of, _: of.type, "flyer": lambda of, change: of.flyer(change.of),
        "drones": lambda of, change: of.flyer("".join(change.names))}
    owner, path = owners[limit.whose], limit.path.split(".")

    def found(of: Changing, change: Change) -> Found:
        keys, quantity = (*owner(of, change), *path), change.quantity
        if limit.step is not ONE:
            quantity /= THOUSANDTHS
        if limit.is_total:
            return [(keys, {"to": of.written(keys, quantity)})]
        return of.more(keys, quantity, is_instant=limit.is_instant)

    return found


def _one_more(all_of: str, name: str) -> Callable[[Changing, Change], Found]:
    """Return what adds one at a depot."""
    return lambda of, change: of.more(of.named(all_of, change.of, name), 1)


def _amounts(change: Change) -> Data:
    return {"to": list(map(float, change.amounts))}


WHOSE: dict[str, Literal["subject", "end", "drones", "named", "request"]] = {
    **{name: "subject" for name, limit in LIMITS.items()
       if limit.whose in {"customer", "shipment"}},
    **{name: "drones" for name, limit in LIMITS.items() if limit.whose in {"flyer", "drones"}},
    **dict.fromkeys(("by_truck", "by_drone", "window", "detour", "lag", "relations",
                     "own_unassigned_cost"), "subject"),
    "end_window": "end",
    **dict.fromkeys(("drone_capacity", "wind", "battery"), "drones"),
    **dict.fromkeys(("launch", "depot_hours", "hub_batteries", "hub_chargers", "break",
                     "break_load", "break_start"), "named"),
    **dict.fromkeys(("unassigned_cost", "buffer"), "request"),
}
"""Whom a limit is of, where that isn't the vehicle type: `named` are depots and breaks."""

CHANGES: dict[str, Callable[[Changing, Change], Found]] = {
    **{name: _stated(limit) for name, limit in LIMITS.items()},
    "vehicles": _vehicles,
    "by_truck": lambda of, _: [((*of.place, "served_by"), {"to": "either"})],
    "by_drone": lambda of, _: [((*of.place, "served_by"), {"to": "either"})],
    "skills": lambda of, change: [((*of.type, "skills"), {
        "to": [*of.at((*of.type, "skills")), *change.names]})],
    "capacity": lambda of, change: [((*of.type, "capacity"), _amounts(change))],
    "drone_capacity": lambda of, change: [
        ((*of.flyer(change.of), "capacity"), _amounts(change))],
    "pickups": _to("any", "pickups"),
    "window": _window,
    "end_window": _end_window,
    "time_aboard": lambda of, change: of.more(
        (*of.subject, "max_time_aboard" if of.place == of.subject else "max_time_between"),
        change.quantity / THOUSANDTHS),
    "detour": lambda of, change: [
        ((*of.subject, "max_detour"), {"to": change.quantity / THOUSANDTHS})],
    "lag": _lags,
    "relations": lambda of, _: unrelated(of),
    "wind": lambda of, change: [((*of.flyer(change.of), "max_wind_kmh"), {"to": None})],
    "battery": lambda of, change: of.more((*of.flyer(change.of), "energy", "battery_wh"),
                                          change.quantity / 10),
    "launch": lambda of, change: [(of.named("depots", change.of, "launch"), {"to": True})],
    "depot_hours": lambda of, change: of.more(
        of.named("depots", change.of, "time_window", "latest"), change.quantity / THOUSANDTHS,
        is_instant=True),
    "rests_in_flight": _to(True, "driving_rules", "while_drones_fly"),
    "break_load": lambda of, change: [(of.named("breaks", change.of, "max_load"),
                                       _amounts(change))],
    "break_start": lambda of, change: of.more(of.named("breaks", change.of, "start", "latest"),
                                              change.quantity / THOUSANDTHS, is_instant=True),
    "break": lambda of, change: [((*of.type, "breaks"), {"to": [
        as_written(each) for each in of.at((*of.type, "breaks")) if each.id != change.of]})],
    "trips": lambda of, _: of.more((*of.type, "max_trips"), 1),
    "count": lambda of, _: of.more((*of.type, "count"), 1),
    "hub_batteries": _one_more("depots", "batteries"),
    "hub_chargers": _one_more("depots", "chargers"),
    "unassigned_cost": lambda _, change: [
        (("unassigned_cost",), {"to": round(change.quantity + CENT, 2)})],
    "buffer": lambda _, change: [(("airspace", "buffer"), {"to": change.quantity})],
    "own_unassigned_cost": lambda of, change: [
        ((*of.subject, "unassigned_cost"), {"to": round(change.quantity + CENT, 2)})],
}
"""Where the request states what a limit is of, and what it would have to say there."""
