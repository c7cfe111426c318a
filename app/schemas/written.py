"""Seconds of which it matters how they were written: as a length of time, or for a night."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from pydantic import ValidationInfo, ValidatorFunctionWrapHandler
from pydantic_core import PydanticCustomError

from app.schemas.day import DayOfBody, is_clock
from app.schemas.times import READ_DURATION, READ_INSTANT, READ_OPENING, Readable, Written

Window = TypeVar("Window")


@dataclass(frozen=True)
class EndOfWindow(Readable):
    """Reads a time of day that may be of the night that follows."""

    def read_written(self, text: str, number: ValidatorFunctionWrapHandler,
                     info: ValidationInfo) -> Written:
        """Return seconds, and which they may be instead."""
        clocks = _in_the_night(text, info)
        if clocks is None:
            return super().read_written(text, number, info)
        seconds, later = clocks
        return Written.of(seconds, text, number(later))


class StartOfBreak(EndOfWindow):
    """Reads a length of time after ISO 8601, too."""

    def read_written(self, text: str, number: ValidatorFunctionWrapHandler,
                     info: ValidationInfo) -> Written:
        """Return seconds of either."""
        if text.startswith("P"):
            return Written.of(number(READ_DURATION.read(text, info)), text)
        try:
            return super().read_written(text, number, info)
        except PydanticCustomError as error:
            if error.type != "MISSING_PLAN_START":
                raise
            raise PydanticCustomError(
                "MISSING_PLAN_START", f"{error.message()} With after_departure state a length of "
                "time, such as PT5H30M.") from None

def _in_the_night(text: str, info: ValidationInfo) -> tuple[float, float] | None:
    """Return a time of day before any shift begins, and the same on the day after, in a shift.

    None if it is none.
    """
    night = info.context.night if isinstance(info.context, DayOfBody) else None
    if night is None or not is_clock(text):
        return None
    try:
        seconds, later = night.day.seconds_at(text), night.day.seconds_at(f"+1 {text}")
    except ValueError:
        return None
    return (seconds, later) if seconds < night.opens and later <= night.closes else None


def on_the_day_after(window: Window) -> Window:
    """Move a window that ends before any shift begins to the day after, if work goes on then.

    In place: it is complete only then.
    """
    fields: dict[str, Any] = window.__dict__
    latest, earliest = fields["latest"], fields["earliest"]
    ends_then = isinstance(latest, Written) and latest.later is not None
    if isinstance(earliest, Written) and earliest.later is not None:
        is_moved = ends_then and earliest <= latest
        fields["earliest"] = _moved(earliest, is_moved)
    if ends_then:
        fields["latest"] = _moved(latest, True)
    return window


def _moved(end: Written, is_moved: bool) -> Written:
    """Return an end of a window on its day; an opening before plan start is then."""
    seconds = end.later if is_moved and end.later is not None else max(0.0, end)
    return Written.of(seconds, end.text, is_moved=is_moved)


def moved_end(window: Any) -> Written | None:
    """Return the end of a window that was moved to the day after; None if it wasn't."""
    end = window.latest
    return end if isinstance(end, Written) and end.is_moved else None


def length_like(text: str, seconds: float) -> str:
    """Return a length of time as another is written: after ISO 8601, or as `H:MM`."""
    minutes, rest = divmod(round(seconds, 3), 60)
    if text.startswith("P"):
        return f"PT{int(minutes)}M" + (f"{rest:g}S" if rest else "")
    hours, minutes = divmod(int(minutes), 60)
    return f"{hours}:{minutes:02d}" + (f":{rest:06.3f}".rstrip("0").rstrip(".") if rest else "")


_NIGHT = "Before all shifts, in one that lasts until then on the next day: then."
_OR_LENGTH = "With `after_departure` a length of time after ISO 8601 instead."


def _like(kind: Callable[..., Readable], usual: Readable, title: str, more: str,
          *examples: str) -> Readable:
    return kind(title, usual.read, f"{usual.description} {more}", (*usual.examples, *examples),
                usual.read_epoch)


READ_WINDOW_START = _like(EndOfWindow, READ_OPENING, "Opening", _NIGHT)
READ_WINDOW_END = _like(EndOfWindow, READ_INSTANT, "Instant", _NIGHT)
READ_BREAK_EARLIEST = _like(StartOfBreak, READ_OPENING, "OpeningOrLength",
                            f"{_NIGHT} {_OR_LENGTH}", "PT5H30M")
READ_BREAK_LATEST = _like(StartOfBreak, READ_INSTANT, "InstantOrLength",
                          f"{_NIGHT} {_OR_LENGTH}", "PT5H30M")
