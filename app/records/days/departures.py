"""Days with a forecast are decided anew as each departure comes due, though nobody tells anything.

What is due follows from the day's own log, so it holds over restarts, and for all processes: it is
told as an event by a name of its own.
"""

from pydantic_core import from_json, to_json

from app.records.days.fold import Data
from app.records.days.rows import Begun
from app.records.days.store import BY_SERVICE, DayStore
from app.records.dispatches.rows import ToldRow
from app.requests.conversion.units import thousandths
from app.schemas.request import PlanRequest
from app.schemas.times import read_body


class Departures:
    """Finds the days of which a departure has come due since their plan was made."""

    def __init__(self, store: DayStore) -> None:
        self._store = store
        self._every: dict[str, int | None] = {}  # ms, by day; None: it isn't timed
        self._seen: dict[str, int] = {}  # the last departure that was looked at, by day

    def tell(self, now: int) -> None:
        """Tell the time to days that are due, `now` being in milliseconds since 1970. In place."""
        starts = self._store.planned_by(now)
        self._every = {day: self._every[day] if day in self._every
                       else _every(self._store.begun(day)) for day in starts}
        self._seen = {day: number for day, number in self._seen.items() if day in starts}
        for day, start in starts.items():
            every = self._every[day]
            number = 0 if every is None else (now - start) // every
            if every is None or number < 1 or self._seen.get(day) == number:
                continue
            self._seen[day] = number
            due = start + number * every
            if self._store.planned_at(day) < due and self._waits(day):
                self._store.append(day, [ToldRow(f"departure:{number}", "clock", due)],
                                   lambda *_: None, BY_SERVICE)

    def _waits(self, day: str) -> bool:
        """Tell whether anybody of a day's plan waits for a later departure."""
        plan: Data = from_json(self._store.plan(day) or b"{}")
        return any(not each["leaves"] for each in plan.get("outlook") or ())


def _every(begun: Begun) -> int | None:
    """Return the time between departures of a day in ms; None: none, or a clock of its own."""
    if begun.problem.get("forecast") is None or begun.terms.clock is not None:
        return None
    stated = read_body(PlanRequest, to_json({
        **begun.problem, "customers": [], "shipments": [], "relations": [], "replan": None}))
    return None if stated.forecast is None else thousandths(stated.forecast.every)
