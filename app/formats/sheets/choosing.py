"""Which sheets of a file are read, and what is asked about the others."""

from collections import defaultdict, deque
from typing import NamedTuple

from app.formats.sheets.cells import letters
from app.formats.sheets.clocks import Style
from app.formats.sheets.columns import columns_of
from app.formats.sheets.headings import simple
from app.formats.sheets.layout import RowOrigin, Table, table_of
from app.formats.sheets.plan_rules import lists_rules
from app.formats.sheets.questions import Question, Questionnaire
from app.formats.sheets.schemas import Mapping
from app.formats.sheets.table import MAX_COLUMNS, NotASheetError, Sheet, SheetFile
from app.formats.sheets.text import MAX_CELLS
from app.formats.sheets.vans import lists_vans

MOST_ASKED = 40
"""Sheets that are looked at."""

IGNORED, ALSO, INSTEAD, VEHICLES, RULES = "ignored", "also", "instead", "vehicles", "rules"
CHOICES = {IGNORED: "Not read", ALSO: "Its rows too", INSTEAD: "In place of the one that is read",
           VEHICLES: "Its rows are the vehicles", RULES: "Its rows are rules of the whole plan"}
READ_AS = {VEHICLES: "is read as the vehicles", RULES: "is read as rules of the whole plan"}


class Chosen(NamedTuple):
    """The customers' table, and the sheets that list vehicles and rules of the whole plan."""

    table: Table
    fleet: Sheet | None
    rules: Sheet | None


def chosen(file: SheetFile, mapping: Mapping, asking: Questionnaire,
           states_fleet: bool) -> Chosen:
    """Return what each sheet that is read is read as. In place.

    Parameters
    ----------
    states_fleet
        Whether the vehicles are stated beside the file.
    """
    main = _main_sheet(file, mapping)
    header = None if mapping.header_row is None else mapping.header_row - 1
    table, fleet, rules = table_of(main, header), None, None
    for sheet in file.sheets[:MOST_ASKED]:
        count = len(table_of(sheet).rows)
        is_main = sheet is main
        if not count or (is_main and asking.given.get(_id_of(sheet)) != INSTEAD):
            continue
        answer = asking.ask(_question(sheet, count, main, _usual(sheet, states_fleet)))
        if answer == ALSO and not is_main:
            table = with_rows_of(table, table_of(sheet))
        elif answer == VEHICLES and not is_main:
            fleet = sheet
        elif answer == RULES and not is_main:
            rules = sheet
    return Chosen(table, fleet, rules)


def _usual(sheet: Sheet, states_fleet: bool) -> str:
    """Return what a sheet beside the main one is for, by its looks."""
    if lists_vans(sheet):
        return IGNORED if states_fleet else VEHICLES
    return RULES if lists_rules(sheet) else IGNORED


def _id_of(sheet: Sheet) -> str:
    return f"sheet:{sheet.name}"


def _question(sheet: Sheet, count: int, main: Sheet, usual: str) -> Question:
    hidden = "hidden " if sheet.is_hidden else ""
    unread = "is the one read" if sheet is main else f"is not read, as {main.name} is"
    told = READ_AS.get(usual, unread)
    return Question(
        _id_of(sheet), "sheet", f"The {hidden}sheet {sheet.name} has {count} rows and {told}. "
        "What is it for?", CHOICES, usual,
        {"sheet": sheet.name, "count": count, "is_hidden": int(sheet.is_hidden)}, sheet=sheet.name)


def _main_sheet(file: SheetFile, mapping: Mapping) -> Sheet:
    instead = {name.removeprefix("sheet:") for name, answer in mapping.answers.items()
               if answer == INSTEAD}
    named = [sheet for sheet in file.sheets if sheet.name in instead] or [
        sheet for sheet in file.sheets if sheet.name == mapping.sheet]
    if named:
        return named[0]
    shown = [sheet for sheet in file.sheets if not sheet.is_hidden]
    if not shown:
        raise NotASheetError("The workbook has no sheet that shows.")
    return max(shown[:MOST_ASKED], key=_worth) if len(shown) > 1 else shown[0]


def _worth(sheet: Sheet) -> int:
    """Return how much a sheet looks like customers."""
    if lists_vans(sheet) or lists_rules(sheet):
        return 0
    table = table_of(sheet)
    known = sum(column.meaning != "ignored" for column in columns_of(table, Style(), ()))
    return known * min(len(table.rows), 3)


def with_rows_of(table: Table, other: Table) -> Table:
    """Return a table with the rows of another below its own, by their headings.

    Raises
    ------
    NotASheetError
        If it has more columns or cells than a sheet may have.
    """
    headings = list(table.headings)
    free, places = defaultdict[str, deque[int]](deque), []
    for index, known in enumerate(headings):
        free[simple(known)].append(index)
    for heading in other.headings:
        if heading and free[simple(heading)]:
            places.append(free[simple(heading)].popleft())
        else:
            places.append(len(headings))
            headings.append(heading)
    first = len(table.sheet.rows)
    if (len(headings) > MAX_COLUMNS
            or (first + len(other.sheet.rows)) * len(headings) > MAX_CELLS):
        raise NotASheetError(f"With the rows of {other.sheet.name} there are more than "
                             f"{MAX_COLUMNS} columns or {MAX_CELLS} cells: leave that sheet out.")
    moved = []
    for cells in other.sheet.rows:
        row: list[object] = [None] * len(headings)
        for place, raw in zip(places, cells, strict=False):
            row[place] = raw
        moved.append(row)
    sheet = Sheet(
        table.sheet.name, [*table.sheet.rows, *moved],  # type: ignore[list-item]
        table.sheet.merged, table.sheet.is_hidden,
        table.sheet.hidden_rows | {row + first for row in other.sheet.hidden_rows},
        table.sheet.hidden_columns, table.sheet.has_filter or other.sheet.has_filter)
    names = {place: letters(index) for index, place in enumerate(places)}
    return Table(sheet, table.header_rows, tuple(headings),
                 (*table.rows, *(row + first for row in other.rows)),
                 table.num_empty + other.num_empty,
                 (*table.origins, RowOrigin(first, other.sheet.name, names)))
