"""Times of day, windows and lengths of time, as people and programs write them."""

import re
from contextlib import suppress
from dataclasses import dataclass
from datetime import date, datetime, time, timedelta

from app.formats.sheets.cells import BEFORE_ALL_DATES, MisreadError, Raw, clock_text, shown
from app.formats.sheets.headings import simple
from app.formats.sheets.meanings import UNITS
from app.formats.sheets.numbers import number, split_unit
from app.formats.sheets.words import WINDOW_WORDS

MINUTE, HOUR, DAY = 60, 3600, 86400

LAST = 48 * HOUR
"""Latest instant: the end of the night that follows."""

EVENING = 15 * HOUR
LONGEST_NIGHT = 14 * HOUR
"""What begins in the evening, ends before it begins and is no longer than this ends a day later."""

SERIALS = 36_526, 73_051
"""Days since 1900 by which spreadsheets hold dates of this century."""

MOST_HOURS = 4
"""Of a stop in `4:00`; more may be minutes and seconds."""

SIZES = {"minutes": MINUTE, "seconds": 1, "hours": HOUR, "days": DAY}

_TIME = re.compile(
    r"(?P<hour>\d{1,2})\s*+(?:[:h.]\s*+(?P<minute>\d{2})(?:[:.](?P<second>\d{2})(?:[.,]\d++)?)?)?"
    r"\s*+(?P<half>[ap]\.?\s?m\.?)?\s*+(?P<word>uhr|uur|hrs|heures?|horas?|hs?|u|godz\.?)?")
_BARE = re.compile(r"\d++(?:[.,]\d++)?")
_BARE_HOUR, _BARE_HHMM = re.compile(r"\d{1,2}"), re.compile(r"\d{3,4}")
_BARE_POINT, _BARE_MINUTES = re.compile(r"\d{1,2}[.,]\d{2}"), re.compile(r"\d{1,2}[.,][0-5]\d")
_DATE = re.compile(r"(?P<date>\d{4}[-/.]\d{1,2}[-/.]\d{1,2}|\d{1,2}([./-])\d{1,2}\2\d{2,4})"
                   r"[T,.\s]*+(?P<rest>.*+)")
_NO_YEAR = re.compile(r"(\d{1,2})([./-])(\d{1,2})\2?")
_DATES = re.compile(r"\d{4}-\d{1,2}-\d{1,2}|\d{1,2}([./-])\d{1,2}\1\d{2,4}")
_WEEKDAY = re.compile(r"^[^\W\d_]{2,10}[.,]{0,2}\s(?=\d{1,4}[-./]\d{1,2}[-./]\d)")
_BETWEEN_BEHIND = re.compile(
    r"(?:[-\u2010-\u2015~]|\b(?:to|until|till|bis|al?|alle|tot|do|ate))$", re.IGNORECASE)
_DATE_SIGNS = re.compile(r"[./-]")
_SERIAL = re.compile(r"[3-7]\d{4}(?:[.,]\d{1,12})?")
_ZONE = re.compile(r"(?<=\d)(Z|[+-]\d{2}:?\d{2})$", re.IGNORECASE)
_NEXT_DAY = re.compile(r"\+1\s++(?P<before>\d[^+(]{0,20})|(?P<behind>\d[^+(]{0,20}?)\s?\(?\+1\)?")
_DASH = re.compile(r"(?<!\s)\s++[-\u2013\u2014]\s++")
_BETWEEN = re.compile(r"(?:(?<!\s)\s++)?(?:[-\u2010-\u2015~]++|\.{2,}+|\b(?:to|until|till|bis"
                      r"|a(?!\.)|à|al|alle|tot|do|ate|até|às)\b)\s*+", re.IGNORECASE)
_APART = re.compile(r"(?:(?<!\s)\s++)?(?:[;|/+&\n]|,(?!\d)|\b(?:und|and|et|oder|or|y|e|en|i"
                    r"|sowie)\b)\s*+", re.IGNORECASE)
_SINCE = re.compile(r"(?:ab|de|du|da|das|from|after|von|since|not before|nach|des|dès|à partir de"
                    r"|desde|dalle|dopo|vanaf|od|>=?)\s++(.*+)", re.IGNORECASE)
_TILL = re.compile(r"(?:bis|until|till|before|by|vor|jusqu'?[àa]|avant|hasta|antes de|entro"
                   r"|fino alle|tot|do|spätestens|<=?)\s++(.*+)", re.IGNORECASE)
_HALF = re.compile(r"[ap]\.?\s?m\.?\s*+$")
_ENDS_HALF = re.compile(r"m\.?\s*+$")
_COLONS = re.compile(r"(\d{1,2}):(\d{2})(?::(\d{2}))?")
_HOURS = re.compile(r"(?<!\d)(\d++)\s*+h[a-z]*+\.?\s*+(\d{1,2})\s*+(?:m[a-z]*+\.?)?")
_ISO = re.compile(r"pt(?:(\d++)h)?(?:(\d++)m)?(?:(\d++)s)?")
_ENDS_MINUTES = re.compile(r"['\u2032m]$")
ALWAYS = frozenset(WINDOW_WORDS["all_day"])
"""Windows in words, in simple letters, that leave any time of day."""

Window = tuple[float | None, float | None]

NOON = 12 * HOUR
HALVES: dict[str, Window] = {**dict.fromkeys(WINDOW_WORDS["morning"], (None, NOON)),
                             **dict.fromkeys(WINDOW_WORDS["afternoon"], (NOON, None))}
"""Windows in words, in simple letters, that are half of the day."""

BEFORE_TIMES = ("ore ", "um ", "at ")
FRAMES, FRAMED = frozenset(WINDOW_WORDS["frames"]), frozenset(WINDOW_WORDS["framed"])
ONWARDS = ("+", "onwards")


@dataclass(frozen=True)
class Style:
    """How a file writes what may be written in several ways."""

    comma: bool = False  # before decimals
    day_first: bool = True  # in dates with slashes
    day: date | None = None  # that is planned; times with a date count from its midnight


def clock(raw: Raw, unit: str, style: Style) -> float:
    """Return an instant in seconds since midnight of the day that is planned.

    Raises
    ------
    MisreadError
        If the cell states none.
    """
    match raw:
        case datetime():
            return _bounded(_of_day(raw.date(), style) + _since_midnight(raw.time()), raw)
        case time():
            return _since_midnight(raw)
        case timedelta():
            return _bounded(raw.total_seconds(), raw)
        case bool():
            raise MisreadError(f"{shown(raw)} is no time of day")
        case float() if (instant := _serial(raw)) and unit in ("clock", "days"):
            return clock(instant, unit, style)
        case float():
            return _bounded(_bare(raw, f"{raw:.10g}", unit), raw)
        case str() if (instant := _serial(raw)) and unit in ("clock", "days"):
            return clock(instant, unit, style)
        case str():
            return _bounded(_text_clock(raw, unit, style), raw)
    raise MisreadError(f"{shown(raw)!r} is no time of day: write one such as 8:30")


def past_midnight(earliest: float | None, latest: float | None) -> float | None:
    """Return the end of a window; one from an evening to the small hours ends a day later."""
    if earliest is None or latest is None or latest >= earliest or earliest < EVENING:
        return latest
    return latest + DAY if latest + DAY - earliest <= LONGEST_NIGHT else latest


def _text_clock(text: str, unit: str, style: Style) -> float:
    if found := _NEXT_DAY.fullmatch(text):
        return DAY + _text_clock(found["before"] or found["behind"], unit, style)
    dated = _DATE.fullmatch(_WEEKDAY.sub("", text))
    if dated and dated["rest"]:
        rest = _ZONE.sub("", dated["rest"])
        return _of_day(read_date(dated["date"], style), style) + _text_clock(rest, unit, style)
    plain = text.lower().strip()
    if plain.startswith(BEFORE_TIMES):
        plain = plain.split(maxsplit=1)[1]
    if _BARE.fullmatch(plain):
        meant = look(plain) if unit == "clock" else unit
        if meant == "h.mm" and _BARE_POINT.fullmatch(plain):
            return _clock_parts(plain.replace(",", "."), text)
        return _bare(number(plain, "," in plain), plain, unit)
    return _clock_parts(plain, text)


def _clock_parts(plain: str, text: str) -> float:
    """Return the instant of `8:30`, `8h30`, `8.30 Uhr`, `8 am` or `8 Uhr`."""
    found = _TIME.fullmatch(plain)
    if found is None or not (found["minute"] or found["half"] or found["word"]):
        raise MisreadError(f"{text!r} is no time of day: write one such as 8:30")
    hour, minute, second = (int(found[part] or 0) for part in ("hour", "minute", "second"))
    half = found["half"]
    if minute > 59 or second > 59 or (half and not 1 <= hour <= 12):
        raise MisreadError(f"{text!r} is no time of day: write one such as 8:30")
    if half:
        hour = hour % 12 + (12 if half.startswith("p") else 0)
    return hour * HOUR + minute * MINUTE + second


def _bare(value: float, text: str, unit: str) -> float:
    """Return the instant of a number by its unit."""
    if unit == "clock":
        unit = look(text) or unit
    if unit in SIZES:
        return round(value * SIZES[unit])
    if unit == "hhmm" and value == int(value):
        hour, minute = divmod(int(value), 100)
    elif unit == "h.mm":
        hour, minute = divmod(round(value * 100), 100)
    else:
        raise MisreadError(f"{text} may be hours, minutes or seconds: say which its column has")
    if minute > 59:
        raise MisreadError(f"{text} has {minute} minutes, and an hour has 60")
    return hour * HOUR + minute * MINUTE


def look(text: str) -> str | None:
    """Return the unit that a bare number itself looks like: `8` hours, `0830`, or `8.30`."""
    if _BARE_HOUR.fullmatch(text) and int(text) <= 24:
        return "hours"
    if _BARE_HHMM.fullmatch(text) and int(text) <= 2400 and int(text) % 100 < 60:
        return "hhmm"
    if _BARE_MINUTES.fullmatch(text):
        return "h.mm"
    return None


def _since_midnight(instant: time) -> float:
    # What Excel computes is a millisecond off now and then.
    return round(instant.hour * HOUR + instant.minute * MINUTE + instant.second
                 + instant.microsecond / 1e6)


def _of_day(day: date, style: Style) -> float:
    """Return the midnight of a date in seconds since that of the day that is planned."""
    if day <= BEFORE_ALL_DATES or style.day is None:
        return 0
    return (day - style.day).days * DAY


def _bounded(seconds: float, raw: Raw) -> float:
    if seconds < 0:
        raise MisreadError(f"{shown(raw)} lies before the day that is planned")
    if seconds > LAST:
        raise MisreadError(f"{shown(raw)} would be {seconds / HOUR:,.0f} hours after midnight: "
                           "check the unit of the column, or the date")
    return seconds


def states_zone(text: str) -> bool:
    """Tell whether a text is a time of some time zone."""
    found = _DATE.fullmatch(text)
    # `11:00-12:00` behind a date is a window: times with zones have seconds, a T, or a plus.
    return found is not None and _ZONE.search(text) is not None and (
        "T" in text or "-" not in found["rest"] or found["rest"].count(":") > 2)


def read_date(raw: Raw, style: Style) -> date:
    """Return the date of a cell.

    Raises
    ------
    MisreadError
        If it states none.
    """
    if isinstance(raw, datetime):
        return raw.date()
    if isinstance(raw, date):
        return raw
    if (serial := _serial(raw)) is not None:
        return serial.date()
    if isinstance(raw, str) and (found := _DATE.fullmatch(_WEEKDAY.sub("", raw))):
        parts = [int(part) for part in _DATE_SIGNS.split(found["date"])]
        if parts[0] < 1000:
            first, second, year = parts
            is_day_first = style.day_first or "." in found["date"]
            day, month = (first, second) if is_day_first else (second, first)
            parts = [year + 2000 if year < 100 else year, month, day]
        with suppress(ValueError):
            return date(*parts)
    if style.day and isinstance(raw, str) and (found := _NO_YEAR.fullmatch(raw)):
        first, second = int(found[1]), int(found[3])
        month, day = (second, first) if style.day_first or found[2] == "." else (first, second)
        with suppress(ValueError):
            return date(style.day.year, month, day)
    raise MisreadError(f"{shown(raw)!r} is no date: write one such as 2026-11-23")


def _serial(raw: Raw) -> datetime | None:
    """Return the instant of a number by which spreadsheets hold dates; None: it is none."""
    if isinstance(raw, str):
        raw = float(raw.replace(",", ".")) if _SERIAL.fullmatch(raw) else None
    if not isinstance(raw, float) or not SERIALS[0] <= raw < SERIALS[1]:
        return None
    # What they compute is a little off now and then.
    return datetime(1899, 12, 30) + timedelta(seconds=round(raw * DAY))


def date_parts(raw: Raw) -> tuple[int, int] | None:
    """Return the first two numbers of a date with slashes, whose order is open."""
    if not isinstance(raw, str) or (found := _DATE.fullmatch(raw)) is None or "/" not in raw:
        return None
    first, second, *_ = map(int, _DATE_SIGNS.split(found["date"]))
    return (first, second) if first < 1000 else None


def windows(raw: Raw, unit: str, style: Style) -> list[Window]:
    """Return the windows of a cell such as `8-10`, `8:30-12:00; 14-15` or `ab 9 Uhr`."""
    if isinstance(raw, date) and (not isinstance(raw, datetime) or raw.time() == time()):
        raise MisreadError(f"{shown(raw)} is a date: a spreadsheet takes a window such as 8-10 for "
                           "one. Write 8:00-10:00")
    if not isinstance(raw, str):
        return [(clock(raw, unit, style), None)]
    if simple(raw) in ALWAYS:
        return [(None, None)]
    return [_window(part, unit, style) for part in _parts(_unframed(raw))]


def _unframed(text: str) -> str:
    """Return a text in which `between 8 and 10` is `8 - 10`."""
    words, is_open = [], False
    for word in text.split(" "):
        if word.lower() in FRAMES:
            is_open = True
        elif is_open and word.lower() in FRAMED:
            words.append("-")
            is_open = False
        else:
            words.append(word)
    return " ".join(words)


def _parts(text: str) -> list[str]:
    """Return the windows of a text; `10-12 and 14-16` are two, `8 and 10` is one."""
    parts = [part for part in _APART.split(text) if part]
    return parts if all(_BETWEEN.search(part) or _begin_of(part) or _TILL.fullmatch(part)
                        or simple(part) in HALVES for part in parts) else [text]


def _begin_of(text: str) -> str | None:
    """Return the instant in `from 8`, `8+` or `8 onwards`; None: it is none of these."""
    if found := _SINCE.fullmatch(text):
        return found[1]
    end = next((end for end in ONWARDS if text.lower().endswith(end)), None)
    return None if end is None else text[:-len(end)].strip()


def _window(text: str, unit: str, style: Style) -> Window:
    """Return one window; a date before it is that of both ends, unless the second has its own."""
    text = _WEEKDAY.sub("", text)
    dated = _DATE.fullmatch(text)
    if dated is None or not _BETWEEN.search(dated["rest"]):
        return _undated(text, unit, style)
    if second := _DATES.search(dated["rest"]):
        place = dated.start("rest") + second.start()
        first = _BETWEEN_BEHIND.sub("", text[:place].rstrip()).rstrip()
        return clock(first, unit, style), clock(text[place:], unit, style)
    since = _of_day(read_date(dated["date"], style), style)
    earliest, latest = _undated(dated["rest"], unit, style)
    return (None if earliest is None else _bounded(earliest + since, text),
            None if latest is None else _bounded(latest + since, text))


def _undated(text: str, unit: str, style: Style) -> Window:
    if (of_day := HALVES.get(simple(text))) is not None:
        return of_day
    if begin := _begin_of(text):
        if len(_BETWEEN.split(begin)) == 1:
            return clock(begin, unit, style), None
        text = begin
    if (found := _TILL.fullmatch(text)) and len(_BETWEEN.split(found[1])) == 1:
        return None, clock(found[1], unit, style)
    ends = _DASH.split(text)
    if len(ends) != 2:
        ends = [part for part in _BETWEEN.split(text) if part]
    if len(ends) != 2:
        raise MisreadError(f"{text!r} is no window: write one such as 8:00-10:00")
    first, second = ends
    latest = clock(second, unit, style)
    half = _HALF.search(second.lower())
    if half and not _ENDS_HALF.search(first.lower()):
        earliest = _bounded(_text_clock(f"{first}{half[0]}", unit, style), first)
        if earliest >= latest:
            earliest = clock(f"{first} am", unit, style)
    else:
        earliest = clock(first, unit, style)
    return earliest, latest


def duration(raw: Raw, unit: str, style: Style) -> float:
    """Return a length of time in seconds.

    Raises
    ------
    MisreadError
        If the cell states none.
    """
    match raw:
        case time():
            seconds = _since_midnight(raw)
        case timedelta():
            seconds = raw.total_seconds()
        case datetime() if raw.date() <= BEFORE_ALL_DATES:
            seconds = _since_midnight(raw.time())
        case bool():
            raise MisreadError(f"{shown(raw)} is no length of time")
        case float():
            seconds = round(raw * SIZES[unit], 3)
        case str():
            seconds = _text_duration(raw, unit, style)
        case _:
            raise MisreadError(f"{shown(raw)!r} is no length of time: write one such as 10 min")
    if not 0 <= seconds <= 7 * DAY:
        raise MisreadError(f"{shown(raw)} is no length of time that a stop takes")
    return seconds


def _text_duration(text: str, unit: str, style: Style) -> float:
    plain = text.lower().strip()
    if found := _COLONS.fullmatch(plain):
        first, second, third = (int(part or 0) for part in found.groups())
        if found[3] is None and first > MOST_HOURS:
            raise MisreadError(f"{text!r} may be {first} minutes or {first} hours: write "
                               f"{first} min")
        return first * HOUR + second * MINUTE + third
    if found := _HOURS.fullmatch(plain):
        return int(found[1]) * HOUR + int(found[2]) * MINUTE
    found = _ISO.fullmatch(plain)
    if found and any(found.groups()):
        first, second, third = (int(part or 0) for part in found.groups())
        return first * HOUR + second * MINUTE + third
    value, own = split_unit(_ENDS_MINUTES.sub("min", plain))
    stated = UNITS.get(own.strip(".")) if own else unit
    if stated not in SIZES:
        raise MisreadError(f"{text!r} is no length of time: write one such as 10 min")
    return round(number(value, style.comma) * SIZES[stated], 3)


def window_text(window: Window) -> str:
    """Return a window as people write it."""
    begin, end = ("" if side is None else clock_text(side) for side in window)
    return f"{begin}\u2013{end}" if begin or end else "any time"
