"""A unit more of a limit that binds, or a rule lifted, as changes of the request."""

from collections.abc import Callable
from dataclasses import replace

from app.plans.changes import (
    Changing, Data, Keys, NowhereError, Stated, as_written, parsed, unrelated,
)
from app.schemas.errors import json_path
from app.schemas.fields import MAX_AMOUNT
from model.counsel.binding import Limit

SECONDS_OR_METRES = {"minute": 60.0, "km": 1000.0}
"""A unit in that of the request, where that isn't one."""

LESS = frozenset({"earliest", "release_time", "min_vehicles"})
"""Fields of which it is one less that may save something."""

Steps = Callable[[Limit, str, bool], list[Data]]
"""Tells a unit more of a limit by the id of whose it is, and whether that is a whole shipment."""

INSTANTS = frozenset({"earliest", "latest", "release_time"})

LIFTED: dict[str, object] = {
    "vehicles": None, "skills": [], "served_by": "either", "goods": [], "pickups": "any",
    "lifo": False, "truck_waits": False, "max_wind_kmh": None, "while_drones_fly": True}
"""What a field without a number is, where it forbids nothing."""


def step(stated: Stated, limit: Limit, at: str, is_shipment: bool) -> list[Data]:
    """Return what a unit more changes; none where the request has no place for it.

    `at` is the id of whose limit it is, as replies tell it, and may be that of a whole shipment.
    """
    try:
        of = _changing(stated, limit, at, is_shipment)
        return [{"path": json_path(keys), **value} for keys, value in _found(of, limit)]
    except NowhereError:
        return []


def _changing(stated: Stated, limit: Limit, at: str, is_shipment: bool) -> Changing:
    of = Changing(stated)
    if limit.whose == "request":
        return of
    if limit.kind is not None:
        return replace(of, type=of.named("fleet", at))
    return replace(of, name=at, subject=(stated.shipments if is_shipment else stated.customers)[at])


def _found(of: Changing, limit: Limit) -> list[tuple[Keys, Data]]:
    if limit.field == "relations":
        return unrelated(of)
    keys = _place(of, limit.field)
    *_, name = [key for key in keys if isinstance(key, str)]
    if limit.unit == "rule":
        return [_lifted(of, keys, name)]
    unit = SECONDS_OR_METRES.get(limit.unit, 1)
    if isinstance(keys[-1], int):
        if of.at(keys) + unit > MAX_AMOUNT:
            raise NowhereError
        return [(keys, {"by": unit})]
    if name in LESS:
        unit = -min(unit, of.at(keys) or 0)
    return of.more(keys, unit, is_instant=name in INSTANTS)


def _lifted(of: Changing, keys: Keys, name: str) -> tuple[Keys, Data]:
    if isinstance(keys[-1], int):  # an entry of a list, which goes
        *all_of, number = keys
        return tuple(all_of), {"to": [as_written(each) for index, each in
                                      enumerate(of.at(tuple(all_of))) if index != number]}
    if name not in LIFTED or of.at(keys) is None:
        raise NowhereError
    return keys, {"to": LIFTED[name]}


def _place(of: Changing, field: str) -> Keys:
    """Return where a field is stated that is named as `binding` names it."""
    keys = of.type or of.subject
    if field.startswith("depot."):
        depot = of.at((*of.type, "depot")) or of.request.depots[0].id
        return of.named("depots", depot, *field.split(".")[1:])
    if field.startswith("drones."):
        return _within(of, of.flyer(""), parsed(field)[1:])
    for all_of in ("breaks", "drones"):
        stated = of.at((*keys, all_of)) if field.startswith(f"{all_of}[") else []
        for index, each in enumerate(stated):
            name = f"{all_of}[{each.id}]"
            if field.startswith(name):
                return _within(of, (*keys, all_of, index), parsed(field[len(name):]))
    return _within(of, keys, parsed(field))


def _within(of: Changing, keys: Keys, names: Keys) -> Keys:
    """Return a place of somebody: of one window alone it may be stated as one of several."""
    if not names:
        return keys
    first, *rest = names
    if first == "time_window" and of.at((*keys, "time_windows")):
        first, rest = "time_windows", [0, *rest]
    if first == "time_windows" and rest[0] == -1:
        rest[0] = len(of.at((*keys, first))) - 1
    if names[-1:] in (("capacity",), ("max_load",)):
        rest.append(0)
    return *keys, first, *rest
