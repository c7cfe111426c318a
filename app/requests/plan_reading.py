"""A plan as `POST /plan` sent it -> `Solution`, so that it can be checked again or gone on from."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TypeVar

from pydantic import ValidationError

from app.requests.conversion.names import number_in
from app.requests.conversion.units import thousandths
from app.requests.plan_names import Known, KnownType
from app.requests.reading import read_json
from app.schemas.driving import REST_ID
from app.schemas.errors import ErrorCode, InputError, InvalidRequestError, json_path, schema_errors
from app.schemas.hints import with_hints
from app.schemas.plan import (
    ON_THE_WAY, PlanInput, RouteInput, SortieInput, StopInput, TripInput, VisitInput,
)
from app.schemas.times import read_body
from model.judge.clock import with_all_setups
from model.problem import REST, Problem, VehicleType
from model.solution import (
    BreakPlace, Charge, Route, Solution, Sortie, Stop, TakenBreak, Trip, Visit,
)

NO_MORE = -1
"""Node of a customer, or a launch site, that a plan has and the problem no longer has."""

Path = tuple[str | int, ...]
Key = TypeVar("Key")
Value = TypeVar("Value")
_UNKNOWN: dict[str, ErrorCode] = {
    "customer": "UNKNOWN_CUSTOMER",
    "depot": "UNKNOWN_DEPOT",
    "start": "UNKNOWN_DEPOT",
    "end": "UNKNOWN_DEPOT",
    "launch_site": "UNKNOWN_DEPOT",
    "vehicle type": "UNKNOWN_VEHICLE_TYPE",
    "break": "UNKNOWN_BREAK",
}


def plan_to_solution(body: bytes, problem: Problem) -> Solution:
    """Return the plan for `problem` that `body` holds.

    Raises
    ------
    NotJsonError
        If `body` is not JSON.
    InvalidRequestError
        If it holds no plan, or names what `problem` doesn't have.
    """
    return read_plan(parse_plan(body), problem)


def parse_plan(body: bytes) -> PlanInput:
    """Return the plan that `body` holds, whatever it names.

    Raises
    ------
    NotJsonError
        If `body` is not JSON.
    InvalidRequestError
        If it holds no plan.
    """
    try:
        return read_body(PlanInput, body)
    except ValidationError as error:
        read_json(body)
        found = schema_errors(error.errors(include_url=False))
        raise InvalidRequestError(with_hints(found, PlanInput)) from error


def read_plan(plan: PlanInput, problem: Problem, path: Path = ()) -> Solution:
    """Return a plan for `problem`; `path` is where it is in the request.

    Raises
    ------
    InvalidRequestError
        If it names what `problem` doesn't have.
    """
    reader = _PlanReader(Known.by(problem), None)
    solution = reader.plan(plan, path)
    if reader.errors:
        raise InvalidRequestError(reader.errors)
    return with_all_setups(problem, _by_parts(problem, solution))


def plan_errors(plan: PlanInput, known: "Known", path: Path = ()) -> list[InputError]:
    """Return an error for all that a plan names and that isn't known."""
    reader = _PlanReader(known, None)
    reader.plan(plan, path)
    return reader.errors


def read_earlier_plan(plan: PlanInput, problem: Problem, path: Path) -> Solution:
    """Return a plan made before something was taken away, which is at `path` of the request.

    Customers and launch sites that are gone become `NO_MORE`, breaks are left out, and trips begin
    and end where vehicles of their type do.

    Raises
    ------
    InvalidRequestError
        If it names vehicles that `problem` doesn't have.
    """
    reader = _PlanReader(Known.by(problem), NO_MORE)
    solution = reader.plan(plan, path)
    if reader.errors:
        raise InvalidRequestError(reader.errors)
    return with_all_setups(problem, _by_parts(problem, solution))


def _by_parts(problem: Problem, solution: Solution) -> Solution:
    """Return a plan whose vehicles are told by the parts of their types, if these have any."""
    kinds = problem.vehicle_types
    if all(kind.part_of is None for kind in kinds):
        return solution
    return replace(solution, routes=tuple([
        Route(*problem.find_vehicle(kinds[route.vehicle_type].type_id, route.vehicle), route.trips)
        for route in solution.routes]))


def _places(stops: Sequence[StopInput]) -> dict[int, int]:
    """Return the index of each stop among those that are no breaks."""
    places = [index for index, stop in enumerate(stops) if stop.kind != "break"]
    return {index: place for place, index in enumerate(places)}


def _break_place(stops: Sequence[StopInput], index: int) -> BreakPlace:
    """Return where a break is taken: at once, at the end of the leg, or on the way."""
    first = index
    while first > 0 and stops[first].kind == "break" and (
            _is_instant(stops[first - 1].departure, stops[first].arrival)):
        first -= 1
    if stops[first].kind != "break":
        return "departure"
    last = index
    while last + 1 < len(stops) and stops[last].kind == "break" and (
            _is_instant(stops[last].departure, stops[last + 1].arrival)):
        last += 1
    return "way" if stops[last].kind == "break" else "arrival"


def _is_instant(end: float, begin: float) -> bool:
    """Tell whether two times are one, in milliseconds."""
    return thousandths(end) == thousandths(begin)


class _PlanReader:
    """Finds what a plan names; `errors` collects what isn't there.

    With a node for what was `cancelled` customers and launch sites that aren't there are at that,
    breaks are left out, and where vehicles start and end is as it is now.
    """

    def __init__(self, known: Known, cancelled: int | None) -> None:
        self.errors: list[InputError] = []
        self._known = known
        self._cancelled = cancelled

    def plan(self, plan: PlanInput, path: Path) -> Solution:
        routes = tuple(self._route((*path, "routes", index), route)
                       for index, route in enumerate(plan.routes))
        unassigned = [self._customer((*path, "unassigned", index, "id"), left_out.id)
                      for index, left_out in enumerate(plan.unassigned)]
        return Solution(routes, tuple(node for node in unassigned if node != self._cancelled))

    def _route(self, path: Path, route: RouteInput) -> Route:
        kind = self._find((*path, "type"), "vehicle type", self._known.types, route.type,
                          route.type, KnownType())
        vehicle = self._number((*path, "vehicle"), f"{route.type}-", route.vehicle)
        trips = [self._trip((*path, "trips", index), trip, route.vehicle, kind)
                 for index, trip in enumerate(route.trips)]
        if trips and kind.nowhere is not None:
            trips[-1] = self._open_ended(trips[-1], route.trips[-1], kind.nowhere)
        return Route(kind.number, vehicle, tuple(trips))

    def _open_ended(self, trip: Trip, stated: TripInput, nowhere: int) -> Trip:
        """Return a trip that ends nowhere, if it ends at its last stop."""
        if not trip.stops or (len(trip.stops) > 1 and stated.stops[-1].kind not in ON_THE_WAY):
            return trip
        end = thousandths(stated.stops[-1].departure)
        return replace(trip, stops=(*trip.stops, Stop(nowhere, end, end, end)))

    def _customer(self, path: Path, name: str) -> int:
        customers = self._known.customers
        if self._cancelled is not None and customers is not None:
            return customers.get(name, self._cancelled)
        return self._find(path, "customer", customers, name, name, 0)

    def _trip(self, path: Path, trip: TripInput, vehicle: str, kind: KnownType) -> Trip:
        charges = tuple(Charge(thousandths(each.start), thousandths(each.end))
                        for each in trip.charging)
        stops = tuple(self._stop((*path, "stops", index), stop, kind)
                      for index, stop in enumerate(trip.stops) if stop.kind != "break")
        sorties = tuple(self._sortie((*path, "sorties", index), sortie, vehicle, kind)
                        for index, sortie in enumerate(trip.sorties))
        if len(stops) == len(trip.stops):
            return Trip(stops, sorties, (), charges)
        places = _places(trip.stops)
        flown = tuple(replace(sortie, launch_stop=places.get(sortie.launch_stop, -1),
                              recovery_stop=places.get(sortie.recovery_stop, -1))
                      for sortie in sorties)
        return Trip(stops, flown, tuple(self._breaks(path, trip, kind)))

    def _breaks(self, path: Path, trip: TripInput, kind: KnownType) -> Iterator[TakenBreak]:
        """Yield the breaks of a trip; their places follow from the times of those that are left."""
        known = None
        if kind.kind is not None:
            known = {each.id: number for number, each in enumerate(kind.kind.breaks)}
            known |= {} if kind.kind.driving is None else {REST_ID: REST}
        left = [(index, stop) for index, stop in enumerate(trip.stops)
                if stop.kind != "break" or not self._is_cancelled(known, stop.id)]
        stops, before = [stop for _, stop in left], -1
        for place, (index, stop) in enumerate(left):
            if stop.kind != "break":
                before += 1
                continue
            number = self._find((*path, "stops", index, "id"), "break", known, stop.id, stop.id, 0)
            yield TakenBreak(number, before, _break_place(stops, place),
                             thousandths(stop.arrival), thousandths(stop.service_start),
                             thousandths(stop.departure))

    def _stop(self, path: Path, stop: StopInput, kind: KnownType) -> Stop:
        node = self._place((*path, "id"), stop, kind.kind, path[-1] == 0)
        return Stop(
            is_launch_site=stop.kind == "launch_site" and node != NO_MORE,
            node=node,
            arrival=thousandths(stop.arrival),
            service_start=thousandths(stop.service_start),
            departure=thousandths(stop.departure),
        )

    def _place(self, path: Path, stop: StopInput, kind: VehicleType | None,
               is_first: bool) -> int:
        if stop.kind == "customer":
            return self._customer(path, stop.id)
        if stop.kind == "depot":
            if kind is not None and self._is_cancelled(self._known.depots, stop.id):
                return kind.begins_at if is_first else kind.ends_at
            return self._find(path, "depot", self._known.depots, stop.id, stop.id, 0)
        place = stop.kind, stop.id
        if kind is not None and self._is_cancelled(self._known.stands, place):
            return {"start": kind.begins_at, "end": kind.ends_at}.get(stop.kind, NO_MORE)
        return self._find(path, stop.kind, self._known.stands, place, stop.id, 0)

    def _is_cancelled(self, known: Mapping[Key, Value] | None, key: Key) -> bool:
        """Tell whether something isn't there any more, in a plan that may name such."""
        return self._cancelled is not None and known is not None and key not in known

    def _sortie(self, path: Path, sortie: SortieInput, vehicle: str, kind: KnownType) -> Sortie:
        recovery_time = thousandths(sortie.recovery_time)
        drone = self._number((*path, "drone"), f"{vehicle}/drone-", sortie.drone)
        return Sortie(
            drone=drone,
            launch_stop=sortie.launch_stop,
            recovery_stop=sortie.recovery_stop,
            visits=self._visits((*path, "customers"), sortie.customers),
            launch_time=thousandths(sortie.launch_time),
            recovery_start=recovery_time - kind.recovery_duration(drone),
            recovery_time=recovery_time,
        )

    def _visits(self, path: Path, visits: Sequence[VisitInput]) -> tuple[Visit, ...]:
        return tuple(
            Visit(
                node=self._customer((*path, index, "id"), visit.id),
                arrival=thousandths(visit.arrival),
                service_start=thousandths(visit.service_start),
                departure=thousandths(visit.departure),
            )
            for index, visit in enumerate(visits)
        )

    def _find(self, path: Path, kind: str, known: Mapping[Key, Value] | None, key: Key, name: str,
              otherwise: Value) -> Value:
        if known is None:
            return otherwise
        if key not in known:
            message = f"The problem has no {kind} {name!r}: use the id of one it has."
            self.errors.append(InputError(code=_UNKNOWN[kind], path=json_path(path),
                                          message=message))
        return known.get(key, otherwise)

    def _number(self, path: Path, prefix: str, name: str) -> int:
        """Return the 0-based number at the end of a vehicle's or drone's name."""
        number = number_in(prefix, name)
        if number is None:
            message = f"The name must be {prefix!r} and a number from 1: correct it."
            self.errors.append(InputError(code="WRONG_NAME", path=json_path(path),
                                          message=message))
            return 0
        return number
