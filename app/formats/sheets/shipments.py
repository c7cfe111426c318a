"""Both ends of parcels that are fetched and brought -> shipments of a request."""

from collections.abc import Iterable, Sequence
from typing import Any

from app.formats.sheets.cells import CellError
from app.formats.sheets.customers import LONGEST_NAME, Entry, joined
from app.formats.sheets.readers import DELIVERY, PICKUP
from app.formats.sheets.rows import Row
from app.schemas.fields import MAX_INFO_ENTRIES
from model.problem import MOST_PICKUPS

OF_END = ("location", "service_duration", "time_window", "time_windows", "approach", "info")
OF_BOTH = ("vehicles", "unassigned_cost")

Data = dict[str, Any]


def shipments_of(entries: Sequence[Entry]) -> tuple[list[Entry], list[CellError]]:
    """Return the shipments that rows make, and what is wrong."""
    wholes: dict[str | int, list[Entry]] = {}
    for entry in entries:
        row = entry.rows[0]
        if row.side in (PICKUP, DELIVERY) and row.whole is not None:
            wholes.setdefault(row.whole, []).append(entry)
    found: list[Entry] = []
    errors: list[CellError] = []
    names: set[str] = set()
    for whole in wholes.values():
        ends = [[entry for entry in whole if entry.rows[0].side == side]
                for side in (PICKUP, DELIVERY)]
        if not all(ends):  # the other row is refused
            continue
        wrong = _wrong(ends)
        if wrong is not None:
            errors.append(wrong)
            continue
        shipment = _shipment([joined(found) for found in _by_place(ends[0])], joined(ends[1]),
                             names)
        names.add(shipment.customer["id"])
        found.append(shipment)
    return found, errors


def _wrong(ends: Sequence[Sequence[Entry]]) -> CellError | None:
    """Return why rows make no shipment; None: they do."""
    for end, most in zip(ends, (MOST_PICKUPS, 1), strict=True):
        places = len(_by_place(end))
        if places > most:
            row = end[1].rows[0]
            return CellError(
                "SHIPMENT_ROWS", f"The shipment {_name(row)} has {places} places of {row.side}, "
                f"and {most} {'is' if most == 1 else 'are'} possible: make several shipments.",
                row.cell("shipment", "order"), {"case": "places", "name": _name(row)})
    lacking = [found for found in _by_place(ends[0]) if not any(_amounts(found))]
    if lacking and len(_by_place(ends[0])) > 1:
        row = lacking[0][0].rows[0]
        return CellError("SHIPMENT_AMOUNTS", f"What is picked up there of {_name(row)} isn't "
                         "stated: state the amount of each pickup.",
                         row.cell("demand", "pickup", "shipment", "order"),
                         {"case": "lacks", "name": _name(row)})
    amounts = [_amounts(end) for end in ends]
    if all(map(any, amounts)) and amounts[0] != amounts[1]:
        row = ends[1][0].rows[0]
        return CellError(
            "SHIPMENT_AMOUNTS", f"Another amount is picked up than is delivered of {_name(row)}: "
            "state the same, or one.", row.cell("demand", "pickup", "shipment", "order"),
            {"name": _name(row)})
    return None


def _by_place(end: Iterable[Entry]) -> list[list[Entry]]:
    """Return an end's rows by where they are."""
    found: dict[str, list[Entry]] = {}
    for entry in end:
        found.setdefault(repr(entry.customer["location"]), []).append(entry)
    return [*found.values()]


def _amounts(end: Iterable[Entry]) -> list[float]:
    """Return what is fetched, or brought, at an end, in whichever column it stands."""
    stated = [entry.customer["demand"] if any(entry.customer["demand"])
              else entry.customer.get("pickup", entry.customer["demand"]) for entry in end]
    return [round(sum(amounts), 9) for amounts in zip(*stated, strict=True)]


def _shipment(pickups: Sequence[Entry], delivery: Entry, names: set[str]) -> Entry:
    rows = [*(row for pickup in pickups for row in pickup.rows), *delivery.rows]
    ends = (delivery.customer, *(pickup.customer for pickup in pickups))
    shipment: Data = {"id": _own_name(_name(delivery.rows[0]), names),
                      **_fetched(pickups, delivery), "delivery": _end(delivery)}
    released = max(end.get("release_time", 0.0) for end in ends)
    for pickup in shipment.get("pickups") or [shipment["pickup"]]:
        _wait_for_release(pickup, released)
    if len(pickups) == 1 and delivery.customer.get("served_by", "truck") != "truck":
        shipment["delivery"]["served_by"] = "either"
    for name in OF_BOTH:
        if stated := [end[name] for end in ends if name in end]:
            shipment[name] = stated[0]
    if skills := list(dict.fromkeys(skill for end in ends for skill in end.get("skills", ()))):
        shipment["skills"] = skills
    for meaning, field in (("max_between", "max_time_between"), ("max_detour", "max_detour")):
        if limits := [row.values[meaning] for row in rows if row.get(meaning) is not None]:
            shipment[field] = min(limits)
    return Entry(shipment, rows, tuple([each.rows[0] for each in (*pickups, delivery)]))


def _fetched(pickups: Sequence[Entry], delivery: Entry) -> Data:
    """Return what is fetched where: at one place, or in parts at several."""
    if len(pickups) > 1:
        return {"pickups": [{"id": f"pickup-{number}", "amount": _amounts([pickup]), **_end(pickup)}
                            for number, pickup in enumerate(pickups, 1)]}
    amounts = _amounts(pickups)
    return {"amount": amounts if any(amounts) else _amounts([delivery]), "pickup": _end(pickups[0])}


def _end(entry: Entry) -> Data:
    """Return an end; who is there is told to drivers, as it has no name of its own."""
    end = {name: entry.customer[name] for name in OF_END if name in entry.customer}
    name = entry.rows[0].get("name")
    if not name:
        return end
    told = {"name": str(name)[:LONGEST_NAME], **end.get("info", {})}
    return end | {"info": dict(list(told.items())[:MAX_INFO_ENTRIES])}


def _wait_for_release(pickup: Data, release: float) -> None:
    """Have a parcel picked up no earlier than it is there. In place."""
    if not release:
        return
    if "time_windows" in pickup:
        windows = pickup["time_windows"]
        left = [window for window in windows if window.get("latest", release) >= release]
        # One that has closed by then stays, and is refused.
        pickup["time_windows"] = [window | {"earliest": max(window["earliest"], release)}
                                  for window in left or windows[-1:]]
    else:
        window = pickup.get("time_window", {"earliest": 0.0})
        pickup["time_window"] = window | {"earliest": max(window["earliest"], release)}


def _name(row: Row) -> str:
    """Return what a shipment is called, by any of its rows."""
    name = next((str(row.get(meaning)) for meaning in ("shipment", "order", "name")
                 if row.get(meaning)), f"row {row.number + 1}")
    return " ".join(name.split())[:LONGEST_NAME - 20]


def _own_name(name: str, names: set[str]) -> str:
    number, free = 1, name
    while free in names:
        number += 1
        free = f"{name} ({number})"
    return free
