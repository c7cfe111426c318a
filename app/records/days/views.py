"""A day's problem and plan as they are read, by its owner or whoever was given a link."""

from typing import Any

from pydantic_core import from_json, to_json

from app.plans.telling import Telling
from app.records.days.errors import NoDayPlanError
from app.records.days.fold import visits
from app.records.days.memory import DayMemory
from app.records.days.spreads import is_stated, without_chances
from app.records.days.store import DayStore
from app.records.dispatches.rows import DayRow
from app.schemas.day import Times
from app.schemas.request import PlanRequest
from app.schemas.response import PlanReply
from app.schemas.times import read_body


def problem_of(store: DayStore, memory: DayMemory, row: DayRow) -> dict[str, Any]:
    """Return a day's problem with the orders that were told."""
    begun = memory.begun(store, row.id)
    told = memory.stood(store, row, begun).told
    plan = memory.plan(store, row)
    planned = set() if plan is None else {
        order.partition("/")[0] for order, _, _ in visits(plan)}
    stay = {order: each for order, each in told.cancelled.items() if order in planned}
    return {**begun.problem, "replan": None,
            "customers": [*told.customers.values(), *(
                each for each in stay.values() if "delivery" not in each)],
            "shipments": [*told.shipments.values(), *(
                each for each in stay.values() if "delivery" in each)]}


def plan_of(store: DayStore, memory: DayMemory, row: DayRow,
            times: Times | None = None) -> dict[str, Any]:
    """Return a day's plan, times as its problem asks for, or as stated.

    Raises
    ------
    NoDayPlanError
        If it has none yet.
    """
    content = store.plan(row.id)
    if content is None:
        raise NoDayPlanError
    plan = dict(from_json(content))
    begun = memory.begun(store, row.id)
    stated = begun.problem
    if times is not None:
        stated = {**stated, "options": {**stated.get("options", {}), "times": times}}
    telling = Telling.of(read_body(PlanRequest, to_json({
        **stated, "customers": [], "shipments": [], "relations": [], "replan": None})))
    if not is_stated(begun):
        plan = without_chances(plan)
    telling.tell(PlanReply, plan)
    return {**telling.stated, **plan}
