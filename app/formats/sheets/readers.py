"""Cells by the meaning of their column -> values, and how values are shown."""

import re
from collections.abc import Callable
from typing import Any

from app.formats.sheets.cells import LONGEST_READ, MisreadError, Raw, clock_text, shown
from app.formats.sheets.clocks import Style, clock, duration, read_date, window_text, windows
from app.formats.sheets.headings import simple
from app.formats.sheets.links import is_link, place_of
from app.formats.sheets.meanings import Kind
from app.formats.sheets.numbers import ENTRIES, amount_of, number, number_of
from app.formats.sheets.words import CELL_WORDS, KIND_STEMS
from app.schemas.fields import MAX_INFO_LENGTH

Reader = Callable[[Raw, str | None, Style], Any]

YES, NO, DEPOTS = (frozenset(CELL_WORDS[name]) for name in ("yes", "no", "depots"))
NOTHING = frozenset((
    "-", "--", "\u2013", "\u2014", "n/a", "na", "none", "null", "k.a.", "?", "/", "."))
"""What stands in cells for nothing, where it can't be anything else."""

SIDES = ("N", "S", "E", "W")
PART_SIGNS = " ,;/"
"""What may stand between two coordinates, each with its side."""

DEPOT, CUSTOMER, DELIVERY, PICKUP = ORDER_KINDS = ("depot", "customer", "delivery", "pickup")

_DEGREES = re.compile(
    r"(?P<degrees>[-+]?\d{1,3})\s*+[°d]\s*+(?:(?P<minutes>\d{1,2}(?:[.,]\d++)?)\s*+['\u2032m]\s*+)?"
    r"(?:(?P<seconds>\d{1,2}(?:[.,]\d++)?)\s*+(?:[\"\u2033s]|'')\s*+)?")
_PAIRS = (re.compile(r"(?<!\d)(-?\d++,\d++)[\s;,/]++(-?\d++,\d++)"),
          re.compile(r"(?<!\d)(-?\d++\.\d++)\s++(-?\d++\.\d++)"))
"""Two numbers with decimal commas, or with a blank between."""
_NAMES = re.compile(r"[,;|]")
"""What stands between entries that may hold decimal commas."""


def _text(raw: Raw, unit: str | None, style: Style) -> str:
    text = shown(raw)
    if len(text) > MAX_INFO_LENGTH:
        raise MisreadError(f"The text has {len(text)} letters, and {MAX_INFO_LENGTH} are carried "
                           "along at most: shorten it")
    return text


def _number(raw: Raw, unit: str | None, style: Style) -> float:
    return number_of(raw, style.comma)


def _amount(raw: Raw, unit: str | None, style: Style) -> float:
    return amount_of(raw, style.comma, unit)


def _clock(raw: Raw, unit: str | None, style: Style) -> float:
    return clock(raw, unit or "clock", style)


def _windows(raw: Raw, unit: str | None, style: Style) -> Any:
    return windows(raw, unit or "clock", style)


def _duration(raw: Raw, unit: str | None, style: Style) -> float:
    return duration(raw, unit or "minutes", style)


def _names(raw: Raw, unit: str | None, style: Style) -> list[str]:
    return [name for part in _NAMES.split(shown(raw)) if (name := part.strip())]


def _prices(raw: Raw, unit: str | None, style: Style) -> list[tuple[str, float]]:
    """Return names, each with a price behind a colon."""
    found = []
    for part in filter(None, map(str.strip, ENTRIES.split(shown(raw)))):
        name, sign, price = part.rpartition(":")
        if not sign or not name.strip():
            raise MisreadError(f"{part!r} is no vehicle with a price: write one such as van-1: 5")
        found.append((name.strip(), number_of(price.strip(), style.comma)))
    return found


def _server(raw: Raw, unit: str | None, style: Style) -> str:
    """Return who may serve: a drone too where the cell says yes."""
    plain = simple(shown(raw))
    if plain in ("drone", "truck", "either"):
        return plain
    if plain in YES:
        return "either"
    if plain in NO:
        return "truck"
    raise MisreadError(f"{shown(raw)!r} is neither yes nor no: write one, or drone, truck, either")


def _side(raw: Raw, unit: str | None, style: Style) -> str:
    """Return how a place is reached: on its own side of the street where the cell says yes."""
    plain = simple(shown(raw))
    if plain in ("curb", "any"):
        return plain
    if plain in YES or plain in NO:
        return "curb" if plain in YES else "any"
    raise MisreadError(f"{shown(raw)!r} is neither yes nor no: write one, or curb, any")


def _degrees(raw: Raw, unit: str | None, style: Style) -> float:
    """Return degrees, of decimals or of minutes and seconds; south and west are below 0."""
    if isinstance(raw, float):
        return raw
    if not isinstance(raw, str):
        raise MisreadError(f"{shown(raw)!r} are no degrees")
    plain = raw.strip()
    side = next((sign for sign in (plain[:1].upper(), plain[-1:].upper()) if sign in SIDES), "")
    if side:
        plain = (plain[1:] if plain[:1].upper() == side else plain[:-1]).strip()
    sign = -1 if side in ("S", "W") else 1
    if found := _DEGREES.fullmatch(plain):
        parts = (float((found[name] or "0").replace(",", "."))
                 for name in ("degrees", "minutes", "seconds"))
        degrees, minutes, seconds = parts
        size = abs(degrees) + minutes / 60 + seconds / 3600
        return sign * (-size if plain.startswith("-") else size)
    if plain.count(".") > 1 or plain.count(",") > 1:
        raise MisreadError(f"{raw!r} has lost its decimal point: degrees have up to three digits "
                           "before it")
    # Degrees have no thousands: whatever stands in them is before decimals.
    return sign * number(plain.rstrip("°").replace(",", "."), comma=False)


def _point(raw: Raw, unit: str | None, style: Style) -> tuple[float, float]:
    """Return the two numbers of a place in one cell, in their order."""
    # GeoJSON and WKT put the longitude first.
    turned = shown(raw).startswith(("[", "POINT"))
    text = shown(raw).removeprefix("POINT").strip("()[] ")
    pair = place_of(text) if is_link(text) else _two_numbers(text)
    if pair is None and is_link(text):
        raise MisreadError(f"{text[:80]!r} has no coordinates: open it and copy the longer address "
                           "of the map, or write latitude and longitude")
    if pair is None:
        raise MisreadError(f"{text!r} is no place: write latitude and longitude such as "
                           "48.137, 11.575")
    turned = turned or pair[0][-1:].upper() in ("E", "W") or pair[0][:1].upper() in ("E", "W")
    first, second = (_degrees(part, None, style) for part in pair)
    return (second, first) if turned else (first, second)


def _two_numbers(text: str) -> tuple[str, str] | None:
    """Return the texts of the two numbers of a place."""
    if found := _PAIRS[0].fullmatch(text):
        return found[1], found[2]
    upper = text.upper()
    for sides, others in (("NS", "EW"), ("EW", "NS")):
        # The side stands behind its number, or before it: N 48.1 E 11.5.
        if upper[:1] in sides and (place := _first_of(upper, others)) > 0:
            return text[:place].strip(PART_SIGNS), text[place:]
        if upper[-1:] in others and 0 < (place := _first_of(upper, sides)) < len(text) - 1:
            return text[:place + 1], text[place + 1:].strip(PART_SIGNS)
    for sign in ";,/":
        parts = [part.strip() for part in text.split(sign)]
        if len(parts) == 2 and all(parts):
            return parts[0], parts[1]
    found = _PAIRS[1].fullmatch(text)
    return (found[1], found[2]) if found else None


def _first_of(text: str, signs: str) -> int:
    """Return where the first of some signs stands; -1: none does."""
    return min((place for sign in signs if (place := text.find(sign)) >= 0), default=-1)


def _date(raw: Raw, unit: str | None, style: Style) -> Any:
    return read_date(raw, style)


def ticked_kind(value: Any, heading: str) -> Any:
    """Return the kind of order of a row; a column of ticks is about what it is named after."""
    text = simple(str(value))
    named = _kind(heading, None, Style())
    if text not in YES | NO or named not in (PICKUP, DELIVERY):
        return value
    other = DELIVERY if named == PICKUP else PICKUP
    return named if text in YES else other


def _kind(raw: Raw, unit: str | None, style: Style) -> str:
    """Return what a row is; what no language here calls so as it is written."""
    words = simple(shown(raw)).split()
    if " ".join(words) in DEPOTS:
        return DEPOT
    for kind, known in KIND_STEMS.items():
        if any(word.startswith(tuple(known)) for word in words[:3]):
            return kind
    return shown(raw)


READERS: dict[Kind, Reader] = {
    "text": _text, "number": _number, "amount": _amount, "clock": _clock, "windows": _windows,
    "duration": _duration, "names": _names, "server": _server, "side": _side, "degrees": _degrees,
    "point": _point, "date": _date, "kind": _kind, "prices": _prices,
}


def read(raw: Raw, kind: Kind, unit: str | None, style: Style) -> Any:
    """Return what a cell says; None if it says nothing.

    Raises
    ------
    MisreadError
        If it doesn't say what its column means.
    """
    if raw is None or (kind != "text" and isinstance(raw, str) and raw.lower() in NOTHING):
        return None
    if kind != "text" and isinstance(raw, str) and len(raw) > LONGEST_READ:
        raise MisreadError(f"The cell has {len(raw)} letters, and no more than {LONGEST_READ} are "
                           "read as anything but words")
    return READERS[kind](raw, unit, style)


def reading_text(value: Any, kind: Kind, unit: str | None) -> str:
    """Return a value as people are shown what was read."""
    match kind:
        case _ if value is None:
            return "nothing"
        case "clock":
            return clock_text(value)
        case "windows":
            return ", ".join(map(window_text, value))
        case "duration":
            whole, rest = divmod(value, 60)
            return f"{whole:.0f} min {rest:g} s" if rest else f"{whole:.0f} min"
        case "amount":
            return f"{value:.10g} {unit or ''}".strip()
        case "number":
            return f"{value:.10g}"
        case "degrees":
            return f"{value:.7g}\u00b0"
        case "point":
            return ", ".join(f"{number:.7g}\u00b0" for number in value)
        case "names":
            return ", ".join(value)
        case "prices":
            return ", ".join(f"{name}: {price:.10g}" for name, price in value)
        case "server":
            return {"either": "by drone or truck", "truck": "by truck alone",
                    "drone": "by drone alone"}[value]
        case "side":
            return {"curb": "on its own side", "any": "from either side"}[value]
        case _:
            return str(value)
