"""The cheapest plans of tiny problems, found by trying all of them with the checker alone.

Every trip begins as late as costs nothing; drones are recovered in order of arrival.
"""

import math
from bisect import bisect_right
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial
from itertools import (
    combinations, combinations_with_replacement, pairwise, permutations, product,
)
from operator import add, le

from model.judge.check import check
from model.judge.hubs import batteries_taken
from model.judge.rules import farthest
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import MM_PER_KM, MS_PER_HOUR, UNLIMITED, Fairness, Measure, Problem, VehicleType
from model.problem.travel import Matrix
from model.solution import Route, Solution
from tests.model.mask_oracle import costs_nothing
from tests.model.search.exhaustive_rests import MINUTE, least_rest, rested
from tests.model.tiny_choices import by_choice
from tests.model.tiny_company import companions

STEP = 30_000
"""Departures are tried every half minute: enough where all else is in whole minutes."""

Nodes = tuple[int, ...]
Taken = tuple[int, ...]
Whole = tuple[int, float]
"""When a route ends, and its share of the work, where these cost."""

NEVER_BY_BEGINNING_LATER = {
    "CAPACITY", "GOODS", "SERVED_BY", "SKILLS", "VEHICLE", "MAX_STOPS", "MAX_SORTIES", "MAX_TRIPS",
    "PAYLOAD", "PICKUP_ORDER", "MAX_RANGE", "UNREACHABLE", "TRAVEL_DURATION", "TRIP_DISTANCE",
    "DISTANCE", "TIME_WINDOW", "SHIFT"}
"""Rules that no later departure keeps, as all is later then, whatever breaks are where."""


def cheapest_cost(problem: Problem) -> float:
    """Return the cost of the cheapest plan of a problem of a few customers."""
    if problem.choices:
        return min(map(cheapest_cost, by_choice(problem)))
    everyone = tuple(range(problem.num_depots, problem.num_nodes))
    kinds = range(len(problem.vehicle_types))
    routes = {(kind, nodes): _cheapest_routes(problem, kind, nodes)
             for kind in kinds for size in range(1, len(everyone) + 1)
             for nodes in combinations(everyone, size)}

    stock = _stock(problem)
    without = {node: problem.cost_of_leaving_out(problem.customer_at(node)) for node in everyone}

    @cache
    def cheapest(left: Nodes, used: tuple[int, ...], taken: Taken,
                 wholes: tuple[Whole, ...]) -> float:
        """Return the cost of serving or leaving out the customers left."""
        if not left:
            return _cost_as_a_whole(problem, wholes)
        best = without[left[0]] + cheapest(left[1:], used, taken, wholes)
        for kind in kinds:
            if used[kind] < problem.vehicle_types[kind].count:
                more = (*used[:kind], used[kind] + 1, *used[kind + 1:])
                for size in range(len(left)):
                    for others in combinations(left[1:], size):
                        alone = companions(problem, (left[0], *others))
                        rest = tuple(node for node in left[1:]
                                     if node not in others and node not in alone)
                        parted = sum(without[node] for node in left if node in alone)
                        for (own, whole), cost in routes[kind, (left[0], *others)].items():
                            total = tuple(map(add, taken, own))
                            if all(map(le, total, stock)):
                                best = min(best, cost + parted + cheapest(
                                    rest, more, total, tuple(sorted((*wholes, whole)))))
        return best

    return cheapest(everyone, (0,) * len(kinds), (0,) * len(stock), ())


def _cost_as_a_whole(problem: Problem, wholes: tuple[Whole, ...]) -> float:
    """Return what the latest end and unequal shares cost."""
    fairness = problem.fairness
    if not fairness.is_stated or not wholes:
        return 0.0
    cost = max(end for end, _ in wholes) / MS_PER_HOUR * fairness.makespan_cost_per_hour
    mean = sum(share for _, share in wholes) / len(wholes)
    if fairness.balance is not None and mean > 0:
        cost += fairness.balance.cost * sum((share - mean) ** 2 for _, share in wholes) / mean
    return cost


def _whole(problem: Problem, route: Route) -> Whole:
    """Return when a route ends and what is its share, nothing of it where that costs nothing."""
    balance = problem.fairness.balance
    if not problem.fairness.is_stated:
        return 0, 0.0
    end = _end(route) if problem.fairness.makespan_cost_per_hour else 0
    return end, 0.0 if balance is None else _share(problem, balance.measure, route)


def _share(problem: Problem, measure: Measure, route: Route) -> float:
    """Return a vehicle's share of the work, in hours, stops, units or km."""
    metrics = check(problem, Solution((route,))).routes[0]
    if measure == "duration":
        return metrics.working_duration / MS_PER_HOUR
    if measure == "distance":
        return sum(trip.distance for trip in metrics.trips) / MM_PER_KM
    stops = [stop.node for trip in route.trips for stop in trip.customer_stops]
    if measure == "stops":
        return len(stops)
    flown = [visit.node for trip in route.trips for sortie in trip.sorties
             for visit in sortie.visits]
    return sum(sum((each.demand[0], *each.pickup[:1]))
               for each in map(problem.customer_at, (*stops, *flown))) / 1000


def _stock(problem: Problem) -> Taken:
    """Return the batteries, and the places to charge, at all depots; none where all have enough."""
    if not problem.limits_hubs:
        return ()
    return tuple(UNLIMITED if stated is None else stated for depot in problem.depots
                 for stated in (depot.batteries, depot.chargers))


def _taken(problem: Problem, route: Route) -> Taken:
    """Return what a route takes of that: of places to charge one all day, which is dearer."""
    if not problem.limits_hubs:
        return ()
    batteries, kind = batteries_taken(problem, (route,)), problem.vehicle_types[route.vehicle_type]
    is_charged = len(route.trips) > kind.trips_uncharged
    return tuple(part for node in range(problem.num_depots)
                 for part in (batteries[node], int(is_charged and node == kind.depot)))


def _cheapest_routes(problem: Problem, kind: int, nodes: Nodes) -> dict[tuple[Taken, Whole], float]:
    """Return the costs of the cheapest routes that serve exactly these, by what they take."""
    found, vehicle_type = dict[tuple[Taken, Whole], float](), problem.vehicle_types[kind]
    if not all(_may_serve(problem, kind, node) for node in nodes):
        return found
    is_one = not problem.limits_hubs and not problem.fairness.is_stated
    alone = replace(problem, fairness=Fairness())
    bounded = [(_least_cost(problem, vehicle_type, trips), trips)
               for driven in _trip_lists(problem, vehicle_type, nodes, vehicle_type.max_trips,
                                         vehicle_type.begins_at)
               for trips in rested(problem, vehicle_type, driven)]
    # The most promising first, so that the others need not be timed.
    for least, trips in sorted(bounded, key=lambda entry: entry[0]):
        best = found.get(((), (0, 0.0)), math.inf) if is_one else math.inf
        if least == math.inf or least >= best:
            break
        decision = RouteDecision(kind, 0, trips)
        late = _cheapest_start(alone, decision, best)
        if late is not None:
            cost, route = late
            key = _taken(problem, route), _whole(problem, route)
            if cost < found.get(key, math.inf):
                found[key] = cost
    return found


def _may_serve(problem: Problem, kind: int, node: int) -> bool:
    """Tell whether skills and the table allow a vehicle type to serve a customer."""
    return problem.customer_at(node).skills <= problem.vehicle_types[kind].skills and (
        problem.may_serve is None or bool(problem.may_serve[kind, node - problem.num_depots]))


def _cheapest_start(problem: Problem, decision: RouteDecision,
                    best: float) -> tuple[float, Route] | None:
    """Return a route that costs less than `best`, and what; None if there is none."""
    kind, soon = problem.vehicle_types[decision.vehicle_type], schedule(problem, decision)
    if kind.breaks or kind.driving:
        return _begun_at_any_time(problem, decision, soon, best)
    evaluation = check(problem, Solution((soon,)))
    broken = {violation.code for violation in evaluation.violations} - {"MISSING"}
    cost = evaluation.cost
    # A later start saves nothing but time and waiting.
    driven = cost.fixed + cost.distance + cost.stops
    if broken <= {"WORKING_DURATION", "TRAVEL_DURATION"} and driven + cost.lateness < best:
        late = _begun_late(problem, decision, soon)
        if late is not soon:
            evaluation = check(problem, Solution((late,)))
            broken = {violation.code for violation in evaluation.violations} - {"MISSING"}
        if not broken and evaluation.cost.total < best:
            return evaluation.cost.total, late
    return None


def _begun_at_any_time(problem: Problem, decision: RouteDecision, soon: Route,
                       best: float) -> tuple[float, Route] | None:
    """Return the same of a route with breaks, which may be left out if it begins later."""
    found, kind = None, problem.vehicle_types[decision.vehicle_type]
    for start in range(soon.trips[0].stops[0].arrival, _end(soon) + 1, MINUTE):
        _, route = _begun(problem, decision, 0, start)
        evaluation = check(problem, Solution((route,)))
        broken = {violation.code for violation in evaluation.violations} - {"MISSING"}
        if not broken and evaluation.cost.total < best:
            best, found = evaluation.cost.total, (evaluation.cost.total, route)
        elif broken & NEVER_BY_BEGINNING_LATER or (
                "DRIVING" in broken and kind.driving and kind.driving.max_work >= UNLIMITED):
            break
    return found


def _least_cost(problem: Problem, kind: VehicleType, trips: tuple[TripDecision, ...]) -> float:
    """Return a cost that the trips can't undercut; infinite if a flight exceeds endurance."""
    truck = problem.travel[kind.travel]
    kilometres = sum(_sum(truck.distance, trip.nodes) for trip in trips) / MM_PER_KM
    cost = kind.fixed_cost + kilometres * kind.cost_per_km
    busy = Counter({"truck": sum(_least_duration(problem, kind, trip) for trip in trips)
                    + least_rest(kind, trips)})
    flights = [(trip, sortie) for trip in trips for sortie in trip.sorties]
    for trip, sortie in flights:
        drones = kind.drone_type(sortie.drone)
        path = (trip.nodes[sortie.launch_stop], *sortie.nodes, trip.nodes[sortie.recovery_stop])
        flight = _sum(problem.travel[drones.travel].duration, path)
        flight += sum(drones.service_at(problem.customer_at(node)) for node in sortie.nodes)
        if flight > drones.endurance:
            return math.inf
        busy[f"drone {sortie.drone}"] += flight
        flown = _sum(problem.travel[drones.travel].distance, path)
        cost += flown / MM_PER_KM * drones.cost_per_km
    return cost + max(busy.values()) / MS_PER_HOUR * kind.cost_per_hour


def _least_duration(problem: Problem, kind: VehicleType, trip: TripDecision) -> int:
    """Return what driving and serving take on a trip, which lasts no shorter."""
    served = sum(kind.service_at(problem.customer_at(node)) for node in trip.nodes[1:-1]
                 if node >= problem.num_depots)
    return _sum(problem.travel[kind.travel].duration, trip.nodes) + served


def _sum(legs: Matrix, path: Nodes) -> int:
    return sum([legs.item(origin, to) for origin, to in pairwise(path)])


def _begun_late(problem: Problem, decision: RouteDecision, soon: Route) -> Route:
    """Return a route whose trips begin as late as costs nothing."""
    kind = problem.vehicle_types[decision.vehicle_type]
    for index in range(len(decision.trips)):
        first, end = soon.trips[index].stops[0].arrival, _end(soon)
        # What begins later than that ends later, too.
        last = end - sum(_least_duration(problem, kind, trip) for trip in decision.trips[index:])
        starts = range(first + STEP, last + 1, STEP)
        begun = partial(_begun, problem, decision, index)
        # Nothing begun later ends sooner.
        in_time = bisect_right(starts, end, key=lambda start: _end(begun(start)[1]))
        for start in reversed(starts[:in_time]):
            later, late = begun(start)
            if costs_nothing(problem, soon, late):
                decision, soon = later, late
                break
    return soon


def _begun(problem: Problem, decision: RouteDecision, index: int,
           start: int) -> tuple[RouteDecision, Route]:
    """Return a route one trip of which begins at `start`, and with its times."""
    trip = replace(decision.trips[index], start=start)
    trips = (*decision.trips[:index], trip, *decision.trips[index + 1:])
    later = replace(decision, trips=trips)
    return later, schedule(problem, later)


def _end(route: Route) -> int:
    return route.trips[-1].stops[-1].departure


def _trip_lists(problem: Problem, kind: VehicleType, nodes: Nodes,
                most: int, begin: int) -> Iterator[tuple[TripDecision, ...]]:
    """Yield all ways to serve customers by at most `most` trips, the first from `begin`."""
    if not nodes:
        yield ()
    elif most > 0:
        for size in range(1, len(nodes) + 1):
            for served in combinations(nodes, size):
                rest = tuple(node for node in nodes if node not in served)
                for end in {*kind.reload_places} if rest else (kind.ends_at,):
                    for trip in _trips(problem, kind, served, (begin, end)):
                        for others in _trip_lists(problem, kind, rest, most - 1, end):
                            yield (trip, *others)


def _trips(problem: Problem, kind: VehicleType, nodes: Nodes,
           ends: tuple[int, int]) -> Iterator[TripDecision]:
    """Yield all trips between two depots that serve exactly these customers by truck and drones.

    Those of which it is plain that they can't be are left out.
    """
    if _is_too_much(problem, nodes, kind.capacity):
        return
    for size in range(len(nodes) + 1 if kind.drones else 1):
        for flown in combinations(nodes, size):
            driven = [node for node in nodes if node not in flown]
            barred = "truck" if kind.flies else "drone"
            if (any(problem.customer_at(node).served_by == "truck" for node in flown)
                    or any(problem.customer_at(node).served_by == barred for node in driven)):
                continue
            for order in permutations(driven):
                for halting in _with_halts(problem, kind, order, 2 * len(flown)):
                    stops = (ends[0], *halting, ends[1])
                    for queue in permutations(flown):
                        for sorties in _sorties(kind, queue, len(stops), 0):
                            if _uses_all(problem, stops, sorties) and all(
                                    _may_fly(problem, kind, stops, sortie) for sortie in sorties):
                                yield TripDecision(stops, sorties)


def _is_too_much(problem: Problem, nodes: Nodes, most: Nodes) -> bool:
    """Tell whether customers are brought more than can be aboard at once."""
    demands = [problem.customer_at(node).demand for node in nodes]
    return any(sum(brought) > limit
               for brought, limit in zip(zip(*demands, strict=True), most, strict=False))


def _may_fly(problem: Problem, kind: VehicleType, stops: Nodes, sortie: SortieDecision) -> bool:
    """Tell whether a drone lifts what a sortie brings, and is never too far from its truck."""
    drones = kind.drone_type(sortie.drone)
    ends = stops[sortie.launch_stop], stops[sortie.recovery_stop]
    return not _is_too_much(problem, sortie.nodes, drones.capacity) and (
        drones.max_range is None or all(farthest(problem, drones, ends, node) <= drones.max_range
                                        for node in sortie.nodes))


def _with_halts(problem: Problem, kind: VehicleType, order: Nodes,
                most: int) -> Iterator[Nodes]:
    """Yield the truck's customers in order, with up to so many stops at launch sites, two at most.
    """
    yield order
    sites = problem.launch_sites if kind.drones else ()
    for places in (*combinations(range(len(order) + 1), 1),
                   *combinations_with_replacement(range(len(order) + 1), 2)):
        if len(places) <= most:
            for chosen in product(sites, repeat=len(places)):
                stops = list(order)
                for place, site in zip(reversed(places), chosen, strict=True):
                    stops.insert(place, site)
                yield tuple(stops)


def _uses_all(problem: Problem, stops: Nodes, sorties: tuple[SortieDecision, ...]) -> bool:
    """Tell whether a drone is launched or recovered at each stop at a launch site."""
    used = {stop for sortie in sorties for stop in (sortie.launch_stop, sortie.recovery_stop)}
    return all(index in used for index, node in enumerate(stops[1:-1], 1)
               if node < problem.num_depots)


def _sorties(kind: VehicleType, queue: Nodes, num_stops: int,
             earliest: int) -> Iterator[tuple[SortieDecision, ...]]:
    """Yield all ways to fly to customers in turn, launched from stop `earliest` on.

    No drone is launched before it is back.
    """
    if not queue:
        yield ()
        return
    most = max([drones.max_customers_per_sortie for drones in kind.drone_types], default=0)
    for size in range(1, min(len(queue), most) + 1):
        for launch in range(earliest, num_stops):
            for others in _sorties(kind, queue[size:], num_stops, launch):
                for recovery in range(launch, num_stops):
                    for drone in range(kind.num_drones):
                        if not any(other.drone == drone and other.launch_stop < recovery
                                   for other in others):
                            yield (SortieDecision(queue[:size], launch, recovery, drone), *others)
