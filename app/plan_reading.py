"""A plan as `POST /plan` sent it -> `Solution`, so that it can be checked again."""

import re
from collections.abc import Sequence
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from app.errors import ErrorCode, InputError, InvalidRequestError, json_path, schema_error
from app.reading import read_json
from app.units import thousandths
from model.problem import MAX_QUANTITY, Problem
from model.solution import Route, Solution, Sortie, Stop, Trip, Visit

Instant = Annotated[float, Field(ge=-MAX_QUANTITY, le=MAX_QUANTITY)]

_UNKNOWN: dict[str, ErrorCode] = {
    "customer": "UNKNOWN_CUSTOMER",
    "depot": "UNKNOWN_DEPOT",
    "vehicle type": "UNKNOWN_VEHICLE_TYPE",
}


class _Plan(BaseModel):
    """What a plan decides; what follows from it, such as loads, is ignored."""

    model_config = ConfigDict(strict=True, allow_inf_nan=False)


class PlannedVisit(_Plan):
    """A customer served by a drone."""

    id: str
    arrival: Instant
    service_start: Instant
    departure: Instant


class PlannedStop(PlannedVisit):
    """A place where the truck halts."""

    kind: Literal["depot", "customer"]


class PlannedSortie(_Plan):
    """One drone flight."""

    drone: str
    launch_stop: int
    recovery_stop: int
    customers: list[PlannedVisit]
    launch_time: Instant
    recovery_time: Instant


class PlannedTrip(_Plan):
    """Depot to depot."""

    stops: list[PlannedStop]
    sorties: list[PlannedSortie] = []


class PlannedRoute(_Plan):
    """One vehicle's trips."""

    vehicle: str
    type: str
    trips: list[PlannedTrip]


class LeftOut(_Plan):
    """A customer left out."""

    id: str


class PlannedPlan(_Plan):
    """A plan."""

    routes: list[PlannedRoute]
    unassigned: list[LeftOut] = []


def plan_to_solution(body: bytes, problem: Problem) -> Solution:
    """Return the plan for `problem` that `body` holds.

    Raises
    ------
    NotJsonError
        If `body` is not JSON.
    InvalidRequestError
        If it holds no plan, or names what `problem` doesn't have.
    """
    try:
        plan = PlannedPlan.model_validate_json(body)
    except ValidationError as error:
        read_json(body)
        details = error.errors(include_url=False)
        raise InvalidRequestError([schema_error(item) for item in details]) from error
    reader = _PlanReader(problem)
    routes = tuple(reader.route(("routes", index), route)
                   for index, route in enumerate(plan.routes))
    unassigned = tuple(reader.customer(("unassigned", index, "id"), left_out.id)
                       for index, left_out in enumerate(plan.unassigned))
    if reader.errors:
        raise InvalidRequestError(reader.errors)
    return Solution(routes, unassigned)


class _PlanReader:
    """Finds what a plan names; `errors` collects what isn't there."""

    def __init__(self, problem: Problem) -> None:
        self.errors: list[InputError] = []
        self._problem = problem
        self._types = {kind.id: index for index, kind in enumerate(problem.vehicle_types)}
        self._depots = {depot.id: node for node, depot in enumerate(problem.depots)}
        self._customers = {customer.id: node for node, customer
                           in enumerate(problem.customers, start=problem.num_depots)}

    def route(self, path: tuple[str | int, ...], route: PlannedRoute) -> Route:
        vehicle_type = self._find((*path, "type"), "vehicle type", self._types, route.type)
        vehicle = self._number((*path, "vehicle"), f"{route.type}-", route.vehicle)
        drones = self._problem.vehicle_types[vehicle_type].drones
        recovery_duration = 0 if drones is None else drones.recovery_duration
        trips = tuple(
            self._trip((*path, "trips", index), trip, route.vehicle, recovery_duration)
            for index, trip in enumerate(route.trips)
        )
        return Route(vehicle_type, vehicle, trips)

    def customer(self, path: tuple[str | int, ...], name: str) -> int:
        return self._find(path, "customer", self._customers, name)

    def _trip(self, path: tuple[str | int, ...], trip: PlannedTrip, vehicle: str,
              recovery_duration: int) -> Trip:
        return Trip(
            stops=tuple(self._stop((*path, "stops", index), stop)
                        for index, stop in enumerate(trip.stops)),
            sorties=tuple(self._sortie((*path, "sorties", index), sortie, vehicle,
                                       recovery_duration)
                          for index, sortie in enumerate(trip.sorties)),
        )

    def _stop(self, path: tuple[str | int, ...], stop: PlannedStop) -> Stop:
        known = self._depots if stop.kind == "depot" else self._customers
        return Stop(
            node=self._find((*path, "id"), stop.kind, known, stop.id),
            arrival=thousandths(stop.arrival),
            service_start=thousandths(stop.service_start),
            departure=thousandths(stop.departure),
        )

    def _sortie(self, path: tuple[str | int, ...], sortie: PlannedSortie, vehicle: str,
                recovery_duration: int) -> Sortie:
        recovery_time = thousandths(sortie.recovery_time)
        return Sortie(
            drone=self._number((*path, "drone"), f"{vehicle}/drone-", sortie.drone),
            launch_stop=sortie.launch_stop,
            recovery_stop=sortie.recovery_stop,
            visits=self._visits((*path, "customers"), sortie.customers),
            launch_time=thousandths(sortie.launch_time),
            recovery_start=recovery_time - recovery_duration,
            recovery_time=recovery_time,
        )

    def _visits(self, path: tuple[str | int, ...],
                visits: Sequence[PlannedVisit]) -> tuple[Visit, ...]:
        return tuple(
            Visit(
                node=self.customer((*path, index, "id"), visit.id),
                arrival=thousandths(visit.arrival),
                service_start=thousandths(visit.service_start),
                departure=thousandths(visit.departure),
            )
            for index, visit in enumerate(visits)
        )

    def _find(self, path: tuple[str | int, ...], kind: str, known: dict[str, int],
              name: str) -> int:
        if name not in known:
            message = f"The problem has no {kind} {name!r}: use the id of one it has."
            self.errors.append(InputError(code=_UNKNOWN[kind], path=json_path(path),
                                          message=message))
        return known.get(name, 0)

    def _number(self, path: tuple[str | int, ...], prefix: str, name: str) -> int:
        """Return the 0-based number at the end of a vehicle's or drone's name."""
        match = re.fullmatch(re.escape(prefix) + "([1-9][0-9]{0,8})", name)
        if match is None:
            message = f"The name must be {prefix!r} and a number from 1: correct it."
            self.errors.append(InputError(code="WRONG_NAME", path=json_path(path),
                                          message=message))
            return 0
        return int(match[1]) - 1
