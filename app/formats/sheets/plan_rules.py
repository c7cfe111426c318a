"""A sheet of names and values -> what a plan costs as a whole: `fairness`."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from app.formats.sheets.cells import Doubt, MisreadError, Raw, cell_name, shown
from app.formats.sheets.clocks import Style
from app.formats.sheets.headings import simple
from app.formats.sheets.numbers import number_of
from app.formats.sheets.table import Sheet
from app.formats.sheets.words import MEASURES, PLAN_NAMES, meant

NAMES, MEASURE_NAMES = meant(PLAN_NAMES), meant(MEASURES)

MOST_ROWS = 100

Data = dict[str, Any]


class NamedLine(NamedTuple):
    """A name and what stands beside it."""

    name: str | None  # None: it is none that is known
    shown: str
    raw: Raw
    cell: str


def lists_rules(sheet: Sheet) -> bool:
    """Tell whether a sheet states what holds for the whole plan: it has few rows, most of which do.

    Of a list of customers one may be called Balance.
    """
    known = [line.name is not None for line in _lines(sheet)]
    return len(sheet.rows) <= MOST_ROWS and any(known) and 2 * sum(known) >= len(known)


def fairness_of(sheet: Sheet, style: Style) -> tuple[Data, list[Doubt]]:
    """Return what a sheet says of the whole plan, and what of it isn't used.

    Raises
    ------
    MisreadError
        If a value isn't what its name says.
    """
    stated: Data = {}
    unused = []
    for line in _lines(sheet):
        if line.name is None or line.name in stated:
            unused.append(f"{line.shown} ({line.cell})")
        else:
            stated[line.name] = _value(line, style)
    measure, cost = stated.pop("balance", None), stated.pop("balance_cost", None)
    doubts = [Doubt("RULES_IN_FILE", f"The sheet {sheet.name} is read as rules of the whole plan.",
                    values={"sheet": sheet.name})]
    if (measure is None) != (cost is None):
        lacks = "what is balanced" if measure is None else "its cost"
        doubts.append(Doubt("BALANCE_INCOMPLETE", f"The sheet {sheet.name} doesn't say {lacks}: "
                            "nothing is balanced. State both.", values={"sheet": sheet.name}))
    elif measure is not None:
        stated["balance"] = {"measure": measure, "cost": cost}
    if unused:
        doubts.append(Doubt("RULES_UNUSED", f"Of the sheet {sheet.name} nothing is made of "
                            f"{', '.join(unused[:10])}.",
                            values={"sheet": sheet.name, "names": unused[:10]}))
    return stated, doubts


def _lines(sheet: Sheet) -> Iterator[NamedLine]:
    """Yield the rows with a name and a value, but for a row of headings."""
    for number, row in enumerate(sheet.rows[:MOST_ROWS]):
        cells = [(column, raw) for column, raw in enumerate(row) if raw is not None]
        if len(cells) < 2 or not isinstance(cells[0][1], str):
            continue
        (_, name), (column, raw) = cells[:2]
        known = NAMES.get(simple(name))
        if known is not None or number:
            yield NamedLine(known, shown(name)[:80], raw,
                            f"{sheet.name}!{cell_name(number, column)}")


def _value(line: NamedLine, style: Style) -> Any:
    try:
        if line.name != "balance":
            found = number_of(line.raw, style.comma)
            if line.name != "min_vehicles":
                return found
            if found != round(found):
                raise MisreadError(f"{shown(line.raw)} is no number of vehicles: write a whole one")
            return round(found)
    except MisreadError as error:
        raise MisreadError(f"{line.cell}: {error}", line.cell, shown(line.raw)[:80]) from error
    measure = MEASURE_NAMES.get(simple(shown(line.raw)))
    if measure is None:
        raise MisreadError(f"{line.cell}: {shown(line.raw)[:80]!r} is nothing that can be balanced "
                           f"here: write one of {', '.join(MEASURES)}", line.cell,
                           shown(line.raw)[:80])
    return measure
