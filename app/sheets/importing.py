"""A file -> what its columns mean, the request that it makes, and every guess on the way."""

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from typing import Any

from app.schemas.response import WarningReply
from app.settings import MAX_CUSTOMERS
from app.sheets.addresses import NO_FINDER, Finder, locate, with_depot
from app.sheets.cells import CellError, Doubt, MisreadError, Raw, cell_name, letters, shown
from app.sheets.clocks import Style, date_parts, states_zone
from app.sheets.columns import Column, columns_of, language_of, with_begin
from app.sheets.customers import Entry, address_of, entries_of, placed, together
from app.sheets.days import on_day
from app.sheets.fleet import Incomplete
from app.sheets.geography import Ground, far_off, ground_of
from app.sheets.layout import Table, table_of
from app.sheets.looks import with_looks
from app.sheets.meanings import MEANINGS
from app.sheets.numbers import reads_two_ways, uses_comma
from app.sheets.readers import read, reading_text
from app.sheets.request import look_over, request_of, stated_depot
from app.sheets.rows import Row, days_in, rows_of, without_totals
from app.sheets.schemas import (
    ColumnMapping, ColumnReply, DoubtReply, ExampleReply, ImportReply, ImportSettings,
    LookUpReply, Mapping, MeaningReply, SheetErrorReply, SheetReply, day_of,
)
from app.sheets.table import NotASheetError, Sheet, SheetFile, read_sheets
from app.warnings.warning import RequestWarning

EXAMPLES = 4
MOST_LISTED = 1000

FOR_NUMBERS = ("number", "amount", "degrees", "point")


@dataclass
class Import:
    """A file as far as it has been understood."""

    table: Table
    style: Style
    columns: list[Column]
    doubts: list[Doubt] = field(default_factory=list)
    errors: list[CellError] = field(default_factory=list)
    stops: list[Entry] = field(default_factory=list)
    request: dict[str, Any] | None = None
    warnings: tuple[RequestWarning, ...] = ()
    looked_up: LookUpReply | None = None


def import_file(content: bytes, settings: ImportSettings, finder: Finder = NO_FINDER,
                road_profiles: Collection[str] = ()) -> ImportReply:
    """Return what a file says and what became of it.

    Addresses of rows without coordinates are looked up by `finder`; `road_profiles` are those
    for which there are roads.

    Raises
    ------
    NotASheetError
        If it holds no rows of cells.
    """
    mapping = settings.mapping
    file = read_sheets(content, mapping.encoding)
    sheet = _sheet(file, mapping.sheet)
    header = None if mapping.header_row is None else mapping.header_row - 1
    table = table_of(sheet, header)
    if not table.rows:
        raise NotASheetError("The sheet has no rows of customers below its headings.")
    style, doubts = _style(table, file, settings)
    columns, more = with_begin(columns_of(table, style, mapping.columns))
    columns = with_looks(table, columns)
    work = Import(table, style, columns, doubts + more)
    if file.is_guessed:
        work.doubts.append(_encoding_doubt(file, table))
    if not table.header_rows:
        work.doubts.append(Doubt("NO_HEADINGS", "There are no headings: say what columns mean."))
    _understand(work, settings, finder, road_profiles)
    return _reply(work, file, settings)


def _sheet(file: SheetFile, name: str | None) -> Sheet:
    if name:
        found = [sheet for sheet in file.sheets if sheet.name == name]
        if found:
            return found[0]
    if not file.sheets:
        raise NotASheetError("The workbook has no sheet that shows.")

    def worth(sheet: Sheet) -> int:
        table = table_of(sheet)
        known = sum(column.meaning != "ignored" for column in columns_of(table, Style(), ()))
        return known * min(len(table.rows), 3)

    return max(file.sheets, key=worth) if len(file.sheets) > 1 else file.sheets[0]


def _style(table: Table, file: SheetFile,
           settings: ImportSettings) -> tuple[Style, list[Doubt]]:
    """Return how the file writes numbers and dates."""
    mapping = settings.mapping
    cells = [(row, column, raw) for row in table.rows[:2000]
             for column, raw in enumerate(table.sheet.rows[row]) if isinstance(raw, str)]
    doubts = []
    comma = None if mapping.decimals is None else mapping.decimals == ","
    if comma is None:
        comma = uses_comma(raw for _, _, raw in cells)
    if comma is None:
        comma = file.delimiter == ";"
        if open_cell := next((place for place in cells if reads_two_ways(place[2])), None):
            row, column, raw = open_cell
            name = cell_name(row, column)
            doubts.append(Doubt("DECIMALS_GUESSED", f"{name} ({raw}) may have decimals or "
                                f"thousands: a {'comma' if comma else 'point'} is taken to stand "
                                "before decimals.", cell=name))
    if zone := next((place for place in cells if states_zone(place[2])), None):
        name = cell_name(zone[0], zone[1])
        doubts.append(Doubt("ZONE_NOT_READ", f"Times such as {name} ({zone[2]}) are read as they "
                            "are written: their time zone is not looked at.", cell=name))
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
        f"{'month' if american else 'day'} is taken to come first.", cell=name)


def _encoding_doubt(file: SheetFile, table: Table) -> Doubt:
    cells = [*table.headings, *(raw for row in table.rows for raw in table.sheet.rows[row])]
    strange = next((raw for raw in cells if isinstance(raw, str) and not raw.isascii()), "")
    return Doubt("ENCODING_GUESSED", f"The file doesn't say its encoding: {file.encoding} is "
                 f"taken. Check that {strange[:60]!r} is spelt right.")


def _understand(work: Import, settings: ImportSettings, finder: Finder,
                road_profiles: Collection[str]) -> None:
    """Read the rows and make the request, as far as that goes. In place."""
    rows = list(without_totals(rows_of(work.table, work.columns, work.style)))
    if len(rows) < len(work.table.rows):
        work.doubts.append(Doubt("TOTAL_LEFT_OUT", "The last row sums up the others and is left "
                                 "out.", cell=cell_name(work.table.rows[-1], 0)))
    rows = _of_day(work, rows, settings)
    try:
        settings, doubts = with_depot(settings, finder)
        work.doubts += doubts
        ground = _ground(work, rows, settings, finder)
    except Incomplete as incomplete:
        work.errors.append(incomplete.error)
        return
    ground = _with_addresses(work, rows, ground, finder, settings.not_found == "address")
    depots = [row for row in rows if row.is_depot]
    customers = [row for row in rows if not row.is_depot]
    entries = entries_of(customers, work.columns, ground, settings.service_minutes)
    work.errors += [error for row in customers for error in row.errors]
    _note_amounts(work, customers)
    work.stops, doubts = together(entries, settings.mapping.same_place)
    work.doubts += doubts
    if ground.is_geographic:
        work.doubts += far_off(placed(work.stops))
    if not work.stops:
        if not work.errors:
            work.errors.append(CellError("NO_CUSTOMERS", "There is no customer in the file."))
        return
    _complete(work, depots, ground, settings, road_profiles)


def _complete(work: Import, depots: Sequence[Row], ground: Ground, settings: ImportSettings,
              road_profiles: Collection[str]) -> None:
    """Make the request, unless there are errors. In place."""
    if len(work.stops) > MAX_CUSTOMERS:
        work.errors.append(_too_many(work.stops))
        return
    try:
        request, doubts = request_of(work.stops, depots, ground, work.columns, settings)
    except Incomplete as incomplete:
        work.errors.append(incomplete.error)
        return
    work.doubts += doubts
    day = work.style.day
    if day is not None and settings.time_zone is not None:
        request = on_day(request, day, settings.time_zone)
    else:
        since = f" of {day.isoformat()}" if day else ", of whichever day: no date is stated"
        work.doubts.append(Doubt("MIDNIGHT", f"Times are counted from midnight{since}."))
    if work.errors and not settings.leave_out_errors:
        return
    wrong, work.warnings = look_over(request, work.stops, road_profiles)
    if wrong:
        work.errors += wrong
        return
    if work.errors:
        work.doubts.append(Doubt("ROWS_LEFT_OUT", "Rows with errors are left out."))
    work.request = request


def _too_many(stops: Sequence[Entry]) -> CellError:
    first = stops[MAX_CUSTOMERS].rows[0]
    cell = first.cell("name", "order", "latitude", "point", "y")
    return CellError("WRONG_LENGTH", f"There are {len(stops):,} stops, and {MAX_CUSTOMERS:,} are "
                     f"planned at once at most; {cell} is one too many. Cut the file in parts, by "
                     "area or by day, and plan each with the vehicles that serve it.", cell=cell)


def _of_day(work: Import, rows: list[Row], settings: ImportSettings) -> list[Row]:
    """Return the rows of the day that is planned; note which it is. In place."""
    days = days_in(rows)
    day = work.style.day
    if day is None and not days:
        days = _days_of_clocks(work)
    if day is None and len(days) > 1:
        listed = ", ".join(found.isoformat() for found in days[:5])
        cell = next((row.cell("date") for row in rows if row.get("date") == days[1]), None)
        work.errors.append(CellError("SEVERAL_DAYS", f"There are {len(days)} days ({listed}): "
                                     "state the one that is planned.", cell))
    if day is None and days:
        work.style = replace(work.style, day=days[0])
        rows = list(without_totals(rows_of(work.table, work.columns, work.style)))
    if day is None:
        return rows
    kept = [row for row in rows if row.get("date") in (None, day)]
    if len(kept) < len(rows):
        work.doubts.append(Doubt("OTHER_DAYS", f"{len(rows) - len(kept)} rows of other days than "
                                 f"{day.isoformat()} are left out."))
    return kept


def _days_of_clocks(work: Import) -> list[date]:
    """Return the days that times state, if there is no column of days: the first of them."""
    days: set[date] = set()
    for column in work.columns:
        if MEANINGS[column.meaning].kind == "clock":
            for _, raw in work.table.column(column.index):
                try:
                    days.add(read(raw, "date", None, work.style))
                except MisreadError:
                    continue
    return sorted(day for day in days if day.year > 1900)[:1]


def _ground(work: Import, rows: Sequence[Row], settings: ImportSettings,
            finder: Finder) -> Ground:
    """Return how the file states places; note what is doubtful or lacks. In place."""
    language = language_of(work.columns)
    ground = ground_of(rows, language != "en", stated_depot(settings))
    work.doubts += ground.doubts
    keeps = settings.not_found == "address"
    if ground.is_geographic and (finder.finds or keeps):
        ground = replace(ground, looks_up=True)
    if not ground.columns and not (ground.looks_up and any(map(address_of, rows))):
        addresses = any(column.meaning in ("address", "street", "town") for column in work.columns)
        raise Incomplete("NO_COORDINATES", "No columns hold coordinates" + (
            ": there are addresses, which are not looked up here. Add columns with latitude and "
            "longitude, or have the service set up with a geocoder (TANDEM_GEOCODER)."
            if addresses else ": say which hold latitude and longitude, or x and y."))
    return ground


def _with_addresses(work: Import, rows: Sequence[Row], ground: Ground, finder: Finder,
                    keeps: bool) -> Ground:
    """Return a ground that knows where addresses are; note what is doubtful. In place."""
    located = locate(rows, ground, finder, keeps=keeps)
    work.doubts += located.doubts
    work.errors += located.errors
    work.looked_up = located.reply
    return replace(ground, found=located.places, unplaced=located.unplaced,
                   pending=located.pending)


def _note_amounts(work: Import, rows: Sequence[Row]) -> None:
    """Note where amounts are taken for granted. In place."""
    columns = [column for column in work.columns if column.meaning == "demand"]
    if not columns:
        work.doubts.append(Doubt("NO_AMOUNTS", "No column holds amounts: each customer counts 1."))
    for place, column in enumerate(columns):
        empty = [row for row in rows if row.get("demand")[place] is None and not any(
            error.cell == cell_name(row.number, column.index) for error in row.errors)]
        if empty:
            name = cell_name(empty[0].number, column.index)
            work.doubts.append(Doubt("EMPTY_AMOUNT", f"{len(empty)} cells of column {column.name} "
                                     f"are empty, such as {name}: they count 0.", letters(
                                         column.index), name))


def _reply(work: Import, file: SheetFile, settings: ImportSettings) -> ImportReply:
    table, style = work.table, work.style
    return ImportReply(
        sheets=[SheetReply(name=sheet.name, rows=len(sheet.rows)) for sheet in file.sheets],
        sheet=table.sheet.name,
        encoding=file.encoding,
        delimiter=file.delimiter,
        header_rows=[row + 1 for row in table.header_rows],
        rows=len(table.rows),
        customers=len(work.stops),
        columns=[_column_reply(table, column, style) for column in work.columns],
        day=style.day.isoformat() if style.day else None,
        doubts=[_doubt_reply(doubt) for doubt in work.doubts],
        errors=[SheetErrorReply(code=error.code, message=error.message, cell=error.cell)
                for error in work.errors[:MOST_LISTED]],
        num_errors=len(work.errors),
        looked_up=work.looked_up,
        mapping=_mapping(work, file, settings),
        meanings=[MeaningReply(meaning=name, title=meaning.title, units=list(meaning.units))
                  for name, meaning in MEANINGS.items()],
        request=work.request,
        warnings=[WarningReply(**warning._asdict()) for warning in work.warnings],
    )


def _column_reply(table: Table, column: Column, style: Style) -> ColumnReply:
    cells = table.column(column.index)
    return ColumnReply(
        column=letters(column.index), heading=column.heading, meaning=column.meaning,
        unit=column.unit, confidence=column.confidence,
        examples=[_example(row, raw, column, style) for row, raw in _telling(cells)],
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


def _example(row: int, raw: Raw, column: Column, style: Style) -> ExampleReply:
    kind = MEANINGS[column.meaning].kind
    try:
        told: str | None = reading_text(read(raw, kind, column.unit, style), kind, column.unit)
    except MisreadError:
        told = None
    return ExampleReply(cell=cell_name(row, column.index), raw=shown(raw)[:200],
                        read=None if told is None else told[:200])


def _doubt_reply(doubt: Doubt) -> DoubtReply:
    return DoubtReply(code=doubt.code, message=doubt.message, column=doubt.column, cell=doubt.cell)


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
    )
