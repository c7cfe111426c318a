"""Days as they stood last, in the memory of this process.

Events never change, so a day is what it was and what was told since. Other processes, and this one
when it begins anew, fold the same from nothing.
"""

import threading
from collections import OrderedDict
from collections.abc import Sequence
from typing import NamedTuple

from app.records.days.fold import ToldDay, fold, fold_on
from app.records.days.rows import Begun, LoggedEvent
from app.records.days.store import DayStore
from app.records.dispatches.rows import DayRow
from app.requests.plan_reading import parse_plan
from app.schemas.plan import PlanInput

MOST = 64
"""Days that are remembered."""


class Stood(NamedTuple):
    """A day's events, and how it stands by them."""

    log: Sequence[LoggedEvent]
    told: ToldDay


class DayMemory:
    """Folds days on from how they stood last."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._days: OrderedDict[str, Stood] = OrderedDict()
        self._plans: OrderedDict[str, tuple[int, PlanInput]] = OrderedDict()  # with their numbers

    def plan(self, store: DayStore, day: DayRow) -> PlanInput | None:
        """Return a day's plan; None: there is none yet. In place."""
        with self._lock:
            known = self._plans.get(day.id)
        if known is not None and known[0] == day.plan_number:
            return known[1]
        content = store.plan(day.id)
        return None if content is None else self.keep(day.id, day.plan_number, parse_plan(content))

    def keep(self, day: str, number: int, plan: PlanInput) -> PlanInput:
        """Remember a plan, and return it. In place."""
        with self._lock:
            self._plans[day] = number, plan
            self._plans.move_to_end(day)
            while len(self._plans) > MOST:
                self._plans.popitem(last=False)
        return plan

    def stood(self, store: DayStore, day: DayRow, begun: Begun) -> Stood:
        """Return a day's events up to its revision, and how it stands by them. In place."""
        with self._lock:
            known = self._days.get(day.id, Stood((), fold(begun, (), day.plan_start)))
        last = known.log[-1].number if known.log else 0
        if last > day.revision:
            log = [event for event in known.log if event.number <= day.revision]
            return Stood(log, fold(begun, log, day.plan_start))
        new = [event for event in store.log(day.id, last) if event.number <= day.revision]
        log = [*known.log, *new]
        told = fold_on(known.told, new)
        stood = Stood(log, fold(begun, log, day.plan_start) if told is None else told)
        with self._lock:
            self._days[day.id] = stood
            self._days.move_to_end(day.id)
            while len(self._days) > MOST:
                self._days.popitem(last=False)
        return stood
