"""Kept plans that are a day's: who reads one gets the day's problem and plan as they are then."""

from contextlib import suppress
from dataclasses import replace
from typing import Any

from pydantic_core import to_json

from app.records.days.errors import NoDayPlanError, UnknownDayError
from app.records.days.memory import DayMemory
from app.records.days.store import DayStore
from app.records.days.views import plan_of, problem_of
from app.records.dispatches.rows import DayRow
from app.records.kept.rows import Content, KeptRow
from app.records.kept.store import KeptStore


def content_of(store: KeptStore, memory: DayMemory, owner: str, content: Content) -> Content:
    """Return what is to be kept; of a day, as that stands, by an id that no other has.

    Raises
    ------
    UnknownDayError
        If `owner` has no such day.
    """
    if content.day is None:
        return content
    days = DayStore(store.engine)
    day = days.find(owner, content.day)
    if day is None:
        raise UnknownDayError
    now = _standing(days, memory, day)
    problem, plan = now["request"], now["plan"]
    return replace(content, body=to_json(now),
                   customers=len(problem["customers"]) + len(problem["shipments"]),
                   cost=None if plan is None else plan["cost"]["total"], day=day.id)


def read(store: KeptStore, memory: DayMemory, kept: tuple[KeptRow, bytes]) -> tuple[KeptRow, bytes]:
    """Return a kept plan and its content as JSON: of a day as that stands, as long as it is there.
    """
    row, body = kept
    days = DayStore(store.engine)
    day = None if row.day is None else days.find(row.owner, row.day)
    if day is None:
        return row, body
    return row, to_json(_standing(days, memory, day))


def _standing(days: DayStore, memory: DayMemory, day: DayRow) -> dict[str, Any]:
    """Return a day's problem and plan; none is there yet: null."""
    plan = None
    with suppress(NoDayPlanError):
        plan = plan_of(days, memory, day)
    return {"request": problem_of(days, memory, day), "plan": plan}
