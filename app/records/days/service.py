"""Days as their owners see them: begun, told of, read; methods wait for the database."""

import re
import secrets
from collections.abc import Collection, Iterator, Sequence
from datetime import UTC, datetime, timedelta
from functools import partial
from typing import Any

from pydantic_core import from_json, to_json

from app.records.clock import now_ms
from app.records.days.customers import links_of
from app.records.days.errors import (
    DayMovedError, DayOverError, TooManyDayEventsError, UnknownDayError,
)
from app.records.days.events import (
    AnyEvent, DayEventsRequest, DroneFlown, DroneLost, OrderCancelled, OrderPinned, OrderStated,
)
from app.records.days.fold import ToldDay
from app.records.days.memory import DayMemory
from app.records.days.news import served_orders
from app.records.days.pins import too_many
from app.records.days.quoting import (
    AcceptedSlot, AskedOfDay, accepted, asked_of, with_token,
)
from app.records.days.rows import Begun, DayTerms, LoggedEvent
from app.records.days.runner import now_of
from app.records.days.schemas import (
    AcceptRequest, CustomerLinksReply, DayEventsReply, DayReply, DayRequest, LoggedReply,
    TakenReply,
)
from app.records.days.standings import orders_of, vehicles_of
from app.records.days.store import BY_CLIENT, DayStore
from app.records.days.telling import Steps
from app.records.days.views import plan_of, problem_of
from app.records.dispatches.errors import TooManyDispatchesError
from app.records.dispatches.instants import PlanStart, instant
from app.records.dispatches.rows import DayRow
from app.records.dispatches.store import DispatchStore
from app.records.jobs.webhook import check_url
from app.requests.bounds import Bounds
from app.requests.reading import read_json, read_model, request_errors
from app.schemas.day import DayOfBody, Times
from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.plan import PlanInput
from app.schemas.request import PlanRequest
from app.schemas.times import read_body
from app.serving.settings import Settings

NO_PLAN = PlanInput(routes=())

MAX_EVENTS = 100_000
"""Most events of a day."""

_KIND = re.compile(r"(\$\[\d+\])(?:\['[a-z]+\.[a-z_]+'\]|\.clock(?=$|\.))")
"""What errors have of an event's kind in their paths, which isn't in the body."""


class DayService:
    """Begins days, has them told, and tells how they stand.

    Parameters
    ----------
    store, dispatches
        Where they, and what their vehicles do, are kept.
    settings
        How long, and how many.
    bounds, policies
        Those of `POST /plan`.
    memory
        How days stood last.
    """

    def __init__(self, store: DayStore, dispatches: DispatchStore, settings: Settings,
                 bounds: Bounds, policies: Collection[str], memory: DayMemory) -> None:
        self._store = store
        self._dispatches = dispatches
        self._settings = settings
        self._bounds = bounds
        self._policies = policies
        self._memory = memory

    def begin(self, body: bytes, owner: str, client: str) -> DayRow:
        """Keep a day that begins, or find the one that the same request began. In place.

        Raises
        ------
        RequestError
            If `body` is no valid request, another has its name, or too many are open.
        """
        request = read_model(body, DayRequest)
        errors = request_errors(request.problem, self._policies, self._bounds)
        if errors:
            raise InvalidRequestError([error.model_copy(update={
                "path": f"$.problem{error.path[1:]}"}) for error in errors])
        if request.webhook is not None:
            check_url(request.webhook, self._settings, "$.webhook")
        row = self._row(request, owner, client)
        terms = DayTerms(request.plan_within, request.eta_threshold, request.clock,
                         secrets.token_urlsafe(), request.webhook, request.risk_threshold)
        return self._store.add(row, Begun(from_json(body)["problem"], terms), self._refuse_more)

    def find(self, name: str, owner: str) -> DayRow:
        """Return a day.

        Raises
        ------
        UnknownDayError
            If `owner` has none of that id.
        """
        row = self._store.find(owner, name)
        if row is None:
            raise UnknownDayError
        return row

    def tell(self, name: str, owner: str, body: bytes,
             revision: int | None = None) -> DayEventsReply:
        """Keep what happened. In place.

        Raises
        ------
        RequestError
            If there is no such day, it is over or full, or `body` is no valid list of events.
        DayMovedError
            If the day has another `revision`, where one is stated.
        """
        row = self.find(name, owner)
        if row.ends_at <= now_ms():
            raise DayOverError
        begun = self._memory.begun(self._store, row.id)
        day = DayOfBody(to_json(begun.problem))
        events = read_events(body, day)
        raw = read_json(body)
        log, told = self._memory.stood(self._store, row, begun)
        there = {event.id for event in log if event.origin == BY_CLIENT}
        new = [(number, event) for number, event in enumerate(events)
               if event.event_id not in there]
        plan = self._memory.plan(self._store, row) or NO_PLAN
        self._require_known(begun.problem, told, plan, new, raw)
        steps = Steps(plan, dict(told.standings))
        rows = [steps.row(event, round(row.plan_start + 1000 * event.at), raw[number])
                for number, event in sorted(new, key=lambda each: each[1].at)]
        self._store.append(row.id, rows, partial(_refuse_events, revision))
        numbers = self._store.numbers(row.id, [event.event_id for event in events])
        return DayEventsReply(
            accepted=[TakenReply(event_id=event.event_id, number=numbers[event.event_id])
                      for event in events],
            revision=self.find(name, owner).revision)

    def asked_of(self, name: str, owner: str, body: bytes) -> AskedOfDay:
        """Return the request of `POST /quote` about a day as it stands; raises as the function."""
        return asked_of(self._store, self._dispatches, self.find(name, owner), body, self._memory)

    def quoted(self, name: str, owner: str, body: bytes, reply: bytes) -> dict[str, Any]:
        """Return the reply to a quote with a token; raises as `find` does."""
        return with_token(
            self._memory.begun(self._store, self.find(name, owner).id), body, reply)

    def asked_again(self, name: str, owner: str, token: str,
                    body: bytes) -> AskedOfDay | DayEventsReply:
        """Return what asks whether a slot of a quote can still be kept; or that it was accepted.

        Raises
        ------
        RequestError
            If there is no such day, the quote has lapsed, or `body` names none of its slots.
        """
        row, slot = self._accepted(name, owner, token, body)
        if self._store.numbers(row.id, [slot.event["event_id"]]):
            return self.tell(name, owner, to_json([slot.event]))
        return asked_of(self._store, self._dispatches, row, slot.asked, self._memory)

    def accept(self, name: str, owner: str, token: str, body: bytes,
               revision: int) -> DayEventsReply:
        """Have an order count in a slot of a quote. In place.

        Raises
        ------
        RequestError
            As `asked_again` does.
        DayMovedError
            If the day has another revision than that by which the slot can be kept.
        """
        _, slot = self._accepted(name, owner, token, body)
        return self.tell(name, owner, to_json([slot.event]), revision)

    def _accepted(self, name: str, owner: str, token: str,
                  body: bytes) -> tuple[DayRow, AcceptedSlot]:
        row = self.find(name, owner)
        begun = self._memory.begun(self._store, row.id)
        told = self._memory.stood(self._store, row, begun).told
        return row, accepted(begun, token, read_model(body, AcceptRequest).slot,
                             max(0.0, row.seconds(now_of(told))))

    def plan(self, name: str, owner: str, times: Times | None = None) -> dict[str, Any]:
        """Return a day's plan, and which it is; times as its problem asks for, or as stated.

        Raises
        ------
        UnknownDayError, NoDayPlanError
            If there is no such day, or it has no plan yet.
        """
        row = self.find(name, owner)
        return {"number": row.plan_number, "planned": row.planned,
                "plan": plan_of(self._store, self._memory, row, times)}

    def links(self, name: str, owner: str, base: str) -> CustomerLinksReply:
        """Return a link for each order, `base` being the service's address; raises as `find`."""
        row = self.find(name, owner)
        begun = self._memory.begun(self._store, row.id)
        told = self._memory.stood(self._store, row, begun).told
        plan = self._memory.plan(self._store, row) or NO_PLAN
        return CustomerLinksReply(links=links_of(base, begun, row, told, plan))

    def problem(self, name: str, owner: str) -> dict[str, Any]:
        """Return a day's problem with the orders that were told; raises as `find` does."""
        return problem_of(self._store, self._memory, self.find(name, owner))

    def read(self, name: str, owner: str) -> DayReply:
        """Return how a day stands; raises as `find` does."""
        row = self.find(name, owner)
        told = self._memory.stood(self._store, row, self._memory.begun(self._store, row.id)).told
        plan = self._memory.plan(self._store, row) or NO_PLAN
        return DayReply(
            id=row.told_name, dispatch=row.id, time_zone=row.time_zone,
            plan_start=instant(row.plan_start, row.zone_offset), ends_at=instant(row.ends_at),
            now=row.seconds(now_of(told)), is_rehearsed=told.clock is not None,
            revision=row.revision, planned=row.planned,
            is_planned=row.planned >= row.asked, plan_number=row.plan_number, failure=row.failure,
            orders=list(orders_of(told, plan, row.seconds(now_of(told)))),
            vehicles=vehicles_of(told, plan, row), out=told.out)

    def _require_known(self, problem: dict[str, Any], told: ToldDay, plan: PlanInput,
                       events: Sequence[tuple[int, AnyEvent]], raw: Any) -> None:
        """Make sure that events name what there is, and state orders that can be planned.

        Raises
        ------
        InvalidRequestError
            With every error, if they don't.
        """
        counts = {kind["id"]: kind.get("count", 1) for kind in problem["fleet"]}
        errors = list(too_many(problem, told, served_orders(plan, told), events))
        customers, shipments = dict(told.customers), dict(told.shipments)
        orders = {*customers, *shipments, *told.cancelled}
        origin: dict[str, int] = {}
        for number, event in events:
            if isinstance(event, OrderStated):
                kind = "customer" if event.customer is not None else "shipment"
                (customers if kind == "customer" else shipments)[event.order] = raw[number][kind]
                orders.add(event.order)
                origin[event.order] = number
            errors += [InputError(
                code="UNKNOWN_CUSTOMER", path=f"$[{number}].{field}",
                message=f"The day has no order {name!r}: use the id of one.")
                for field, name in _orders_named(event) if name not in orders]
            field = "drone" if isinstance(event, DroneFlown | DroneLost) else "vehicle"
            vehicle = getattr(event, field, None)
            if vehicle is not None and not (_is_of(vehicle, counts) and not (
                    isinstance(event, OrderPinned) and "/" in vehicle)):
                errors.append(InputError(
                    code="UNKNOWN_VEHICLE", path=f"$[{number}].{field}",
                    message=f"The fleet has no {field} {vehicle!r}: use its name in the plan."))
        if origin and not errors:
            errors = self._order_errors(problem, customers, shipments, origin)
        if errors:
            raise InvalidRequestError(errors)

    def _order_errors(self, problem: dict[str, Any], customers: dict[str, Any],
                      shipments: dict[str, Any], origin: dict[str, int]) -> list[InputError]:
        """Return what is wrong with orders, where the events of these numbers state them."""
        whole = {**problem, "replan": None, "customers": list(customers.values()),
                 "shipments": list(shipments.values())}
        errors = request_errors(read_body(PlanRequest, to_json(whole)), self._policies,
                                self._bounds)
        paths = {f"$.customers[{index}]": f"$[{origin[order]}].customer"
                 for index, order in enumerate(customers) if order in origin}
        paths |= {f"$.shipments[{index}]": f"$[{origin[order]}].shipment"
                  for index, order in enumerate(shipments) if order in origin}
        told = []
        for error in errors:
            start = error.path[:error.path.find("]") + 1]
            path = f"{paths[start]}{error.path[len(start):]}" if start in paths else "$"
            told.append(error.model_copy(update={"path": path}))
        return told

    def _row(self, request: DayRequest, owner: str, client: str) -> DayRow:
        now = datetime.now(UTC)
        stated = request.problem.day
        day = PlanStart.stated(None if stated is None else stated.start, request.problem.time_zone,
                               now)
        ends_at = max(day.end(NO_PLAN),
                      now + timedelta(hours=self._settings.dispatch_hours))
        return DayRow.begun((owner, client), day, ends_at, self._settings.dispatch_expiry_hours,
                            request.id)

    def _refuse_more(self, there: int) -> None:
        most = self._settings.max_dispatches_per_client
        if there >= most:
            raise TooManyDispatchesError(most)


def read_events(body: bytes, day: DayOfBody) -> list[AnyEvent]:
    """Return the events that a body holds, told as times of a day are.

    Raises
    ------
    NotJsonError, InvalidRequestError
        If it holds none, or what are none.
    """
    try:
        return read_model(body, DayEventsRequest, day).root
    except InvalidRequestError as error:
        raise InvalidRequestError([each.model_copy(update={"path": _KIND.sub(r"\1", each.path)})
                                   for each in error.errors]) from error


def _refuse_events(since: int | None, revision: int, count: int) -> None:
    if since is not None and since != revision:
        raise DayMovedError
    if revision + count > MAX_EVENTS:
        raise TooManyDayEventsError(MAX_EVENTS)


def logged(row: DayRow, event: LoggedEvent) -> LoggedReply:
    """Return an event as clients read it."""
    return LoggedReply(number=event.number, kind=event.kind, at=row.seconds(event.time),
                       event_id=event.id if event.origin == BY_CLIENT else None,
                       vehicle=event.vehicle, reason=event.reason, about=event.about)


def _orders_named(event: AnyEvent) -> Iterator[tuple[str, str]]:
    """Yield the orders that an event names and that have to be there, each with its field."""
    if isinstance(event, OrderCancelled | OrderPinned):
        yield "order", event.order
    if isinstance(event, OrderPinned) and event.after is not None:
        yield "after", event.after


def _is_of(name: str, counts: dict[str, int]) -> bool:
    """Tell whether a vehicle, or a drone of it, is of the fleet."""
    kind, _, number = name.partition("/")[0].rpartition("-")
    return number.isdecimal() and 1 <= int(number) <= counts.get(kind, 0)
