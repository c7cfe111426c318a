"""A column for each day of the week -> that of the day planned; empty cells are no stops."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import date
from typing import NamedTuple

from app.formats.sheets.cells import CellError, Doubt, MisreadError, Raw, letters, shown
from app.formats.sheets.clocks import Style
from app.formats.sheets.headings import guesses, simple
from app.formats.sheets.layout import Table
from app.formats.sheets.questions import Question, Questionnaire
from app.formats.sheets.readers import NO, YES, read
from app.formats.sheets.schemas import ColumnMapping
from app.formats.sheets.words import WEEKDAYS, meant

NAMES = meant(WEEKDAYS)
DAYS = list(WEEKDAYS)

LEAST = 3
"""Columns from which shortened days alone are days: `do` is an end in Polish, too."""

NOTHING = NO | {"", "-"}


class OfDay(NamedTuple):
    """A table of one day, what its columns of days mean, and what is told."""

    table: Table
    stated: list[ColumnMapping]
    doubts: list[Doubt]
    errors: list[CellError]


def of_weekday(table: Table, style: Style, asking: Questionnaire) -> OfDay:
    """Return a table of the day that is planned, if it has a column for each. In place."""
    columns = _columns_of_days(table.headings)
    if not columns:
        return OfDay(table, [], [], [])
    chosen = _asked(table, columns, style.day, asking)
    stated = [ColumnMapping(
        heading=table.headings[index][:2000], column=letters(index), **_meant(table, index, style)
        if index == chosen else {"meaning": "ignored"}) for index in columns]
    if chosen is None:
        cell = table.name(table.header_rows[-1], min(columns))
        return OfDay(table, stated, [], [CellError(
            "SEVERAL_DAYS", f"There are {len(columns)} days of the week: state the one that is "
            "planned.", cell, {"count": len(columns)})])
    rows = tuple(row for row in table.rows
                 if simple(shown(table.cell(row, chosen))) not in NOTHING)
    left_out = len(table.rows) - len(rows)
    doubts = [Doubt("OTHER_DAYS", f"{left_out} rows have nothing under {table.headings[chosen]}, "
                    "and are left out.", letters(chosen),
                    values={"count": left_out})] if left_out else []
    return OfDay(replace(table, rows=rows), stated, doubts, [])


def _columns_of_days(headings: Sequence[str]) -> dict[int, str]:
    """Return the columns of days, each with its day; none: there are no such."""
    groups: dict[str, dict[int, str]] = defaultdict(dict)
    for index, heading in enumerate(headings):
        words = simple(heading).split()
        for count in (2, 1):
            for first, rest in ((" ".join(words[:count]), words[count:]),
                                (" ".join(words[len(words) - count:]), words[:-count])):
                if first in NAMES:
                    groups[" ".join(rest)].setdefault(index, NAMES[first])
    for others, found in groups.items():
        is_long = all(len(word) > LEAST for index in found
                      for word in simple(headings[index]).split())
        if len(set(found.values())) == len(found) >= (2 if others or is_long else LEAST):
            return found
    return {}


def _asked(table: Table, columns: Mapping[int, str], day: date | None,
           asking: Questionnaire) -> int | None:
    """Return the column of the day that is planned; None: nobody says. In place."""
    listed: str = ", ".join(table.headings[index] for index in columns)
    planned = None if day is None else DAYS[day.weekday()]
    answer = asking.ask(Question(
        "weekday", "day", f"There are {len(columns)} days ({listed}): which is planned?",
        {name: table.headings[index] for index, name in columns.items()}, None,
        {"count": len(columns), "days": listed},
        cell=table.name(table.header_rows[-1], min(columns))),
        planned if planned in columns.values() else None)
    return next((index for index, name in columns.items() if name == answer), None)


def _meant(table: Table, index: int, style: Style) -> dict[str, str | None]:
    """Return what cells of a day say: amounts, windows, or no more than that there is a stop."""
    cells = [raw for _, raw in table.column(index)]
    unit = next((guess.unit for guess in guesses(table.headings[index])
                 if guess.meaning == "demand"), None)
    if all(simple(shown(raw)) in (YES | NO) - {"1", "0"} for raw in cells):
        return {"meaning": "ignored"}
    for meaning, kind in (("demand", "amount"), ("window", "windows")):
        if all(_says(raw, kind, style) for raw in cells):
            return {"meaning": meaning, "unit": unit}
    return {"meaning": "info"}


def _says(raw: Raw, kind: str, style: Style) -> bool:
    try:
        read(raw, "amount" if kind == "amount" else "windows", None, style)
    except (MisreadError, TypeError):
        return simple(shown(raw)) in NOTHING
    return True
