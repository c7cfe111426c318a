"""What a dispatcher settles by hand, and how plans keep to it until it is lifted.

Who serves an order is stated as the `vehicles` that may, and behind whom as one of the problem's
`relations`. What has happened stays: who is on the way already is nobody else's.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any

from app.records.days.events import AnyEvent, OrderPinned
from app.records.days.fold import Data, Pin, ToldDay, visits
from app.schemas.errors import InputError
from app.schemas.plan import PlanInput
from model.problem import MOST_RELATIONS


def pinned(request: Mapping[str, Any], told: ToldDay, plan: PlanInput, now: float,
           served: Collection[str]) -> Data:
    """Return a request for the plan after one by which orders are where they were pinned.

    Of those who were `served` nobody else is behind any more.
    """
    begun = dict(_begun(plan, now))
    pins = {order: pin for order, pin in told.pins.items()
            if pin.vehicle is not None and begun.get(order, pin.vehicle) == pin.vehicle}
    names = {each["id"] for each in request["customers"]}
    behind = [{"kind": "before", "customers": [pin.after, order]} for order, pin in pins.items()
              if pin.after is not None and order not in served
              and order in names and pin.after in names
              and _who(pin.after, pins, begun) in (None, pin.vehicle)]
    held = {kind: [_bound(each, pins) for each in request[kind]]
            for kind in ("customers", "shipments")}
    return {**request, **held, "relations": [*(request.get("relations") or ()), *behind]}


def too_many(problem: Mapping[str, Any], told: ToldDay, served: Collection[str],
             events: Iterable[tuple[int, AnyEvent]]) -> Iterator[InputError]:
    """Yield an error for each event that pins an order behind another where no plan holds more."""
    room = MOST_RELATIONS - sum(
        each["kind"] != "apart" for each in problem.get("relations") or ())
    held = {order for order, pin in told.pins.items()
            if pin.after is not None and order not in served}
    for number, event in events:
        if not isinstance(event, OrderPinned):
            continue
        held.discard(event.order)
        if event.after is not None and not event.undone and event.order not in served:
            held.add(event.order)
            if len(held) > room:
                yield InputError(
                    code="OUT_OF_RANGE", path=f"$[{number}].after",
                    message=f"Plans of this day hold {room} orders behind others, no more: lift "
                    "a pin, or leave `after` out.")


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
