"""Quotes of a day: what an order would cost its plan, and accepting it by a token.

A token holds the order and its slots, signed by the day's own secret: nothing is kept of a quote
until it is accepted.
"""

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from hashlib import sha256
from math import ceil
from typing import NamedTuple

from itsdangerous import BadData, URLSafeTimedSerializer
from pydantic_core import from_json, to_json

from app.records.days.errors import DayOverError, NoDayPlanError, QuoteLapsedError
from app.records.days.fold import Data, visits
from app.records.days.memory import DayMemory
from app.records.days.planning import asked
from app.records.days.rows import Begun
from app.records.days.runner import now_of
from app.records.days.store import DayStore
from app.records.dispatches.store import DispatchStore
from app.requests.reading import read_json, read_model
from app.schemas.day import DayOfBody
from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.quote import OrderAsked
from app.records.clock import now_ms
from app.records.dispatches.rows import DayRow

AHEAD = 5.0
"""Seconds of which all quotes are by their end, so that they are asked of the same: who has
departed by then takes nobody more."""

LAPSES = 120
"""Seconds in which a quote may be accepted."""


@dataclass(frozen=True)
class AskedOfDay:
    """A request of `POST /quote` about a day."""

    body: bytes
    waiting: list[str]  # orders that the plan lacks yet
    revision: int  # of the day


def asked_of(days: DayStore, dispatches: DispatchStore, row: DayRow, body: bytes,
             memory: DayMemory) -> AskedOfDay:
    """Return the request of `POST /quote` that asks what a body does of a day as it stands now.

    Raises
    ------
    RequestError
        If the day is over or has no plan yet, or `body` is no valid request.
    """
    begun = memory.begun(days, row.id)
    read_model(body, OrderAsked, DayOfBody(to_json(begun.problem)))
    if row.ends_at <= now_ms():
        raise DayOverError
    plan = memory.plan(days, row)
    if plan is None:
        raise NoDayPlanError
    told = memory.stood(days, row, begun).told
    now = max(0.0, row.seconds(now_of(told)))
    if told.clock is None:
        now = AHEAD * ceil(now / AHEAD)

    def make() -> bytes:
        wanted = asked(begun, told, plan, dispatches.steps_by_vehicle(row.id), now, row.planned)
        return to_json({"problem": wanted, "plan": wanted["replan"]["plan"]})[:-1]

    about = memory.quoted(row.id, (row.revision, row.plan_number, row.planned, now), make)
    planned = {name.partition("/")[0] for name in (
        *(order for order, _, _ in visits(plan)), *(left.id for left in plan.unassigned))}
    waiting = [order for order in (*told.customers, *told.shipments)
               if order not in planned and order not in told.gone]
    return AskedOfDay(b"%b,%b" % (about, to_json(read_json(body))[1:]), waiting, row.revision)


def with_token(begun: Begun, body: bytes, reply: bytes) -> Data:
    """Return the reply to a quote with a token by which one of its slots is accepted."""
    quoted = dict(from_json(reply))
    if quoted["best"] is None:
        return quoted
    asked_for = dict(from_json(body))
    kept = [each["feasible"] for each in quoted["slots"]]
    lapses_at = datetime.now(UTC) + timedelta(seconds=LAPSES)
    return quoted | {"token": _signer(begun).dumps({**asked_for, "kept": kept}),
                     "lapses_at": lapses_at}


class AcceptedSlot(NamedTuple):
    """A slot of a quote that is to be accepted, and the order that follows from it."""

    asked: bytes  # what is asked of the day once more
    event: Data


def accepted(begun: Begun, token: str, slot: int, now: float) -> AcceptedSlot:
    """Return a slot of a quote, and the event by which its order is placed.

    Raises
    ------
    QuoteLapsedError
        If the token is none of this day, or too old.
    InvalidRequestError
        If there is no such slot, it couldn't be kept, or the order is there already.
    """
    try:
        asked_for = _signer(begun).loads(token, max_age=LAPSES)
    except BadData as error:
        raise QuoteLapsedError from error
    slots: list[Data] = asked_for["slots"]
    if slot >= len(slots) or not asked_for.pop("kept")[slot]:
        raise InvalidRequestError([InputError(
            code="OUT_OF_RANGE", path="$.slot", message="The quote has no such slot that can be "
            "kept: choose another.")])
    kind = "customer" if asked_for.get("order") is not None else "shipment"
    order: Data = asked_for["order"] if kind == "customer" else asked_for["shipment"]
    name = f"quote-{sha256(token.encode()).hexdigest()[:32]}"
    return AcceptedSlot(to_json({**asked_for, "slots": [slots[slot]]}), {
        "event_id": name, "kind": "order.placed", "at": now,
        kind: _within(order, slots[slot], kind == "shipment")})


def _within(order: Data, slot: Data, is_shipment: bool) -> Data:
    """Return an order that is to be served in a slot, of a shipment its delivery."""
    if is_shipment:
        return {**order, "delivery": _within(order["delivery"], slot, False)}
    limits = {name: slot[name] for name in ("earliest", "latest") if slot.get(name) is not None}
    # Ends of shipments aren't for drones alone.
    fixed = ("truck",) if "demand" not in order else ("truck", "drone")
    by = {"served_by": slot["by"]} if slot.get("by") in fixed else {}
    return {**{name: value for name, value in order.items() if name != "time_windows"},
            "time_window": limits, **by}


def _signer(begun: Begun) -> URLSafeTimedSerializer:
    return URLSafeTimedSerializer(begun.terms.secret, "quote")
