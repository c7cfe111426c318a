"""Which unit the bare numbers of a column are in, by how they look together."""

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from app.formats.sheets.cells import MisreadError, Raw, shown
from app.formats.sheets.clocks import SERIALS, look
from app.formats.sheets.numbers import number, own_unit

_BARE = re.compile(r"\d++(?:[.,]\d++)?")
_MILITARY = re.compile(r"0\d{3}")
_TWO_DECIMALS = re.compile(r"\d{1,2}[.,]\d{2}")

QUARTERS = {25, 50, 75}
"""Hundredths of an hour that people write as decimals."""

MIDNIGHT = 1440
"""Of the day's end, in minutes."""

LAST_HOUR, LAST_MINUTE, LAST_SECOND = 24, 2880, 172_800
FEW = 4
"""Values from which on their look together tells enough."""


class UnitGuess(NamedTuple):
    """A unit, and what makes it doubtful, if anything does."""

    unit: str | None
    doubt: str | None = None


def clock_unit(cells: Sequence[Raw], stated: str | None) -> UnitGuess:
    """Return how bare numbers of a column with times of day are meant."""
    bare = _bare_cells(cells)
    if stated in ("minutes", "seconds", "hhmm"):
        return UnitGuess(stated)
    if not bare:
        return UnitGuess("clock")
    values = [_value(raw) for raw in bare]
    if all(SERIALS[0] <= value < SERIALS[1] for value in values):
        return UnitGuess("days", "numbers such as these are dates with times")
    looks = {look(shown(raw)) for raw, value in zip(bare, values, strict=True) if value}
    if len(looks) > 1 and None not in looks and "hhmm" in looks:
        return UnitGuess("clock", "its numbers are written in several ways, each is read by its "
                         "look")
    if all(value == int(value) for value in values):
        return UnitGuess("hours") if stated == "hours" else _whole_clock_unit(bare, values)
    if max(values) <= 1:
        return UnitGuess("days")
    if max(values) > LAST_HOUR:
        return UnitGuess("minutes", "numbers with decimals that are too large for hours may be "
                         "minutes")
    return _fraction_unit(bare, values)


def are_instants(cells: Sequence[Raw]) -> bool:
    """Tell whether numbers are days since 1900, with times, as spreadsheets hold them."""
    values = [_value(raw) for raw in _bare_cells(cells)]
    return (bool(values) and all(SERIALS[0] <= value < SERIALS[1] for value in values)
            and any(value % 1 for value in values))


def _whole_clock_unit(bare: Sequence[Raw], values: Sequence[float]) -> UnitGuess:
    most = max(values)
    if most <= LAST_HOUR:
        return UnitGuess("hours")
    if most == MIDNIGHT:
        return UnitGuess("minutes", "1440 may be 24:00 in minutes, or 14:40")
    distinct = set(values)
    if any(isinstance(raw, str) and _MILITARY.fullmatch(raw) for raw in bare):
        return UnitGuess("hhmm")
    if most <= 2400 and all(value % 100 < 60 for value in distinct):
        sure = len(distinct) >= FEW or most > 1440
        return UnitGuess("hhmm", None if sure else "800 may be 8:00, or 800 minutes after midnight")
    if most <= LAST_MINUTE:
        return UnitGuess("minutes", "these may be minutes or seconds after midnight")
    return UnitGuess("seconds", None if most <= LAST_SECOND else "numbers as large as these are no "
                     "time of one day")


def _fraction_unit(bare: Sequence[Raw], values: Sequence[float]) -> UnitGuess:
    """Return whether 8.30 is 8:30 or a bit over a quarter past eight."""
    hundredths = {round(value % 1 * 100) for value in values} - {0}
    if any(part >= 60 for part in hundredths):
        return UnitGuess("hours")
    written = [raw for raw in bare if isinstance(raw, str)]
    shows_two = bool(written) and all(_TWO_DECIMALS.fullmatch(raw) or raw.isdigit()
                                      for raw in written)
    if hundredths <= QUARTERS and not shows_two:
        return UnitGuess("hours", "8.5 may be 8:30, or 8:50")
    open_to_doubt = hundredths <= QUARTERS or not shows_two
    return UnitGuess("h.mm", "8.30 may be 8:30, or 8.3 hours" if open_to_doubt else None)


def duration_unit(cells: Sequence[Raw], stated: str | None) -> UnitGuess:
    """Return the unit of bare numbers in a column with lengths of time."""
    bare = _bare_cells(cells)
    if stated in ("minutes", "seconds", "hours"):
        return UnitGuess(stated)
    if not bare:
        return UnitGuess("minutes")
    values = [_value(raw) for raw in bare]
    most, least = max(values), min(value for value in values if value or not any(values))
    if most < 0.1 and most > 0:
        return UnitGuess("days")
    if any(value != int(value) for value in values) and most <= 3:
        return UnitGuess("hours", "no unit is stated: these may be hours or minutes")
    if least >= 60 and most >= 240 and all(value % 30 == 0 for value in values):
        return UnitGuess("seconds", "no unit is stated: these may be seconds or minutes")
    return UnitGuess("minutes", "no unit is stated: these may be minutes or seconds")


def amount_unit(cells: Iterable[Raw], stated: str | None) -> UnitGuess:
    """Return the unit of a column's amounts: as stated, or as most of its cells say."""
    if stated:
        return UnitGuess(stated)
    own = [unit for raw in cells if (unit := own_unit(raw))]
    return UnitGuess(max(set(own), key=own.count) if own else None)


def _bare_cells(cells: Iterable[Raw]) -> list[Raw]:
    return [raw for raw in cells if (isinstance(raw, float) and not isinstance(raw, bool))
            or (isinstance(raw, str) and _BARE.fullmatch(raw))]


def _value(raw: Raw) -> float:
    try:
        return number(raw, "," in raw) if isinstance(raw, str) else float(raw)  # type: ignore[arg-type]
    except MisreadError:
        return 0.0
