"""A file -> what its columns mean, the request that it makes, and every guess on the way."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from datetime import date

from app.formats.sheets.addresses import NO_FINDER, Finder, locate, with_depot
from app.formats.sheets.alternatives import add_alternatives, is_alternative
from app.formats.sheets.asked_columns import ask_columns, stated_columns
from app.formats.sheets.cells import CellError, Doubt, MisreadError, letters
from app.formats.sheets.choosing import Chosen, chosen
from app.formats.sheets.columns import columns_of, language_of, with_begin
from app.formats.sheets.customers import Entry, address_of, entries_of, overnight, placed, together
from app.formats.sheets.damage import damaged
from app.formats.sheets.days import on_day
from app.formats.sheets.dividing import divided
from app.formats.sheets.dropping import (
    with_kinds, without_cancelled, without_doubles, without_hidden, without_sums,
)
from app.formats.sheets.fleet import Incomplete
from app.formats.sheets.geography import TableGeography, far_off, ground_of
from app.formats.sheets.looks import with_looks
from app.formats.sheets.meanings import MEANINGS
from app.formats.sheets.nights import into_the_night
from app.formats.sheets.plan_rules import fairness_of
from app.formats.sheets.questions import Question, Questionnaire
from app.formats.sheets.readers import read
from app.formats.sheets.rejoining import rejoined
from app.formats.sheets.related import relations_of, stops_called
from app.formats.sheets.replies import reply_of
from app.formats.sheets.request import look_over, request_of, stated_depot
from app.formats.sheets.rows import Row, days_in, rows_of, sums_in
from app.formats.sheets.schemas import ImportReply, ImportSettings
from app.formats.sheets.shipments import shipments_of
from app.formats.sheets.styles import encoding_doubt, style_of
from app.formats.sheets.table import NotASheetError, SheetFile, read_sheets
from app.formats.sheets.vans import vans_of
from app.formats.sheets.weekdays import of_weekday
from app.formats.sheets.work import Import
from app.schemas.limits import MAX_CUSTOMERS


OF_RIDES = ("max_between", "max_detour", "back_from")
"""What rows say of rides, which have two places."""


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
    file = read_sheets(content, settings.mapping.encoding)
    work, found = _columns(file, settings)
    _read_others(work, found)
    if not work.errors:
        _understand(work, settings, finder, road_profiles)
    work.errors += work.asking.errors
    if work.asking.errors:
        work.request = None
    return reply_of(work, file, settings)


def _columns(file: SheetFile, settings: ImportSettings) -> tuple[Import, Chosen]:
    """Return a file with its columns known, and what its other sheets are for."""
    mapping = settings.mapping
    asking = Questionnaire(mapping.answers)
    states_fleet = settings.vehicles is not None or settings.capacity is not None
    found = chosen(file, mapping, asking, states_fleet)
    if not found.table.rows:
        raise NotASheetError("The sheet has no rows of customers below its headings.")
    table, rejoining, cut = rejoined(found.table, file.delimiter)
    table = without_hidden(table, asking)
    style, doubts = style_of(table, file, settings)
    of_day = of_weekday(table, style, asking)
    table = of_day.table
    stated = [*of_day.stated, *stated_columns(table, mapping, asking)]
    columns, more = with_begin(columns_of(table, style, stated))
    columns = with_looks(table, columns)
    ask_columns(table, columns, style, asking)
    work = Import(table, style, columns, asking, doubts=rejoining + doubts + more + of_day.doubts,
                  errors=cut + of_day.errors)
    if file.is_guessed:
        work.doubts.append(encoding_doubt(file, table))
    if not table.header_rows:
        work.doubts.append(Doubt("NO_HEADINGS", "There are no headings: say what columns mean."))
    return work, found


def _read_others(work: Import, found: Chosen) -> None:
    """Read the vehicles, and the rules of the whole plan, that sheets list. In place."""
    try:
        if found.fleet is not None:
            work.vans, doubts = vans_of(found.fleet, work.style)
            work.doubts += doubts
        if found.rules is not None:
            work.fairness, doubts = fairness_of(found.rules, work.style)
            work.doubts += doubts
    except MisreadError as error:
        work.errors.append(CellError("MISREAD", f"{error}.", error.cell,
                                     {"case": "aside", "value": error.value}))


def _understand(work: Import, settings: ImportSettings, finder: Finder,
                road_profiles: Collection[str]) -> None:
    """Read the rows and make the request, as far as that goes. In place."""
    rows = rows_of(work.table, work.columns, work.style)
    sums = sums_in(rows)
    rows = _of_day(work, rows, sums, settings)
    rows = without_cancelled(work.table, rows, work.columns, work.asking)
    rows = without_doubles(work.table, rows, work.asking)
    rows = with_kinds(work.table, rows, work.columns, work.asking)
    rows, doubts, errors = divided(rows, len(work.table.sheet.rows), work.asking)
    work.doubts += doubts
    work.errors += errors
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
    _serve(work, entries, frozenset(row.number for row in customers if row.errors), settings)
    served = [*work.stops, *work.shipments]
    work.doubts += overnight(served) + damaged(work.table, work.columns)
    if ground.is_geographic:
        work.doubts += far_off(placed(served))
    if not served:
        if not work.errors:
            work.errors.append(CellError("NO_CUSTOMERS", "There is no customer in the file."))
        return
    _complete(work, depots, ground, settings, road_profiles)


def _serve(work: Import, entries: Sequence[Entry], refused: frozenset[int],
           settings: ImportSettings) -> None:
    """Make customers with their other places, and shipments, of rows. In place."""
    others = [entry for entry in entries if is_alternative(entry.rows[0])]
    own = [entry for entry in entries
           if not entry.rows[0].side and not is_alternative(entry.rows[0])]
    work.stops, doubts = together(own, settings.mapping.same_place)
    told, wrong = add_alternatives(others, work.stops, stops_called(work.stops), refused)
    work.shipments, errors = shipments_of(entries)
    work.doubts += doubts + told + _unused_rides(own)
    work.errors += wrong + errors


def _unused_rides(own: Sequence[Entry]) -> list[Doubt]:
    """Return the doubt about the longest ride of who isn't fetched elsewhere."""
    stated = [row for entry in own for row in entry.rows
              if any(row.get(meaning) is not None for meaning in OF_RIDES)]
    if not stated:
        return []
    cell = stated[0].cell(*(meaning for meaning in OF_RIDES
                            if stated[0].get(meaning) is not None))
    return [Doubt("RIDE_UNUSED", f"{len(stated)} rows state a ride, such as {cell}, and have "
                  "one place: say where each is fetched, or nothing is made of it.",
                  cell=cell, values={"count": len(stated)})]


def _complete(work: Import, depots: Sequence[Row], ground: TableGeography, settings: ImportSettings,
              road_profiles: Collection[str]) -> None:
    """Make the request, unless there are errors. In place."""
    if len(work.stops) > MAX_CUSTOMERS:
        work.errors.append(_too_many(work.stops))
        return
    try:
        request, doubts = request_of(work, depots, ground, settings)
    except Incomplete as incomplete:
        work.errors.append(incomplete.error)
        return
    relations, alone = relations_of([*work.stops, *work.shipments], work.asking)
    if relations:
        request["relations"] = [relation.stated for relation in relations]
    work.doubts += doubts + alone
    work.doubts += into_the_night(request["fleet"], [*work.stops, *work.shipments])
    day = work.style.day
    if day is not None and settings.time_zone is not None:
        request = on_day(request, day, settings.time_zone)
    else:
        since = f" of {day.isoformat()}" if day else ", of whichever day: no date is stated"
        work.doubts.append(Doubt("MIDNIGHT", f"Times are counted from midnight{since}."))
    if work.errors and not settings.leave_out_errors:
        return
    wrong, work.warnings = look_over(request, work, relations, road_profiles)
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
                     "area or by day, and plan each with the vehicles that serve it.", cell,
                     {"count": len(stops), "most": MAX_CUSTOMERS})


def _of_day(work: Import, rows: list[Row], sums: list[Row],
            settings: ImportSettings) -> list[Row]:
    """Return the rows of the day that is planned; note which it is. In place."""
    before, rows = rows, without_sums(work.table, rows, sums, work.asking)
    if len(rows) < len(before):
        cell = sums[0].cell("name", "order")
        work.doubts.append(Doubt("TOTAL_LEFT_OUT", f"What sums up others is left out ({cell}).",
                                 cell=cell))
    days = days_in(rows)
    day = work.style.day
    if len(days) > 1:
        day = _asked_day(work, rows, days)
    if day is None and not days:
        days = _days_of_clocks(work)
    if day != work.style.day or (day is None and days):
        numbers = {row.number for row in rows}
        work.style = replace(work.style, day=day or days[0])
        rows = [row for row in rows_of(work.table, work.columns, work.style)
                if row.number in numbers]
    planned = work.style.day
    if planned is None:
        return rows
    kept = [row for row in rows if row.get("date") in (None, planned)]
    if len(kept) < len(rows):
        work.doubts.append(Doubt("OTHER_DAYS", f"{len(rows) - len(kept)} rows of other days than "
                                 f"{planned.isoformat()} are left out.",
                                 values={"count": len(rows) - len(kept)}))
    return kept


def _asked_day(work: Import, rows: Sequence[Row], days: Sequence[date]) -> date | None:
    """Return which of several days is planned; None: nobody says. In place."""
    listed = ", ".join(found.isoformat() for found in days[:5])
    cell = next((row.cell("date") for row in rows if row.get("date") == days[1]), None)
    counts = {day: sum(row.get("date") == day for row in rows) for day in days}
    stated = work.style.day
    answer = work.asking.ask(Question(
        "day", "day", f"There are {len(days)} days ({listed}): which is planned?",
        {day.isoformat(): f"{day.isoformat()}, {counts[day]} rows" for day in days[:100]}, None,
        {"count": len(days), "days": listed}, cell=cell),
        stated.isoformat() if stated is not None and stated in days else None)
    if stated is None and answer is None:
        work.errors.append(CellError("SEVERAL_DAYS", f"There are {len(days)} days ({listed}): "
                                     "state the one that is planned.", cell,
                                     {"count": len(days)}))
    return stated or (None if answer is None else date.fromisoformat(answer))


def _days_of_clocks(work: Import) -> list[date]:
    """Return the days that times state, if there is no column of days: the first of them."""
    days: set[date] = set()
    for column in work.columns:
        if MEANINGS[column.meaning].kind in ("clock", "windows"):
            for _, raw in work.table.column(column.index):
                try:
                    day = read(raw, "date", None, work.style)
                except MisreadError:
                    continue
                days |= set() if day is None else {day}
    return sorted(day for day in days if day.year > 1900)[:1]


def _ground(work: Import, rows: Sequence[Row], settings: ImportSettings,
            finder: Finder) -> TableGeography:
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
            if addresses else ": say which hold latitude and longitude, or x and y."),
            {"case": "addresses" if addresses else "columns"})
    return ground


def _with_addresses(work: Import, rows: Sequence[Row], ground: TableGeography, finder: Finder,
                    keeps: bool) -> TableGeography:
    """Return a ground that knows where addresses are; note what is doubtful. In place."""
    located = locate(rows, ground, finder, keeps=keeps)
    work.doubts += located.doubts
    work.errors += located.errors
    work.looked_up = located.reply
    return replace(ground, found=located.places, unplaced=located.unplaced,
                   pending=located.pending)


def _note_amounts(work: Import, rows: Sequence[Row]) -> None:
    """Note where amounts are taken for granted. In place."""
    rows = [row for row in rows if not row.side and not is_alternative(row)]
    columns = [column for column in work.columns if column.meaning == "demand"]
    if not columns and not any(column.meaning == "pickup" for column in work.columns):
        work.doubts.append(Doubt("NO_AMOUNTS", "No column holds amounts: each customer counts 1."))
    for place, column in enumerate(columns):
        empty = [row for row in rows if row.get("demand")[place] is None and not any(
            error.cell == work.table.name(row.number, column.index) for error in row.errors)]
        if empty:
            name = work.table.name(empty[0].number, column.index)
            work.doubts.append(Doubt("EMPTY_AMOUNT", f"{len(empty)} cells of column {column.name} "
                                     f"are empty, such as {name}: they count 0.", letters(
                                         column.index), name, {"count": len(empty)}))
