"""Days as they stood last, in the memory of this process.

Events never change, so a day is what it was and what was told since. Other processes, and this one
when it begins anew, fold the same from nothing.
"""

from collections.abc import Callable, Hashable, Sequence
from typing import NamedTuple

from app.records.days.fold import ToldDay, fold, fold_on
from app.records.days.rows import Begun, LoggedEvent
from app.records.days.store import DayStore
from app.records.dispatches.rows import DayRow
from app.requests.plan_reading import parse_plan
from app.schemas.plan import PlanInput
from app.serving.remembered import Remembered

MOST = 64
"""Days that are remembered."""

MOST_QUOTED = 2**24
"""Bytes of what quotes were asked of that are remembered."""


class Stood(NamedTuple):
    """A day's events, and how it stands by them."""

    log: Sequence[LoggedEvent]
    told: ToldDay


class DayMemory:
    """Folds days on from how they stood last."""

    def __init__(self) -> None:
        self._begun: Remembered[str, Begun] = Remembered(MOST)
        self._days: Remembered[str, Stood] = Remembered(MOST)
        self._plans: Remembered[str, tuple[int, PlanInput]] = Remembered(MOST)  # their numbers
        self._quoted: Remembered[str, tuple[Hashable, bytes]] = Remembered(
            MOST_QUOTED, lambda each: len(each[1]))

    def begun(self, store: DayStore, day: str) -> Begun:
        """Return with what a day began. In place."""
        return self._begun.get(day) or self._begun.put(day, store.begun(day))

    def plan(self, store: DayStore, day: DayRow) -> PlanInput | None:
        """Return a day's plan; None: there is none yet. In place."""
        known = self._plans.get(day.id)
        if known is not None and known[0] == day.plan_number:
            return known[1]
        content = store.plan(day.id)
        return None if content is None else self.keep(day.id, day.plan_number, parse_plan(content))

    def keep(self, day: str, number: int, plan: PlanInput) -> PlanInput:
        """Remember a plan, and return it. In place."""
        return self._plans.put(day, (number, plan))[1]

    def quoted(self, day: str, by: Hashable, make: Callable[[], bytes]) -> bytes:
        """Return what quotes of a day are asked of, made once as long as it goes `by` the same.

        In place.
        """
        known = self._quoted.get(day)
        if known is not None and known[0] == by:
            return known[1]
        return self._quoted.put(day, (by, make()))[1]

    def stood(self, store: DayStore, day: DayRow, begun: Begun) -> Stood:
        """Return a day's events up to its revision, and how it stands by them. In place."""
        known = self._days.get(day.id) or Stood((), fold(begun, (), day.plan_start))
        last = known.log[-1].number if known.log else 0
        if last > day.revision:
            log = [event for event in known.log if event.number <= day.revision]
            return Stood(log, fold(begun, log, day.plan_start))
        if last == day.revision:
            return known
        new = [event for event in store.log(day.id, last) if event.number <= day.revision]
        log = [*known.log, *new]
        told = fold_on(known.told, new)
        return self._days.put(day.id, Stood(
            log, fold(begun, log, day.plan_start) if told is None else told))
