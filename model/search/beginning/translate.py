"""Plans to and from the routes of a search."""

import numpy as np

from model.kernel.alarm import rung
from model.kernel.compiled import compiled
from model.kernel.flight import ready, recovery_end
from model.kernel.instance import (
    RATE_HOUR, RATE_KM, TYPE_CAPACITY, TYPE_COUNT, TYPE_DRONES, TYPE_MAX_TRIPS,
    NODE_DEMAND, NONE,
)
from model.kernel.stop import start_of_service
from model.problem import FloatArray, IntArray, Problem
from model.search.beginning.savings import savings_routes
from model.search.insertion.evaluate import INFEASIBLE, serve_alone
from model.search.insertion.offers import AT_ONE_STOP
from model.search.moves.split import LINE_COLUMNS
from model.search.route.edit import MOVE_COLUMNS
from model.search.route.layout import (
    CUSTOMER, END, F_BEGIN, F_COUNT, F_DRONE, F_LAUNCH, F_NODE, F_RECOVERY, F_TAKEOFF, KEPT_COLUMNS,
    K_MOVE, NOWHERE, R_LENGTH, R_SORTIES, R_STAMP, R_TRIPS, R_TYPE, START, S_ARRIVAL, S_GAP, S_HOLD,
    S_KIND, S_LEAVE, S_LEG, S_NODE, S_RELEASE, T_FIRST, T_LAST, W_SLOT, Fleet, World, empty_fleet,
)
from model.search.route.refresh import clear_holds, locate, refresh, settle
from model.search.route.routes import drive_forward, load_trips
from model.search.route.state import (
    COUNTS, I_BEST_MISSING, I_CUSTOMERS, I_LEAN, I_MISSING, I_STAMP, V_COST, Searcher, keep_best,
    left_out_cost, list_active,
)
from model.solution import Route, Solution, Sortie, Stop, Trip, Visit

SPARE_SLOTS = 8
STOPS_OPENED = 4
"""Stops that one insertion adds at most, and one more."""


def make_searcher(problem: Problem, world: World, solution: Solution,
                  seed: np.random.SeedSequence) -> Searcher:
    """Begin a search from a plan; routes that it can't read are left to be planned anew."""
    alone = np.full(world.can.shape, INFEASIBLE)
    searcher = empty_searcher(world, _sizes(problem, world, solution), alone, seed)
    alone_costs(world, searcher.now, searcher.acc, alone)
    for slot, route in enumerate(solution.routes):
        write_route(searcher.now, slot, route)
    begin(world, searcher, len(solution.routes))
    return searcher


def empty_searcher(world: World, sizes: tuple[int, ...], alone: FloatArray,
                   seed: np.random.SeedSequence) -> Searcher:
    """Make room for a search: for so many routes, and stops, trips and sorties of one."""
    slots, stops, trips, sorties = sizes
    now, before, best = (empty_fleet(world, slots, stops, trips, sorties) for _ in range(3))
    nodes, count = world.num_nodes, _row(COUNTS)
    count[I_LEAN] = not world.general
    columns = K_MOVE + MOVE_COLUMNS if world.general else KEPT_COLUMNS
    kept = np.zeros((nodes, slots, columns) if world.keeps else (0, 0, 0), np.int64)
    kept_cost = np.zeros((nodes, slots) if world.keeps and world.general else (0, 0))
    # On one route, by a trip more on any, beside neighbours.
    offers = max(AT_ONE_STOP * stops + sorties * (world.max_visits + 1),
                 nodes + slots * (3 * trips + 2), 2 * AT_ONE_STOP * world.fit.shape[1])
    return Searcher(
        now=now, before=before, best=best, count=count, value=np.zeros(4),
        rng=seed.generate_state(1, np.uint64).astype(np.uint64), active=_row(slots),
        missing=_row(nodes), best_missing=_row(nodes), absent=_row(nodes), touched=_row(slots),
        marked=np.zeros(nodes, np.bool_), absences=_row(nodes),
        hit=np.zeros((slots, trips), np.int64), key=np.zeros(nodes),
        line=np.zeros((nodes + 3, LINE_COLUMNS), np.int64), line_cost=np.zeros(nodes + 3),
        moved=_row(max(slots, stops) + 2), move=_row(MOVE_COLUMNS),
        offer=np.zeros((offers, MOVE_COLUMNS), np.int64), least=np.zeros(offers),
        acc=_row(8), bound=np.zeros(2), alone=alone, kept=kept, kept_cost=kept_cost)


def _row(length: int) -> IntArray:
    return np.zeros(length, np.int64)


def first_plan(problem: Problem, world: World) -> Solution:
    """Return routes by savings where all vehicles are alike, none flies drones; else none.

    What flies is up to `world`, in which drones may be left aside. Routes have no times yet.
    """
    everyone = tuple(range(world.num_depots, world.num_nodes))
    if world.num_types > 1 or world.type[0, TYPE_DRONES] > 0:
        return Solution((), everyone)
    kind, = problem.vehicle_types
    start, end = kind.begins_at, kind.ends_at
    routes = sorted(savings_routes(world, 0), key=len, reverse=True)[: kind.count]
    return Solution(tuple(
        Route(0, number, (Trip(tuple(Stop(node, 0, 0, 0) for node in (start, *customers, end))),))
        for number, customers in enumerate(routes)), everyone)


def _sizes(problem: Problem, world: World, solution: Solution) -> tuple[int, int, int, int]:
    """Return how many routes, and stops, trips and sorties of one, are provided for."""
    columns, number = world.type, problem.num_customers
    demand = np.sort(world.place[problem.num_depots:, NODE_DEMAND:], axis=0).cumsum(axis=0)
    most, fewest = 0, number
    for kind in columns:
        trips = min(int(kind[TYPE_MAX_TRIPS]), number)
        capacity = kind[TYPE_CAPACITY:TYPE_CAPACITY + 3] * trips
        most = max(most, int((demand <= capacity).all(axis=1).sum()))
        largest = np.maximum(capacity, 1)
        fewest = min(fewest, int(np.ceil(demand[-1] / largest).max()) if number else 0)
    count = int(columns[:, TYPE_COUNT].sum())
    wanted = 2 * max(len(solution.routes), 2 * fewest) + SPARE_SLOTS
    if not solution.routes:
        wanted = number
    trips = min(int(columns[:, TYPE_MAX_TRIPS].max()), max(1, most)) + 1
    flown = most if world.visits.any() else 0
    return (max(1, min(count, number, wanted), len(solution.routes)),
            most + 2 * trips + STOPS_OPENED, trips, flown + 1)


@compiled
def alone_costs(world: World, fleet: Fleet, acc: IntArray, alone: FloatArray) -> None:
    """Write the cost of a route that serves one customer alone, (type, 2, node). In place."""
    slot = len(fleet.route) - 1
    for k in range(world.num_types):
        for by_drone in range(2):
            for node in range(world.num_depots, world.num_nodes):
                if (world.can[k, by_drone, node] and not rung(world.stop)
                        and serve_alone(world, fleet, slot, k, node, by_drone == 1, acc)):
                    alone[k, by_drone, node] = fleet.cost[slot]


@compiled
def begin(world: World, searcher: Searcher, num_routes: int) -> None:
    """Time the routes written; those that break a rule are left to be planned anew. In place."""
    now, count = searcher.now, searcher.count
    now.where[:] = NOWHERE
    cost = 0.0
    for slot in range(num_routes):
        if refresh(world, now, slot, searcher.acc):
            now.used[now.route[slot, R_TYPE]] += 1
            now.route[slot, R_STAMP] = 1
            cost += now.cost[slot]
            locate(now, slot)
        else:
            now.route[slot, R_LENGTH] = now.route[slot, R_SORTIES] = now.route[slot, R_TRIPS] = 0
            now.cost[slot] = 0.0
    for node in range(world.num_depots, world.num_nodes):
        if now.where[node, W_SLOT] == NOWHERE:
            searcher.missing[count[I_MISSING]] = node
            count[I_MISSING] += 1
    count[I_STAMP], count[I_CUSTOMERS] = 1, world.num_nodes - world.num_depots
    left_out = left_out_cost(world, searcher.missing, count[I_MISSING])
    searcher.value[V_COST] = cost + left_out
    list_active(searcher)
    keep_best(searcher)


@compiled
def leg_cost(world: World, searcher: Searcher) -> float:
    """Return what the truck's legs between customers cost on average.

    Where there are none, a share of the whole cost; always above zero.
    """
    now = searcher.now
    cost, legs = 0.0, 0
    for slot in range(len(searcher.active)):
        rate = world.rate[now.route[slot, R_TYPE]]
        for p in range(now.route[slot, R_LENGTH] - 1):
            if now.stop[slot, p, S_KIND] == CUSTOMER and now.stop[slot, p + 1, S_KIND] == CUSTOMER:
                cost += (now.stop[slot, p, S_LEG] * rate[RATE_KM]
                         + now.stop[slot, p, S_GAP] * rate[RATE_HOUR])
                legs += 1
    if cost > 0.0:
        return cost / legs
    left_out = left_out_cost(world, searcher.missing, searcher.count[I_MISSING])
    return max(1e-9, (searcher.value[V_COST] - left_out) / len(world.place))


def write_route(fleet: Fleet, slot: int, route: Route) -> None:
    """Write the sequence of a route. In place."""
    stops = [(stop.node, START if index == 0 else END if index == len(trip.stops) - 1 else CUSTOMER)
             for trip in route.trips for index, stop in enumerate(trip.stops)]
    fleet.stop[slot, : len(stops), [S_NODE, S_KIND]] = np.array(stops).T
    fleet.stop[slot, : len(stops), S_HOLD] = NONE
    firsts = np.cumsum([0] + [len(trip.stops) for trip in route.trips])
    sorties = sorted(
        ((int(first) + sortie.launch_stop, sortie.launch_time, int(first) + sortie.recovery_stop,
          index, sortie)
         for first, trip in zip(firsts, route.trips, strict=False)
         for index, sortie in enumerate(trip.sorties)), key=lambda entry: entry[:4])
    for s, (launch, _, recovery, _, sortie) in enumerate(sorties):
        row = fleet.sortie[slot, s]
        nodes = [visit.node for visit in sortie.visits]
        row[[F_LAUNCH, F_RECOVERY, F_DRONE, F_COUNT]] = (launch, recovery, sortie.drone,
                                                         len(nodes))
        row[F_NODE:F_NODE + len(nodes)] = nodes
    fleet.route[slot, [R_TYPE, R_LENGTH, R_SORTIES]] = (route.vehicle_type, len(stops),
                                                        len(sorties))


def read_plan(world: World, searcher: Searcher) -> Solution:
    """Return the best plan found, each trip begun as late as costs nothing."""
    best = searcher.best
    routes = []
    numbers = [0] * world.num_types
    for slot in range(len(searcher.active)):
        if best.route[slot, R_LENGTH] > 0:
            finish_route(world, best, slot, searcher.acc)
            k = int(best.route[slot, R_TYPE])
            routes.append(Route(k, numbers[k], _trips(world, best, slot)))
            numbers[k] += 1
    missing = searcher.best_missing[: searcher.count[I_BEST_MISSING]]
    return Solution(tuple(routes), tuple(sorted(int(node) for node in missing)))


@compiled
def finish_route(world: World, fleet: Fleet, slot: int, acc: IntArray) -> None:
    """Write the times of a route whose trips begin as late as costs nothing. In place."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    trips, sorties = fleet.trip[slot], fleet.sortie[slot]
    load_trips(world, route, stops, trips, sorties)
    clear_holds(route, stops, trips)
    drive_forward(world, route, stops, sorties, acc)
    settle(world, route, stops, trips, sorties, acc)


@compiled
def service_starts(place: IntArray, nodes: IntArray, arrivals: IntArray) -> IntArray:
    """Return when service begins at customers."""
    starts = np.empty_like(nodes)
    for index in range(len(nodes)):
        starts[index] = start_of_service(place[nodes[index]], arrivals[index])
    return starts


@compiled
def sortie_ends(place: IntArray, columns: IntArray, nodes: IntArray, arrivals: IntArray,
                begin: int) -> tuple[IntArray, int]:
    """Return when a drone has served its customers, and when it is aboard, recovered from `begin`.
    """
    ends = np.empty_like(nodes)
    for index in range(len(nodes)):
        ends[index] = ready(columns, place[nodes[index]], arrivals[index])
    return ends, recovery_end(columns, begin)


def _trips(world: World, fleet: Fleet, slot: int) -> tuple[Trip, ...]:
    """Return the trips of a timed route."""
    columns = fleet.route[slot]
    kind = world.type[columns[R_TYPE]]
    rows = fleet.stop[slot, : columns[R_LENGTH]]
    starts = service_starts(world.place, rows[:, S_NODE].copy(), rows[:, S_ARRIVAL].copy())
    stops = rows.tolist()
    halts = [_stop(row, start) for row, start in zip(stops, starts.tolist(), strict=True)]
    sorties = fleet.sortie[slot, : columns[R_SORTIES]]
    trips = []
    for first, last in fleet.trip[slot, : columns[R_TRIPS], [T_FIRST, T_LAST]].T.tolist():
        flown = tuple(_sortie(world, kind, row, first) for row in sorties
                      if first <= row[F_LAUNCH] <= last)
        trips.append(Trip(tuple(halts[first:last + 1]), flown))
    return tuple(trips)


def _stop(row: list[int], start: int) -> Stop:
    """Return a timed stop; `start` is when service begins if it is a customer's."""
    arrival = begin = row[S_ARRIVAL]
    if row[S_KIND] == START:
        arrival = begin = max(arrival, row[S_RELEASE], row[S_HOLD])
    elif row[S_KIND] == CUSTOMER:
        begin = start
    return Stop(row[S_NODE], arrival, begin, row[S_LEAVE])


def _sortie(world: World, kind: IntArray, row: IntArray, first: int) -> Sortie:
    count, times = row[F_COUNT], F_NODE + world.max_visits
    nodes, arrivals = row[F_NODE:F_NODE + count], row[times:times + count]
    launch, recovery, drone, takeoff, begin = row[
        [F_LAUNCH, F_RECOVERY, F_DRONE, F_TAKEOFF, F_BEGIN]].tolist()
    starts = service_starts(world.place, nodes, arrivals)
    ends, aboard = sortie_ends(world.place, kind, nodes, arrivals, begin)
    visits = tuple(Visit(*visit) for visit in zip(
        nodes.tolist(), arrivals.tolist(), starts.tolist(), ends.tolist(), strict=True))
    return Sortie(drone, launch - first, recovery - first, visits, takeoff, begin, int(aboard))
