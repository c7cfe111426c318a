"""Rows of a table -> what they say, column by column; wrong cells are named."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import date
from functools import lru_cache
from math import isclose
from typing import Any

from app.formats.sheets.cells import (
    CellError, MisreadError, Raw, Values, cell_name, letters, shown,
)
from app.formats.sheets.clocks import Style
from app.formats.sheets.columns import Column
from app.formats.sheets.headings import simple
from app.formats.sheets.layout import Table
from app.formats.sheets.meanings import MEANINGS
from app.formats.sheets.readers import DEPOT, DEPOTS, NO, YES, read, ticked_kind
from app.formats.sheets.words import CELL_WORDS


READINGS = 4096
"""Readings of a column that are kept: cells of a column are often alike."""


@dataclass
class Row:
    """What one row says, by meaning; a list with an entry a column where meanings repeat."""

    number: int  # from 0
    first: str = ""  # name of its first cell
    values: dict[str, Any] = field(default_factory=dict)
    cells: dict[str, str] = field(default_factory=dict)  # names, by meaning
    errors: list[CellError] = field(default_factory=list)
    side: str = ""  # which place of a whole it states: pickup, delivery, alternative
    whole: str | int | None = None  # the shipment, or the row, that it is a part of

    def get(self, meaning: str) -> Any:
        """Return what the row says; None if nothing."""
        return self.values.get(meaning)

    def cell(self, *meanings: str) -> str:
        """Return the name of the cell for the first of these, else of the row's first cell."""
        return next((self.cells[meaning] for meaning in meanings if meaning in self.cells),
                    self.first or cell_name(self.number, 0))

    def refuse(self, code: str, message: str, *meanings: str,
               values: Values | None = None) -> None:
        """Note an error at a cell. In place."""
        self.errors.append(CellError(code, message, self.cell(*meanings), values or {}))

    @property
    def is_depot(self) -> bool:
        """Whether it states where trips begin and end."""
        if self.get("kind") is not None:
            return bool(self.get("kind") == DEPOT)
        if simple(str(self.get("layer") or "")) in DEPOTS:
            return True
        return simple(str(self.get("name") or "")) in DEPOTS and not any(self.get("demand") or ())


def rows_of(table: Table, columns: Sequence[Column], style: Style) -> list[Row]:
    """Return what the rows say."""
    rows = [Row(number, table.name(number, 0)) for number in table.rows]
    for column in columns:
        if column.meaning != "ignored":
            _read_column(table, column, style, rows)
    return rows


def _read_column(table: Table, column: Column, style: Style, rows: Sequence[Row]) -> None:
    """Read a column's cells into the rows. In place."""
    meaning = MEANINGS[column.meaning]
    letter = letters(column.index)

    @lru_cache(READINGS)
    def reading(kind: str, raw: Raw) -> tuple[Any, str | None]:
        try:
            value = read(raw, meaning.kind, column.unit, style)
            if column.meaning == "kind" and value is not None:
                return ticked_kind(value, column.heading), None
            return _ticked(value, column) if column.meaning == "skills" else value, None
        except MisreadError as error:
            return None, f"{error}."

    for row in rows:
        raw = table.cell(row.number, column.index)
        name = (table.name(row.number, column.index) if table.origins
                else f"{letter}{row.number + 1}")
        value, wrong = reading(type(raw).__name__, raw)
        if wrong:
            row.errors.append(CellError("MISREAD", wrong, name, {
                "case": meaning.kind, "value": shown(raw)[:40], "meaning": column.meaning}))
        if meaning.repeats:
            row.values.setdefault(column.meaning, []).append(value)
        elif value is not None:
            row.values[column.meaning] = value
        row.cells.setdefault(column.meaning, name)


def _ticked(names: list[str] | None, column: Column) -> list[str] | None:
    """Return skills; a column of ticks is about the skill that it is named after."""
    ticks = {simple(name) for name in names or ()}
    if not ticks or not ticks <= YES | NO:
        return names
    return [column.heading or column.name] if ticks & YES else None


def days_in(rows: Sequence[Row]) -> list[date]:
    """Return the days of delivery that rows state, in order."""
    return sorted({row.values["date"] for row in rows if row.get("date") is not None})


def sums_in(rows: Sequence[Row]) -> list[Row]:
    """Return the rows that sum up others.

    They are called so, and have no place or are the last; or the last holds no more than the sums
    of all above.
    """
    found = [rows[-1]] if len(rows) > 2 and _sums_up(rows[-1], rows[:-1]) else []
    for place, row in enumerate(rows):
        texts = [simple(value) for value in row.values.values() if isinstance(value, str)]
        is_called = any(text.split()[:1] and text.split()[0] in TOTALS for text in texts)
        is_last = place == len(rows) - 1
        if is_called and row not in found and (is_last or not any(map(row.get, PLACED))):
            found.append(row)
    return found


def _sums_up(last: Row, others: Sequence[Row]) -> bool:
    """Tell whether a row holds amounts, each the sum of its column, and no more than a name."""
    stated = {meaning: value for meaning, value in last.values.items()
              if (any(part is not None for part in value) if isinstance(value, list) else True)}
    if not stated.keys() <= {*AMOUNTS, "name"} or last.errors:
        return False
    sums = [(amount, sum(row.values[meaning][place] or 0 for row in others))
            for meaning in AMOUNTS & stated.keys() for place, amount in enumerate(stated[meaning])
            if amount is not None]
    return bool(sums) and all(isclose(amount, total, rel_tol=1e-6) for amount, total in sums)


AMOUNTS = {"demand", "pickup"}

PLACED = ("latitude", "point", "x", "address", "street", "town", "postcode")

TOTALS = frozenset(CELL_WORDS["totals"])
