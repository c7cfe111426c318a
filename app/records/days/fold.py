"""A day's events -> how it stands."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, fields
from typing import Any, NamedTuple

from app.records.days.rows import Begun, LoggedEvent
from app.records.dispatches.going_on import GROUNDING
from app.records.dispatches.rows import PLAN_SEEN, EventRow
from app.records.dispatches.standing import Standing, is_broken, of_steps, standing_of
from app.schemas.plan import PlanInput, StopInput, VisitInput

Data = dict[str, Any]


CLIENTS = frozenset({
    "order.placed", "order.changed", "order.cancelled", "order.pinned", "vehicle.departed",
    "vehicle.arrived", "vehicle.served", "vehicle.failed", "vehicle.broken", "vehicle.delayed",
    "vehicle.position", "drone.launched", "drone.recovered", "drone.lost", "clock"})
"""Kinds of events that clients and drivers tell; others are the service's own."""

TOUCHING = frozenset({"order.changed", "order.cancelled", "order.pinned", "vehicle.failed",
                      "vehicle.broken", "vehicle.delayed", "drone.lost"})
"""Kinds that ask for another plan of an order or a vehicle."""

KINDS = (*sorted(CLIENTS), PLAN_SEEN, "day.begun", "plan.changed", "eta.changed", "order.at_risk")


class Pace(NamedTuple):
    """How far off ways and services were, of which vehicles told."""

    ways: int = 0
    squares: float = 0.0  # of how often they were off by the usual spread


NO_PACE = Pace()


class Pin(NamedTuple):
    """Who serves an order, as its dispatcher settled by hand."""

    vehicle: str | None  # None: nobody does
    after: str | None = None  # an order that the vehicle serves before


@dataclass
class ToldDay:
    """What was told of a day so far."""

    customers: dict[str, Data]
    shipments: dict[str, Data]
    cancelled: dict[str, Data] = field(default_factory=dict)
    standings: dict[str, Standing] = field(default_factory=dict)  # by vehicle
    elsewhere: dict[str, str] = field(default_factory=dict)  # orders served by another than planned
    lost: set[str] = field(default_factory=set)  # drones
    delays: list[LoggedEvent] = field(default_factory=list)
    sighted: dict[str, LoggedEvent] = field(default_factory=dict)  # last, by vehicle
    told_at: dict[str, int] = field(default_factory=dict)  # by vehicle, milliseconds since 1970
    pins: dict[str, Pin] = field(default_factory=dict)  # by order, the last one last
    touched: dict[str, int] = field(default_factory=dict)
    """Number of the last event that asks for another plan of an order or a vehicle, by its name."""
    clock: int | None = None  # the latest time, of a day that goes by what it is told
    etas: dict[str, float] = field(default_factory=dict)  # that were told, by order
    at_risk: dict[str, Data] = field(default_factory=dict)  # what was told of orders
    pace: Pace = NO_PACE
    plan_start: int = 0  # milliseconds since 1970
    steps: dict[str, list[EventRow]] = field(default_factory=dict)
    """What was told of steps, by vehicle, in the order in which it came."""
    last: dict[bool, tuple[int, int]] = field(default_factory=dict)
    """Time and number of the last event that clients told, and of the service's own: what these
    say is told apart, so which of both came first doesn't count."""

    @property
    def out(self) -> list[str]:
        """Vehicles and drones that do nothing more."""
        broken = [vehicle for vehicle, standing in self.standings.items() if is_broken(standing)]
        return [*broken, *sorted(self.lost)]

    @property
    def gone(self) -> set[str]:
        """Orders that plans lack: cancelled, served by another than planned, left out by hand."""
        by_hand = [order for order, pin in self.pins.items() if pin.vehicle is None]
        return {*self.cancelled, *self.elsewhere, *by_hand}

    def count(self, vehicle: str) -> tuple[int, int]:
        """Return how many steps of a vehicle were told to be done, and to have failed."""
        outcomes = [told.outcome for told in of_steps(self.standings.get(vehicle, {})).values()]
        return outcomes.count("done"), outcomes.count("failed")


def fold(begun: Begun, events: Iterable[LoggedEvent], plan_start: int) -> ToldDay:
    """Return how a day stands; `plan_start` is in milliseconds since 1970.

    What was told late is put where it belongs: events count in the order of their times.
    """
    clock = begun.terms.clock
    told = ToldDay({each["id"]: each for each in begun.problem.get("customers", ())},
                {each["id"]: each for each in begun.problem.get("shipments", ())},
                plan_start=plan_start, clock=None if clock is None else round(
                    plan_start + 1000 * clock))
    _take_all(told, list(events))
    return told


def fold_on(told: ToldDay, events: Sequence[LoggedEvent]) -> ToldDay | None:
    """Return how a day stands with more events; None: one belongs before others that it has."""
    if any((event.time, event.number) < told.last.get(event.kind in CLIENTS, (0, 0))
           for event in events):
        return None
    parts = {each.name: copy(getattr(told, each.name)) for each in fields(told)}
    further = ToldDay(**parts | {"steps": {name: [*rows] for name, rows in told.steps.items()}})
    _take_all(further, events)
    return further


def _take_all(told: ToldDay, events: Sequence[LoggedEvent]) -> None:
    """Have events count, listed in the order in which they came. In place."""
    for event in sorted(events, key=lambda event: (event.time, event.number)):
        _take(told, event)
        told.last[event.kind in CLIENTS] = event.time, event.number
    moved = set[str]()
    for event in events:
        if told.clock is not None and event.kind in CLIENTS:
            told.clock = max(told.clock, event.time)
        if event.vehicle is not None and event.step is not None and event.outcome is not None:
            moved.add(event.vehicle)
            told.steps.setdefault(event.vehicle, []).append(EventRow(
                event.id, event.step, event.outcome, event.time, event.reason, event.number))
    for vehicle in moved:
        told.standings[vehicle] = standing_of(told.steps[vehicle], told.plan_start)


def _take(told: ToldDay, event: LoggedEvent) -> None:
    """Have an event count. In place."""
    about = event.about
    if event.kind in ("order.placed", "order.changed"):
        _state(told, about)
    elif event.kind == "order.cancelled":
        _cancel(told, about["order"])
    elif event.kind == "order.pinned":
        _pin(told, about["order"], event.vehicle, about)
    elif event.kind == "drone.lost" or (event.reason in GROUNDING and "drone" in about):
        told.lost.add(about["drone"])
    elif event.kind == "vehicle.delayed":
        told.delays.append(event)
    elif event.kind == "vehicle.position" and event.vehicle is not None:
        told.sighted[event.vehicle] = event
    elif event.kind == "vehicle.served" and event.step is None and event.vehicle is not None:
        told.elsewhere[about["order"]] = event.vehicle
    elif event.kind == "plan.changed" and "pace" in about:
        told.pace = Pace(*map(sum, zip(told.pace, about["pace"], strict=True)))
    elif event.kind == "eta.changed":
        told.etas[about["order"]] = about["arrival"]
    elif event.kind == "order.at_risk":
        told.at_risk.pop(about["order"], None)
        if about["at_risk"]:
            told.at_risk[about["order"]] = about
    if event.kind in TOUCHING:
        order = about.get("customer") or about.get("shipment") or {"id": about.get("order")}
        told.touched |= dict.fromkeys([name for name in (event.vehicle, order["id"]) if name],
                                      event.number)
    if event.vehicle is not None and event.kind in CLIENTS and event.kind != "order.pinned":
        told.told_at[event.vehicle] = event.time


def _state(told: ToldDay, about: Mapping[str, Any]) -> None:
    kind, orders = (("customer", told.customers) if "customer" in about
                    else ("shipment", told.shipments))
    order = about[kind]
    orders[order["id"]] = order
    told.cancelled.pop(order["id"], None)


def _pin(told: ToldDay, order: str, vehicle: str | None, about: Mapping[str, Any]) -> None:
    told.pins.pop(order, None)
    if vehicle is None and not about.get("left_out"):
        return
    told.pins[order] = Pin(vehicle, about.get("after"))
    # Of pins in a circle the last counts.
    other = about.get("after")
    while other in told.pins and other != order:
        pin = told.pins[other]
        if pin.after == order:
            told.pins[other] = pin._replace(after=None)
        other = pin.after


def _cancel(told: ToldDay, order: str) -> None:
    for orders in (told.customers, told.shipments):
        if order in orders:
            told.cancelled[order] = orders.pop(order)


def visits(plan: PlanInput) -> Iterator[tuple[str, str, StopInput | VisitInput]]:
    """Yield the orders of a plan, by stop and by drone: its name, the vehicle, and the visit."""
    for route in plan.routes:
        for trip in route.trips:
            for stop in trip.stops:
                if stop.kind == "customer":
                    yield stop.customer, route.vehicle, stop
            for sortie in trip.sorties:
                for visit in sortie.customers:
                    yield visit.customer, route.vehicle, visit
