"""Requests about days that can't be answered."""

from app.schemas.errors import RequestError


class UnknownDayError(RequestError, status=404, name="unknown-day"):
    """There is no such day, or it is another's."""

    title = "There is no such day"
    always = "No day of yours has this id: it may have expired."


class DayTakenError(RequestError, status=409, name="day-taken"):
    """Another day has the name."""

    title = "Another day has this name"
    always = "You began another day by this id: choose another, or send the same request."


class NoDayPlanError(RequestError, status=409, name="no-day-plan"):
    """The day has no plan yet."""

    title = "There is no plan yet"
    always = "The day's first plan isn't made yet: ask again, or follow its events."


class QuoteLapsedError(RequestError, status=410, name="quote-lapsed"):
    """A quote is accepted too late, or is none."""

    title = "The quote has lapsed"
    always = "No quote of this day has this token, or it has lapsed: ask for another."


class SlotTakenError(RequestError, status=409, name="slot-taken"):
    """A slot that was quoted can't be kept any more."""

    title = "The slot can't be kept any more"
    always = "The day has changed since the slot was quoted: ask for another quote."


class DayMovedError(Exception):
    """Something was told of a day since it was looked at."""


class DayOverError(RequestError, status=409, name="day-over"):
    """The day is over."""

    title = "The day is over"
    always = "What happens now belongs to another day: begin one."


class TooManyDayEventsError(RequestError, status=409, name="too-many-day-events"):
    """A day has as many events as it may."""

    title = "Too much was told of this day"

    def __init__(self, most: int) -> None:
        super().__init__(f"A day has at most {most} events: begin another.")
