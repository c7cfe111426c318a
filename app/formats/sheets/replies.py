"""What an import answers."""

import re
from collections import Counter
from collections.abc import Mapping as MappingType, Sequence

from app.formats.sheets.asked_columns import choices_of
from app.formats.sheets.cells import Doubt, MisreadError, Raw, letters, shown
from app.formats.sheets.clocks import Style
from app.formats.sheets.columns import Column
from app.formats.sheets.headings import guesses, is_aside, is_known
from app.formats.sheets.layout import Table
from app.formats.sheets.meanings import MEANINGS, PAIRS
from app.formats.sheets.readers import read, reading_text
from app.formats.sheets.schemas import (
    Certainty, ColumnMapping, ColumnReply, DoubtReply, ExampleReply, ImportReply, ImportSettings,
    Mapping, MeaningReply, QuestionReply, SheetErrorReply, SheetReply,
)
from app.formats.sheets.table import SheetFile
from app.formats.sheets.work import Import
from app.schemas.response import WarningReply

EXAMPLES = 4
MOST_LISTED = 1000
ROWS_SHOWN = 6


def reply_of(work: Import, file: SheetFile, settings: ImportSettings) -> ImportReply:
    table, style = work.table, work.style
    return ImportReply(
        sheets=[SheetReply(name=sheet.name, rows=len(sheet.rows), is_hidden=sheet.is_hidden)
                for sheet in file.sheets],
        sheet=table.sheet.name,
        encoding=file.encoding,
        delimiter=file.delimiter,
        header_rows=[row + 1 for row in table.header_rows],
        rows=len(table.rows),
        customers=len(work.stops),
        shipments=len(work.shipments),
        columns=_column_replies(work),
        table_rows=[row + 1 for row in table.rows[:ROWS_SHOWN]],
        day=style.day.isoformat() if style.day else None,
        doubts=[_doubt_reply(doubt) for doubt in work.doubts],
        questions=[QuestionReply.of(asked) for asked in work.asking.asked],
        errors=[SheetErrorReply(code=error.code, message=error.message, cell=error.cell,
                                values=dict(error.values))
                for error in work.errors[:MOST_LISTED]],
        num_errors=len(work.errors),
        looked_up=work.looked_up,
        mapping=_mapping(work, file, settings),
        meanings=[MeaningReply(meaning=name, title=meaning.title, units=list(meaning.units))
                  for name, meaning in MEANINGS.items()],
        request=work.request,
        warnings=[WarningReply(**warning._asdict()) for warning in work.warnings],
    )


def _column_replies(work: Import) -> list[ColumnReply]:
    where = {column.meaning: letters(column.index) for column in work.columns}
    return [_column_reply(work.table, column, work.style, where) for column in work.columns]


def _column_reply(table: Table, column: Column, style: Style,
                  where: MappingType[str, str]) -> ColumnReply:
    cells = table.column(column.index)
    raws = [raw for _, raw in cells]
    first = [(row, table.cell(row, column.index)) for row in table.rows[:ROWS_SHOWN]]
    return ColumnReply(
        column=letters(column.index), heading=column.heading, meaning=column.meaning,
        unit=column.unit, confidence=column.confidence,
        certainty=certainty_of(column, raws, "name" in where),
        pair=where.get(PAIRS.get(column.meaning, "")),
        likely=list(choices_of(column, raws, style)),
        cells=[None if raw is None else _example(table, row, raw, column, style)
               for row, raw in first],
        examples=[_example(table, row, raw, column, style) for row, raw in _telling(cells)],
        doubts=[_doubt_reply(doubt) for doubt in column.doubts])


def _telling(cells: Sequence[tuple[int, Raw]]) -> list[tuple[int, Raw]]:
    """Return some cells that look different, the first of each look."""
    looks: dict[str, tuple[int, Raw]] = {}
    for row, raw in cells[:1000]:
        text = shown(raw)
        look = "".join("9" if sign.isdigit() else sign for sign in text) if any(
            map(str.isdigit, text)) else "words"
        looks.setdefault(look, (row, raw))
        if len(looks) == EXAMPLES:
            break
    kept = list(looks.values())
    kept += [cell for cell in cells[:EXAMPLES] if cell not in kept][:EXAMPLES - len(kept)]
    return sorted(kept, key=lambda cell: cell[0])


def _example(table: Table, row: int, raw: Raw, column: Column,
             style: Style) -> ExampleReply:
    kind = MEANINGS[column.meaning].kind
    try:
        told: str | None = reading_text(read(raw, kind, column.unit, style), kind, column.unit)
    except MisreadError:
        told = None
    return ExampleReply(cell=table.name(row, column.index), raw=shown(raw)[:200],
                        read=None if told is None else told[:200])


def _doubt_reply(doubt: Doubt) -> DoubtReply:
    return DoubtReply(code=doubt.code, message=doubt.message, column=doubt.column, cell=doubt.cell,
                      values=dict(doubt.values))


def _mapping(work: Import, file: SheetFile, settings: ImportSettings) -> Mapping:
    """Return how the file was read, for the next one like it."""
    stated = settings.mapping
    headings = Counter(column.heading for column in work.columns)
    return Mapping(
        sheet=work.table.sheet.name if len(file.sheets) > 1 else None,
        header_row=stated.header_row,
        columns=[ColumnMapping(heading=column.heading[:2000],
                               column=None if headings[column.heading] == 1 and column.heading
                               else letters(column.index),
                               meaning=column.meaning, unit=column.unit)
                 for column in work.columns],
        decimals=stated.decimals,
        day_first=stated.day_first,
        encoding=stated.encoding,
        same_place=stated.same_place,
        answers=stated.answers,
    )


SAMPLED = 50
LONGEST_GROUP = 20

FOR_DRIVERS = frozenset(("phone", "email", "contact", "notes", "priority", "info", "order",
                         "layer"))
"""Meanings that no plan goes by: left out of it, nothing is planned wrongly."""

_TELLING = re.compile(
    r"\A(?:-?\d{1,6}(?:[.,]\d++)?|\d{1,2}[:.h]\d{2}.*+|.*\d{1,2}:\d{2}(?::\d{2})?"
    r"|-?\d{1,3}[.,]\d++[ ,;/]++-?\d{1,3}[.,]\d++|\d++(?:[.,]\d++)? ?[a-z]{1,4}\.?)",
    re.IGNORECASE)
"""Cells that may be amounts, times, coordinates: no phones, nor numbers of orders."""


def certainty_of(column: Column, cells: Sequence[Raw], is_named: bool) -> Certainty:
    """Return how sure the meaning of a column is, by its heading and cells.

    Parameters
    ----------
    is_named
        Whether a column names customers; else any with words may.
    """
    if column.confidence == 1:
        return "stated"
    if column.meaning != "ignored":
        return "doubtful" if column.doubts and column.meaning not in FOR_DRIVERS else "sure"
    return "open" if _may_matter(column, cells[:SAMPLED], is_named) else "unused"


def _may_matter(column: Column, cells: Sequence[Raw], is_named: bool) -> bool:
    """Tell whether a column that isn't used may be for the plan."""
    if not cells or is_aside(column.heading):
        return False
    if is_known(column.heading):
        likely = guesses(column.heading)[0].meaning
        return likely not in FOR_DRIVERS and likely != "name" and MEANINGS[likely].kind != "text"
    if all(any(map(str.isalpha, shown(raw))) for raw in cells) and (
            not is_named or _are_groups(cells)):
        return True
    return all(_TELLING.fullmatch(shown(raw)) for raw in cells)


def _are_groups(cells: Sequence[Raw]) -> bool:
    """Tell whether words divide rows, as crews, areas and skills do."""
    words = {shown(raw) for raw in cells}
    return 1 < len(words) <= len(cells) / 2 and max(map(len, words)) <= LONGEST_GROUP
