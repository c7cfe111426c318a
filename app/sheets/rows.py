"""Rows of a table -> what they say, column by column; wrong cells are named."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from datetime import date
from functools import lru_cache
from typing import Any

from app.sheets.cells import CellError, MisreadError, Raw, cell_name, letters
from app.sheets.clocks import Style
from app.sheets.columns import Column
from app.sheets.layout import Table
from app.sheets.meanings import MEANINGS
from app.sheets.readers import DEPOTS, NO, YES, read
from app.sheets.headings import simple


READINGS = 4096
"""Readings of a column that are kept: cells of a column are often alike."""


@dataclass
class Row:
    """What one row says, by meaning; a list with an entry a column where meanings repeat."""

    number: int  # from 0
    values: dict[str, Any] = field(default_factory=dict)
    cells: dict[str, str] = field(default_factory=dict)  # names, by meaning
    errors: list[CellError] = field(default_factory=list)

    def get(self, meaning: str) -> Any:
        """Return what the row says; None if nothing."""
        return self.values.get(meaning)

    def cell(self, *meanings: str) -> str:
        """Return the name of the cell for the first of these, else of the row's first cell."""
        return next((self.cells[meaning] for meaning in meanings if meaning in self.cells),
                    cell_name(self.number, 0))

    def refuse(self, code: str, message: str, *meanings: str) -> None:
        """Note an error at a cell. In place."""
        self.errors.append(CellError(code, message, self.cell(*meanings)))

    @property
    def is_depot(self) -> bool:
        """Whether it states where trips begin and end."""
        if self.get("kind") is not None:
            return bool(self.get("kind") == "depot")
        return simple(str(self.get("name") or "")) in DEPOTS and not any(self.get("demand") or ())


def rows_of(table: Table, columns: Sequence[Column], style: Style) -> list[Row]:
    """Return what the rows say."""
    rows = [Row(number) for number in table.rows]
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
            return _ticked(value, column) if column.meaning == "skills" else value, None
        except MisreadError as error:
            return None, f"{error}."

    for row in rows:
        raw = table.cell(row.number, column.index)
        name = f"{letter}{row.number + 1}"
        value, wrong = reading(type(raw).__name__, raw)
        if wrong:
            row.errors.append(CellError("MISREAD", wrong, name))
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


def without_totals(rows: Sequence[Row]) -> Iterator[Row]:
    """Yield the rows but a last one that sums up the others."""
    for place, row in enumerate(rows):
        texts = [simple(value) for value in row.values.values() if isinstance(value, str)]
        is_last = place == len(rows) - 1
        if not (is_last and any(text.split()[:1] and text.split()[0] in TOTALS for text in texts)):
            yield row


TOTALS = frozenset((
    "total", "totals", "sum", "summe", "gesamt", "gesamtsumme", "somme", "totale", "suma",
    "totaal", "razem"))
