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
