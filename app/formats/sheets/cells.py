"""Cells of a sheet: what they hold, how people see them, what they are called."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date, datetime, time, timedelta
from math import isfinite
from typing import Any

Raw = str | float | bool | datetime | date | time | timedelta | None
"""What a cell holds. Texts have single blanks between words; None: nothing."""

BEFORE_ALL_DATES = date(1900, 1, 1)
"""Up to here, spreadsheets mean the time of day alone."""

Values = Mapping[str, str | float | list[str]]
"""What a message is made of, by name."""


@dataclass(frozen=True)
class Doubt:
    """Something guessed that may be meant otherwise, or left out."""

    code: str
    message: str
    column: str | None = None  # letters
    cell: str | None = None
    values: Values = field(default_factory=dict, hash=False)


@dataclass(frozen=True)
class CellError:
    """A cell, or all of a sheet, that can't be used."""

    code: str
    message: str
    cell: str | None = None
    values: Values = field(default_factory=dict, hash=False)


LONGEST_READ = 1000
"""Letters of a cell that is more than words; texts alone may be longer."""


def tidy(text: str) -> str | None:
    """Return a text with one blank between words and no empty lines; None: nothing is left."""
    lines = (" ".join(line.split()) for line in text.splitlines())
    return "\n".join(line for line in lines if line) or None


def bounded(raw: Raw) -> Raw:
    """Return a cell as far as patterns look at it."""
    return raw[:LONGEST_READ] if isinstance(raw, str) else raw


class MisreadError(ValueError):
    """A cell that doesn't say what its column means."""

    def __init__(self, message: str, cell: str | None = None, value: str = "") -> None:
        super().__init__(message)
        self.cell = cell
        self.value = value


def raw_of(value: Any) -> Raw:
    """Return what a cell of a workbook holds, from JSON; what no type can hold is a text."""
    try:
        return _typed(value)
    except (ValueError, OverflowError):
        return str(value[-1] if isinstance(value, list) else value)


def _typed(value: Any) -> Raw:
    match value:
        case str():
            return tidy(value.encode(errors="replace").decode())
        case float() if not isfinite(value):
            return str(value)
        case bool() | float() | None:
            return value
        case int():
            return float(value)
        case ["datetime", text]:
            return datetime.fromisoformat(text)
        case ["date", text]:
            return date.fromisoformat(text)
        case ["time", text]:
            return time.fromisoformat(text)
        case ["timedelta", seconds]:
            return timedelta(seconds=seconds)
        case _:
            return str(value)


def shown(raw: Raw) -> str:
    """Return a cell about as a spreadsheet shows it."""
    match raw:
        case None:
            return ""
        case bool():
            return "TRUE" if raw else "FALSE"
        case float():
            return str(int(raw)) if raw == round(raw) and abs(raw) < 1e15 else f"{raw:.10g}"
        case datetime():
            return raw.isoformat(sep=" ", timespec="minutes")
        case time():
            return clock_text(raw.hour * 3600 + raw.minute * 60 + raw.second)
        case timedelta():
            return clock_text(raw.total_seconds())
        case _:
            return str(raw)


def clock_text(seconds: float) -> str:
    """Return an instant of the day or a length as `8:30`, with seconds if there are any."""
    minutes, rest = divmod(round(seconds), 60)
    text = f"{minutes // 60}:{minutes % 60:02}"
    return f"{text}:{rest:02}" if rest else text


def next_day(seconds: float) -> str:
    """Return an instant past midnight as `+1 06:00`."""
    days, rest = divmod(round(seconds), 86_400)
    hours, minutes = divmod(rest // 60, 60)
    return f"{days:+d} {hours:02}:{minutes:02}"


def letters(column: int) -> str:
    """Return what spreadsheets call a column, counted from 0."""
    text = ""
    column += 1
    while column:
        column, digit = divmod(column - 1, 26)
        text = chr(ord("A") + digit) + text
    return text


def cell_name(row: int, column: int) -> str:
    """Return what spreadsheets call a cell, such as `C17`; both are counted from 0."""
    return f"{letters(column)}{row + 1}"
