"""Rows that a comma cut within numbers: decimals are written with it, and it parts cells, too."""

from dataclasses import replace

from app.formats.sheets.cells import CellError, Doubt, Raw
from app.formats.sheets.headings import HEADING, guesses
from app.formats.sheets.layout import Table
from app.formats.sheets.meanings import MEANINGS

NUMERIC = frozenset(("degrees", "number", "amount", "duration"))
EXACT = frozenset(("degrees",))
"""Kinds of columns whose numbers have decimals, in every row that can be read so."""

FEWEST_ROWS = 1

MOST_COLUMNS = 100
"""Of a table that is put together: in each row, every column is tried at every cell."""


def rejoined(table: Table, delimiter: str | None) -> tuple[Table, list[Doubt], list[CellError]]:
    """Return a table whose numbers are whole again, and what is to be said of it or is wrong.

    Only where each row can be put together in one way; else the table as it is.
    """
    count = len(table.header_rows) and max(
        (place + 1 for place, heading in enumerate(table.headings) if heading), default=0)
    wide = [row for row in table.rows if _width(table.sheet.rows[row]) > count] if count else []
    is_cut = delimiter == "," and len(wide) >= max(FEWEST_ROWS, len(table.rows) / 2)
    if not is_cut or len(table.headings) > MOST_COLUMNS:
        return table, [], []
    kinds = [_kind(heading) for heading in table.headings[:count]]
    rows = list(table.sheet.rows)
    for number in table.rows:
        cells = rows[number]
        whole = _whole(cells[:_width(cells)], kinds)
        if whole is None:
            return table, [], _cut(table, kinds, number)
        rows[number] = whole
    sheet = replace(table.sheet, rows=rows)
    first = table.name(wide[0], 0)
    told = Doubt("DECIMAL_COMMAS", "Rows have more cells than there are headings, such as "
                 f"{first}: commas are taken for decimal ones where numbers stand, so that each "
                 f"row has {count} cells.", cell=first, values={"count": count})
    return replace(table, sheet=sheet, headings=table.headings[:count]), [told], []


def _cut(table: Table, kinds: list[str], row: int) -> list[CellError]:
    """Return the error about a row whose coordinates a comma has cut; none: it only is wide."""
    cells = table.sheet.rows[row]
    degrees = [place for place, kind in enumerate(kinds) if kind in EXACT]
    if not degrees or not _are_parts(cells, degrees[0]):
        return []
    return [CellError(
        "TOO_MANY_CELLS", f"Row {row + 1} has {_width(cells)} cells under {len(kinds)} headings: "
        "decimals are written with a comma, which parts cells, too, so that it can't be told where "
        "numbers end. Save the file with semicolons, or as a workbook.", table.name(row, 0))]


def _width(cells: list[Raw]) -> int:
    """Return the number of cells up to the last that holds anything."""
    return max((place + 1 for place, raw in enumerate(cells) if raw is not None), default=0)


def _kind(heading: str) -> str:
    found = guesses(heading)
    return MEANINGS[found[0].meaning].kind if found and found[0].score >= HEADING else "text"


def _whole(cells: list[Raw], kinds: list[str]) -> list[Raw] | None:
    """Return the cells of a row, one for each column; None: there are several ways, or none.

    Degrees take two cells wherever they can: nobody writes 48 degrees alone beside decimals.
    """
    for must in (EXACT, frozenset()):
        ways = _ways(cells, kinds, must)
        if ways[0][0] == 1:
            return _way(cells, kinds, must, ways)
        if ways[0][0] > 1:
            return None
    return None


def _ways(cells: list[Raw], kinds: list[str], must: frozenset[str]) -> list[list[int]]:
    """Return in how many ways columns from one on take the cells from one on."""
    ways = [[0] * (len(cells) + 3) for _ in range(len(kinds) + 1)]
    ways[len(kinds)][len(cells)] = 1
    for column in range(len(kinds) - 1, -1, -1):
        for place in range(len(cells) + 1):
            ways[column][place] = sum(ways[column + 1][place + taken]
                                      for taken in _takes(cells, place, kinds[column], must))
    return ways


def _takes(cells: list[Raw], place: int, kind: str, must: frozenset[str]) -> tuple[int, ...]:
    """Return how many cells a column may take: one past the end stands for an empty one."""
    if place >= len(cells):
        return (0,)
    if kind not in NUMERIC or not _are_parts(cells, place):
        return (1,)
    return (2,) if kind in must else (1, 2)


def _are_parts(cells: list[Raw], place: int) -> bool:
    if place + 1 >= len(cells):
        return False
    first, second = cells[place], cells[place + 1]
    return (isinstance(first, str) and isinstance(second, str)
            and first.lstrip("+-").isdecimal() and second.isdecimal())


def _way(cells: list[Raw], kinds: list[str], must: frozenset[str],
         ways: list[list[int]]) -> list[Raw]:
    whole: list[Raw] = []
    place = 0
    for column, kind in enumerate(kinds):
        taken = next(taken for taken in _takes(cells, place, kind, must)
                     if ways[column + 1][place + taken])
        whole.append(f"{cells[place]},{cells[place + 1]}" if taken == 2
                     else cells[place] if taken else None)
        place += taken
    return whole
