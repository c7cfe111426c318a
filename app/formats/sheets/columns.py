"""What the columns of a table mean, by their headings and what stands below."""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, time

from app.formats.sheets.cells import Doubt, MisreadError, Raw, letters, shown
from app.formats.sheets.clocks import Style
from app.formats.sheets.headings import HEADING, guesses, simple
from app.formats.sheets.layout import Table
from app.formats.sheets.links import is_link, place_of
from app.formats.sheets.meanings import MEANINGS, MONEY, PAIRS, PLACES, meaning_at
from app.formats.sheets.numbers import own_unit
from app.formats.sheets.readers import NO, ORDER_KINDS, YES, read, ticked_kind
from app.formats.sheets.schemas import ColumnMapping
from app.formats.sheets.sides import DELIVERY, OWN, Side, guesses_at, sides_of
from app.formats.sheets.states import CANCELLED, DONE, STATES
from app.formats.sheets.units import (
    UnitGuess, amount_unit, are_instants, clock_unit, duration_unit,
)

SAMPLED = 300
"""Cells of a column from which its meaning is guessed."""

LEAST_FIT = 0.3
"""Share of a column's cells that must say what its heading says, else it is not that."""

GUESSED = 0.99
"""Most confidence in a meaning that is not stated."""

MOST = 0.7
"""Share of a column's cells that must look like something for the column to be taken for it."""

FETCHED = {meaning_at("pickup", part) for part in ("latitude", "point", "x", "address")}
"""Columns of which one tells that goods are fetched elsewhere."""

BY_CONTENT = 0.5
"""Most confidence in a meaning that no heading states."""

_EMAIL = re.compile(r"(?<![^@\s])[^@\s]++@[^@\s.]++(?:\.[^@\s.]++)++")
_POINT = re.compile(r"(?:POINT ?)?[(\[]?\s?-?\d{1,3}\.\d{2,}+[\s,;]++-?\d{1,3}\.\d{2,}+\s?[)\]]?"
                    r"|\d{1,3}(?:\.\d++)?\s?°[^A-Z]{0,20}[NS][\s,;/]*+\d{1,3}(?:\.\d++)?\s?°"
                    r"[^A-Z]{0,20}[EW]")
_PHONE = re.compile(r"(\+|00?)[\d ()/.-]{6,}")
_CLOCK = re.compile(r"\d{1,2}[:h]\d{2}(:\d{2})?(\s*+[ap]\.?m\.?)?", re.IGNORECASE)
_WINDOW = re.compile(r"\d{1,2}([:.h]\d{2})?\s*+([ap]m|uhr|h)?\s*+(-|\u2013|to|bis)\s*+\d{1,2}"
                     r"([:.h]\d{2})?.*+", re.IGNORECASE)
_AGAIN = re.compile(r"[2-8]\b|afternoon|nachmittag|apres midi|evening|abend|\bpm\b")


@dataclass(frozen=True)
class Column:
    """A column and what it is taken for."""

    index: int
    heading: str
    meaning: str = "ignored"
    unit: str | None = None
    confidence: float = 0.0  # 0 to 1; 1 where it was stated
    doubts: tuple[Doubt, ...] = ()
    language: str = "en"

    @property
    def name(self) -> str:
        """Letters, such as `C`, and the heading."""
        return f"{letters(self.index)} ({self.heading})" if self.heading else letters(self.index)


def columns_of(table: Table, style: Style, mapping: Sequence[ColumnMapping]) -> list[Column]:
    """Return the columns that hold anything, each with its meaning.

    Parameters
    ----------
    mapping
        Columns whose meaning is stated.
    """
    stated = _stated(table, mapping)
    found: dict[int, Column] = {
        index: _with_unit(table, Column(index, table.headings[index], entry.meaning, entry.unit,
                                        1.0, language=_language(table.headings[index])))
        for index, entry in stated.items()}
    points = [_share(_samples(table, index), _is_point) > MOST
              for index in range(len(table.headings))]
    options = [option for index, side in enumerate(sides_of(table.headings, points))
               if index not in stated for option in _options(table, index, style, side)]
    taken = {column.meaning for column in found.values()}
    spoken = language_of(options)
    # `van` is a vehicle in English, and where a window begins in Dutch.
    for column in sorted(options, key=lambda option: (-option.confidence,
                                                      option.language != spoken)):
        if column.index in found:
            continue
        if column.meaning in taken and not _may_repeat(column):
            continue
        taken.add(column.meaning)
        found[column.index] = column
    _align_windows(table, found)
    _doubt_ends(table, found)
    for index, heading in enumerate(table.headings):
        if index not in found and (heading or table.column(index)):
            found[index] = Column(index, heading, doubts=_unfit(table, index))
    return [found[index] for index in sorted(found)]


def _align_windows(table: Table, columns: dict[int, Column]) -> None:
    """Have begins and ends of windows in one unit, that of all their numbers. In place."""
    ends = [column for column in columns.values()
            if column.meaning in ("earliest", "latest") and column.confidence < 1
            and not any(guess.unit for guess in guesses(column.heading)[:1])]
    guess = clock_unit([raw for column in ends for _, raw in table.column(column.index)], None)
    for column in ends:
        alone = clock_unit([raw for _, raw in table.column(column.index)], None)
        if alone.unit not in ("clock", guess.unit):
            bare = replace(column, unit=guess.unit, doubts=())
            columns[column.index] = replace(bare, doubts=_unit_doubts(bare, guess))


def _doubt_ends(table: Table, columns: dict[int, Column]) -> None:
    """Doubt when a stop may begin where two places may be meant, and half a pair. In place."""
    meanings = {column.meaning for column in columns.values()}
    are_fetched = any(len(table.column(index)) > len(table.rows) / 2
                      for index, column in columns.items() if column.meaning in FETCHED)
    for index, column in columns.items():
        if column.confidence == 1:
            continue
        others = PAIRS.get(column.meaning)
        lacks = (others is not None and MEANINGS[column.meaning].kind in ("degrees", "number")
                 and others not in meanings)
        if lacks or (column.meaning in ("earliest", "window") and are_fetched):
            code, told = ("HALF_PAIR", f"no column is its {others}") if lacks else (
                "WHICH_END", "it doesn't say of which of the two places it is")
            columns[index] = replace(column, doubts=(*column.doubts, Doubt(
                code, f"Column {column.name}: {told}.", letters(index))))


def _may_repeat(column: Column) -> bool:
    """Tell whether a column may mean what another one means: of windows, those with a number."""
    repeats = MEANINGS[column.meaning].repeats
    if MEANINGS[column.meaning].kind in ("clock", "windows"):
        return repeats and _AGAIN.search(simple(column.heading)) is not None
    return repeats


def with_begin(columns: Sequence[Column]) -> tuple[list[Column], list[Doubt]]:
    """Return columns of which one begins windows, if another ends them.

    Some call `ready time` when the customer is, not the parcel; where parcels are fetched, it is
    theirs.
    """
    meanings = {column.meaning for column in columns}
    if any(meaning_at("pickup", part) in meanings for place in PLACES for part in place) or (
            meaning_at("pickup", "address") in meanings):
        return list(columns), []
    if not {"ready", "latest"} <= meanings or meanings & {"earliest", "window"}:
        return list(columns), []
    changed = [replace(column, meaning="earliest")
               if column.meaning == "ready" and column.confidence < 1 else column
               for column in columns]
    return changed, [Doubt("READY_IS_BEGIN", f"Column {column.name} is taken for when windows "
                           "begin, as none else is: it may be when parcels are there.",
                           letters(column.index))
                     for column, before in zip(changed, columns, strict=True) if column != before]


def _stated(table: Table, mapping: Sequence[ColumnMapping]) -> dict[int, ColumnMapping]:
    """Return the columns that a mapping is about; those of one heading in their order."""
    left = list(mapping)
    found = {}
    for index, heading in enumerate(table.headings):
        repeats = table.headings.count(heading) > 1
        same = next((entry for entry in left if _matches(entry, heading, index, repeats)), None)
        if same is not None:
            left.remove(same)
            found[index] = same
    return found


def _matches(entry: ColumnMapping, heading: str, index: int, repeats: bool) -> bool:
    if not entry.heading and not heading:
        return entry.column == letters(index)
    if repeats and entry.column not in (None, letters(index)):
        return False
    return simple(entry.heading) == simple(heading) and bool(heading)


def _options(table: Table, index: int, style: Style, side: Side) -> Iterable[Column]:
    """Yield what a column may mean, with the confidence that it does."""
    cells, named = _samples(table, index), set()
    heading, are_points = table.headings[index], _share(cells, _is_point) > MOST
    for guess in guesses_at(heading, side)[:6]:
        if are_points and guess.score >= HEADING and guess.meaning.endswith("address"):
            named.add(guess.meaning.removesuffix("address") + "point")
        # Coordinates are words as well: of a second place, that would go unasked.
        if guess.score >= HEADING and not (are_points and guess.meaning.endswith("address")):
            column = _with_unit(table, Column(index, heading, guess.meaning, guess.unit,
                                              language=guess.language))
            fit = _fit(cells, column, style) if cells else 0.5
            if fit >= LEAST_FIT:
                confidence = GUESSED * guess.score * (0.5 + 0.5 * fit)
                named.add(guess.meaning)
                yield replace(column, confidence=round(confidence, 3))
                # Two columns with names: one of them is a number for the driver.
                if guess.meaning == "name":
                    yield Column(index, heading, "order", None, round(guess.score * 0.6, 3),
                                 language=guess.language)
    for column in _by_content(table, index, cells):
        meaning = column.meaning if side.name in (OWN, DELIVERY) else (
            meaning_at(side.name, column.meaning))
        if meaning in named:
            yield replace(column, meaning=meaning, doubts=())
        elif meaning in MEANINGS:
            yield replace(column, meaning=meaning)


def _by_content(table: Table, index: int, cells: Sequence[Raw]) -> Iterable[Column]:
    """Yield what the cells of a column look like, whatever its heading is."""
    heading = table.headings[index]
    looks: tuple[tuple[str, Callable[[str], object], float], ...] = (
        ("point", _is_point, 1.0),
        ("email", _EMAIL.fullmatch, BY_CONTENT), ("window", _WINDOW.fullmatch, BY_CONTENT),
        ("phone", _PHONE.fullmatch, BY_CONTENT))
    for meaning, fits, sure in looks:
        share = _share(cells, fits)
        if share > MOST:
            doubt = Doubt("MEANING_BY_CONTENT", f"Column {letters(index)} is taken for "
                          f"{MEANINGS[meaning].title.lower()} by its cells alone.", letters(index),
                          values={"meaning": meaning})
            yield _with_unit(table, Column(index, heading, meaning, None,
                                           min(sure * share, 0.995), (doubt,)))


def _samples(table: Table, index: int) -> list[Raw]:
    return [raw for _, raw in table.column(index)][:SAMPLED]


def _share(cells: Sequence[Raw], fits: Callable[[str], object]) -> float:
    """Return the share of cells that are texts which fit."""
    return sum(isinstance(raw, str) and bool(fits(raw)) for raw in cells) / max(len(cells), 1)


def _is_point(text: str) -> bool:
    """Tell whether a text is a place: two numbers, or a link to a map."""
    return _POINT.fullmatch(text) is not None or (is_link(text) and place_of(text) is not None)


def _with_unit(table: Table, column: Column) -> Column:
    """Return a column with the unit of its bare numbers, and what makes that doubtful."""
    kind = MEANINGS[column.meaning].kind
    if column.confidence == 1 and column.unit:
        return column
    cells = [raw for _, raw in table.column(column.index)]
    guess = UnitGuess(None)
    if kind == "clock":
        guess = clock_unit(cells, column.unit)
    elif kind == "windows":
        bare = clock_unit(cells, column.unit)
        guess = bare if bare.unit != "clock" and column.unit else UnitGuess("clock")
    elif kind == "duration":
        guess = duration_unit(cells, column.unit)
    elif kind == "amount":
        guess = amount_unit(cells, column.unit)
    elif column.meaning in ("x", "y"):
        guess = UnitGuess(column.unit or "m")
    return replace(column, unit=guess.unit, doubts=column.doubts + _unit_doubts(column, guess))


def _unit_doubts(column: Column, guess: UnitGuess) -> tuple[Doubt, ...]:
    if guess.doubt is None:
        return ()
    return (Doubt("UNIT_GUESSED", f"Column {column.name} is read in {guess.unit}: {guess.doubt}.",
                  letters(column.index), values={"unit": guess.unit or ""}),)


def _fit(cells: Sequence[Raw], column: Column, style: Style) -> float:
    """Return the share of cells that say what the column is taken for."""
    kind = MEANINGS[column.meaning].kind
    if column.meaning == "name":
        return 0.7 + (0.2 * sum(any(map(str.isalpha, shown(raw))) for raw in cells)
                      + 0.1 * len(set(map(shown, cells)))) / len(cells)
    if column.meaning.endswith("phone"):
        return sum(any(map(str.isdigit, shown(raw))) for raw in cells) / len(cells)
    if column.meaning in ("status", "region"):
        return _fit_words(cells, column.meaning, column.heading)
    if kind == "text":
        return 1.0
    if kind == "kind":
        return sum(ticked_kind(read(raw, kind, None, style), column.heading) in ORDER_KINDS
                   for raw in cells) / len(cells)
    if kind == "amount" and (units := {unit for raw in cells if (unit := own_unit(raw))}):
        return 0.0 if MONEY in units else 1.0
    if kind == "amount" and column.unit is None and are_instants(cells):
        return 0.0
    if kind == "names" and (are_instants(cells) or all(map(_is_moment, cells))):
        return 0.0  # before which time, not whom
    said = 0.0
    for raw in cells:
        try:
            value = read(raw, kind, column.unit, style)
            said += column.meaning not in ("latitude", "longitude") or abs(value) <= 180
            if kind == "date" and _says_clock(raw):
                said -= 0.5  # `Fecha` is a date in Spanish, and closes in Portuguese
        except (MisreadError, TypeError):
            continue
    return said / len(cells)


def _is_moment(raw: Raw) -> bool:
    """Tell whether a cell is a time, with a date or without, and so no name."""
    if isinstance(raw, str):
        return raw[:1].isdigit() and _CLOCK.search(raw) is not None
    return isinstance(raw, (time, datetime)) or (isinstance(raw, float) and raw < 1)


def _says_clock(raw: Raw) -> bool:
    """Tell whether a cell states a time of day."""
    if isinstance(raw, datetime):
        return raw.time() != time()
    return isinstance(raw, time) or (isinstance(raw, str) and ":" in raw)


def _fit_words(cells: Sequence[Raw], meaning: str, heading: str) -> float:
    """Return whether cells are states of an order, or of a country: `State` may be either."""
    told = {simple(shown(raw)) for raw in cells}
    words = {word for text in told for word in text.split()}
    is_status = bool(words & STATES) or (told <= YES | NO and bool(set(simple(heading).split())
                                                                  & (CANCELLED | DONE)))
    if meaning == "region":
        return 0.0 if is_status else 0.9
    if is_status:
        return 1.0
    return 0.0 if any(guess.meaning == "region" and guess.score > HEADING
                      for guess in guesses(heading)) else 0.5


def _unfit(table: Table, index: int) -> tuple[Doubt, ...]:
    """Return the doubt about a column whose cells don't say what its heading does."""
    heading = table.headings[index]
    likely = next((guess for guess in guesses(heading) if guess.score >= HEADING), None)
    cells = table.column(index)
    if likely is None or not cells:
        return ()
    row, raw = cells[0]
    title = MEANINGS[likely.meaning].title.lower()
    return (Doubt("NOT_USED", f"Column {letters(index)} ({heading}) is not used: by its heading it "
                  f"is {title}, which another column is already, or its cells don't say it "
                  f"({table.name(row, index)} is {shown(raw)[:40]!r}).", letters(index),
                  table.name(row, index), {"meaning": likely.meaning, "value": shown(raw)[:40]}),)


def _language(heading: str) -> str:
    found = guesses(heading)
    return found[0].language if found else "en"


def language_of(columns: Sequence[Column]) -> str:
    """Return the language that most headings are in."""
    known = Counter(column.language for column in columns if column.meaning != "ignored")
    return max(known, key=lambda language: known[language], default="en")
