"""What a client tells of vehicles -> the steps of the plan that it is of."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from pydantic_core import to_json

from app.records.days.events import (
    AnyEvent, DroneFlown, DroneLost, OrderPinned, VehicleArrived, VehicleBroken, VehicleDeparted,
    VehicleServed,
)
from app.records.dispatches.going_on import GROUNDING
from app.records.dispatches.rows import ToldRow
from app.records.dispatches.schemas import BREAKDOWN, EventKind, StepKind
from app.records.dispatches.standing import Standing, ToldStep
from app.records.dispatches.steps import flight_id, stop_ids
from app.schemas.plan import PlanInput, SortieInput, TripInput

LOST = "Did not come back"
assert LOST in GROUNDING

_COLUMNS = {"event_id", "at", "kind", "vehicle", "reason", "undone"}


@dataclass(frozen=True)
class PlannedStep:
    """A step of a vehicle in a plan."""

    vehicle: str
    step: str


@dataclass
class Steps:
    """Finds what events are of, in a plan and beside what was told of it already.

    Parameters
    ----------
    plan
        The day's plan.
    standings
        What was told of steps, by vehicle.
    """

    plan: PlanInput
    standings: dict[str, Standing] = field(default_factory=dict)

    def row(self, event: AnyEvent, time: int, stated: dict[str, Any]) -> ToldRow:
        """Return an event as it is kept, `stated` as its client wrote it. In place.

        What isn't of any step of the plan has none.
        """
        found, outcome = self._found(event), _outcome(event)
        if found is not None:
            self._note(found, outcome, event.at)
        vehicle = getattr(event, "vehicle", None) if found is None else found.vehicle
        if isinstance(event, OrderPinned) and event.undone:
            vehicle, stated = None, {"order": event.order}
        if vehicle is None and "drone" in stated:
            vehicle = str(stated["drone"]).partition("/")[0]
        reason = getattr(event, "reason", None)
        if isinstance(event, DroneLost) and found is not None:
            reason = LOST
        about = {name: value for name, value in stated.items() if name not in _COLUMNS}
        return ToldRow(event.event_id, event.kind, time, vehicle,
                       None if found is None else found.step,
                       None if found is None else outcome, reason,
                       to_json(about).decode() if about else None)

    def _note(self, found: PlannedStep, outcome: EventKind, at: float) -> None:
        """Know what the next event may build on. In place."""
        standing = dict(self.standings.get(found.vehicle, {}))
        if outcome == "undone":
            standing.pop(found.step, None)
        else:
            standing[found.step] = ToldStep(outcome, at)
        self.standings[found.vehicle] = standing

    def _found(self, event: AnyEvent) -> PlannedStep | None:
        """Return the step that an event is of."""
        if isinstance(event, VehicleBroken):
            return PlannedStep(event.vehicle, BREAKDOWN)
        if isinstance(event, VehicleDeparted):
            return self._end_of_trip(event.vehicle, 0, event.undone)
        if isinstance(event, VehicleArrived) and event.order is None:
            return self._end_of_trip(event.vehicle, -1, event.undone)
        if isinstance(event, VehicleServed):
            return next(self._served(event), None)
        if isinstance(event, DroneFlown | DroneLost):
            return next(self._flown(event), None)
        return None

    def _trips(self, vehicle: str | None) -> Iterator[tuple[str, int, TripInput]]:
        for route in self.plan.routes:
            if vehicle is None or route.vehicle == vehicle:
                for index, trip in enumerate(route.trips):
                    yield route.vehicle, index, trip

    def _is_told(self, vehicle: str, step: str) -> bool:
        return step in self.standings.get(vehicle, {})

    def _end_of_trip(self, vehicle: str, place: int, undone: bool) -> PlannedStep | None:
        """Return a trip's first or last step: of the first of which it wasn't told.

        Or, if that is taken back, of the last of which it was.
        """
        steps = [step for _, index, trip in self._trips(vehicle)
                 for step in stop_ids(index, trip, place % len(trip.stops))]
        fitting = [step for step in steps if self._is_told(vehicle, step) == undone]
        return PlannedStep(vehicle, fitting[-1 if undone else 0]) if fitting else None

    def _served(self, event: VehicleServed) -> Iterator[PlannedStep]:
        for vehicle, index, trip in self._trips(event.vehicle):
            for place, stop in enumerate(trip.stops):
                if stop.kind == "customer" and event.order in (stop.id, stop.customer):
                    yield PlannedStep(vehicle, stop_ids(index, trip, place)[0])
            for sortie in trip.sorties:
                if _flies_to(sortie, event.order):
                    launch = flight_id(index, "launch", sortie)
                    is_up = event.kind == "vehicle.served" or self._is_told(vehicle, launch)
                    yield PlannedStep(vehicle, flight_id(index, "recover", sortie) if is_up
                                      else launch)

    def _flown(self, event: DroneFlown | DroneLost) -> Iterator[PlannedStep]:
        """Yield the flights that an event may be of: of the drone, and not told of yet.

        A drone that is lost was launched.
        """
        kind: StepKind = "launch" if event.kind == "drone.launched" else "recover"
        order = getattr(event, "order", None)
        undone = getattr(event, "undone", False)
        for vehicle, index, trip in self._trips(event.drone.partition("/")[0]):
            for sortie in trip.sorties:
                step = flight_id(index, kind, sortie)
                if (sortie.drone == event.drone and self._is_told(vehicle, step) == undone
                        and (order is None or _flies_to(sortie, order))
                        and (not isinstance(event, DroneLost) or self._is_told(
                            vehicle, flight_id(index, "launch", sortie)))):
                    yield PlannedStep(vehicle, step)


def _flies_to(sortie: SortieInput, order: str) -> bool:
    return any(order in (visit.id, visit.customer) for visit in sortie.customers)


def _outcome(event: AnyEvent) -> EventKind:
    if getattr(event, "undone", False):
        return "undone"
    return "failed" if event.kind in ("vehicle.failed", "vehicle.broken", "drone.lost") else "done"
