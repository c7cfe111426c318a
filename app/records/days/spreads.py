"""How far a day's times are off its plan: stated, or by what vehicles told so far.

Each way and service that was told is compared with the plan that was made before. How many there
were, and how far they were off, is kept with the plan that follows, in `plan.changed`.
"""

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from itertools import pairwise

from app.records.days.fold import Data, Pace, ToldDay
from app.records.days.rows import Begun, LoggedEvent
from app.records.dispatches.standing import Standing
from app.records.dispatches.steps import stop_ids
from app.schemas.lateness import SERVICE, TRAVEL
from app.schemas.plan import PlanInput, RouteInput, StopInput, TripInput, VisitInput

WORTH = 10
"""So many observed ways the usual spread is worth."""

FURTHEST = 25.0
"""Most that one way counts, as the square of how often it is off by the usual spread: a lunch says
little about traffic."""

LEAST, MOST = 0.3, 4.0
"""Of the usual spread: what is observed never tells less, or more."""

SLACK = 1.0
"""Seconds within which nobody waits."""


def risk_of(begun: Begun, told: ToldDay) -> Data:
    """Return what a day's plans ask for as `options.lateness_risk`."""
    stated = begun.problem.get("options", {}).get("lateness_risk")
    if stated is not None and "spread" in stated:
        return dict(stated)
    off = ((WORTH + told.pace.squares) / (WORTH + told.pace.ways)) ** 0.5
    share = min(max(off, LEAST), MOST)
    return {**(stated or {}), "spread": {"travel": TRAVEL * share, "service": SERVICE * share}}


def is_stated(begun: Begun) -> bool:
    """Tell whether a day's problem asks for chances of being late."""
    return begun.problem.get("options", {}).get("lateness_risk") is not None


def without_chances(plan: Data) -> Data:
    """Return a plan's reply as if nobody had asked for chances."""
    plan.pop("lateness", None)
    plan["cost"].pop("lateness_risk", None)
    for route in plan["routes"]:
        for trip in route["trips"]:
            for halt in (*trip["stops"], *(visit for sortie in trip["sorties"]
                                           for visit in sortie["customers"])):
                if isinstance(halt["lateness"], dict):
                    halt["lateness"] = halt["lateness"]["seconds"]
    return plan


def observed(before: PlanInput | None, told: ToldDay, log: Collection[LoggedEvent],
             seen: int) -> Pace:
    """Return how far off a plan what was told since was, `seen` being the last event before it."""
    new = {(event.vehicle, event.step) for event in log if event.number > seen}
    squares = [min(square, FURTHEST)
               for route in (before or PlanInput(routes=())).routes
               for square in _squares(route, told.standings.get(route.vehicle, {}), new)]
    return Pace(len(squares), sum(squares))


@dataclass(frozen=True)
class _Told:
    """A stop of which was told when it was over."""

    stop: StopInput
    time: float
    is_new: bool


def _squares(route: RouteInput, standing: Standing,
             new: Collection[tuple[str | None, str | None]]) -> Iterator[float]:
    """Yield of each way and service by how often the usual spread they are off, squared."""
    for index, trip in enumerate(route.trips):
        for first, second in pairwise(_told(index, trip, standing, route.vehicle, new)):
            if first is None or second is None or not second.is_new:
                continue
            way = second.stop.arrival - first.stop.departure
            service = second.stop.departure - second.stop.service_start
            waits = second.stop.service_start - second.stop.arrival - (second.stop.setup or 0.0)
            usual = (TRAVEL * way) ** 2 + (SERVICE * service) ** 2
            if usual > 0 and waits <= SLACK:
                planned = second.stop.departure - first.stop.departure
                yield (second.time - first.time - planned) ** 2 / usual


def _told(index: int, trip: TripInput, standing: Standing, vehicle: str,
          new: Collection[tuple[str | None, str | None]]) -> Iterator[_Told | None]:
    """Yield a trip's stops but the last; None: nothing was told, or it met drones there."""
    meetings = {place for sortie in trip.sorties
                for place in (sortie.launch_stop, sortie.recovery_stop)}
    for place, stop in enumerate(trip.stops[:-1]):
        steps = [step for step in stop_ids(index, trip, place) if step in standing]
        if not steps or place in meetings or standing[steps[0]].outcome != "done":
            yield None
        else:
            yield _Told(stop, standing[steps[0]].time, (vehicle, steps[0]) in new)


def chance_of(visit: StopInput | VisitInput) -> Data:
    """Return what a day's plan tells of when somebody comes; nothing if it was made without."""
    told = visit.lateness if isinstance(visit.lateness, dict) else {}
    return {name: each for name, each in told.items() if name != "seconds"}
