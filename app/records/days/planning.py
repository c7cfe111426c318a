"""How a day stands -> the request of its next plan."""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

from app.records.days.fold import Data, ToldDay, visits
from app.records.days.news import served_orders
from app.records.days.pins import pinned
from app.records.days.rows import Begun, LoggedEvent
from app.records.days.sighting import late_by_position
from app.records.days.spreads import risk_of
from app.records.days.store import BY_SERVICE
from app.records.dispatches.going_on import OnTheRoad, going_on
from app.records.dispatches.rows import PLAN_SEEN
from app.records.dispatches.schemas import StepReply
from app.records.dispatches.steps import stop_ids
from app.schemas.errors import InputError
from app.schemas.plan import PlanInput, RouteInput, StopInput

MAKING, SEARCHING = 0.5, 0.3
"""Shares of the time from an event to its plan in which one is made, since an event that comes
meanwhile waits for that first, and in which it is searched."""

LEAST_SHARE, LEAST_SEARCHING, EACH = 0.15, 0.1, 2e-4
"""The least that is searched where what is beside takes long: a share of the time, and seconds, of
all and for each order, without which a plan of many is refused."""

_STEP = re.compile(r"\.(\w+)|\[(\d+)\]")


def asked(begun: Begun, told: ToldDay, plan: PlanInput | None,
          steps: Mapping[str, Sequence[StepReply]], now: float, seen: int,
          kept: Collection[str] = (), beside: float = 0.0) -> Data:
    """Return the request of `POST /plan` that goes on from a day's plan.

    Parameters
    ----------
    begun
        With what the day began.
    told
        What was told since.
    plan
        The plan before; None: there is none.
    steps
        What vehicles do by it.
    now
        In seconds since plan start.
    seen
        Number of the last event that the plan counts with.
    kept
        Orders that stay although they were cancelled, as a vehicle is on its way to them.
    beside
        Seconds that the plan before took beside its search.
    """
    within = begun.terms.plan_within
    options = {**begun.problem.get("options", {}), "times": "seconds"}
    options["time_limit"] = min(options.get("time_limit", within), _search_time(
        within, beside, len(told.customers) + len(told.shipments)))
    options["lateness_risk"] = risk_of(begun, told)
    request = {**begun.problem, "options": options}
    failed: dict[str, float] = {}
    given: PlanInput | None = None
    if plan is None:
        first = begun.problem.get("replan") or {"plan": {"routes": []}}
        replan: Data = {"plan": first["plan"], "freeze_before": now}
    else:
        sighted = late_by_position(begun, told, plan, seen)
        late = delayed(plan, told, seen, sighted)
        vehicles = {route.vehicle: OnTheRoad(steps.get(route.vehicle, ()),
                                             told.standings.get(route.vehicle, {}))
                    for route in late.routes}
        going, given = going_on(late, vehicles, now)
        replan = dict(going.replan)
        replan["concerned"] = sorted({*sighted, *_concerned(plan, told, seen)})
        failed = {each.customer: each.parcel_back for each in going.failed if each.is_open}
    if options.get("change_costs"):
        replan["promised"] = told.etas
    replan["unavailable"] = [*dict.fromkeys([*replan.get("unavailable", ()), *told.out])]
    request["replan"] = replan
    gone = told.gone
    for name, orders in (("customers", told.customers), ("shipments", told.shipments)):
        back = {order: each for order, each in told.cancelled.items()
                if order in kept and ("delivery" in each) == (name == "shipments")}
        wanted = {order: each for order, each in orders.items()
                  if order not in gone or order in kept}
        request[name] = [_released(each, failed.get(order))
                         for order, each in {**wanted, **back}.items()]
    if not told.pins:
        return request
    return pinned(request, told, given or PlanInput.model_validate(replan["plan"], strict=False),
                  now, {} if plan is None else served_orders(plan, told))


def waited_for(log: Iterable[LoggedEvent], planned: int, now: int) -> float:
    """Return for how many seconds an event that a plan is to count with has waited, at most.

    `planned` is the number of the last that one counts with, `now` in milliseconds since 1970.
    """
    return max([(now - event.received_at) / 1000 for event in log if event.number > planned
                and event.origin != BY_SERVICE and event.kind != PLAN_SEEN], default=0.0)


def _search_time(within: float, beside: float, orders: int) -> float:
    """Return how many seconds of the time from an event to its plan are searched."""
    least = max(LEAST_SHARE * within, EACH * orders)
    return max(LEAST_SEARCHING, min(SEARCHING * within, max(least, MAKING * within - beside)))


def _concerned(plan: PlanInput, told: ToldDay, seen: int) -> Iterator[str]:
    """Yield the vehicles of which, or of whose orders, something else was told than planned."""
    for order, vehicle, _ in visits(plan):
        if max(told.touched.get(name, 0) for name in (vehicle, order.partition("/")[0])) > seen:
            yield vehicle


def _released(order: Data, at: float | None) -> Data:
    """Return an order whose parcel is at the depot again from some time on."""
    return order if at is None else {**order, "release_time": at}


def delayed(plan: PlanInput, told: ToldDay, seen: int, sighted: Mapping[str, float]) -> PlanInput:
    """Return a plan with the ways longer on which vehicles are late, since it was made.

    They were told to be, or `sighted` says so by where they are: by how many seconds.
    """
    late = dict(sighted)
    for event in told.delays:
        if event.number > seen and event.vehicle is not None and event.vehicle not in sighted:
            late[event.vehicle] = late.get(event.vehicle, 0.0) + float(event.about["by"])
    if not late:
        return plan
    return plan.model_copy(update={"routes": tuple([
        _delayed(route, late[route.vehicle], told) if route.vehicle in late else route
        for route in plan.routes])})


def _delayed(route: RouteInput, by: float, told: ToldDay) -> RouteInput:
    """Return a route all of which that wasn't told is later, but for what waits for it anyway."""
    standing = told.standings.get(route.vehicle, {})
    trips, is_behind = [], False
    for index, trip in enumerate(route.trips):
        stops, start = [], len(trip.stops)
        for place, stop in enumerate(trip.stops):
            if not is_behind and not any(step in standing
                                         for step in stop_ids(index, trip, place)):
                is_behind = place > 0 or index > 0
                start = place
            stops.append(_later(stop, by) if is_behind else stop)
        flights = tuple([sortie if sortie.launch_stop < start else sortie.model_copy(update={
            "launch_time": sortie.launch_time + by, "recovery_time": sortie.recovery_time + by,
            "customers": tuple([visit.model_copy(update={
                name: getattr(visit, name) + by
                for name in ("arrival", "service_start", "departure")})
                for visit in sortie.customers])}) for sortie in trip.sorties])
        trips.append(trip.model_copy(update={"stops": tuple(stops), "sorties": flights}))
    return route.model_copy(update={"trips": tuple(trips)})


def _later(stop: StopInput, by: float) -> StopInput:
    return stop.model_copy(update={name: getattr(stop, name) + by
                                   for name in ("arrival", "service_start", "departure")})


def too_late(errors: Collection[InputError], request: Mapping[str, Any], told: ToldDay) -> set[str]:
    """Return the orders that a request lacks, and that can't be taken back any more."""
    names = [_name_at(request, error.path) for error in errors
             if error.code == "UNKNOWN_CUSTOMER" and error.path.startswith("$.replan.")]
    return {order for order in told.gone
            if any(name == order or name.startswith(f"{order}/") for name in names)}


def _name_at(request: Mapping[str, Any], path: str) -> str:
    at: Any = request
    for name, index in _STEP.findall(path):
        at = at[int(index)] if index else at[name]
    return str(at["id"] if isinstance(at, Mapping) else at)
