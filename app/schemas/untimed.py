"""A plan that a client sends and whose times it may leave out, so that they are made."""

from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel, Field

from app.schemas.plan import (
    Instant, PlanInput, RouteInput, SortieInput, StopInput, TripInput, VisitInput,
)


def _without_default(schema: dict[str, Any]) -> None:
    """Take the default out of a description: what is left out isn't 0. In place."""
    schema.pop("default", None)


def _made(description: str) -> Any:
    return Field(0.0, description=f"{description} Left out: made anew, with the vehicle's others.",
                 json_schema_extra=_without_default)


class UntimedVisitInput(VisitInput):
    """A customer served by a drone. Times in seconds since plan start."""

    arrival: Instant = _made("Arrival of the drone.")
    service_start: Instant = _made("Start of service.")
    departure: Instant = _made("Departure of the drone.")


class UntimedStopInput(StopInput):
    """A place where the truck halts. Times in seconds since plan start."""

    arrival: Instant = _made(
        "Arrival; at the trip's first stop, when loading is done, which is tried as a start where "
        "other times are made.")
    service_start: Instant = _made("Start of service; at depots the arrival.")
    departure: Instant = _made("Departure; at the trip's last stop, its end.")


class UntimedSortieInput(SortieInput):
    """One drone flight. Times in seconds since plan start."""

    customers: tuple[UntimedVisitInput, ...] = Field(description="Customers served, in order.")
    launch_time: Instant = _made("Take-off; the launch lies before it.")
    recovery_time: Instant = _made("End of the recovery.")


class UntimedTripInput(TripInput):
    """Depot to depot on one loading."""

    stops: tuple[UntimedStopInput, ...] = Field(
        description="Stops in order, where the trip begins first, where it ends last; an open "
        "route's last trip ends at its last customer.")
    sorties: tuple[UntimedSortieInput, ...] = Field(
        (), description="Drone flights of this trip.")


class UntimedRouteInput(RouteInput):
    """One vehicle's work."""

    trips: tuple[UntimedTripInput, ...] = Field(description="Trips in order.")

    @property
    def is_untimed(self) -> bool:
        """Whether any time is left out."""
        return any(not need <= part.model_fields_set for part, need in self._parts())

    @property
    def starts(self) -> list[float | None]:
        """When each trip's loading is done, as far as that is stated."""
        return [trip.stops[0].arrival
                if trip.stops and "arrival" in trip.stops[0].model_fields_set else None
                for trip in self.trips]

    def _parts(self) -> Iterator[tuple[BaseModel, frozenset[str]]]:
        for trip in self.trips:
            for stop in trip.stops:
                yield stop, HALT_TIMES
            for sortie in trip.sorties:
                yield sortie, SORTIE_TIMES
                for visit in sortie.customers:
                    yield visit, HALT_TIMES


HALT_TIMES = frozenset({"arrival", "service_start", "departure"})
SORTIE_TIMES = frozenset({"launch_time", "recovery_time"})


class UntimedPlanInput(PlanInput):
    """A plan, as `POST /plan` replied it, or of its decisions alone."""

    routes: tuple[UntimedRouteInput, ...] = Field(description="One entry per vehicle used.")
