"""What a dispatcher settles by hand, and how plans keep to it until it is lifted.

Who serves an order is stated as the `vehicles` that may, and behind whom as one of the problem's
`relations`. What has happened stays: who is on the way already is nobody else's.
"""

from collections.abc import Iterator, Mapping
from typing import Any

from app.records.days.fold import Data, Pin, ToldDay, visits
from app.schemas.plan import PlanInput
from model.problem import MOST_RELATIONS


def pinned(request: Mapping[str, Any], told: ToldDay, plan: PlanInput, now: float) -> Data:
    """Return a request for the plan after one by which orders are where they were pinned."""
    begun = dict(_begun(plan, now))
    pins = {order: pin for order, pin in told.pins.items()
            if begun.get(order, pin.vehicle) == pin.vehicle}
    names = {each["id"] for each in request["customers"]}
    behind = [{"kind": "before", "customers": [pin.after, order]} for order, pin in pins.items()
              if pin.after is not None and order in names and pin.after in names
              and _who(pin.after, pins, begun) in (None, pin.vehicle)]
    stated = request.get("relations") or []
    room = MOST_RELATIONS - sum(each["kind"] != "apart" for each in stated)
    held = {kind: [_bound(each, pins) for each in request[kind]]
            for kind in ("customers", "shipments")}
    return {**request, **held, "relations": [*stated, *behind[max(0, len(behind) - room):]]}


def _begun(plan: PlanInput, now: float) -> Iterator[tuple[str, str]]:
    """Yield the orders of trips that have begun, each with its vehicle."""
    under_way = plan.model_copy(update={"routes": tuple([
        route.model_copy(update={"trips": tuple([
            trip for trip in route.trips if trip.stops[0].departure <= now])})
        for route in plan.routes])})
    for order, vehicle, _ in visits(under_way):
        yield order.partition("/")[0], vehicle


def _who(order: str, pins: Mapping[str, Pin], begun: Mapping[str, str]) -> str | None:
    """Return which vehicle alone serves an order; None: any may."""
    return pins[order].vehicle if order in pins else begun.get(order)


def _bound(order: Data, pins: Mapping[str, Pin]) -> Data:
    """Return an order with the vehicle that it was given."""
    pin = pins.get(order["id"])
    return order if pin is None else {**order, "vehicles": {"allowed": [pin.vehicle]}}
