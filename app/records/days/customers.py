"""A customer's own view of a day: when who comes, by its link alone.

A link's token states day and order, signed by the day's own secret: nothing is kept of it.
"""

from collections.abc import Iterable, Sequence
from typing import Any

from itsdangerous import BadData, URLSafeSerializer
from sqlalchemy import Engine

from app.records.clock import now_ms
from app.records.days.fold import ToldDay, fold, visits
from app.records.days.news import served_orders
from app.records.days.rows import Begun, LoggedEvent
from app.records.days.schemas import CustomerLink, ToldArrival, VisitState, VisitStatusReply
from app.records.days.spreads import chance_of
from app.records.days.store import DayStore
from app.records.dispatches.errors import LinkOverError, UnknownVehicleLinkError
from app.records.dispatches.instants import instant
from app.records.dispatches.rows import DayRow
from app.records.dispatches.store import DispatchStore
from app.requests.plan_reading import parse_plan
from app.schemas.plan import PlanInput, StopInput

PAGE = "visit/"
"""Where customers' page is, below the service's own address."""


def address_of(base: str, begun: Begun, day: str, order: str) -> str:
    """Return the link of an order; its token stands behind `#`, which no server is told."""
    return f"{base.rstrip('/')}/{PAGE}#{_signer(begun.terms.secret).dumps([day, order])}"


def links_of(base: str, begun: Begun, row: DayRow, told: ToldDay,
             plan: PlanInput) -> list[CustomerLink]:
    """Return the links of a day's orders, as they are named in the plan."""
    planned = [order for order, _, _ in visits(plan)]
    left_out = [left.id for left in plan.unassigned]
    whole = {name.partition("/")[0] for name in (*planned, *left_out)}
    others = [order for order in (*told.customers, *told.shipments) if order not in whole]
    names = dict.fromkeys([*planned, *left_out, *others])
    return [CustomerLink(order=order, url=address_of(base, begun, row.id, order))
            for order in names]


def read_visit(engine: Engine, token: str) -> VisitStatusReply:
    """Return what the customer of a link may know.

    Raises
    ------
    UnknownVehicleLinkError
        If the token is none.
    LinkOverError
        If its day is over, or the order was cancelled.
    """
    store = DayStore(engine)
    row, begun, order = _opened(store, token)
    log = store.log(row.id)
    told = fold(begun, log, row.plan_start)
    if row.ends_at <= now_ms() or order.partition("/")[0] in told.cancelled:
        raise LinkOverError(was_revoked=row.ends_at > now_ms())
    content = store.plan(row.id)
    plan = PlanInput(routes=()) if content is None else parse_plan(content)
    names = {link.vehicle: link.name or link.vehicle
             for link in DispatchStore(engine).links(row.id)}
    return VisitStatusReply(
        order=order, time_zone=row.time_zone, plan_start=instant(row.plan_start, row.zone_offset),
        ends_at=instant(row.ends_at, row.zone_offset), told=_told(row, log, order),
        **_visit(told, plan, row, order, names))


def _opened(store: DayStore, token: str) -> tuple[DayRow, Begun, str]:
    """Return the day and the order that a token is for."""
    # What it states isn't believed before the secret of that day has signed it.
    _, stated = URLSafeSerializer("").loads_unsafe(token)
    if not isinstance(stated, list) or len(stated) != 2 or not isinstance(stated[0], str):
        raise UnknownVehicleLinkError
    row = store.find_any(stated[0])
    if row is None:
        raise UnknownVehicleLinkError
    begun = store.begun(row.id)
    try:
        _, order = _signer(begun.terms.secret).loads(token)
    except BadData as error:
        raise UnknownVehicleLinkError from error
    return row, begun, str(order)


def _signer(secret: str) -> URLSafeSerializer:
    return URLSafeSerializer(secret, "customer")


def _told(row: DayRow, log: Iterable[LoggedEvent], order: str) -> Sequence[ToldArrival]:
    return [ToldArrival(at=instant(event.time, row.zone_offset),
                        arrival=_instant(row, event.about["arrival"]))
            for event in log if event.kind == "eta.changed" and event.about["order"] == order]


def _instant(row: DayRow, seconds: float) -> Any:
    return instant(row.plan_start + round(1000 * seconds), row.zone_offset)


def _visit(told: ToldDay, plan: PlanInput, row: DayRow, order: str,
           names: dict[str, str]) -> dict[str, Any]:
    """Return how an order stands, and who comes when."""
    if order in told.elsewhere:
        return {"state": "served", "by": "truck",
                "vehicle": names.get(told.elsewhere[order], told.elsewhere[order])}
    for name, vehicle, visit in visits(plan):
        if name == order:
            served = served_orders(plan, told).get(order)
            state: VisitState = ("coming" if served is None else "served" if served
                                 else "failed")
            expected = chance_of(visit)
            earliest = expected.get("earliest", visit.arrival)
            return {"state": state, "by": "truck" if isinstance(visit, StopInput) else "drone",
                    "vehicle": names.get(vehicle, vehicle),
                    "arrival": _instant(row, visit.arrival), "earliest": _instant(row, earliest),
                    "latest": _instant(row, expected.get("latest", visit.arrival))}
    return {"state": "open"}
