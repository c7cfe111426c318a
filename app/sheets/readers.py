"""Cells by the meaning of their column -> values, and how values are shown."""

import re
from collections.abc import Callable
from typing import Any

from app.schemas.fields import MAX_INFO_LENGTH
from app.sheets.cells import MisreadError, Raw, clock_text, shown
from app.sheets.clocks import (
    Style, clock, duration, read_date, window_text, windows,
)
from app.sheets.headings import simple
from app.sheets.meanings import Kind
from app.sheets.numbers import amount_of, number, number_of

Reader = Callable[[Raw, str | None, Style], Any]

YES = frozenset((
    "y", "yes", "ja", "j", "oui", "o", "si", "s", "true", "wahr", "vrai", "vero", "1", "x",
    "ok", "tak", "t", "sim", "either", "both"))
NO = frozenset((
    "n", "no", "nein", "non", "false", "falsch", "faux", "falso", "0", "nee", "nie", "nao",
    "truck only"))
NOTHING = frozenset((
    "-", "--", "\u2013", "\u2014", "n/a", "na", "none", "null", "k.a.", "?", "/", "."))
"""What stands in cells for nothing, where it can't be anything else."""

DEPOTS = frozenset((
    "depot", "lager", "zentrale", "hub", "warehouse", "base", "entrepot", "deposito",
    "almacen", "magazzino", "magazijn", "magazyn", "baza", "armazem", "dc"))

_DEGREES = re.compile(
    r"(?P<degrees>[-+]?\d{1,3})\s*[°d]\s*(?:(?P<minutes>\d{1,2}(?:[.,]\d+)?)\s*['\u2032m]\s*)?"
    r"(?:(?P<seconds>\d{1,2}(?:[.,]\d+)?)\s*(?:[\"\u2033s]|'')\s*)?")
_SIDE = re.compile(r"^\s*([NSEW])\s*|\s*([NSEW])\s*$", re.IGNORECASE)
_POINT = re.compile(r"\s*(?P<first>[^,;]+?)\s*[;,/]\s*(?P<second>[^,;]+?)\s*")
_POINT_COMMAS = re.compile(r"\s*(?P<first>-?\d+,\d+)\s*[;,\s/]\s*(?P<second>-?\d+,\d+)\s*")
_POINT_SIDES = re.compile(r"\s*(?P<first>.+?[NS])[\s,;/]*(?P<second>.+[EW])\s*", re.IGNORECASE)
_POINT_BLANK = re.compile(r"\s*(?P<first>-?\d+\.\d+)\s+(?P<second>-?\d+\.\d+)\s*")


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
    return [name for part in re.split(r"[,;|]", shown(raw)) if (name := part.strip())]


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


def _degrees(raw: Raw, unit: str | None, style: Style) -> float:
    """Return degrees, of decimals or of minutes and seconds; south and west are below 0."""
    if isinstance(raw, float):
        return raw
    if not isinstance(raw, str):
        raise MisreadError(f"{shown(raw)!r} are no degrees")
    side = _SIDE.search(raw)
    plain = _SIDE.sub("", raw).strip() if side else raw.strip()
    sign = -1 if side and (side[1] or side[2]).upper() in "SW" else 1
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
    patterns = (_POINT_COMMAS, _POINT_SIDES, _POINT, _POINT_BLANK)
    found = next((match for pattern in patterns if (match := pattern.fullmatch(text))), None)
    if found is None:
        raise MisreadError(f"{text!r} is no place: write latitude and longitude such as "
                           "48.137, 11.575")
    first, second = (_degrees(found[name], None, style) for name in ("first", "second"))
    return (second, first) if turned else (first, second)


def _date(raw: Raw, unit: str | None, style: Style) -> Any:
    return read_date(raw, style)


def _kind(raw: Raw, unit: str | None, style: Style) -> str:
    return "depot" if simple(shown(raw)) in DEPOTS else "customer"


READERS: dict[Kind, Reader] = {
    "text": _text, "number": _number, "amount": _amount, "clock": _clock, "windows": _windows,
    "duration": _duration, "names": _names, "server": _server, "degrees": _degrees, "point": _point,
    "date": _date, "kind": _kind,
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
        case "server":
            return {"either": "by drone or truck", "truck": "by truck alone",
                    "drone": "by drone alone"}[value]
        case _:
            return str(value)
