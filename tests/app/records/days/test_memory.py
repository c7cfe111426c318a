"""Days that were folded on, and from nothing."""

import random
from dataclasses import replace

import pytest
from pydantic_core import to_json

from app.records.days.fold import fold, fold_on
from app.records.days.memory import DayMemory
from app.records.days.rows import Begun, DayTerms, LoggedEvent
from app.records.days.store import DayStore
from app.records.dispatches.rows import DayRow
from app.schemas.plan import PlanInput
from tests.seeds import seeds

BEGIN = Begun({"customers": [{"id": name} for name in "AB"]}, DayTerms(2.0, 600.0, 0.0, ""))
ABOUT = {
    "order.placed": {"customer": {"id": "A"}}, "order.changed": {"customer": {"id": "B", "x": 1}},
    "order.cancelled": {"order": "A"}, "order.pinned": {"order": "B", "after": "A"},
    "vehicle.served": {"order": "A"}, "vehicle.delayed": {"by": 60}, "clock": {},
    "vehicle.position": {"location": [1, 2]}, "drone.lost": {"drone": "van-1/drone-1"},
    "plan.changed": {"pace": [1, 0.5]}, "eta.changed": {"order": "B", "arrival": 5.0},
    "order.at_risk": {"order": "B", "at_risk": True}}


def drawn(draw: random.Random, number: int, lateness: float) -> LoggedEvent:
    """Return an event that came soon after the one before, or is told late."""
    kind = draw.choice([*ABOUT])
    vehicle = draw.choice(["van-1", "van-2"]) if kind.startswith(("vehicle", "order.p")) else None
    step = draw.choice([None, "1-stop-1", "1-stop-2"]) if kind == "vehicle.served" else None
    late = draw.randrange(3000) if draw.random() < lateness else 0
    return LoggedEvent(number, "", str(number), kind, max(0, 100 * number - late), vehicle, step,
                       None if step is None else draw.choice(["done", "failed", "undone"]), None,
                       to_json(ABOUT[kind]).decode())


class Log(DayStore):
    """A day's events, and how many of them were read."""

    def __init__(self, events: list[LoggedEvent]) -> None:
        self.events = events
        self.read = 0

    def log(self, day: str, after: int = 0) -> list[LoggedEvent]:
        found = [event for event in self.events if event.number > after]
        self.read += len(found)
        return found

    def plan(self, day: str) -> bytes | None:
        self.read += 1
        return b'{"routes": []}'


@pytest.mark.parametrize("seed", seeds(20))
@pytest.mark.parametrize("lateness", [0.0, 0.3])
def test_day_that_is_remembered_is_that_folded_from_nothing(seed: int, lateness: float) -> None:
    draw = random.Random(seed)
    events = [drawn(draw, number, lateness) for number in range(1, 60)]
    row = DayRow("day", "", "", 0, 0, 0, 0, 0, None, None)
    store, memory, revision = Log(events), DayMemory(), 0
    while revision < len(events):
        revision = min(len(events), revision + draw.randint(1, 9))
        for asked in (revision, draw.randint(1, revision)):
            log, told = memory.stood(store, replace(row, revision=asked), BEGIN)
            assert list(log) == events[:asked]
            assert told == fold(BEGIN, events[:asked], 0)


def test_what_was_told_is_read_once() -> None:
    events = [drawn(random.Random(number), number, 0.0) for number in range(1, 11)]
    row, store, memory = DayRow("day", "", "", 0, 0, 0, 0, 0, None, None), Log(events), DayMemory()
    for revision in (10, 10):
        memory.stood(store, replace(row, revision=revision), BEGIN)
    assert store.read == 10


def test_plan_is_read_again_once_it_is_another() -> None:
    row, store, memory = DayRow("day", "", "", 0, 0, 0, 0, 0, None, None), Log([]), DayMemory()
    for number, read in ((1, 1), (1, 1), (2, 2)):
        assert memory.plan(store, replace(row, plan_number=number)) == PlanInput(routes=())
        assert store.read == read


def test_only_what_is_put_before_others_is_folded_from_nothing() -> None:
    first, later = (LoggedEvent(number, "", str(number), kind, time, None, None, None, None,
                                to_json(ABOUT[kind]).decode())
                    for number, kind, time in ((1, "clock", 50), (2, "order.placed", 40)))
    own = replace(later, kind="plan.changed", body=to_json(ABOUT["plan.changed"]).decode())
    told = fold(BEGIN, [first], 0)
    assert fold_on(told, [later]) is None
    assert fold_on(told, [own]) == fold(BEGIN, [first, own], 0)
