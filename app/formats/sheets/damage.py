"""Numbers that a spreadsheet has damaged: of `1,23457E+11` the last digits are lost."""

import re
from collections.abc import Sequence

from app.formats.sheets.cells import Doubt, Raw, letters, shown
from app.formats.sheets.columns import Column
from app.formats.sheets.layout import Table

LOST = 1e15
"""From here on spreadsheets put zeros in place of digits."""

NUMBERED = ("order", "name", "phone", "info", "notes")

_SHORTENED = re.compile(r"-?\d(?:[.,]\d{1,14})?E\+?\d{1,3}", re.IGNORECASE)


def is_damaged(raw: Raw) -> bool:
    """Tell whether a cell holds a number of which digits are lost."""
    if isinstance(raw, str):
        return _SHORTENED.fullmatch(raw) is not None
    return isinstance(raw, float) and abs(raw) >= LOST


def damaged(table: Table, columns: Sequence[Column]) -> list[Doubt]:
    """Return a doubt about each column of numbers that hold damaged ones."""
    doubts = []
    for column in columns:
        if column.meaning not in NUMBERED:
            continue
        cells = [(row, raw) for row, raw in table.column(column.index) if is_damaged(raw)]
        if cells:
            row, raw = cells[0]
            cell = table.name(row, column.index)
            doubts.append(Doubt(
                "DIGITS_LOST", f"Column {column.name} holds {len(cells)} numbers that a "
                f"spreadsheet has shortened, such as {cell} ({shown(raw)}): their last digits are "
                "lost. Take them from where they come from, as text.", letters(column.index), cell,
                {"count": len(cells), "value": shown(raw)}))
    return doubts
