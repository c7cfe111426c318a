"""What drivers told -> the plan to go on from."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from app.records.dispatches.doubts import Answers, DoubtfulOrder, answered, doubts_of
from app.records.dispatches.retiming import Retimed, retime
from app.records.dispatches.schemas import (
    DoubtfulReply, FailedReply, GoingOnReply, StepKind, StepReply,
)
from app.records.dispatches.standing import Standing, is_broken, of_steps
from app.records.dispatches.steps import flight_id, stop_ids
from app.schemas.plan import PlanInput, RouteInput, SortieInput, StopInput, TripInput

GROUNDING = frozenset({"Did not come back", "Drone is broken"})
"""What drivers tell of a drone that flies no more, as their page offers it."""


NOBODY_KNOWS = Answers()


@dataclass(frozen=True)
class OnTheRoad:
    """What is known of a vehicle."""

    steps: Sequence[StepReply]
    standing: Standing


class GoneOn(NamedTuple):
    """How to plan on, and the plan that is given for it."""

    reply: GoingOnReply
    given: PlanInput


def going_on(plan: PlanInput, vehicles: Mapping[str, OnTheRoad], now: float,
             answers: Answers = NOBODY_KNOWS) -> GoneOn:
    """Return how to plan on, by what drivers told.

    Parameters
    ----------
    plan
        As it was sent out.
    vehicles
        What is known of each, by name. One whose driver told nothing is where the plan has it.
    now
        From when on, in seconds since plan start.
    answers
        What is known of orders of which nobody told.
    """
    routes, failed, told, doubtful = [], [], [], list[DoubtfulReply]()
    for route in plan.routes:
        known = vehicles[route.vehicle]
        if known.standing:
            told.append(route.vehicle)
        doubts = doubts_of(route, of_steps(known.standing), now)
        breaks = is_broken(known.standing)
        standing = answered(route, of_steps(known.standing), doubts, answers, breaks, now)
        doubtful += [_reply(doubt, standing) for doubt in doubts]
        if standing is None:
            routes.append(route)
            continue
        durations = {step.id: step.duration for step in known.steps}
        trips = retime(route, standing, durations, now, breaks)
        driven, failures = _driven(route, trips, standing)
        failed += failures
        if driven.trips:
            routes.append(driven)
    given = plan.model_copy(update={"routes": tuple(routes)})
    broken = [route.vehicle for route in routes if is_broken(vehicles[route.vehicle].standing)]
    grounded = list(dict.fromkeys(drone for known in vehicles.values() for drone in _lost(known)))
    replan = {"plan": given.model_dump(mode="json", exclude_none=True), "freeze_before": now}
    if broken or grounded:
        replan["unavailable"] = [*broken, *grounded]
    stays = {each.customer for each in failed if not each.is_open}
    replan["doubtful"] = [doubt.customer for doubt in doubtful
                          if doubt.customer not in {*answers.served, *answers.unserved}
                          and (doubt.is_served or doubt.customer in stays)]
    return GoneOn(GoingOnReply(replan=replan, broken=broken, grounded=grounded, told=told,
                               failed=failed, doubtful=doubtful), given)


def _reply(doubt: DoubtfulOrder, standing: Standing | None) -> DoubtfulReply:
    """Return an order in doubt, and whether it is held to be served."""
    is_served = standing is None or (
        standing[doubt.step].outcome == "done" if doubt.step in standing
        else doubt.is_flying and doubt.failing not in standing)
    return DoubtfulReply(customer=doubt.customer, vehicle=doubt.vehicle, time=doubt.time,
                         is_served=is_served)


def _lost(known: OnTheRoad) -> Iterator[str]:
    """Yield the drones of a vehicle that fly no more, by their names."""
    standing = of_steps(known.standing)
    for step in known.steps:
        if (step.drone is not None and _has_failed(standing, step.id)
                and standing[step.id].reason in GROUNDING):
            yield step.drone


def _driven(route: RouteInput, trips: Sequence[Retimed],
            standing: Standing) -> tuple[RouteInput, list[FailedReply]]:
    """Return a route without what failed, and who wasn't served."""
    left, failed = [], []
    come_back_to = frozenset(
        stop.id for index, retimed in enumerate(trips)
        for stop in _met(retimed.trip, _flown(index, retimed.trip, standing)).values()
        if stop.kind == "launch_site")
    for index, retimed in enumerate(trips):
        trip, failures = _without_failed(route.vehicle, index, retimed, standing, come_back_to)
        failed += failures
        if trip is not None:
            left.append(trip)
    return route.model_copy(update={"trips": tuple(left)}), failed


def _flown(index: int, trip: TripInput, standing: Standing) -> list[SortieInput]:
    """Return the flights of a trip but for those that could not be launched."""
    return [sortie for sortie in trip.sorties
            if not _has_failed(standing, flight_id(index, "launch", sortie))]


def _met(trip: TripInput, flown: Sequence[SortieInput]) -> dict[int, StopInput]:
    """Return the stops, by place, at which drones are launched or met."""
    return {place: trip.stops[place] for sortie in flown
            for place in (sortie.launch_stop, sortie.recovery_stop)}


def _without_failed(vehicle: str, index: int, retimed: Retimed, standing: Standing,
                    come_back_to: Collection[str]) -> tuple[TripInput | None, list[FailedReply]]:
    """Return a trip without what failed, None if nothing is left of it; and who wasn't served.

    A stop where a drone is launched or met stays, and so does the last of a trip that is under
    way: the truck was there. So does one at a customer to whom the truck comes back.
    """
    trip = retimed.trip
    stops, failed = trip.stops, list[FailedReply]()

    def note(customer: str, kind: StepKind, step: str, is_open: bool) -> None:
        told = standing[step]
        failed.append(FailedReply(customer=customer, vehicle=vehicle, step=kind, time=told.time,
                                  reason=told.reason, is_open=is_open,
                                  parcel_back=stops[-1].arrival))

    for sortie in trip.sorties:
        for kind in _FLIGHTS:
            step = flight_id(index, kind, sortie)
            if _has_failed(standing, step):
                for visit in sortie.customers:
                    note(visit.customer, kind, step, is_open=kind == "launch")
    flown = _flown(index, trip, standing)
    meetings = _met(trip, flown)
    failing = {place: step for place, stop in enumerate(stops) if stop.kind == "customer"
               for step in stop_ids(index, trip, place) if _has_failed(standing, step)}
    dropped = [place for place, stop in enumerate(stops) if place not in meetings and (
        stop.kind == "launch_site" or (place in failing and stop.id not in come_back_to))]
    served = sum(stop.kind == "customer" and place not in dropped
                 for place, stop in enumerate(stops))
    if not served and not flown and dropped and not retimed.is_over:
        dropped.remove(max(dropped, key=lambda place: (stops[place].kind == "customer", place)))
    for place, step in failing.items():
        note(stops[place].customer, "stop", step, place in dropped)
    if not served and not flown and retimed.is_over:
        return None, failed
    return _cut(trip, flown, dropped), failed


_FLIGHTS: tuple[StepKind, ...] = ("launch", "recover")


def _has_failed(standing: Standing, step: str) -> bool:
    told = standing.get(step)
    return told is not None and told.outcome == "failed"


def _cut(trip: TripInput, flown: Sequence[object], dropped: Sequence[int]) -> TripInput:
    """Return a trip with some of its flights, and without some of its stops."""
    stops = tuple(stop for place, stop in enumerate(trip.stops) if place not in dropped)

    def moved(place: int) -> int:
        return place - sum(other < place for other in dropped)

    sorties = [sortie.model_copy(update={"launch_stop": moved(sortie.launch_stop),
                                         "recovery_stop": moved(sortie.recovery_stop)})
               for sortie in trip.sorties if sortie in flown]
    return trip.model_copy(update={"stops": stops, "sorties": tuple(sorties)})
