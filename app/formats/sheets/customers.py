"""Rows -> customers of a request: one a place and name, with what drivers are told."""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any, Literal

from app.formats.sheets.amounts import amounts_of
from app.formats.sheets.cells import Doubt, clock_text, next_day
from app.formats.sheets.clocks import DAY, past_midnight
from app.formats.sheets.columns import Column
from app.formats.sheets.damage import is_damaged
from app.formats.sheets.geography import Pair, TableGeography, on_globe
from app.formats.sheets.meanings import OF_SIDES, meaning_at
from app.formats.sheets.rows import Row
from app.schemas.fields import MAX_INFO_ENTRIES, MAX_INFO_LENGTH

MINUTE, HOUR = 60, 3600
MOST_WINDOWS = 8
LONGEST_NAME = 200

SAME = ("time_window", "time_windows", "served_by", "approach", "skills", "vehicles",
        "release_time")
SAME_CELLS = ("preferred_vehicles", "preference_cost", "vehicle_costs", "together", "apart",
              "together_on_trip", "apart_on_trip", "before", "after", "min_lag", "max_lag",
              "alternative_cost", *(meaning_at("alternative", own) for own in OF_SIDES))
"""What rows must agree on to be one stop, of customers and as cells say it."""

CARRIED = ("phone", "email", "contact", "notes", "priority", "layer")

Data = dict[str, Any]


@dataclass
class Entry:
    """A customer, or a shipment, and the rows that it is made of."""

    customer: Data
    rows: list[Row]
    heads: tuple[Row, ...] = ()  # of a shipment: the first row of each place

    @property
    def first(self) -> str:
        """What relations call who is served first: the customer, or the first pickup."""
        name: str = self.customer["id"]
        if "delivery" not in self.customer:
            return name
        parts = self.customer.get("pickups")
        return f"{name}/pickup/{parts[0]['id']}" if parts else f"{name}/pickup"

    @property
    def last(self) -> str:
        """What relations call who is served last: the customer, or the delivery."""
        name: str = self.customer["id"]
        return f"{name}/delivery" if "delivery" in self.customer else name

    def places(self) -> list[tuple[Row, Data]]:
        """Return the first row of each place, and what it says of it."""
        if "delivery" not in self.customer:
            return [(self.rows[0], self.customer)]
        pickups = self.customer.get("pickups") or [self.customer["pickup"]]
        return [*zip(self.heads, (*pickups, self.customer["delivery"]), strict=True)]


def entries_of(rows: Sequence[Row], columns: Sequence[Column], ground: TableGeography,
               service_minutes: float | None) -> list[Entry]:
    """Return a customer for each row that states its place; other rows are refused. In place."""
    amounts = [column for column in columns if column.meaning == "demand"]
    pickups = [column for column in columns if column.meaning == "pickup"]
    entries = []
    for row in rows:
        place = _location(row, ground)
        window = _windows(row)
        if place is None or row.errors:
            continue
        customer: Data = {
            "id": _name(row),
            "location": place,
            **amounts_of(row, amounts, pickups),
        }
        service = row.get("service")
        if service is None and service_minutes is not None:
            service = service_minutes * MINUTE
        if service:
            customer["service_duration"] = service
        customer |= window | _rules(row)
        if info := _info(row, columns):
            customer["info"] = info
        entries.append(Entry(customer, [row]))
    return entries


def together(entries: Sequence[Entry],
             same_place: Literal["together", "apart"]) -> tuple[list[Entry], list[Doubt]]:
    """Return stops under names of their own, and what was done to rows of one name."""
    groups: dict[tuple[Any, ...], list[Entry]] = defaultdict(list)
    for number, entry in enumerate(entries):
        customer = entry.customer
        alike = [repr(customer.get(field)) for field in SAME]
        alike += [repr(entry.rows[0].get(meaning)) for meaning in SAME_CELLS]
        # Numbers whose last digits are lost are alike without being one.
        apart = number if same_place == "apart" or is_damaged(customer["id"]) else -1
        groups[customer["id"].casefold(), repr(customer["location"]), apart, *alike].append(entry)
    stops = [joined(group) for group in groups.values()]
    doubts = []
    if several := [stop for stop in stops if len(stop.rows) > 1]:
        first = several[0]
        cells = ", ".join(row.cell("name", "order") for row in first.rows[:4])
        doubts.append(Doubt(
            "ROWS_JOINED", f"Rows of one name and place make one stop, {len(several)} in all, "
            f"such as {first.customer['id']} ({cells}): amounts are added up, the longest time at "
            "the stop counts once.",
            values={"count": len(several), "name": first.customer["id"], "cells": cells}))
    return stops, [*doubts, *_renamed(stops)]


def placed(stops: Iterable[Entry]) -> list[tuple[Row, Pair]]:
    """Return rows and coordinates of the places that are known."""
    return [(row, (location[0], location[1])) for stop in stops for row, place in stop.places()
            if isinstance(location := place["location"], list)]


def _location(row: Row, ground: TableGeography) -> list[float] | Data | None:
    """Return a location of a request, perhaps an address; None: refused or pending. In place."""
    if row.number in ground.unplaced:
        return {"address": ground.unplaced[row.number]}
    place = _place(row, ground)
    return None if place is None else list(place)


def _place(row: Row, ground: TableGeography) -> Pair | None:
    """Return where a row's customer is; refuse the row if it doesn't say. In place."""
    place = ground.pair(row)
    cells = (*ground.columns, "address", "street", "town", "name")
    if row.number in ground.pending:
        return None
    if place is None:
        is_told = any(error.code.startswith("ADDRESS_") or error.cell == row.cell(name)
                      for error in row.errors for name in ground.columns or ("address",))
        if not is_told:
            row.refuse("NO_COORDINATES", "The row has neither coordinates nor an address: add "
                       "either." if ground.looks_up else "The row has no coordinates, and "
                       "addresses are not looked up: add its latitude and longitude.", *cells,
                       values={"case": "neither" if ground.looks_up else "row"})
    elif ground.is_geographic and place == (0, 0):
        row.refuse("NO_COORDINATES", "0, 0 is in the sea off Africa: add the customer's latitude "
                   "and longitude.", *cells, values={"case": "zero"})
        return None
    elif ground.is_geographic and not on_globe(place):
        row.refuse("OFF_GLOBE", f"{place[1]:.10g} is no latitude, or {place[0]:.10g} no "
                   "longitude: state degrees with a decimal point.", *cells,
                   values={"latitude": f"{place[1]:.10g}", "longitude": f"{place[0]:.10g}"})
        return None
    return place


def _windows(row: Row) -> Data:
    """Return the windows of a row; refuse the row if one ends before it begins. In place."""
    told = [windows for windows in row.get("window") or () if windows is not None]
    stated = [window for windows in told for window in windows]
    cells: tuple[str, ...] = ("window",)
    if not told:
        stated = list(zip_longest(row.get("earliest") or (), row.get("latest") or ()))
        cells = ("latest", "earliest")
    stated = [(earliest, past_midnight(earliest, latest)) for earliest, latest in stated]
    for earliest, latest in stated:
        if latest is not None and (earliest or 0) > latest:
            later = latest + (12 if latest + 12 * HOUR > earliest else 24) * HOUR
            night = f", or {next_day(later)}," if later > DAY else ""
            row.refuse("ENDS_BEFORE", f"The window ends ({clock_text(latest)}) before it begins "
                       f"({clock_text(earliest)}): write {clock_text(later)}{night} if that is "
                       "meant.", *cells, values={
                           "begin": clock_text(earliest), "end": clock_text(latest)})
    ends = sorted((earliest or 0.0, latest) for earliest, latest in stated
                  if earliest is not None or latest is not None)
    merged = disjoint(ends)
    if len(merged) > MOST_WINDOWS:
        row.refuse("TOO_MANY_WINDOWS", f"There are {len(merged)} windows, and {MOST_WINDOWS} are "
                   "possible at most.", "window",
                   values={"count": len(merged), "most": MOST_WINDOWS})
    costs = {field: row.values[meaning] for meaning, field in
             (("late_cost", "late_cost_per_hour"), ("early_cost", "early_cost_per_hour"))
             if row.get(meaning) is not None}
    windows = [{"earliest": earliest} | ({} if latest is None else {"latest": latest})
               | {field: cost for field, cost in costs.items()
                  if field == "early_cost_per_hour" or place == len(merged) - 1}
               for place, (earliest, latest) in enumerate(merged)]
    if not windows:
        return {}
    return {"time_windows": windows} if len(windows) > 1 else {"time_window": windows[0]}


def overnight(stops: Iterable[Entry]) -> list[Doubt]:
    """Return the doubt about windows that end on the day after."""
    late = [(row, place) for stop in stops for row, place in stop.places() if _latest(place) > DAY]
    if not late:
        return []
    row, place = late[0]
    cell = row.cell("latest", "window", "earliest")
    return [Doubt("PAST_MIDNIGHT", f"{len(late)} windows end on the day after, such as {cell} at "
                  f"{next_day(_latest(place))}.", cell=cell, values={"count": len(late)})]


def _latest(customer: Data) -> float:
    windows = customer.get("time_windows") or [customer.get("time_window", {})]
    return max(window.get("latest", 0.0) for window in windows)


def disjoint(windows: Iterable[tuple[float, float | None]]) -> list[tuple[float, float | None]]:
    """Return windows of which none touches another."""
    merged: list[tuple[float, float | None]] = []
    for earliest, latest in windows:
        if merged and (merged[-1][1] is None or earliest <= merged[-1][1]):
            before = merged[-1]
            ends = None if latest is None or before[1] is None else max(before[1], latest)
            merged[-1] = (before[0], ends)
        else:
            merged.append((earliest, latest))
    return merged


def _rules(row: Row) -> Data:
    found: Data = {}
    for meaning, name in (("served_by", "served_by"), ("approach", "approach"),
                          ("skills", "skills"),
                          ("ready", "release_time"), ("unassigned_cost", "unassigned_cost")):
        if row.get(meaning) not in (None, []):
            found[name] = row.values[meaning]
    if row.get("vehicles"):
        found["vehicles"] = {"allowed": row.values["vehicles"]}
    elif row.get("forbidden_vehicles"):
        found["vehicles"] = {"forbidden": row.values["forbidden_vehicles"]}
    return found


def _name(row: Row) -> str:
    named = " ".join([*_texts(row, "first_name"), *_texts(row, "name")])
    for name in (named, *_texts(row, "order")):
        if name:
            return " ".join(name.split())[:LONGEST_NAME]
    return address_of(row)[:LONGEST_NAME] or f"row {row.number + 1}"


def address_of(row: Row) -> str:
    """Return the address of a row on one line; empty: it has none."""
    street = " ".join([*_texts(row, "street"), *_texts(row, "house_number")])
    town = " ".join([*_texts(row, "postcode"), *_texts(row, "town")])
    return ", ".join(part for part in (*_texts(row, "address"), street, town,
                                       *_texts(row, "region"), *_texts(row, "country")) if part)


def _texts(row: Row, meaning: str) -> list[str]:
    value = row.get(meaning)
    return [str(text) for text in (value if isinstance(value, list) else [value]) if text]


def _info(row: Row, columns: Sequence[Column]) -> dict[str, str]:
    """Return what drivers are to know."""
    told = {"address": address_of(row)}
    if row.get("name"):
        told["order"] = "".join(_texts(row, "order"))
    told |= {meaning: "; ".join(_texts(row, meaning)) for meaning in CARRIED}
    headings = [column.heading or column.name for column in columns if column.meaning == "info"]
    told |= {heading[:LONGEST_NAME]: text for heading, text
             in zip(headings, row.get("info") or (), strict=False) if text}
    kept = [(name, _cut(text)) for name, text in told.items() if text]
    return dict(kept[:MAX_INFO_ENTRIES])


def _cut(text: str) -> str:
    return text if len(text) <= MAX_INFO_LENGTH else text[:MAX_INFO_LENGTH - 1] + "\u2026"


def joined(group: Sequence[Entry]) -> Entry:
    """Return one stop for rows of one name and place."""
    if len(group) == 1:
        return group[0]
    customers = [entry.customer for entry in group]
    whole = dict(customers[0])
    for what in ("demand", "pickup"):
        stated = [customer[what] for customer in customers if what in customer]
        if stated:
            whole[what] = [round(sum(amounts), 9) for amounts in zip(*stated, strict=True)]
    if longest := max(customer.get("service_duration", 0) for customer in customers):
        whole["service_duration"] = longest
    told: dict[str, list[str]] = defaultdict(list)
    for customer in customers:
        for name, text in customer.get("info", {}).items():
            if text not in told[name]:
                told[name].append(text)
    if told:
        whole["info"] = {name: _cut("; ".join(texts))
                          for name, texts in list(told.items())[:MAX_INFO_ENTRIES]}
    costs = [customer["unassigned_cost"] for customer in customers if "unassigned_cost" in customer]
    if len(costs) == len(customers):
        whole["unassigned_cost"] = sum(costs)
    else:
        whole.pop("unassigned_cost", None)
    return Entry(whole, [row for entry in group for row in entry.rows])


def _renamed(stops: Sequence[Entry]) -> list[Doubt]:
    """Give stops of one name names of their own, and say so. In place."""
    taken = {stop.customer["id"] for stop in stops}
    seen: set[str] = set()
    changed = []
    for stop in stops:
        name = stop.customer["id"]
        if name in seen:
            number = 2
            while f"{name[:LONGEST_NAME - 8]} ({number})" in taken:
                number += 1
            stop.customer["id"] = f"{name[:LONGEST_NAME - 8]} ({number})"
            taken.add(stop.customer["id"])
            changed.append(stop)
        seen.add(stop.customer["id"])
    if not changed:
        return []
    first = changed[0]
    cell = first.rows[0].cell("name", "order")
    return [Doubt("NAMES_REPEAT", "Stops with the name of another, at another place or time, get "
                  f"names of their own, {len(changed)} in all: such as {cell}, called "
                  f"{first.customer['id']!r}.", cell=cell,
                  values={"count": len(changed), "name": first.customer["id"]})]
