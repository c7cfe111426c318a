"""Where in a sheet the headings stand, and which rows follow."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from app.formats.sheets.cells import Raw, bounded, cell_name, shown
from app.formats.sheets.headings import LONGEST_HEADING, is_known, is_unit
from app.formats.sheets.questions import rows_named
from app.formats.sheets.table import Sheet

SEARCHED_ROWS = 40
"""Rows among which the headings stand; above them are titles and dates."""

SEARCHED_COLUMNS = 200
MOST_HEADER_ROWS = 3
KNOWN_SHARE = 0.5
"""Of a row's cells that are headings or units, where it goes on with the headings."""


@dataclass(frozen=True)
class RowOrigin:
    """Where rows of a table come from, that are not those of its own sheet."""

    first: int  # row
    sheet: str
    letters: Mapping[int, str]  # of columns there, by columns here


@dataclass(frozen=True)
class Table:
    """A sheet's headings and the rows below; rows and columns are counted from 0."""

    sheet: Sheet
    header_rows: tuple[int, ...]  # none: there are no headings
    headings: tuple[str, ...]
    rows: tuple[int, ...]  # those that hold anything
    num_empty: int
    origins: tuple[RowOrigin, ...] = ()

    def name(self, row: int, column: int) -> str:
        """Return what a spreadsheet calls a cell, such as `C17` or `Tuesday!C17`."""
        for origin in reversed(self.origins):
            if row >= origin.first:
                letter = origin.letters.get(column, "A")
                return f"{origin.sheet}!{letter}{row - origin.first + 1}"
        return cell_name(row, column)

    def rows_named(self, rows: Sequence[int]) -> str:
        """Return rows as people name them: 3, 5-7."""
        own = [row for row in rows if not self.origins or row < self.origins[0].first]
        known = set(own)
        others = [self.name(row, 0) for row in rows if row not in known]
        return ", ".join([*([rows_named(own)] if own else ()), *others[:10]])

    def cell(self, row: int, column: int) -> Raw:
        """Return what a cell holds."""
        cells = self.sheet.rows[row]
        return cells[column] if column < len(cells) else None

    def column(self, column: int) -> list[tuple[int, Raw]]:
        """Return the rows where a column holds anything, and what, as far as patterns look."""
        return [(row, bounded(raw)) for row in self.rows
                if (raw := self.cell(row, column)) is not None]


def table_of(sheet: Sheet, header_row: int | None = None) -> Table:
    """Return a sheet's headings and rows.

    Parameters
    ----------
    header_row
        The last row of headings, counted from 0; None: found, -1: there are none.
    """
    header = _header_rows(sheet, _best_row(sheet) if header_row is None else header_row)
    first = header[-1] + 1 if header else 0
    width = max((len(row) for row in sheet.rows), default=0)
    rows = tuple(number for number in range(first, len(sheet.rows))
                 if any(raw is not None for raw in sheet.rows[number]))
    last = rows[-1] if rows else first - 1
    return Table(sheet, header, _headings(sheet, header, width), rows, last + 1 - first - len(rows))


def _best_row(sheet: Sheet) -> int:
    """Return the row with most headings; -1 if none has two, and the first is no row of words."""
    known = {number: sum(_is_heading(raw) for raw in row[:SEARCHED_COLUMNS])
             for number, row in enumerate(sheet.rows[:SEARCHED_ROWS])}
    best = max(known, key=lambda number: known[number], default=-1)
    if best >= 0 and known[best] >= 2:
        return best
    for number, row in enumerate(sheet.rows[:SEARCHED_ROWS]):
        filled = [raw for raw in row if raw is not None]
        if filled:
            below = sheet.rows[number + 1:number + 6]
            has_words = all(isinstance(raw, str) and not any(map(str.isdigit, raw))
                            for raw in filled)
            has_numbers = any(isinstance(raw, float) or any(map(str.isdigit, shown(raw)))
                              for others in below for raw in others)
            return number if has_words and has_numbers else -1
    return -1


def _is_heading(raw: Raw) -> bool:
    return isinstance(raw, str) and is_known(raw)


def _header_rows(sheet: Sheet, best: int) -> tuple[int, ...]:
    """Return the row with headings, and those around it that belong to them."""
    if not 0 <= best < len(sheet.rows):
        return ()
    rows = [best]
    if best > 0 and _groups(sheet, best - 1, best):
        rows.insert(0, best - 1)
    while len(rows) < MOST_HEADER_ROWS and _goes_on(sheet, rows[-1] + 1):
        rows.append(rows[-1] + 1)
    return tuple(rows)


def _groups(sheet: Sheet, row: int, below: int) -> bool:
    """Tell whether a row heads groups of the columns below, such as a window's two ends."""
    filled = [(column, raw) for column, raw in enumerate(sheet.rows[row]) if raw is not None]
    width = sum(raw is not None for raw in sheet.rows[below])
    if not filled or not all(isinstance(raw, str) and len(raw) <= LONGEST_HEADING
                             for _, raw in filled):
        return False
    spans = {first[1]: last[1] - first[1] + 1 for first, last in sheet.merged if first[0] == row}
    if any(spans.get(column, 1) >= max(width, 2) for column, _ in filled):
        return False  # a title over all columns
    return any(spans.get(column, 1) > 1 for column, _ in filled) or (
        len(filled) > 1 and any(_is_heading(raw) for _, raw in filled))


def _goes_on(sheet: Sheet, row: int) -> bool:
    """Tell whether a row goes on with the headings: with units, or with parts of groups."""
    if row >= len(sheet.rows):
        return False
    filled = [raw for raw in sheet.rows[row] if raw is not None]
    texts = [raw for raw in filled if isinstance(raw, str) and not any(map(str.isdigit, raw))]
    fitting = sum(is_unit(raw) or is_known(raw) for raw in texts)
    return bool(filled) and len(texts) == len(filled) and fitting > KNOWN_SHARE * len(filled)


def _headings(sheet: Sheet, header: tuple[int, ...], width: int) -> tuple[str, ...]:
    """Return the heading of each column, from all rows of headings."""
    parts: list[list[str]] = [[] for _ in range(width)]
    for row in header:
        cells = sheet.rows[row]
        group = ""
        for column in range(width):
            raw = cells[column] if column < len(cells) else None
            text = " ".join(shown(bounded(raw)).split())
            if text:
                group = text
            elif row == header[-1] or not _belongs(sheet, header, row, column):
                group = ""
            part = f"({text.strip('()[]')})" if text and is_unit(text) and parts[column] else group
            if part and part not in parts[column]:
                parts[column].append(part)
    return tuple(" ".join(part) for part in parts)


def _belongs(sheet: Sheet, header: tuple[int, ...], row: int, column: int) -> bool:
    """Tell whether an empty cell belongs to the group to its left."""
    for first, last in sheet.merged:
        if first[0] <= row <= last[0] and first[1] < column <= last[1]:
            return True
    if any(first[0] == row for first, _ in sheet.merged):
        return False
    below = sheet.rows[header[-1]]
    return column < len(below) and below[column] is not None
