"""What the schema can't tell of a plan to go on from, by itself and beside its request."""

from collections import Counter
from collections.abc import Iterator, Sequence

from app.requests.conversion.names import drone_number, number_in, read_name
from app.requests.conversion.units import thousandths
from app.requests.ends import named_otherwise
from app.requests.plan_departed import (
    DepartedPart, Errors, Path, as_whole, begun_of, committed, is_there, names_gone, order_errors,
    truck_of,
)
from app.requests.plan_departed import replan_error as _error
from app.requests.plan_names import Names, PlaceName
from app.schemas.driving import REST_ID
from app.schemas.errors import InputError, json_path
from app.schemas.plan import ON_THE_WAY, RouteInput, StopInput, TripInput
from app.schemas.request import ReplanInput
from app.schemas.vehicle import VehicleTypeInput


def replan_errors(replan: ReplanInput | None, names: Names) -> list[InputError]:
    """Return every error of what is to be replanned, by place in the request."""
    if replan is None:
        return []
    checker = _Checker(replan, names)
    return [*checker.routes(), *checker.customers(), *checker.unavailable(), *checker.pinned(),
            *checker.concerned(), *checker.doubtful(), *checker.instants()]


class _Checker:
    """Compares a plan with its request."""

    def __init__(self, replan: ReplanInput, names: Names) -> None:
        self._replan = replan
        self._names = names
        self._now = (-1 if replan.freeze_before is None
                     else thousandths(replan.freeze_before))
        self._vehicles = {route.vehicle for route in replan.plan.routes}

    def routes(self) -> Errors:
        """What is wrong with the routes."""
        seen: set[str] = set()
        for index, route in enumerate(self._replan.plan.routes):
            path: Path = ("plan", "routes", index)
            if route.vehicle in seen:
                yield _error("DUPLICATE_VEHICLE", (*path, "vehicle"),
                             "Another route has the same vehicle: give each its own.")
            seen.add(route.vehicle)
            kind = None if self._names.fleet is None else self._names.fleet.get(route.type)
            has_begun = any(begun_of(trip, kind, self._now) for trip in route.trips)
            if self._names.fleet is not None and kind is None and has_begun:
                yield _error("UNKNOWN_VEHICLE_TYPE", (*path, "type"),
                             f"The fleet has no type {route.type!r}, and the vehicle has left by "
                             "replan.freeze_before: use the id of one it has.")
            yield from self._name_errors((*path, "vehicle"), route, kind, has_begun)
            if self._names.fleet is not None and kind is None:
                continue
            yield from self._trips(path, route, kind)

    def _name_errors(self, path: Path, route: RouteInput, kind: VehicleTypeInput | None,
                     has_begun: bool) -> Errors:
        number = number_in(f"{route.type}-", route.vehicle)
        if number is None:
            yield _error("WRONG_NAME", path, f"The name must be '{route.type}-' and a number from "
                         "1: correct it.")
        elif kind is not None and number >= kind.count and has_begun:
            yield _error("UNKNOWN_VEHICLE", path,
                         f"The fleet has {kind.count} of this type: raise its count, and list the "
                         "vehicle in replan.unavailable if it does nothing more.")

    def _trips(self, path: Path, route: RouteInput, kind: VehicleTypeInput | None) -> Errors:
        free = last_end = 0
        for number, trip in enumerate(route.trips):
            here = (*path, "trips", number)
            is_last = number == len(route.trips) - 1
            is_open = (is_last and kind is not None and kind.end == "open"
                       and (len(trip.stops) < 2 or trip.stops[-1].kind in ON_THE_WAY))
            begun = happened = begun_of(trip, kind, self._now)
            served = {stop.id for stop in trip.stops} | {
                visit.id for sortie in trip.sorties for visit in sortie.customers}
            is_whole = not self._names.shipment_ends.isdisjoint(served) or (
                kind is not None and (kind.breaks or kind.driving_rules))
            if begun and is_whole and (route.vehicle not in self._replan.unavailable
                                       or (kind is not None and kind.flies)):
                begun = as_whole(trip, begun)
            shape = [*self._shape_errors(here, trip, route.vehicle, is_open, bool(begun)),
                     *self._kind_errors(here, trip, kind)]
            yield from shape
            if shape or not begun:
                free += 1
                continue
            if free:
                yield _error("TIMES_DISORDERED", here,
                             "The trip has begun before the one ahead of it: order their times.")
            if kind is not None:
                begin = self._names.begin(kind, route.trips[number - 1] if number else None)
                yield from self._place_errors(here, trip, kind, [begin] if begin else None,
                                              self._names.ends(kind, is_last))
                yield from self._begun_errors(here, trip, kind, begun)
                yield from self._gone_errors(here, trip, kind, begun)
            is_done = (happened.left == len(trip.stops)
                       or route.vehicle in self._replan.unavailable)
            yield from order_errors(here, trip, happened, last_end, is_done)
            last_end = thousandths(trip.stops[-1].departure)
            # What follows a trip that is not over has not begun.
            free += begun.left < len(trip.stops)

    def _shape_errors(self, path: Path, trip: TripInput, vehicle: str, is_open: bool,
                      has_begun: bool) -> Errors:
        kinds = [stop.kind for stop in trip.stops]
        inner = kinds[1:] if is_open else kinds[1:-1]
        if (len(kinds) < 2 - is_open or kinds[0] not in ("depot", "start")
                or (not is_open and kinds[-1] not in ("depot", "end"))
                or any(kind not in ON_THE_WAY for kind in inner)):
            yield _error("TRIP_SHAPE", (*path, "stops"),
                         "A trip begins and ends at a depot, or where its vehicle does, with "
                         "customers between: state it so.")
        # Whoever drove to a launch that there is no more ends its trip there, or goes home.
        has_moved = has_begun and kinds and (_place(trip.stops[0]) != _place(trip.stops[-1])
                                             or "launch_site" in inner)
        if "customer" not in inner and not trip.sorties and not has_moved:
            yield _error("TRIP_SHAPE", path, "The trip serves nobody: leave it out.")
        for index, sortie in enumerate(trip.sorties):
            here = (*path, "sorties", index)
            if not 0 <= sortie.launch_stop <= sortie.recovery_stop < len(kinds):
                yield _error("SORTIE_STOPS", here, f"The trip has {len(kinds)} stops, and a sortie "
                             "ends no earlier than it begins: correct launch_stop and "
                             "recovery_stop.")
            elif "break" in (kinds[sortie.launch_stop], kinds[sortie.recovery_stop]):
                yield _error("SORTIE_STOPS", here, "Nothing is launched or recovered at a break: "
                             "correct launch_stop and recovery_stop.")
            if not sortie.customers:
                yield _error("TRIP_SHAPE", (*here, "customers"),
                             "The sortie serves nobody: leave it out.")
            if number_in(f"{vehicle}/drone-", sortie.drone) is None:
                yield _error("WRONG_NAME", (*here, "drone"), f"The name must be '{vehicle}/drone-' "
                             "and a number from 1: correct it.")

    def _place_errors(self, path: Path, trip: TripInput, kind: VehicleTypeInput,
                      begins: list[PlaceName] | None, ends: list[PlaceName] | None) -> Errors:
        """What of a trip that has begun begins or ends elsewhere than vehicles of its type do."""
        for index, places in ((0, begins), (len(trip.stops) - 1, ends)):
            stop = trip.stops[index]
            if places and (stop.kind, stop.id) not in places and not self._is_gone(stop):
                yield _error("WRONG_DEPOT", (*path, "stops", index, "id"),
                             f"The trip has begun, and vehicles of {kind.id} "
                             f"{'end' if index else 'begin'} it at the {places[0][0]} "
                             f"{places[0][1]!r}: correct one of the two.")

    def _is_gone(self, stop: StopInput) -> bool:
        """Tell whether a stop is at a depot or a launch site that the request doesn't have."""
        if stop.kind == "depot" and self._names.depots is not None:
            return all(depot.id != stop.id for depot in self._names.depots)
        return (stop.kind == "launch_site" and self._names.sites is not None
                and stop.id not in self._names.sites)

    def _begun_errors(self, path: Path, trip: TripInput, kind: VehicleTypeInput,
                      begun: DepartedPart) -> Errors:
        """What of a trip that has begun the request doesn't have."""
        count = sum(drones.count for drones in kind.drone_types)
        for index in begun.launched:
            number = drone_number(trip.sorties[index].drone)
            if number is not None and number >= count:
                yield _error("UNKNOWN_DRONE", (*path, "sorties", index, "drone"),
                             f"The drone has been launched, and vehicles of {kind.id} have {count}:"
                             " raise the count.")
        for place, name in committed(trip, begun):
            if self._names.customers is not None and name not in self._names.customers:
                yield _error("UNKNOWN_CUSTOMER", (*path, *place, "id"),
                             f"A vehicle has served {name!r} or is on its way there by "
                             "replan.freeze_before, too late to cancel: keep it in customers.")

    def _kind_errors(self, path: Path, trip: TripInput, kind: VehicleTypeInput | None) -> Errors:
        """Stops at launch sites that can't have been any: they have names of breaks."""
        names = set() if kind is None else {each.id for each in kind.breaks}
        for index, stop in enumerate(trip.stops):
            if (stop.kind == "launch_site" and stop.id in names
                    and self._names.sites is not None and stop.id not in self._names.sites):
                yield _error("UNKNOWN_DEPOT", (*path, "stops", index, "id"),
                             f"{stop.id!r} is a break, and no launch site: correct the stop's "
                             "kind.")

    def _gone_errors(self, path: Path, trip: TripInput, kind: VehicleTypeInput,
                     begun: DepartedPart) -> Errors:
        """Depots, launch sites and breaks of a trip that the request has no more, too late for it.

        Whoever makes the trip to its end stops at all its places; breaks may still be left out that
        haven't begun.
        """
        breaks = {each.id for each in kind.breaks}
        breaks |= set() if kind.driving_rules is None else {REST_ID}
        meetings = {trip.sorties[index].recovery_stop for index in begun.launched}
        for index, stop in enumerate(trip.stops):
            here = (*path, "stops", index, "id")
            is_bound = index <= begun.left or index in meetings
            if is_bound and self._is_gone(stop):
                yield _error("UNKNOWN_DEPOT", here,
                             f"A vehicle has been at {stop.id!r}, is on its way there or meets a "
                             "drone there by replan.freeze_before, too late to close it: keep it "
                             f"in {stop.kind}s.")
            elif (stop.kind == "break" and stop.id not in breaks
                    and thousandths(stop.arrival) <= self._now):
                yield _error("UNKNOWN_BREAK", here,
                             f"The break {stop.id!r} has begun by replan.freeze_before: keep it in "
                             f"the breaks of {kind.id}, or its driving_rules for a rest.")

    def customers(self) -> Errors:
        """Customers who are in the plan more than once."""
        first: dict[str, Path] = {}
        for path, name in _planned(self._replan.plan.routes):
            if name in first:
                yield _error("PLANNED_TWICE", (*path, "id"),
                             f"The plan serves {name!r} at {json_path(first[name])} too: remove "
                             "one.")
            first.setdefault(name, ("replan", *path))
        for index, left_out in enumerate(self._replan.plan.unassigned):
            if left_out.id in first:
                yield _error("PLANNED_TWICE", ("plan", "unassigned", index, "id"),
                             f"The plan serves {left_out.id!r}: remove it from one of the two.")

    def unavailable(self) -> Errors:
        """Vehicles and drones that the fleet doesn't have."""
        counts, fleet = Counter(self._replan.unavailable), self._names.fleet
        gone = frozenset[str]() if fleet is None else names_gone(self._replan, fleet)
        for index, name in enumerate(self._replan.unavailable):
            path: Path = ("unavailable", index)
            if counts[name] > 1:
                yield _error("DUPLICATE_VEHICLE", path, "It is listed more than once: remove all "
                             "but one.")
            if truck_of(name) in gone:
                continue
            named = None if fleet is None else read_name(name, fleet)
            if fleet is not None and (named is None
                                      or named.number >= fleet[named.vehicle_type].count):
                yield _error("UNKNOWN_VEHICLE", path, f"The fleet has no vehicle {name!r}: use a "
                             "type's id, '-' and a number from 1 to its count.")
            elif fleet is not None and named is not None and named.drone is not None:
                count = sum(kind.count for kind in fleet[named.vehicle_type].drone_types)
                if named.drone >= count:
                    yield _error("UNKNOWN_DRONE", path,
                                 f"Vehicles of {named.vehicle_type} have {count} drones: use the "
                                 "vehicle's name, '/drone-' and a number from 1 to that.")

    def concerned(self) -> Errors:
        """Vehicles that the fleet doesn't have."""
        fleet = self._names.fleet
        for index, name in enumerate(self._replan.concerned if fleet is not None else ()):
            named = read_name(name, fleet or ())
            if (named is None or named.drone is not None
                    or named.number >= (fleet or {})[named.vehicle_type].count):
                yield _error("UNKNOWN_VEHICLE", ("concerned", index), f"The fleet has no vehicle "
                             f"{name!r}: use a type's id, '-' and a number from 1 to its count.")

    def pinned(self) -> Errors:
        """Customers who can't stay with their vehicle."""
        served = {name: path for path, name in _planned(self._replan.plan.routes)}
        for index, name in enumerate(self._replan.pinned):
            path: Path = ("pinned", index)
            if self._names.customers is not None and name not in self._names.customers:
                yield _error("UNKNOWN_CUSTOMER", path, named_otherwise(
                    name, self._names.shipment_ends) or f"The request has no customer {name!r}: "
                    "remove it here, or add it there.")
            elif name not in served:
                yield _error("NOT_PLANNED", path, f"No vehicle serves {name!r} in the plan: remove "
                             "it here.")
            else:
                route = self._replan.plan.routes[int(served[name][2])]
                vehicle, fleet = route.vehicle, self._names.fleet
                if fleet is not None and not is_there(route, fleet):
                    yield _error("UNKNOWN_VEHICLE", path, f"{vehicle} serves {name!r} in the plan "
                                 "and isn't in the fleet any more: remove the pin.")
                elif vehicle in self._replan.unavailable:
                    yield _error("PINNED_TO_UNAVAILABLE", path, f"{vehicle} serves {name!r} in the "
                                 "plan and is unavailable: remove one of the two here.")

    def doubtful(self) -> Errors:
        """Names that neither the request nor the plan has."""
        known = self._names.customers
        planned = {name for _, name in _planned(self._replan.plan.routes)}
        for index, name in enumerate(self._replan.doubtful):
            if known is not None and name not in known and name not in planned:
                yield _error("UNKNOWN_CUSTOMER", ("doubtful", index), named_otherwise(
                    name, self._names.shipment_ends) or f"Neither the request nor the plan has a "
                    f"customer {name!r}: remove it here.")

    def instants(self) -> Errors:
        """Instants that contradict each other."""
        back, now = self._replan.parcels_back, self._replan.freeze_before
        if back is not None and now is None:
            yield _error("MISSING_FIELD", ("freeze_before",), "Without it no parcel is aboard that "
                         "could come back: add it, or remove parcels_back.")
        elif back is not None and now is not None and back < now:
            yield _error("OUT_OF_RANGE", ("parcels_back",),
                         f"The parcels are back before {now:g} s, when the vehicles stop: raise "
                         "it.")


def _place(stop: StopInput) -> PlaceName:
    return stop.kind, stop.id


def _planned(routes: Sequence[RouteInput]) -> Iterator[tuple[Path, str]]:
    """Yield where each customer is in a plan."""
    for index, route in enumerate(routes):
        for number, trip in enumerate(route.trips):
            path: Path = ("plan", "routes", index, "trips", number)
            for place, stop in enumerate(trip.stops):
                if stop.kind == "customer":
                    yield (*path, "stops", place), stop.customer
            for flight, sortie in enumerate(trip.sorties):
                for place, visit in enumerate(sortie.customers):
                    yield (*path, "sorties", flight, "customers", place), visit.customer
