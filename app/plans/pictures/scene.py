"""What a picture shows: a request and a plan for it, with its cost and where everything is."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from pydantic_core import from_json

from app.maps.airspace.zone import Zone
from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.replies import cost_reply, summary_reply
from app.plans.task import task_of
from app.requests.conversion.locating import at_addresses
from app.requests.conversion.names import called
from app.requests.conversion.places import PlacedRequest
from app.requests.plan_reading import read_plan
from app.schemas.customer import CustomerInput
from app.schemas.day import Day
from app.schemas.errors import InputError, InvalidRequestError, json_path
from app.schemas.fields import point_of
from app.schemas.plan import PlanInput, RouteInput, SortieInput, TripInput
from app.schemas.request import PlanRequest
from app.schemas.times import read_body
from app.schemas.vehicle import VehicleTypeInput
from model.problem import FloatArray
from model.travel.matrices import LocalProjection

Point = tuple[float, float]
Place = tuple[str, str]
"""Kind and id: a depot and a customer may share an id."""

METRES_PER_KM = 1000.0

MAX_LABEL = 28
"""Characters of an id in a picture."""


@dataclass(frozen=True)
class Layout:
    """Where things are, in km east and north."""

    points: Mapping[Place, Point]
    no_fly: tuple[FloatArray, ...]  # (corner, 2) each
    project: Callable[[FloatArray], FloatArray]  # of (place, 2) places as the request states them


@dataclass(frozen=True)
class DrawnPlan:
    """A plan that can be drawn: all that it names is there. Times in seconds."""

    request: PlanRequest
    plan: PlanInput
    cost: Mapping[str, float]
    summary: Mapping[str, Any]
    num_violations: int = 0
    published: Sequence[Zone] = ()  # zones beside those of the request

    @classmethod
    def judged(cls, request: PlanRequest, plan: PlanInput,
               roads: Roads = NO_ROADS) -> "DrawnPlan":
        """Return a plan of a file with what it truly costs; it may break rules.

        Raises
        ------
        InvalidRequestError
            If it names what the request doesn't have, or a trip or sortie has no beginning or end.
        """
        task = task_of(request, roads=roads)
        if task.places is not None:
            request = task.places.placed.request
        solution = read_plan(plan, task.problem)
        shapeless = list(_shape_errors(request, plan))
        if shapeless:
            raise InvalidRequestError(shapeless)
        evaluation = task.check(solution)
        return cls(request, plan, cost_reply(evaluation.cost),
                   summary_reply(task.problem, solution, evaluation),
                   len(evaluation.violations), roads.zones)

    @classmethod
    def replied(cls, request: PlanRequest, reply: bytes,
                published: Sequence[Zone] = ()) -> "DrawnPlan":
        """Return a plan as the service replied it, which has been checked."""
        stated = from_json(reply)
        plan = read_body(PlanInput, reply)
        return cls(at_addresses(request, plan), plan, stated["cost"],
                   stated["summary"], published=published)

    @cached_property
    def customers(self) -> Mapping[str, CustomerInput]:
        """Customers by id."""
        return {customer.id: customer for customer in self.request.customers}

    @cached_property
    def types(self) -> Mapping[str, VehicleTypeInput]:
        """Vehicle types by id."""
        return {kind.id: kind for kind in self.request.fleet}

    def called(self, vehicle: str) -> str:
        """Return what people call a vehicle."""
        return called(self.request.fleet, vehicle)

    @cached_property
    def layout(self) -> Layout | None:
        """Where things are; None if some place has no location."""
        placed = PlacedRequest(self.request)
        places = placed.places
        located = [point for place in places
                  if (point := point_of(place.location)) is not None]
        if len(located) < len(places):
            return None
        degrees_or_units = np.array(located, dtype=np.float64)
        scale = self.request.planar_unit / METRES_PER_KM
        projection = (LocalProjection.around(degrees_or_units)
                      if self.request.coordinate_system == "geographic" else None)

        def planar(points: FloatArray) -> FloatArray:
            return (points * scale if projection is None
                    else projection.project(points) / METRES_PER_KM)

        points = planar(degrees_or_units)
        return Layout(
            {name: (float(x), float(y)) for name, (x, y) in zip(placed.names, points, strict=True)},
            tuple(planar(np.array(ring, dtype=np.float64))
                  for ring in self.request.airspace.no_fly),
            planar)

    @property
    def headline(self) -> str:
        """The plan in one line."""
        summary = self.summary
        return " · ".join((
            f"Cost {self.cost['total']:,.2f} {self.request.currency or ''}".rstrip(),
            f"{summary['served']:,} of {counted(summary['customers'], 'customer')} served",
            counted(summary["vehicles"], "vehicle"), counted(summary["trips"], "trip"),
            counted(summary["sorties"], "sortie")))

    @property
    def note(self) -> str:
        """What else has to be said, or nothing."""
        notes = []
        if self.num_violations:
            notes.append(f"This plan breaks rules ({self.num_violations}): tandem check lists "
                         "them.")
        if self.layout is None:
            notes.append("There is no map, since not every place has a location.")
        return " ".join(notes)

    @property
    def subline(self) -> str:
        """Distances, end and what else has to be said."""
        summary = self.summary
        driven = f"{summary['distance'] / METRES_PER_KM:,.1f} km driven"
        flown = (f"{summary['drone_distance'] / METRES_PER_KM:,.1f} km flown"
                 if summary["sorties"] else "")
        end = f"last return at {self.clock(self.end)}"
        return " · ".join(part for part in (driven, flown, end, self.note) if part)

    @property
    def end(self) -> float:
        """When the last vehicle is back."""
        return max((route.trips[-1].stops[-1].departure for route in self.plan.routes
                    if route.trips), default=0.0)

    @cached_property
    def day(self) -> Day | None:
        """The plan's day; None if it is not stated."""
        return self.request.day

    def clock(self, seconds: float) -> str:
        """Return an instant as h:mm, rounded to the minute: of the day, or since plan start."""
        return clock(seconds) if self.day is None else self.day.to_the_minute(seconds)


def counted(number: int, noun: str) -> str:
    """Return a number with its noun, such as `2 trips`."""
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def clock(seconds: float) -> str:
    """Return an instant as h:mm, rounded to the minute."""
    minutes = round(seconds / 60)
    sign = "-" if minutes < 0 else ""
    return f"{sign}{abs(minutes) // 60}:{abs(minutes) % 60:02d}"


def label(name: str) -> str:
    """Return an id that can be shown anywhere: on one line, not too long, without controls."""
    shown = "".join(character if character.isprintable() else "\N{REPLACEMENT CHARACTER}"
                    for character in name[:MAX_LABEL + 1])
    return shown if len(shown) <= MAX_LABEL else shown[:MAX_LABEL - 1] + "…"


def flown_places(trip: TripInput, sortie: SortieInput) -> list[Place]:
    """Return where a sortie goes, from launch to recovery."""
    launch, recovery = trip.stops[sortie.launch_stop], trip.stops[sortie.recovery_stop]
    return [(launch.kind, launch.id), *(("customer", visit.id) for visit in sortie.customers),
            (recovery.kind, recovery.id)]


def all_trips(routes: Iterable[RouteInput]) -> Iterator[tuple[int, int, RouteInput, TripInput]]:
    """Yield every trip with the numbers of its route and of itself."""
    for index, route in enumerate(routes):
        for number, trip in enumerate(route.trips):
            yield index, number, route, trip


def _shape_errors(request: PlanRequest, plan: PlanInput) -> Iterator[InputError]:
    """Yield what has no two ends that a line could be drawn between, unless it is open."""
    is_open = {kind.id: kind.end == "open" for kind in request.fleet}
    for index, number, route, trip in all_trips(plan.routes):
        path = ("routes", index, "trips", number)
        stops = len(trip.stops)
        least = 1 if is_open[route.type] and number == len(route.trips) - 1 else 2
        if stops < least:
            yield InputError(code="TRIP_SHAPE", path=json_path(path),
                             message="A trip has two stops at least, of an open route one: correct "
                             "it.")
        for flight, sortie in enumerate(trip.sorties):
            if not 0 <= sortie.launch_stop <= sortie.recovery_stop < stops:
                yield InputError(
                    code="SORTIE_STOPS", path=json_path((*path, "sorties", flight)),
                    message=f"The trip has {stops} stops, and a sortie ends no earlier than it "
                    "begins: correct launch_stop and recovery_stop.")
