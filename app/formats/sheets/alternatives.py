"""Rows that are other places of a customer, such as a locker -> `alternatives`."""

from collections.abc import Mapping, Sequence
from typing import Any

from app.formats.sheets.cells import CellError, Doubt
from app.formats.sheets.customers import LONGEST_NAME, Entry, address_of
from app.formats.sheets.headings import simple
from app.formats.sheets.readers import NO, YES
from app.formats.sheets.rows import Row
from app.formats.sheets.sides import ALTERNATIVE

OF_PLACE = ("location", "service_duration", "time_window", "time_windows")

Data = dict[str, Any]


def is_alternative(row: Row) -> bool:
    """Tell whether a row is another place of somebody."""
    return row.side == ALTERNATIVE or _named(row) not in (None, *NO)


def add_alternatives(others: Sequence[Entry], stops: Sequence[Entry],
                     called: Mapping[str, Sequence[str]],
                     refused: frozenset[int]) -> tuple[list[Doubt], list[CellError]]:
    """Give customers their other places; tell of them, and of those who are nobody's. In place.

    Parameters
    ----------
    called
        Ids of stops by their names and order numbers.
    refused
        Rows that are wrong.
    """
    by_id = {stop.customer["id"]: stop for stop in stops}
    by_row = {row.number: stop for stop in stops for row in stop.rows}
    errors = []
    for other in others:
        row = other.rows[0]
        if row.side == ALTERNATIVE:
            stop = by_row.get(row.whole)  # type: ignore[arg-type]
            if stop is None and row.whole not in refused:
                errors.append(_error(row, "is another place of a shipment, and only customers "
                                     "have any", "address", "latitude", "point"))
        else:
            found = called.get(_owner(row), ())
            stop = by_id[found[0]] if len(found) == 1 else None
            if stop is None:
                told = "several customers" if found else "nobody"
                errors.append(_error(row, f"is another place of {told}: write the name or order "
                                     "number of one customer", "alternative_to"))
        if stop is not None:
            places = stop.customer.setdefault("alternatives", [])
            places.append(_place(other, stop, {place["id"] for place in places}))
    cells = [other.rows[0].cell("alternative_to", "address", "latitude", "point")
             for other in others]
    return [Doubt("OTHER_PLACES", f"{len(cells)} rows or columns are other places of customers, "
                  f"such as {cells[0]}: amounts and all else are as of the customer's own.",
                  cell=cells[0], values={"count": len(cells)})] if cells else [], errors


def _named(row: Row) -> str | None:
    text = row.get("alternative_to")
    return None if text is None else simple(str(text))


def _owner(row: Row) -> str:
    """Return whose other place a row is; ticked, it is of the row of its name, or its order."""
    named = _named(row) or ""
    return simple(str(row.get("name") or row.get("order") or "")) if named in YES else named


def _error(row: Row, what: str, *meanings: str) -> CellError:
    cell = row.cell(*meanings)
    return CellError("ALTERNATIVE", f"The row {what}.", cell)


def _place(other: Entry, stop: Entry, taken: set[str]) -> Data:
    row = other.rows[0]
    name = str(row.get("name") or "")
    if not name or simple(name) in (simple(stop.customer["id"]),
                                    simple(str(stop.rows[0].get("name") or ""))):
        name = address_of(row) or "other place"
    name = own = " ".join(name.split())[:LONGEST_NAME - 20]
    number = 1
    while own in taken:
        number += 1
        own = f"{name} ({number})"
    cost = row.get("alternative_cost")
    place = {"id": own} | {field: other.customer[field] for field in OF_PLACE
                           if field in other.customer}
    return place | ({} if cost is None else {"cost": cost})
