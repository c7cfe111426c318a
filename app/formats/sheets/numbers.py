"""Numbers as people write them: decimal commas, thousands set apart, units behind."""

import re
from collections.abc import Iterable

from app.formats.sheets.cells import MisreadError, Raw, shown
from app.formats.sheets.headings import simple, unit_named
from app.formats.sheets.meanings import FAMILIES

ENTRIES = re.compile(r"[;|\n]")
"""Between what a cell lists."""

_SPACES = re.compile(r"[\s'\u2019\u00a0\u202f\u2009]+")
_NUMBER = re.compile(r"(?P<number>[-+]?\d[\d.,]*+|[-+]?[.,]\d++)(?P<unit>\D*+)")
_TWO_WAYS = re.compile(r"[-+]?[1-9]\d{0,2}[.,]\d{3}")
_COMMA = re.compile(r"(?<!\d)[-+]?(?:\d*+,(?:\d{1,2}|\d{4,})|\d{1,3}(?:\.\d{3})++(?:,\d++)?"
                    r"|0,\d++)")
_POINT = re.compile(r"(?<!\d)[-+]?(?:\d*+\.(?:\d{1,2}|\d{4,})|\d{1,3}(?:,\d{3})++(?:\.\d++)?"
                    r"|0\.\d++)")
_UNIT_WORD = re.compile(r"[^\W\d_]{3,20}\.?")
_DECIMAL = re.compile(r"[-+]?\d*+\.?\d*+")
_GROUPED = {sign: re.compile(rf"(?<![\d{sign}])[-+]?\d{{1,3}}(?:\{sign}\d{{3}})++(?:[.,]\d*+)?")
            for sign in ".,"}


def split_unit(text: str) -> tuple[str, str]:
    """Return the number that a text begins with, and what stands behind it."""
    found = _NUMBER.fullmatch(_SPACES.sub("", text))
    if found is None:
        raise MisreadError(f"{text!r} is no number")
    return found["number"].rstrip(",."), found["unit"]


def stated_in(cell: str) -> list[str]:
    """Return what may be numbers in a cell behind names (`van-1: 1,5`), as prices are."""
    named = [part.rpartition(":") for part in ENTRIES.split(cell)] if ":" in cell else []
    return [price for name, _, price in named if any(map(str.isalpha, name))]


def reads_two_ways(text: str) -> bool:
    """Tell whether a text such as `1.234` may be a thousand or a bit over one."""
    return _TWO_WAYS.fullmatch(_SPACES.sub("", text)) is not None


def uses_comma(texts: Iterable[str]) -> bool | None:
    """Return whether decimals stand behind a comma, by the texts that leave no doubt.

    None: there is none, or they disagree.
    """
    said = {False: 0, True: 0}
    for text in texts:
        plain = _SPACES.sub("", text)
        if not _TWO_WAYS.fullmatch(plain):
            said[True] += bool(_COMMA.fullmatch(plain))
            said[False] += bool(_POINT.fullmatch(plain))
    if said[True] == said[False]:
        return None
    return said[True] > said[False]


def number(text: str, comma: bool) -> float:
    """Return the number that a text states.

    Raises
    ------
    MisreadError
        If it states none.
    """
    plain = _SPACES.sub("", text)
    if "," in plain and "." in plain:
        # The last sign stands before decimals, whatever others do; the other sets thousands apart.
        comma = plain.rindex(",") > plain.rindex(".")
        if not _grouped(plain, "." if comma else ","):
            raise MisreadError(f"{text!r} is no number")
    if comma:
        plain = plain.replace(".", "").replace(",", ".") if "," in plain or _grouped(
            plain, ".") else plain
    elif "," in plain:
        # A lone comma that can't set thousands apart is a decimal one all the same.
        plain = plain.replace(",", "") if _grouped(plain, ",") or "." in plain else plain.replace(
            ",", ".")
    try:
        value = float(plain)
    except ValueError:
        raise MisreadError(f"{text!r} is no number") from None
    if not _DECIMAL.fullmatch(plain) or abs(value) > 1e15:
        raise MisreadError(f"{text!r} is no number")
    return value


def number_of(raw: Raw, comma: bool) -> float:
    """Return the number that a cell holds."""
    if isinstance(raw, float):
        return raw
    if isinstance(raw, str):
        return number(raw, comma)
    raise MisreadError(f"{shown(raw)!r} is no number")


def amount_of(raw: Raw, comma: bool, unit: str | None) -> float:
    """Return an amount in the unit of its column; a cell may state another of the same family."""
    if isinstance(raw, float):
        value = raw
    elif isinstance(raw, str):
        text, own = split_unit(raw)
        value = number(text, comma) * _factor(own, unit, raw)
    else:
        raise MisreadError(f"{shown(raw)!r} is no amount")
    if value < 0:
        raise MisreadError(f"{shown(raw)} is below 0: an amount to deliver is not")
    return round(value, 9)


def own_unit(raw: Raw) -> str | None:
    """Return the unit that a cell itself states, perhaps a word that is none elsewhere."""
    if not isinstance(raw, str):
        return None
    try:
        stated = split_unit(raw)[1]
    except MisreadError:
        return None
    return unit_named(stated) or (stated if _UNIT_WORD.fullmatch(stated) else None)


def _factor(own: str, unit: str | None, raw: str) -> float:
    if not own:
        return 1.0
    stated = unit_named(own)
    if stated is None and unit is not None and simple(own) == simple(unit):
        return 1.0
    if stated is None:
        raise MisreadError(f"{raw!r} has a unit that is not known")
    if stated == unit or unit is None:
        return 1.0
    for family in FAMILIES:
        if stated in family and unit in family:
            return family[stated] / family[unit]
    raise MisreadError(f"{raw!r} is in {stated}, its column in {unit}")


def _grouped(plain: str, sign: str) -> bool:
    """Tell whether `sign` sets thousands apart."""
    return _GROUPED[sign].fullmatch(plain) is not None
