"""Judge of every plan: recomputes times, loads and costs and collects all broken rules.

Shares nothing with simulator and search, so that it can judge both.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, pairwise
from operator import attrgetter
from types import MappingProxyType

from model.judge.changes import count_changes
from model.judge.fairness import fairness_cost
from model.judge.hours import hours_violations
from model.judge.hubs import hub_violations
from model.judge.launch_sites import site_violations, with_launch_sites
from model.judge.lags import starts_across
from model.judge.metrics import (
    RouteMetrics, flight_legs, measure_route, measure_trip, unassigned_cost,
)
from model.judge.past import EVERYTHING_OPEN, KnownTrip, Past
from model.judge.past_rules import begins_with, past_violations
from model.judge.relations import plan_orders, plan_relations, route_relations
from model.judge.rules import TimedTrip, Violation, route_violations, seconds, trip_violations
from model.judge.shipping import shipment_violations
from model.judge.timing import read_decision, resume_trip, schedule_trip
from model.problem import MAX_QUANTITY, REST, UNREACHABLE, DroneType, Problem, VehicleType
from model.solution import COST_TERMS, Cost, Route, Solution, Sortie, Trip

NOTHING_KNOWN: Mapping[int, "JudgedRoute"] = MappingProxyType({})


@dataclass(frozen=True)
class Evaluation:
    """A judged plan; routes that can't be read have empty metrics and cost nothing."""

    violations: tuple[Violation, ...]
    cost: Cost
    routes: tuple[RouteMetrics, ...]  # in the plan's order
    makespan: int  # ms, the last return of any vehicle

    @property
    def is_feasible(self) -> bool:
        """No rule is broken."""
        return not self.violations


def check(problem: Problem, solution: Solution, past: Past = EVERYTHING_OPEN,
          known: Mapping[int, "JudgedRoute"] = NOTHING_KNOWN) -> Evaluation:
    """Judge a plan, and whether it begins with what has happened.

    `known` are routes, by index, that were judged before by `judge_route`, at the same path.
    """
    routes = [known.get(index) or judge_route(problem, route, f"routes[{index}]", past)
              for index, route in enumerate(solution.routes)]
    violations = [*_assignment_violations(problem, solution, routes),
                  *_fleet_violations(problem, solution), *hub_violations(problem, solution),
                  *plan_relations(problem, [judged.nodes for judged in routes]),
                  *plan_orders(problem, [judged.starts for judged in routes])]
    if past is not EVERYTHING_OPEN:
        violations += past_violations(problem, solution, past)
    for judged in routes:
        violations += judged.violations
    costs = [Cost(unassigned=unassigned_cost(problem, solution.unassigned)),
             *[judged.cost for judged in routes]]
    makespan = max([judged.end for judged in routes], default=0)
    costs.append(fairness_cost(problem, [
        (route, judged.metrics) for route, judged in zip(solution.routes, routes, strict=True)
        if judged.metrics.trips], makespan))
    if past.earlier is not None:
        changes = count_changes(problem, solution, past.earlier)
        costs.append(Cost(changes=changes.cost(past.earlier.prices)))
    return Evaluation(tuple(violations), _total(costs), tuple([each.metrics for each in routes]),
                      makespan)


@dataclass(frozen=True)
class JudgedRoute:
    """A route on its own; one that can't be read has empty metrics and costs nothing."""

    violations: list[Violation]
    metrics: RouteMetrics
    cost: Cost
    end: int  # ms, the last return
    nodes: tuple[int, ...]  # of all whom it serves, or claims to
    starts: Mapping[int, int] = field(default_factory=dict)  # of service, in orders across vehicles


def judge_route(problem: Problem, route: Route, path: str,
                past: Past = EVERYTHING_OPEN) -> JudgedRoute:
    """Judge a route by the rules that concern it alone."""
    route = with_launch_sites(problem, route)
    violations, nodes = list(_unreadable(problem, route, path)), tuple(route.served)
    if violations:
        return JudgedRoute(violations, RouteMetrics(), Cost(), 0, nodes)
    vehicle_type = problem.vehicle_types[route.vehicle_type]
    known = past.trips.get(route.driven_by, ())
    trips = [_time(problem, vehicle_type, trip, f"{path}.trips[{number}]",
                   known[number] if number < len(known) else None, past.now,
                   route.trips[:number])
             for number, trip in enumerate(route.trips)]
    timed = Route(route.vehicle_type, route.vehicle, tuple([trip.trip for trip in trips]))
    measured, cost = measure_route(problem, timed, tuple([trip.metrics for trip in trips]))
    for stated, trip in zip(route.trips, trips, strict=True):
        violations += _mismatches(stated, trip.trip, trip.path)
        violations += trip_violations(problem, route.vehicle_type, trip)
        violations += shipment_violations(problem, vehicle_type, trip)
    violations += site_violations(problem, route.vehicle_type, trips)
    violations += hours_violations(problem, trips)
    violations += route_violations(problem, vehicle_type, trips, measured, path,
                                   len(known) == len(trips))
    violations += route_relations(problem, trips, path)
    starts = starts_across(problem, timed)
    return JudgedRoute(violations, measured, cost, timed.trips[-1].stops[-1].departure, nodes,
                       starts)


def _total(costs: list[Cost]) -> Cost:
    return Cost(*map(sum, zip(*map(attrgetter(*COST_TERMS), costs), strict=True)))


def _time(problem: Problem, vehicle_type: VehicleType, stated: Trip, path: str,
          known: KnownTrip | None, now: int, before: Sequence[Trip]) -> TimedTrip:
    """Recompute a trip from the choices it states, and what is known of it."""
    decision = read_decision(stated, vehicle_type, problem.lags_across)
    if known is not None and begins_with(stated, known):
        trip = resume_trip(problem, vehicle_type, decision, known, now, before)
    else:
        trip = schedule_trip(problem, vehicle_type, decision, 0, before)
    return TimedTrip(decision, trip, measure_trip(problem, vehicle_type, trip), path)


def _assignment_violations(problem: Problem, solution: Solution,
                           routes: list[JudgedRoute]) -> Iterator[Violation]:
    """Every customer is served once or unassigned."""
    first, end = problem.num_depots, problem.num_nodes
    nodes = [*solution.unassigned, *chain.from_iterable([judged.nodes for judged in routes])]
    if problem.choices:
        nodes = [problem.first_place(node) for node in nodes]
    for index, node in enumerate(solution.unassigned):
        if not first <= node < end:
            yield Violation("UNKNOWN_NODE", f"node {node} is no customer", f"unassigned[{index}]")
    if len(nodes) == end - first == len(set(nodes)) and (
            not nodes or (min(nodes) >= first and max(nodes) < end)):
        return
    times = Counter(nodes)
    for index, customer in enumerate(problem.customers):
        if problem.first_place(first + index) != first + index:
            continue
        count = times[first + index]
        if count == 0:
            message = f"customer {customer.id} is neither served nor unassigned"
            yield Violation("MISSING", message, f"customers[{index}]")
        elif count > 1:
            message = f"customer {customer.id} is in the plan {count} times"
            yield Violation("DUPLICATE", message, f"customers[{index}]")


def _fleet_violations(problem: Problem, solution: Solution) -> Iterator[Violation]:
    """Every route has a vehicle of its own, and no more trips than that may make."""
    used: set[tuple[int, int]] = set()
    for index, route in enumerate(solution.routes):
        if not 0 <= route.vehicle_type < len(problem.vehicle_types):
            continue
        vehicle_type = problem.vehicle_types[route.vehicle_type]
        if not 0 <= route.vehicle < vehicle_type.count:
            message = (f"there is no {vehicle_type.vehicle_name(route.vehicle)}: "
                       f"{vehicle_type.id} has {vehicle_type.count}")
            yield Violation("COUNT", message, f"routes[{index}]")
        if route.driven_by in used:
            message = f"{vehicle_type.vehicle_name(route.vehicle)} has another route"
            yield Violation("COUNT", message, f"routes[{index}]")
        used.add(route.driven_by)
        if len(route.trips) > vehicle_type.max_trips:
            message = f"{len(route.trips)} trips, at most {vehicle_type.max_trips} are allowed"
            yield Violation("MAX_TRIPS", message, f"routes[{index}]")


def _unreadable(problem: Problem, route: Route, path: str) -> Iterator[Violation]:
    """What keeps a route's times from being computed."""
    if not route.trips:
        yield Violation("EMPTY_TRIP", "a route without trips", path)
    if not 0 <= route.vehicle_type < len(problem.vehicle_types):
        yield Violation("UNKNOWN_TYPE", f"no vehicle type {route.vehicle_type}", path)
        return
    vehicle_type = problem.vehicle_types[route.vehicle_type]
    for index, trip in enumerate(route.trips):
        trip_path = f"{path}.trips[{index}]"
        if len(trip.stops) < 2:
            yield Violation("DEPOT", "a trip begins and ends at the depot", trip_path)
            continue
        yield from _unreadable_stops(problem, trip, trip_path)
        yield from _unreadable_breaks(vehicle_type, trip, trip_path)
        legs = pairwise([stop.node for stop in trip.stops])
        yield from _unreachable(problem, vehicle_type, legs, trip_path)
        if vehicle_type.drones is None and trip.sorties:
            yield Violation("COUNT", "sorties of a vehicle without drones", trip_path)
        elif vehicle_type.drones is not None:
            for number, sortie in enumerate(trip.sorties):
                sortie_path = f"{trip_path}.sorties[{number}]"
                yield from _unreadable_sortie(problem, vehicle_type.drone_type(sortie.drone), trip,
                                              sortie, sortie_path)


def _unreadable_stops(problem: Problem, trip: Trip, path: str) -> Iterator[Violation]:
    first, end, last = problem.num_depots, problem.num_nodes, len(trip.stops) - 1
    for index, stop in enumerate(trip.stops):
        node = stop.node
        if (0 < index < last and (first <= node < end or stop.is_launch_site)) or (
                index in (0, last) and 0 <= node < first):
            continue
        stop_path = f"{path}.stops[{index}]"
        if not 0 <= node < end:
            yield Violation("UNKNOWN_NODE", f"no node {node}", stop_path)
        elif node < first:
            yield Violation("DEPOT", f"{problem.place_at(node).id} amid a trip", stop_path)
        else:
            message = f"{problem.place_at(node).id} is no depot to begin or end at"
            yield Violation("DEPOT", message, stop_path)


def _unreadable_breaks(vehicle_type: VehicleType, trip: Trip, path: str) -> Iterator[Violation]:
    for index, taken in enumerate(trip.breaks):
        is_known = (vehicle_type.driving is not None if taken.number == REST
                    else 0 <= taken.number < len(vehicle_type.breaks))
        if not (is_known
                and 0 <= taken.stop < len(trip.stops) - 1):
            yield Violation("BREAK", f"{vehicle_type.id} has no such break between two stops",
                            f"{path}.breaks[{index}]")


def _unreadable_sortie(
    problem: Problem, drones: DroneType, trip: Trip, sortie: Sortie, path: str
) -> Iterator[Violation]:
    if not 0 <= sortie.launch_stop <= sortie.recovery_stop < len(trip.stops):
        message = f"launch at stop {sortie.launch_stop}, recovery at stop {sortie.recovery_stop}"
        yield Violation("SORTIE_STOPS", f"{message} of {len(trip.stops)}", path)
        return
    unknown = False
    for index, visit in enumerate(sortie.visits):
        if not problem.num_depots <= visit.node < problem.num_nodes:
            unknown = True
            message = f"node {visit.node} is no customer"
            yield Violation("UNKNOWN_NODE", message, f"{path}.visits[{index}]")
    if not unknown:
        yield from _unreachable(problem, drones, flight_legs(trip, sortie), path)


def _unreachable(problem: Problem, flyer: DroneType | VehicleType,
                 legs: Iterable[tuple[int, int]], path: str) -> Iterator[Violation]:
    """Which of some legs can't be gone, up to one from or to a node that isn't there."""
    travel = problem.travel[flyer.travel]
    drives = isinstance(flyer, VehicleType) and not flyer.flies
    for leg in legs:
        if not all(0 <= node < problem.num_nodes for node in leg):
            return
        lasts = travel.duration.item(*leg)
        is_barred = UNREACHABLE in (lasts, travel.distance.item(*leg))
        if is_barred or (drives and lasts >= MAX_QUANTITY):
            places = " to ".join(problem.place_at(node).id for node in leg)
            message = f"no {'flight' if is_barred else 'way'} from {places}"
            yield Violation("UNREACHABLE", message, path)


def _mismatches(stated: Trip, timed: Trip, path: str) -> Iterator[Violation]:
    """Stated times that differ from the computed ones."""
    if stated == timed:
        return
    for index, (said, stop) in enumerate(zip(stated.stops, timed.stops, strict=True)):
        yield from _mismatch(said, stop, ("arrival", "service_start", "departure"),
                             f"{path}.stops[{index}]")
    for index, (claimed, taken) in enumerate(zip(stated.breaks, timed.breaks, strict=True)):
        yield from _mismatch(claimed, taken, ("arrival", "start", "end"), f"{path}.breaks[{index}]")
    for index, (claim, sortie) in enumerate(zip(stated.sorties, timed.sorties, strict=True)):
        sortie_path = f"{path}.sorties[{index}]"
        yield from _mismatch(claim, sortie, ("launch_time", "recovery_start", "recovery_time"),
                             sortie_path)
        for number, (said_visit, visit) in enumerate(
            zip(claim.visits, sortie.visits, strict=True)
        ):
            yield from _mismatch(said_visit, visit, ("arrival", "service_start", "departure"),
                                 f"{sortie_path}.visits[{number}]")


def _mismatch(
    stated: object, timed: object, fields: tuple[str, ...], path: str
) -> Iterator[Violation]:
    wrong = [
        f"{field} is {seconds(getattr(stated, field))}, computed {seconds(getattr(timed, field))}"
        for field in fields
        if getattr(stated, field) != getattr(timed, field)
    ]
    if wrong:
        yield Violation("TIME_MISMATCH", "; ".join(wrong), path)
