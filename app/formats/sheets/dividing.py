"""Rows that state several places, or belong to one shipment -> rows of one place each."""

from collections import defaultdict
from collections.abc import Mapping, Sequence

from app.formats.sheets.cells import CellError, Doubt
from app.formats.sheets.headings import simple
from app.formats.sheets.meanings import OF_PICKUPS, OF_SIDES, meaning_at
from app.formats.sheets.questions import Question, Questionnaire
from app.formats.sheets.readers import DELIVERY, DEPOT, PICKUP
from app.formats.sheets.rows import PLACED, Row
from app.formats.sheets.sides import ALTERNATIVE

SHIPMENTS, APART = "shipments", "apart"

OF_OUTWARD = ("name", "earliest", "latest", "window")
"""What a place is told of the way there alone."""

OF_PICKUP_COLUMNS = tuple(meaning_at(PICKUP, meaning) for meaning in OF_PICKUPS)

Whole = Mapping[str, Sequence[Row]]


def divided(rows: Sequence[Row], num_rows: int,
            asking: Questionnaire) -> tuple[list[Row], list[Doubt], list[CellError]]:
    """Return rows of one place each, with what was guessed and what is wrong. In place.

    Parameters
    ----------
    num_rows
        Of the sheet: places beside a row's own are rows behind those, by number.
    """
    found: list[Row] = []
    backs: list[Row] = []
    for row in rows:
        for nth, (side, meanings) in enumerate(((PICKUP, OF_PICKUPS), (ALTERNATIVE, OF_SIDES)), 1):
            other = _other_place(row, side, meanings, nth * num_rows + row.number)
            if other is not None:
                found.append(other)
                if side == PICKUP:
                    row.side, row.whole = DELIVERY, row.number
                    backs += _ride_back(row, other, num_rows)
        found.append(row)
    open_rows = [row for row in found if not row.side and row.get("kind") != DEPOT]
    doubts, errors = _paired(_called(open_rows, "shipment"))
    if backs:
        cell = backs[0].cell("back_from")
        doubts.append(Doubt("RIDES_BACK", f"{len(backs) // 2} rows state a ride back, such as "
                            f"{cell}: each is a shipment of its own, the other way.", cell=cell,
                            values={"count": len(backs) // 2}))
    orders = {name: alike for name, alike in _called(
        [row for row in open_rows if not row.side], "order").items()
        if {PICKUP, DELIVERY} <= {row.get("kind") for row in alike}}
    if orders and _are_shipments(orders, asking):
        more = _paired(orders)
        doubts, errors = doubts + more[0], errors + more[1]
    return [*found, *backs], doubts, errors


def _ride_back(row: Row, fetched: Row, num_rows: int) -> list[Row]:
    """Return rows for both ends of the way back from a row's delivery; none: it states no time."""
    begins = row.get("back_from")
    if begins is None:
        return []
    whole = -1 - row.number  # of no row's own shipment
    common = {meaning: value for meaning, value in row.values.items()
              if meaning == "name" or meaning not in (*OF_SIDES, "ready", *OF_PICKUP_COLUMNS)}
    here, there = ({meaning: value for meaning, value in end.values.items()
                    if meaning in OF_SIDES and meaning not in OF_OUTWARD} for end in (row, fetched))
    return [Row(3 * num_rows + row.number, row.first, here | {"earliest": [begins]},
                row.cells, side=PICKUP, whole=whole),
            Row(4 * num_rows + row.number, row.first, common | there,
                row.cells | fetched.cells, side=DELIVERY, whole=whole)]


def _other_place(row: Row, side: str, meanings: Sequence[str], number: int) -> Row | None:
    """Return a row for the place that a row states beside its own; None: it states none."""
    own = {meaning: row.get(meaning_at(side, meaning)) for meaning in meanings}
    if row.errors or row.get("kind") == DEPOT or not any(_says(own[place]) for place in PLACED):
        return None
    cost = "alternative_cost"
    values = {meaning: value for meaning, value in own.items() if value is not None}
    values |= {cost: row.values[cost]} if cost in row.values and side == ALTERNATIVE else {}
    cells = {meaning: row.cells[at] for meaning in meanings
             if (at := meaning_at(side, meaning)) in row.cells}
    return Row(number, row.first, values, cells, side=side, whole=row.number)


def _says(value: object) -> bool:
    return any(part is not None for part in value) if isinstance(value, list) else (
        value is not None)


def _called(rows: Sequence[Row], meaning: str) -> dict[str, list[Row]]:
    """Return the rows by what they are called, those that are."""
    found: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        if row.get(meaning):
            found[simple(str(row.get(meaning)))].append(row)
    return found


def _are_shipments(orders: Whole, asking: Questionnaire) -> bool:
    """Return whether rows of one order are the ends of a shipment. In place."""
    name, alike = next(iter(orders.items()))
    cell = alike[0].cell("order")
    return asking.ask(Question(
        "shipments", "shipments", f"Orders are picked up in one row and delivered in another, "
        f"{len(orders)} in all, such as {name!r} ({cell}): is the same parcel fetched and brought?",
        {SHIPMENTS: "Fetched there, and brought", APART: "Each for itself, from and to the depot"},
        SHIPMENTS, {"count": len(orders), "name": name[:80]}, cell=cell)) == SHIPMENTS


def _paired(wholes: Whole) -> tuple[list[Doubt], list[CellError]]:
    """Say of rows of one shipment which end each is; return doubts and errors. In place."""
    doubts, errors, alone, ordered = [], [], [], []
    for name, rows in wholes.items():
        kinds = {row.get("kind") for row in rows}
        if len(rows) == 1:
            alone.append(rows[0])
            continue
        if len(rows) == 2 and not kinds & {PICKUP, DELIVERY}:
            ordered.append(rows[0])
            sides = [PICKUP, DELIVERY]
        else:
            sides = [DELIVERY if row.get("kind") != PICKUP else PICKUP for row in rows]
            if not {PICKUP, DELIVERY} <= kinds:
                errors.append(CellError(
                    "SHIPMENT_ROWS", f"The shipment {rows[0].get('shipment')} has {len(rows)} "
                    "rows: say of each whether it is a pickup or a delivery.",
                    rows[0].cell("shipment"),
                    {"name": str(rows[0].get("shipment")), "count": len(rows)}))
                continue
        for row, side in zip(rows, sides, strict=True):
            row.side, row.whole = side, name
    if alone:
        doubts.append(Doubt("SHIPMENT_OF_ONE_ROW", f"{len(alone)} shipments have one row and one "
                            f"place, such as {alone[0].cell('shipment')}: they are customers.",
                            cell=alone[0].cell("shipment"), values={"count": len(alone)}))
    if ordered:
        doubts.append(Doubt("SHIPMENT_IN_ORDER", f"{len(ordered)} shipments don't say which row is "
                            f"the pickup, such as {ordered[0].cell('shipment')}: the first is "
                            "taken.", cell=ordered[0].cell("shipment"),
                            values={"count": len(ordered)}))
    return doubts, errors
