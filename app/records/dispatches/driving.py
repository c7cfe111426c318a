"""A vehicle's day as its driver sees it, and what the driver tells; waits for the database."""

from collections.abc import Sequence
from datetime import datetime, timedelta
from typing import Any

from pydantic_core import to_json

from app.plans.flights.flight import Flight
from app.records.clock import now_ms
from app.records.dispatches.errors import LinkOverError, TooManyEventsError
from app.records.dispatches.instants import instant, milliseconds
from app.records.dispatches.links import find_link
from app.records.dispatches.going_on import GROUNDING
from app.records.dispatches.rows import PLAN_SEEN, DayRow, ToldRow, VehicleLinkRow
from app.records.dispatches.schemas import (
    BREAKDOWN, POSITION, SEEN, DriverDay, EventInput, EventsReply, EventsRequest, StepReply,
)
from app.records.dispatches.standing import Standing, standing_of, standing_reply
from app.records.dispatches.store import DispatchStore
from app.schemas.errors import InputError, InvalidRequestError

MAX_EVENTS = 5_000
"""Most events of a vehicle's day."""

TRUE_ENOUGH = timedelta(minutes=1)
"""By how much a phone's clock may be wrong before what it tells is set right."""


def read_day(store: DispatchStore, token: str) -> DriverDay:
    """Return the day of the link that a token opens, and note that it was opened. In place.

    Raises
    ------
    UnknownLinkError
        If the token is none.
    LinkOverError
        If the link was revoked, or its day is over.
    """
    link, dispatch = _open_link(store, token)
    if link.opened_at is None:
        store.note_opening(link.id)
    steps, flights = store.steps(link.id), store.flights(link.id)
    return DriverDay(
        link=link.id, vehicle=link.vehicle, name=link.name or link.vehicle,
        time_zone=dispatch.time_zone,
        plan_start=instant(dispatch.plan_start, dispatch.zone_offset),
        ends_at=instant(dispatch.ends_at, dispatch.zone_offset), steps=steps,
        flights=len(flights), flies=any(each.drone == link.vehicle for each in flights),
        asks_position=_asks_position(dispatch, steps),
        standing=standing_reply(_standing(store, link, dispatch), steps))


def read_flights(store: DispatchStore, token: str) -> list[Flight]:
    """Return the flights of the drones of the vehicle that a token is for.

    Raises
    ------
    InvalidRequestError
        If there are none.
    UnknownLinkError, LinkOverError
        As `read_day` does.
    """
    link, _ = _open_link(store, token)
    flights = store.flights(link.id)
    if not flights:
        raise InvalidRequestError([InputError(
            code="NO_FLIGHTS", path="$", message="No drone flies from this vehicle, or its flights "
            "can't be written: there is nothing to get.")])
    return flights


def _open_link(store: DispatchStore, token: str) -> tuple[VehicleLinkRow, DayRow]:
    link, dispatch = find_link(store, token)
    if link.revoked_at is not None or dispatch.ends_at <= now_ms():
        raise LinkOverError(link.revoked_at is not None)
    return link, dispatch


def tell(store: DispatchStore, token: str, request: EventsRequest) -> EventsReply:
    """Keep what a driver tells, and return what is known then. In place.

    What was told without network may come after the day's end, as long as it is kept, and be of
    steps that were taken out of the plan meanwhile.

    Raises
    ------
    UnknownLinkError
        If the token is none.
    LinkOverError
        If the link was revoked.
    TooManyEventsError
        If the link told too much.
    """
    link, dispatch = open_or_over(store, token)
    now = now_ms()
    wrong_by = clock_error(request.now, now)
    steps = store.steps(link.id)
    known = {step.id: step for step in steps}
    store.add_events(link, [
        _row(event, link.vehicle, known.get(event.step), wrong_by, now) for event in request.events
        if event.step != POSITION or _asks_position(dispatch, steps)], _refuse_more)
    return EventsReply(accepted=[event.id for event in request.events],
                       standing=standing_reply(_standing(store, link, dispatch), steps))


def _asks_position(dispatch: DayRow, steps: Sequence[StepReply]) -> bool:
    """Tell whether somebody plans on from where a vehicle is, on a map of the earth."""
    return dispatch.day is not None and any(step.location is not None for step in steps)


def open_or_over(store: DispatchStore, token: str) -> tuple[VehicleLinkRow, DayRow]:
    """Return a link that wasn't revoked, though its day may be over, and its dispatch.

    Raises
    ------
    UnknownLinkError, LinkOverError
        If the token is none, or the link was revoked.
    """
    link, dispatch = find_link(store, token)
    if link.revoked_at is not None:
        raise LinkOverError(was_revoked=True)
    return link, dispatch


def clock_error(told: datetime, now: int) -> int:
    """Return by how many milliseconds a phone's clock is behind; 0 if it is true enough."""
    wrong_by = now - milliseconds(told)
    return 0 if abs(wrong_by) < TRUE_ENOUGH / timedelta(milliseconds=1) else wrong_by


def _row(event: EventInput, vehicle: str, step: StepReply | None, wrong_by: int,
         now: int) -> ToldRow:
    """Return an event as it is kept; none is of the future."""
    time = min(milliseconds(event.time) + wrong_by, now)
    told: dict[str, Any] = {"by": "driver"}
    if event.step == SEEN:
        return ToldRow(event.id, PLAN_SEEN, time, vehicle, body=to_json(told).decode())
    if event.location is not None:
        told["location"] = event.location
        return ToldRow(event.id, "vehicle.position", time, vehicle, body=to_json(told).decode())
    if step is not None and step.customers:
        told["orders"] = [each.id for each in step.customers]
    if step is not None and step.drone is not None:
        told["drone"] = step.drone
    return ToldRow(event.id, _kind(event), time, vehicle, event.step, event.kind, event.reason,
                   to_json(told).decode())


_KINDS = {"depart": "vehicle.departed", "stop": "vehicle.served", "return": "vehicle.arrived",
          "launch": "drone.launched", "recover": "drone.recovered"}


def _kind(event: EventInput) -> str:
    """Return what an event is to who follows the day."""
    if event.step == BREAKDOWN:
        return "vehicle.broken"
    step = event.step.split("-")[1] if event.step.count("-") > 1 else ""
    if event.kind != "failed":
        return _KINDS.get(step, "vehicle.served")
    return "drone.lost" if event.reason in GROUNDING else "vehicle.failed"


def _standing(store: DispatchStore, link: VehicleLinkRow, dispatch: DayRow) -> Standing:
    return standing_of(store.events(dispatch.id).get(link.vehicle, []), dispatch.plan_start)


def _refuse_more(count: int) -> None:
    if count > MAX_EVENTS:
        raise TooManyEventsError(MAX_EVENTS)
