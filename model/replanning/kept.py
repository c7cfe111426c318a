"""What vehicles under way do in any case: the beginning of a new plan, up to the way home."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

from model.judge.energy import charges_at
from model.judge.past import KnownSortie, KnownStop, KnownTrip, Past
from model.judge.timing import RouteDecision, TripDecision, read_decision, resume_trip
from model.problem import MAX_QUANTITY, UNREACHABLE, Problem, VehicleType
from model.replanning.amend import broken_by, customers_of, repaired, without
from model.solution import Charge, Route, Solution, Sortie, Stop, Trip, Vehicle


@dataclass(frozen=True)
class WayOn:
    """How a vehicle may go on with the trip that it is on."""

    position: int  # stop of the trip
    ready: int  # ms; the truck's next launch or departure there is no sooner
    service_left: int  # ms, of the truck there from `ready` on
    aboard: tuple[int, ...]  # customers whose parcels can be delivered
    planned: TripDecision  # by the plan given; its first stop is that at `position`
    planned_end: int  # ms


@dataclass(frozen=True)
class Kept:
    """One vehicle's route as far as it is settled, then the way home."""

    vehicle: Vehicle
    decision: RouteDecision
    route: Route  # timed
    way_on: WayOn | None = None  # from the last stop of the last trip
    charges: tuple[Charge, ...] = ()  # behind the last trip, by now

    @property
    def served(self) -> set[int]:
        """Customers who are served in any case."""
        return {*self.route.served}

    @property
    def end(self) -> int:
        """When the vehicle is home if it does no more."""
        return self.route.trips[-1].stops[-1].departure


def kept_routes(problem: Problem, plan: Solution, past: Past) -> dict[Vehicle, Kept]:
    """Return what each vehicle does in any case that has done anything by now, in the plan's order.

    A truck whose drone is in the air meets it where that was planned, and serves the stops up to
    there, as long as that breaks no rules.
    """
    planned = {route.driven_by: route for route in plan.routes}
    return {vehicle: _kept(problem, planned[vehicle], vehicle, past)
            for vehicle in planned if vehicle in past.trips}


def retimed(problem: Problem, decision: RouteDecision, known: tuple[KnownTrip, ...],
            now: int) -> Route:
    """Return a route of trips that have all begun with its times."""
    return Route(decision.vehicle_type, decision.vehicle,
                 tuple(resumed(problem, decision, known, now)))


def resumed(problem: Problem, decision: RouteDecision, known: Sequence[KnownTrip],
            now: int) -> list[Trip]:
    """Return the trips of a route that have begun with their times."""
    kind, trips = problem.vehicle_types[decision.vehicle_type], list[Trip]()
    for trip, facts in zip(decision.trips, known, strict=False):
        trips.append(resume_trip(problem, kind, trip, facts, now, trips))
    return trips


def _kept(problem: Problem, route: Route, vehicle: Vehicle, past: Past) -> Kept:
    known = past.trips[vehicle]
    kind = problem.vehicle_types[vehicle.type]
    grounded = past.grounded_on(vehicle)
    trips = [read_decision(_settled(kind, trip, facts, grounded), kind, problem.lags_across)
             for trip, facts in zip(route.trips[:len(known)], known, strict=True)]
    decision = RouteDecision(*vehicle, tuple(trips))
    if known[-1].rest != "anything":
        charges = _charged_by(route.trips[len(known):len(known) + 1], past.now)
        return Kept(vehicle, decision, retimed(problem, decision, known, past.now),
                    charges=charges)
    planned = route.trips[len(known) - 1]
    return _continued(problem, decision, planned, meeting_stop(planned, known[-1]), past)


def _charged_by(planned: Sequence[Trip], now: int) -> tuple[Charge, ...]:
    """Return when a vehicle was charged by now before the trip that is next, if there is one."""
    return tuple([Charge(charge.start, min(charge.end, now))
                  for trip in planned for charge in trip.charges if charge.start < now])


def meeting_stop(trip: Trip, known: KnownTrip) -> int:
    """Return the stop where a truck has all drones aboard that were launched."""
    bound = len(known.stops) - 1
    met = {sortie.recovery_node for sortie in known.sorties if sortie.recovery_stop is None}
    return max([bound, *(index for index, stop in enumerate(trip.stops)
                         if index > bound and stop.node in met)])


def _settled(kind: VehicleType, trip: Trip, known: KnownTrip, grounded: Collection[int]) -> Trip:
    """Return the part of a trip that is settled, with the times that tell its order.

    Drones that are `grounded` fly what they have begun, and no more.
    """
    stops = [Stop(stop.node, stop.arrival, 0, 0) for stop in known.stops]
    if known.rest != "anything":
        sorties = tuple(_as_sortie(sortie, len(stops)) for sortie in known.sorties)
        if known.rest == "home":
            stops.append(Stop(kind.ends_at, 0, 0, 0))
        return Trip(tuple(stops), sorties, known.breaks, trip.charges)
    meeting, bound = meeting_stop(trip, known), len(known.stops) - 1
    stops = list(trip.stops[:meeting + 1])
    if meeting < len(trip.stops) - 1:
        stops.append(trip.stops[-1])
    begun, others = by_launch(trip, known)
    planned = [sortie for sortie in others
               if bound <= sortie.launch_stop and sortie.recovery_stop <= meeting
               and (sortie.launch_stop < meeting or meeting == len(trip.stops) - 1)
               and sortie.drone < kind.num_drones and sortie.drone not in grounded]
    return Trip(tuple(stops), (*begun, *planned))


def by_launch(trip: Trip, known: KnownTrip) -> tuple[list[Sortie], list[Sortie]]:
    """Return the sorties of a trip that have been launched, and the others."""
    launched = {_identity(sortie) for sortie in known.sorties}
    return ([sortie for sortie in trip.sorties if _identity(sortie) in launched],
            [sortie for sortie in trip.sorties if _identity(sortie) not in launched])


def _identity(sortie: Sortie | KnownSortie) -> tuple[int, int, int]:
    return sortie.drone, sortie.launch_stop, sortie.launch_time


def _as_sortie(known: KnownSortie, home: int) -> Sortie:
    begun = UNREACHABLE if known.recovery_start is None else known.recovery_start
    stop = home if known.recovery_stop is None else known.recovery_stop
    return Sortie(known.drone, known.launch_stop, stop, known.visits, known.launch_time, begun,
                  begun)


def _continued(problem: Problem, decision: RouteDecision, planned: Trip, meeting: int,
               past: Past) -> Kept:
    """Return what a vehicle does that is under way, and how the plan has it go on."""
    vehicle = decision.driven_by
    known = past.trips[vehicle]
    fixed = set(_fixed_nodes(known[-1]))
    last = without(decision.trips[-1], {-1})
    decision = replace(decision, trips=(*decision.trips[:-1], last))
    free = set(customers_of(problem, last)) - fixed
    if free:
        def time(tried: RouteDecision) -> Route:
            return retimed(problem, tried, known, past.now)

        everyone = fixed.union(*(customers_of(problem, trip) for trip in decision.trips[:-1]))
        alone = replace(decision, trips=(*decision.trips[:-1], without(last, free)))
        decision = repaired(problem, decision, everyone, [time], past,
                            broken_by(problem, alone, time, past)) or decision
    route = retimed(problem, decision, known, past.now)
    kept = Kept(vehicle, decision, route)
    if meeting == len(planned.stops) - 1:
        return kept
    position = len(decision.trips[-1].nodes) - 2
    served = set(customers_of(problem, decision.trips[-1]))
    aboard = tuple(sorted(known[-1].aboard - served))
    if not aboard:
        return kept
    ready, service_left = _free_from(problem, route, position, past.now)
    rest = _rest(problem, vehicle, planned, meeting, served, past.grounded_on(vehicle))
    planned_end = _planned_end(problem, kept, ready, service_left, rest)
    return replace(kept, way_on=WayOn(position, ready, service_left, aboard, rest, planned_end))


def with_drones_then(kind: VehicleType, has_launched: bool) -> VehicleType:
    """Return a truck for the rest of its trip, by whether a drone has been launched on it."""
    if kind.drones is None:
        return kind
    first, *others = [replace(drones, has_launched=has_launched) for drones in kind.drone_types]
    return replace(kind, drones=first, more_drones=tuple(others), max_trips=1)


def charged_then(problem: Problem, kind: VehicleType, trip: Trip, time: int) -> VehicleType:
    """Return a truck that goes on with a trip at an instant, with what its drones then have."""
    if not any(drones.energy is not None and drones.energy.charge for drones in kind.drone_types):
        return kind
    return replace(kind, charge_left=charges_at(problem, kind, trip, time), max_trips=1)


def _planned_end(problem: Problem, kept: Kept, ready: int, service_left: int,
                 rest: TripDecision) -> int:
    """Return when a trip is over that goes on as planned."""
    kind = problem.vehicle_types[kept.vehicle.type]
    kind = replace(with_drones_then(kind, bool(kept.decision.trips[-1].sorties)), max_trips=1,
                   earliest=min(ready, kind.latest, MAX_QUANTITY))
    kind = charged_then(problem, kind, kept.route.trips[-1], ready)
    node, begun = rest.nodes[0], ready + service_left
    if node >= problem.num_depots:
        begun -= kind.service_at(problem.customer_at(node))
    known = KnownTrip((KnownStop(node, ready, begun, None),), (), frozenset(), "anything")
    trip = resume_trip(problem, kind, rest, known, ready, kept.route.trips)
    return trip.stops[-1].departure


def _fixed_nodes(known: KnownTrip) -> Iterator[int]:
    """Yield whom a vehicle under way serves in any case: drones in the air are met there."""
    yield from (stop.node for stop in known.stops)
    for sortie in known.sorties:
        yield from (visit.node for visit in sortie.visits)
        yield sortie.recovery_node


def _free_from(problem: Problem, route: Route, position: int, now: int) -> tuple[int, int]:
    """Return when all drones are aboard at a stop, and how long the truck serves from then on."""
    trip, kind = route.trips[-1], problem.vehicle_types[route.vehicle_type]
    stop = trip.stops[position]
    ends = [sortie.recovery_time for sortie in trip.sorties if sortie.recovery_stop == position]
    ends += [sortie.launch_time for sortie in trip.sorties if sortie.launch_stop == position]
    ready = max([stop.ready, now, *ends])
    if problem.is_launch_site(stop.node):
        ready = max(ready, stop.service_start)
    if stop.node < problem.num_depots:
        return ready, 0
    service_end = stop.service_start + kind.service_at(problem.customer_at(stop.node))
    return ready, max(0, service_end - ready)


def _rest(problem: Problem, vehicle: Vehicle, planned: Trip, meeting: int, served: set[int],
          grounded: Collection[int]) -> TripDecision:
    """Return how the plan goes on from a stop, but for those who are served before or no more.

    Nor are those whom drones were to serve that are grounded.
    """
    has_launched = any(sortie.launch_stop < meeting for sortie in planned.sorties)
    kind = with_drones_then(problem.vehicle_types[vehicle.type], has_launched)
    sorties = tuple(
        replace(sortie, launch_stop=sortie.launch_stop - meeting,
                recovery_stop=sortie.recovery_stop - meeting)
        for sortie in planned.sorties
        if kind.drones is not None and sortie.launch_stop >= meeting
        and sortie.drone not in grounded)
    trip = Trip(planned.stops[meeting:], sorties)
    decision = read_decision(trip, kind, problem.lags_across)
    return without(decision, {-1, *served})
