"""A sheet that lists vehicles -> their names, capacities, shifts and costs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import Any

from app.formats.sheets.cells import Doubt, MisreadError, Raw, letters, shown
from app.formats.sheets.clocks import Style
from app.formats.sheets.headings import simple, unit_named, without_unit
from app.formats.sheets.layout import SEARCHED_ROWS, Table, table_of
from app.formats.sheets.meanings import DURATION_UNITS, FAMILIES, Kind
from app.formats.sheets.numbers import own_unit
from app.formats.sheets.readers import read
from app.formats.sheets.table import Sheet
from app.formats.sheets.units import clock_unit, duration_unit
from app.formats.sheets.words import BEGIN, END, VAN_HEADINGS, meant

KINDS: dict[str, Kind] = {
    "name": "text", "driver": "text", "count": "number", "capacity": "amount", "earliest": "clock",
    "latest": "clock", "window": "windows", "speed": "number", "per_km": "number",
    "per_hour": "number", "fixed": "number", "max_trips": "number", "skills": "names",
    "break": "windows", "break_from": "clock", "break_to": "clock",
    "break_duration": "duration", "break_within": "duration",
    "break_paid": "text", "break_anywhere": "text", "break_max_load": "amount",
    "max_work": "duration", "max_travel": "duration", "driving_rules": "text",
    "max_driving": "duration", "max_work_before_break": "duration",
    "max_driving_per_day": "duration", "rest": "duration", "rest_split": "text",
    "crew": "text",
    "driven_before": "duration", "worked_before": "duration", "lifo": "text"}
"""What is read; of drones nothing is made, though a number of them is none of vehicles."""

MEANINGS = meant(VAN_HEADINGS)

REPEATED = ("capacity", "break", "break_from", "break_to", "break_duration")
"""Meanings of several columns."""

IN_HOURS = ("max_work", "max_travel", "break_within", "max_driving", "max_work_before_break",
            "max_driving_per_day", "driven_before", "worked_before")
"""What lengths of time are in where neither heading nor cells say so."""

LENGTHS = frozenset(("dauer", "lange", "duration", "length", "duree", "duracion", "durata", "duur",
                     "minutes", "minuten"))
"""Words by which a heading of a numbered break is about its length."""

LONGEST_BREAK = 4 * 3600.0
"""From here on, a time under *break* is when it begins."""

ENDS = {word: end for end, listed in enumerate((BEGIN, END))
        for words in listed.values() for word in words}
"""Words by which a heading is about a begin (0) or an end (1), before or behind others."""

OF_ENDS = {"window": ("earliest", "latest"), "break": ("break_from", "break_to")}

MOST_VANS = 1000


@dataclass
class Van:
    """A row of a sheet with vehicles."""

    name: str = ""
    capacities: list[tuple[str, str | None, float]] = field(default_factory=list)
    values: dict[str, float] = field(default_factory=dict)
    shift: tuple[float | None, float | None] | None = None
    skills: list[str] = field(default_factory=list)
    driver: str = ""
    breaks: list[list[tuple[float | None, float | None]] | None] = field(default_factory=list)
    break_durations: list[float | None] = field(default_factory=list)
    texts: dict[str, str] = field(default_factory=dict)
    cells: dict[str, str] = field(default_factory=dict)  # of texts


def lists_vans(sheet: Sheet) -> bool:
    """Tell whether a sheet lists vehicles: they have names, and hold or work for how long."""
    table = _table_of(sheet)
    if not table.header_rows or len(table.rows) > MOST_VANS:
        return False
    meant = {_meaning_of(heading) for heading in table.headings}
    heads = {simple(heading) for heading in table.headings}
    is_customers = heads & {"lat", "latitude", "breite", "adresse", "address", "kunde", "customer",
                            "client", "adresse de livraison", "plz", "postcode", "strasse"}
    return bool({"name", "driver", "crew"} & meant and meant & {"capacity", "window", "earliest"}
                and not is_customers)


def vans_of(sheet: Sheet, style: Style) -> tuple[list[Van], list[Doubt]]:
    """Return the vehicles of a sheet, and what of it isn't used."""
    table = _table_of(sheet)
    meant = _columns(table)
    units = {column: _unit_in(table, column, meaning) for column, meaning in meant.items()}
    vans = [van for row in table.rows[:MOST_VANS]
            if (van := _van(table, row, meant, units, style)) is not None]
    unused = [heading or letters(column) for column, heading in enumerate(table.headings)
              if column not in meant and table.column(column)]
    doubts = [Doubt("FLEET_IN_FILE", f"The sheet {sheet.name} is read as the vehicles: "
                    f"{len(vans)} rows.",
                    values={"sheet": sheet.name, "count": len(vans)})]
    if unused:
        doubts.append(Doubt("FLEET_UNUSED", f"Of the sheet {sheet.name} nothing is made of "
                            f"{', '.join(unused[:10])}.",
                            values={"sheet": sheet.name, "names": unused[:10]}))
    return vans, doubts


def _table_of(sheet: Sheet) -> Table:
    """Return a sheet's headings and rows; `Break 1` is a heading among those of vehicles."""
    table = table_of(sheet)
    if table.header_rows:
        return table
    known = {number: len({_meaning_of(raw) for raw in row if isinstance(raw, str)} - {None})
             for number, row in enumerate(sheet.rows[:SEARCHED_ROWS])}
    best = max(known, key=lambda number: known[number], default=-1)
    return table_of(sheet, best) if known.get(best, 0) > 1 else table


def _meaning_of(heading: str) -> str | None:
    """Return what a heading says of vehicles; a unit in brackets doesn't count."""
    words = simple(without_unit(heading)).split()
    if len(words) > 1 and unit_named(words[-1]) and " ".join(words) not in MEANINGS:
        words = words[:-1]
    if (whole := _known(words)) is None and len(words) > 1 and words[-1].isdecimal():
        words = words[:-1]
    if " ".join(words) in MEANINGS or len(words) < 2:
        return whole or _known(words)
    for word, rest in ((words[-1], words[:-1]), (words[0], words[1:])):
        if word in ENDS and (own := _known(rest)) in OF_ENDS:
            return OF_ENDS[own][ENDS[word]]
    return whole or _known(words)


def _known(words: Sequence[str]) -> str | None:
    """Return what words mean: all of them, or the longest phrase among them."""
    whole = " ".join(words)
    if whole in MEANINGS:
        return MEANINGS[whole]
    found = [(len(phrase), meaning) for phrase, meaning in MEANINGS.items()
             if len(phrase) > 3 and f" {phrase} " in f" {whole} "]
    return max(found)[1] if found else None


def _unit_in(table: Table, column: int, meaning: str) -> str | None:
    """Return what bare numbers of times in a column are in; None: it has none."""
    cells = [raw for _, raw in table.column(column)]
    if KINDS[meaning] == "clock":
        return clock_unit(cells, None).unit
    if KINDS[meaning] != "duration":
        return None
    stated = _unit_of(table.headings[column], None)
    return duration_unit(cells, stated or ("hours" if meaning in IN_HOURS else None)).unit


def _columns(table: Table) -> dict[int, str]:
    """Return what columns mean; most stand once."""
    meant: dict[int, str] = {}
    for column, heading in enumerate(table.headings):
        meaning = _meaning_of(heading)
        if meaning == "break" and (_unit_of(heading, None) in DURATION_UNITS
                                   or LENGTHS & set(simple(heading).split())
                                   or _are_lengths(table, column)):
            meaning = "break_duration"
        if meaning in KINDS and (meaning in REPEATED or meaning not in meant.values()):
            meant[column] = meaning
    if not {"name", "driver"} & set(meant.values()):  # crews are the vehicles' names
        return {column: "name" if meaning == "crew" else meaning
                for column, meaning in meant.items()}
    return meant


def _are_lengths(table: Table, column: int) -> bool:
    """Tell whether breaks are stated by their length alone, such as `30 min`."""
    cells = [raw for _, raw in table.column(column)]
    unit = duration_unit(cells, None).unit
    try:
        lengths = [read(raw, "duration", unit, Style()) for raw in cells]
    except MisreadError:
        return False
    return bool(lengths) and max(lengths) < LONGEST_BREAK


def _van(table: Table, row: int, meant: Mapping[int, str], units: Mapping[int, str | None],
         style: Style) -> Van | None:
    """Return the vehicle of a row; None: there is none, or no name and no capacity."""
    van = Van()
    ends: dict[str, float] = {}
    pauses: tuple[list[float | None], list[float | None]] = [], []
    for column, meaning in meant.items():
        value = _value(table, row, column, KINDS[meaning], units.get(column), style)
        if meaning == "break":
            van.breaks.append(value)
        elif meaning == "break_duration":
            van.break_durations.append(value)
        elif meaning in OF_ENDS["break"]:
            pauses[OF_ENDS["break"].index(meaning)].append(value)
        elif value is None:
            continue
        elif meaning in ("name", "driver"):
            van.name = str(value) if meaning == "name" or not van.name else van.name
            van.driver = str(value) if meaning == "driver" else van.driver
        elif meaning == "capacity":
            heading = table.headings[column]
            van.capacities.append((heading, _unit_of(heading, table.cell(row, column)), value))
        elif meaning == "window":
            van.shift = value[0]
        elif meaning in ("earliest", "latest"):
            ends[meaning] = value
        elif meaning == "skills":
            van.skills = value
        elif KINDS[meaning] == "text":
            van.texts[meaning] = value
            van.cells[meaning] = f"{table.sheet.name}!{table.name(row, column)}"
        else:
            van.values[meaning] = value
    van.breaks += [[pause] if any(end is not None for end in pause) else None
                   for pause in zip_longest(*pauses)]
    if ends:
        van.shift = ends.get("earliest"), ends.get("latest")
    is_there = van.values.get("count") != 0
    return van if is_there and (van.name or van.capacities) else None


def _value(table: Table, row: int, column: int, kind: Kind, unit: str | None,
           style: Style) -> Any:
    try:
        return read(table.cell(row, column), kind, unit, style)
    except MisreadError as error:
        cell = f"{table.sheet.name}!{table.name(row, column)}"
        value = shown(table.cell(row, column))[:40]
        raise MisreadError(f"{cell}: {error}", cell, value) from error


def _unit_of(heading: str, raw: Raw) -> str | None:
    if unit := own_unit(raw):
        return unit
    words = simple(heading).split()
    return next((unit for word in reversed(words) if (unit := unit_named(word))), None)


def factor_between(unit: str | None, other: str | None) -> float | None:
    """Return how many of another unit one is; None: they are not of one kind."""
    if unit == other:
        return 1.0
    return next((family[unit] / family[other] for family in FAMILIES
                 if unit in family and other in family), None)
