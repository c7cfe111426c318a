"""How a file writes numbers and dates, by what its cells leave no doubt about."""

from collections.abc import Sequence

from app.formats.sheets.cells import LONGEST_READ, Doubt, cell_name
from app.formats.sheets.clocks import Style, date_parts, states_zone
from app.formats.sheets.layout import Table
from app.formats.sheets.numbers import reads_two_ways, stated_in, uses_comma
from app.formats.sheets.schemas import ImportSettings, day_of
from app.formats.sheets.table import NotASheetError, SheetFile


def style_of(table: Table, file: SheetFile,
           settings: ImportSettings) -> tuple[Style, list[Doubt]]:
    """Return how the file writes numbers and dates."""
    mapping = settings.mapping
    cells = [(row, column, raw[:LONGEST_READ]) for row in table.rows[:2000]
             for column, raw in enumerate(table.sheet.rows[row]) if isinstance(raw, str)]
    doubts = []
    comma = None if mapping.decimals is None else mapping.decimals == ","
    if comma is None:
        comma = uses_comma(raw for _, _, raw in cells)
    if comma is None:
        # Behind a colon may stand a price, or what a note says.
        comma = uses_comma(text for _, _, raw in cells for text in stated_in(raw))
    if comma is None:
        comma = file.delimiter == ";"
        if open_cell := next((place for place in cells if any(
                map(reads_two_ways, (place[2], *stated_in(place[2]))))), None):
            row, column, raw = open_cell
            name = cell_name(row, column)
            doubts.append(Doubt("DECIMALS_GUESSED", f"{name} ({raw}) may have decimals or "
                                f"thousands: a {'comma' if comma else 'point'} is taken to stand "
                                "before decimals.", cell=name, values={
                                    "case": "comma" if comma else "point", "value": str(raw)}))
    if zone := next((place for place in cells if states_zone(place[2])), None):
        name = cell_name(zone[0], zone[1])
        doubts.append(Doubt("ZONE_NOT_READ", f"Times such as {name} ({zone[2]}) are read as they "
                            "are written: their time zone is not looked at.", cell=name,
                            values={"value": zone[2]}))
    day_first, doubt = _day_first(cells, mapping.day_first)
    try:
        day = day_of(settings)
    except ValueError as error:
        raise NotASheetError(f"There is no day {settings.day}.") from error
    return Style(comma, day_first, day), doubts + ([doubt] if doubt else [])


def _day_first(cells: Sequence[tuple[int, int, str]],
               stated: bool | None) -> tuple[bool, Doubt | None]:
    """Return whether days stand before months in dates with slashes."""
    dates = [(parts, raw, cell_name(row, column)) for row, column, raw in cells
             if (parts := date_parts(raw)) is not None]
    if stated is not None or not dates:
        return stated is not False, None
    if any(first > 12 for (first, _), _, _ in dates):
        return True, None
    if any(second > 12 for (_, second), _, _ in dates):
        return False, None
    american = any(raw.lower().rstrip(". ").endswith(("am", "pm")) for _, _, raw in cells)
    _, raw, name = dates[0]
    return not american, Doubt(
        "DATES_GUESSED", f"{name} ({raw}) may begin with the day or the month: the "
        f"{'month' if american else 'day'} is taken to come first.", cell=name,
        values={"case": "month" if american else "day", "value": str(raw)})


def encoding_doubt(file: SheetFile, table: Table) -> Doubt:
    cells = [*table.headings, *(raw for row in table.rows for raw in table.sheet.rows[row])]
    strange = next((raw for raw in cells if isinstance(raw, str) and not raw.isascii()), "")
    return Doubt("ENCODING_GUESSED", f"The file doesn't say its encoding: {file.encoding} is "
                 f"taken. Check that {strange[:60]!r} is spelt right.",
                 values={"encoding": file.encoding or "", "example": strange[:60]})
