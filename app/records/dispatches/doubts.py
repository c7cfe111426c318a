"""Orders that a plan has as served by now, and of which nobody told.

A vehicle that told something has done what it told, no more, and one that told nothing is where
the plan has it: so they are told of, and whoever knows may say what was.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field

from app.records.dispatches.retiming import TripTold
from app.records.dispatches.standing import Standing, ToldStep
from app.records.dispatches.steps import flight_id, stop_ids
from app.schemas.plan import RouteInput, TripInput


@dataclass(frozen=True)
class DoubtfulOrder:
    """An order of which nobody told."""

    customer: str
    vehicle: str
    time: float  # when the plan has it as served, seconds since plan start
    step: str  # to tell that it was
    failing: str  # to tell that it wasn't
    is_passed: bool  # the vehicle was there, by what else was told
    is_flying: bool  # the drone was launched, as was told, and flies to its end
    latest: float  # when it was over, by what was told of what lies behind


@dataclass(frozen=True)
class Answers:
    """What is known of orders of which nobody told, by customer."""

    served: Collection[str] = field(default_factory=frozenset)
    unserved: Collection[str] = field(default_factory=frozenset)


def doubts_of(route: RouteInput, standing: Standing, now: float) -> list[DoubtfulOrder]:
    """Return the orders of a route that it has as served by now, and of which nobody told."""
    begun = [TripTold(index, trip, standing).is_begun for index, trip in enumerate(route.trips)]
    return [doubt for index, trip in enumerate(route.trips) for doubt in _on_trip(
        route.vehicle, TripTold(index, trip, standing, any(begun[index + 1:])), standing, now)]


def _on_trip(vehicle: str, told: TripTold, standing: Standing,
             now: float) -> Iterator[DoubtfulOrder]:
    index, trip = told.index, told.planned
    for place, stop in enumerate(trip.stops):
        if stop.kind == "customer" and stop.departure <= now:
            (step,) = stop_ids(index, trip, place)
            if step not in standing:
                yield DoubtfulOrder(stop.customer, vehicle, stop.departure, step, step,
                                    told.has_left(place), False, told.latest(place, now))
    for sortie in trip.sorties:
        launch, recover = (flight_id(index, kind, sortie) for kind in ("launch", "recover"))
        if sortie.recovery_time <= now and recover not in standing and (
                launch not in standing or standing[launch].outcome == "done"):
            is_launched = launch in standing
            place = sortie.recovery_stop if is_launched else sortie.launch_stop
            for visit in sortie.customers:
                yield DoubtfulOrder(visit.customer, vehicle, sortie.recovery_time, recover,
                                    recover if is_launched else launch, told.has_left(place),
                                    is_launched, told.latest(place, now))


def answered(route: RouteInput, standing: Standing, doubts: Collection[DoubtfulOrder],
             answers: Answers, is_broken: bool, now: float) -> Mapping[str, ToldStep] | None:
    """Return how the steps of a route stand with what is known of those in doubt.

    None if the vehicle is where the plan has it.
    """
    if not standing and not is_broken:
        unserved = [doubt for doubt in doubts if doubt.customer in answers.unserved]
        if not unserved:
            return None
        if len(unserved) == len(doubts):
            return {}
        return _marked(doubts, [doubt for doubt in doubts if doubt not in unserved], unserved)
    served = [doubt for doubt in doubts if doubt.customer in answers.served]
    unserved = [doubt for doubt in doubts if doubt not in served and (doubt.is_passed or (
        doubt.is_flying and (is_broken or doubt.customer in answers.unserved)))]
    departed = {} if standing or not is_broken else _departed(route.trips[:1], now)
    return {**departed, **standing, **_marked(doubts, served, unserved)}


def _marked(doubts: Collection[DoubtfulOrder], served: Collection[DoubtfulOrder],
            unserved: Collection[DoubtfulOrder]) -> dict[str, ToldStep]:
    """Return steps in doubt as they were planned: done, or failed."""
    return {**{doubt.step: ToldStep("done", min(doubt.time, doubt.latest))
               for doubt in doubts if doubt in served},
            **{doubt.failing: ToldStep("failed", min(doubt.time, doubt.latest))
               for doubt in doubts if doubt in unserved}}


def _departed(trips: Collection[TripInput], now: float) -> dict[str, ToldStep]:
    """Return that a vehicle that broke down had left as planned: its parcels are aboard."""
    return {step: ToldStep("done", trip.stops[0].departure) for trip in trips
            if trip.stops and trip.stops[0].departure <= now
            for step in stop_ids(0, trip, 0)}
