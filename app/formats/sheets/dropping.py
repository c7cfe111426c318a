"""Rows that are hardly meant to be planned: hidden ones, sums, cancelled orders; each is asked."""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import replace

from app.formats.sheets.cells import Raw, shown
from app.formats.sheets.columns import Column
from app.formats.sheets.headings import simple
from app.formats.sheets.layout import Table
from app.formats.sheets.questions import KEEP_OR_NOT, LEAVE_OUT, PLAN, Question, Questionnaire
from app.formats.sheets.readers import NO, ORDER_KINDS, YES
from app.formats.sheets.rows import Row
from app.formats.sheets.states import CANCELLED, DONE, NOT, OPEN

IN_TEXTS = ("status", "notes", "name", "order", "info", "priority", "ignored", "kind")
"""Meanings of columns in which somebody may have written that an order is cancelled."""

MOST_WORDINGS = 12


def without_hidden(table: Table, asking: Questionnaire) -> Table:
    """Return a table without the rows that its reader doesn't see. In place."""
    unseen = [row for row in table.rows if row in table.sheet.hidden_rows]
    if not unseen:
        return table
    by_filter = table.sheet.has_filter
    told = "left out by a filter" if by_filter else "hidden"
    named = table.rows_named(unseen)
    answer = asking.ask(Question(
        "hidden_rows", "hidden_rows", f"{len(unseen)} rows are {told} ({named}): are they to be "
        "planned?", KEEP_OR_NOT, LEAVE_OUT,
        {"count": len(unseen), "rows": named, "by_filter": int(by_filter)},
        cell=table.name(unseen[0], 0),
        examples=tuple(_shown_row(table, row) for row in unseen[:3])))
    if answer == PLAN:
        return table
    left_out = set(unseen)
    return replace(table, rows=tuple(row for row in table.rows if row not in left_out))


def without_sums(table: Table, rows: Sequence[Row], sums: Sequence[Row],
                 asking: Questionnaire) -> list[Row]:
    """Return the rows without those that sum up others. In place."""
    if not sums:
        return list(rows)
    numbers = [row.number for row in sums]
    named = table.rows_named(numbers)
    answer = asking.ask(Question(
        "total_rows", "total_rows", f"{'Row' if len(sums) == 1 else 'Rows'} {named} sum up others "
        "by their words: are they customers all the same?",
        KEEP_OR_NOT, LEAVE_OUT, {"count": len(sums), "rows": named},
        cell=table.name(numbers[0], 0),
        examples=tuple(_shown_row(table, row) for row in numbers[:3])))
    left_out = set(() if answer == PLAN else numbers)
    return [row for row in rows if row.number not in left_out]


def without_cancelled(table: Table, rows: Sequence[Row], columns: Sequence[Column],
                      asking: Questionnaire) -> list[Row]:
    """Return the rows without orders that are cancelled or done. In place."""
    left_out: set[int] = set()
    for column in columns:
        if column.meaning not in IN_TEXTS:
            continue
        found: dict[str, list[int]] = defaultdict(list)
        for row in rows:
            wording = _wording(table.cell(row.number, column.index), column)
            if wording:
                found[wording].append(row.number)
        if column.meaning != "status" and len(found) > MOST_WORDINGS:
            found = {"": [number for numbers in found.values() for number in numbers]}
        for wording, numbers in list(found.items())[:2 * MOST_WORDINGS]:
            if asking.ask(_status_question(table, column, wording, numbers)) == LEAVE_OUT:
                left_out |= set(numbers)
    return [row for row in rows if row.number not in left_out]


def _wording(raw: Raw, column: Column) -> str | None:
    """Return what a cell says of an order's state, if that is worth a question."""
    text = simple(shown(raw)[:80]) if raw is not None else ""
    words = text.split()
    is_status = column.meaning == "status"
    if not words or (is_status and (text in OPEN or text in NO)):
        return None
    if is_status:
        return text
    place = next((place for place, word in enumerate(words) if word in CANCELLED), None)
    is_ticked = text in YES and any(word in CANCELLED for word in simple(column.heading).split())
    if is_ticked:
        return text
    return text if place is not None and not set(words[:place]) & NOT else None


def _status_question(table: Table, column: Column, wording: str,
                     numbers: Sequence[int]) -> Question:
    words = set(wording.split())
    heads = set(simple(column.heading).split())
    is_over = bool(words & (CANCELLED | DONE)) and not words & NOT
    is_ticked = wording in YES and bool(heads & (CANCELLED | DONE))
    ends = is_over or is_ticked or not wording
    cell = table.name(numbers[0], column.index)
    raw = shown(table.cell(numbers[0], column.index))[:80]
    return Question(
        f"status:{simple(column.heading)}:{wording}"[:500], "status",
        f"{_rows(len(numbers), table.rows_named(numbers))} marked {raw!r} "
        f"({column.heading or column.name}): {'planned all the same' if ends else 'left out'}?",
        KEEP_OR_NOT, LEAVE_OUT if ends else PLAN,
        {"count": len(numbers), "status": raw, "heading": column.heading,
         "rows": table.rows_named(numbers)},
        cell=cell, examples=tuple(_shown_row(table, number) for number in numbers[:3]))


def with_kinds(table: Table, rows: Sequence[Row], columns: Sequence[Column],
               asking: Questionnaire) -> list[Row]:
    """Return rows that are told to be deliveries or pickups; others are asked about. In place."""
    column = next((column for column in columns if column.meaning == "kind"), None)
    if column is None:
        return list(rows)
    unknown: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        if row.get("kind") not in (None, *ORDER_KINDS):
            unknown[str(row.get("kind"))].append(row)
    left_out: set[int] = set()
    for wording, alike in list(unknown.items())[:MOST_WORDINGS]:
        numbers = [row.number for row in alike]
        answer = asking.ask(Question(
            f"order_kind:{simple(wording)}"[:500], "order_kind",
            f"{_rows(len(alike), table.rows_named(numbers))} of the kind {wording[:80]!r} "
            f"({column.heading or column.name}): is that a delivery?",
            {"delivery": "A delivery", "pickup": "A pickup", LEAVE_OUT: "Leave out"}, "delivery",
            {"count": len(alike), "kind": wording[:80], "heading": column.heading},
            cell=table.name(numbers[0], column.index)))
        for row in alike:
            row.values["kind"] = answer
        left_out |= set(numbers if answer == LEAVE_OUT else ())
    return [row for row in rows if row.number not in left_out]


def without_doubles(table: Table, rows: Sequence[Row], asking: Questionnaire) -> list[Row]:
    """Return the rows, each once if those alike, order number and all, are one. In place."""
    first: dict[tuple[Raw, ...], int] = {}
    doubles = []
    for row in rows:
        if row.get("order"):
            cells = tuple(map(shown, table.sheet.rows[row.number]))
            if first.setdefault(cells, row.number) != row.number:
                doubles.append(row.number)
    if not doubles:
        return list(rows)
    named = table.rows_named(doubles)
    answer = asking.ask(Question(
        "same_rows", "same_rows", f"{_rows(len(doubles), named)} like another in all cells, order "
        "number and all: is each an order of its own?",
        {"together": "Each counts", "once": "They count once"}, "together",
        {"count": len(doubles), "rows": named}, cell=table.name(doubles[0], 0),
        examples=tuple(_shown_row(table, row) for row in doubles[:3])))
    left_out = set(doubles if answer == "once" else ())
    return [row for row in rows if row.number not in left_out]


def _rows(count: int, named: str) -> str:
    return f"Row {named} is" if count == 1 else f"Rows {named} are"


def _shown_row(table: Table, row: int) -> str:
    cells: Iterable[Raw] = table.sheet.rows[row]
    return ", ".join(shown(raw)[:60] for raw in cells if raw is not None)[:160]
