"""What of a plan to go on from has departed, and what of that can't have happened so."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from app.requests.conversion.launches import launch_durations
from app.requests.conversion.names import number_in
from app.requests.conversion.units import thousandths
from app.schemas.errors import ErrorCode, InputError, json_path
from app.schemas.plan import MAX_INSTANT, RouteInput, TripInput
from app.schemas.request import ReplanInput
from app.schemas.vehicle import VehicleTypeInput

Path = tuple[str | int, ...]
Errors = Iterator[InputError]


def replan_error(code: ErrorCode, path: Path, message: str) -> InputError:
    return InputError(code=code, path=json_path(("replan", *path)), message=message)


@dataclass(frozen=True)
class DepartedPart:
    """The part of a trip that has departed."""

    left: int  # stops
    launched: tuple[int, ...]  # sorties
    launch_durations: list[int]  # ms, of all its sorties

    def __bool__(self) -> bool:
        return bool(self.left or self.launched)


def begun_of(trip: TripInput, kind: VehicleTypeInput | None, now: int) -> DepartedPart:
    left, durations = 0, launch_durations(kind, trip)
    while left < len(trip.stops) and thousandths(trip.stops[left].departure) <= now:
        left += 1
    return DepartedPart(left, tuple(
        index for index, sortie in enumerate(trip.sorties)
        if thousandths(sortie.launch_time) - durations[index] <= now), durations)


def as_whole(trip: TripInput, begun: DepartedPart) -> DepartedPart:
    """Return a trip that has begun as one that is made to its end."""
    return replace(begun, left=len(trip.stops), launched=tuple(range(len(trip.sorties))))


def committed(trip: TripInput, begun: DepartedPart) -> Iterator[tuple[Path, str]]:
    """Yield the customers of a trip to whom a vehicle is on its way, or where a drone is met."""
    meetings = {trip.sorties[index].recovery_stop for index in begun.launched}
    for place, stop in enumerate(trip.stops):
        if stop.kind == "customer" and (place <= begun.left or place in meetings):
            yield ("stops", place), stop.id
    for flight in begun.launched:
        for place, visit in enumerate(trip.sorties[flight].customers):
            yield ("sorties", flight, "customers", place), visit.id


def order_errors(path: Path, trip: TripInput, begun: DepartedPart, last_end: int,
                  is_done: bool) -> Errors:
    """What of a trip that has begun can't have happened in the order of its times."""
    time = last_end
    for place, stop in enumerate(trip.stops[:begun.left + 1]):
        instants = [("arrival", stop.arrival), ("service_start", stop.service_start),
                    ("departure", stop.departure)]
        for name, instant in instants:
            if not time <= thousandths(instant) <= thousandths(MAX_INSTANT):
                yield replan_error("TIMES_DISORDERED", (*path, "stops", place, name),
                             f"{instant:g} s lies before what comes ahead of it in the plan, and "
                             "has happened: order the times.")
                return
            time = thousandths(instant)
    for flight in begun.launched:
        yield from _flight_errors((*path, "sorties", flight), trip, flight, begun, is_done)


def _flight_errors(path: Path, trip: TripInput, flight: int, begun: DepartedPart,
                   is_done: bool) -> Errors:
    sortie = trip.sorties[flight]
    place = trip.stops[sortie.launch_stop]
    take_off = thousandths(sortie.launch_time)
    # Of a truck that broke down the place is no stop where it stood and served nobody.
    has_left = sortie.launch_stop < begun.left and not is_done
    if (sortie.launch_stop > begun.left
            or take_off - begun.launch_durations[flight] < thousandths(place.arrival)
            or (has_left and take_off > thousandths(place.departure))):
        yield replan_error("TIMES_DISORDERED", (*path, "launch_time"),
                     "The drone has been launched while the truck was not at the launch stop: "
                     "order the times.")
    time = take_off
    for index, visit in enumerate(sortie.customers):
        for name in ("arrival", "service_start", "departure"):
            instant = thousandths(getattr(visit, name))
            if not time <= instant <= thousandths(MAX_INSTANT):
                yield replan_error("TIMES_DISORDERED", (*path, "customers", index, name),
                             f"{instant / 1000:g} s lies before what comes ahead of it, and the "
                             "drone has been launched: order the times.")
                return
            time = instant
    if thousandths(sortie.recovery_time) < time:
        yield replan_error("TIMES_DISORDERED", (*path, "recovery_time"),
                     "The drone is recovered before it has served its customers, and has been "
                     "launched: order the times.")


def is_there(route: RouteInput, fleet: Mapping[str, VehicleTypeInput]) -> bool:
    """Tell whether a fleet still has the vehicle of a route, all of which is dropped if not."""
    number = number_in(f"{route.type}-", route.vehicle)
    return route.type in fleet and (number is None or number < fleet[route.type].count)


def with_what_is_there(replan: ReplanInput,
                       fleet: Sequence[VehicleTypeInput]) -> tuple[ReplanInput, list[int]]:
    """Return what to go on from without vehicles that are gone, and where the routes left were."""
    kinds = {kind.id: kind for kind in fleet}
    routes = [(index, route) for index, route in enumerate(replan.plan.routes)
              if is_there(route, kinds)]
    plan = replan.plan.model_copy(update={"routes": tuple(route for _, route in routes)})
    gone = names_gone(replan, kinds)
    named = [name for name in replan.unavailable if truck_of(name) not in gone]
    return (replan.model_copy(update={"plan": plan, "unavailable": named}),
            [index for index, _ in routes])


def names_gone(replan: ReplanInput, fleet: Mapping[str, VehicleTypeInput]) -> frozenset[str]:
    """Return the vehicles of a plan that a fleet doesn't have any more."""
    return frozenset(route.vehicle for route in replan.plan.routes if not is_there(route, fleet))


def truck_of(name: str) -> str:
    """Return the vehicle of a name, which may be that of its drone."""
    return name.rpartition("/drone-")[0] or name
