"""Plans to and from the routes of a search."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from model.kernel.alarm import rung
from model.kernel.compiled import compiled
from model.kernel.drone_types import most_drone_rows, row_of_drone
from model.kernel.flight import recovery_end
from model.kernel.instance import NONE, TIER
from model.kernel.records import Record, one, read_rows, Records
from model.kernel.stop import end_of_service, places_by_air, start_of_service
from model.problem import FloatArray, IntArray, Problem
from model.search.insertion.evaluate import INFEASIBLE, serve_alone
from model.search.insertion.offers import AT_ONE_STOP
from model.search.moves.split import LINE
from model.search.route.block import SUMS
from model.search.route.edit import MOVE
from model.search.route.freshness import hold_trips
from model.search.route.layout import (
    CUSTOMER, END, MOST_VISITS, NOWHERE, START, Fleet, World, empty_fleet, BOUND, KEPT,
)
from model.search.route.rarer import time_aboard_counts
from model.search.route.refresh import clear_holds, locate, refresh, settle
from model.search.route.routes import drive_forward, load_trips
from model.search.route.state import (
    ALL, COUNTS, VALUES, Searcher, keep_best, left_out_cost, list_active,
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
    nodes, count = world.num_nodes, one(COUNTS)
    now, before, best = (empty_fleet(world, slots, stops, trips, sorties, noted)
                         for noted in (nodes, 0, 0))
    count.lean, count.focus = not world.general, NOWHERE
    room = (nodes, slots) if world.keeps else (0, 0)
    of_moves = room if world.general else (0, 0)
    # On one route, by a trip more on any, beside neighbours.
    at_one_stop = AT_ONE_STOP * most_drone_rows(world.type)
    offers = max(at_one_stop * stops + sorties * (world.max_visits + 1),
                 nodes + slots * (2 + most_drone_rows(world.type)) * (trips + 1),
                 2 * at_one_stop * world.fit.shape[1])
    return Searcher(
        now=now, before=before, best=best, count=count, value=one(VALUES),
        rng=seed.generate_state(1, np.uint64).astype(np.uint64), active=_row(slots),
        rank=_row(slots), changed=_row(slots), is_changed=np.zeros(slots, np.bool_),
        missing=_row(nodes), best_missing=_row(nodes), absent=_row(nodes), touched=_row(slots),
        marked=np.zeros(nodes, np.bool_), absences=_row(nodes),
        hit=np.zeros((slots, trips), np.int64), key=np.zeros(nodes),
        line=np.zeros(nodes + 3, LINE), line_cost=np.zeros(nodes + 3),
        moved=_row(max(slots, stops) + 2), move=one(MOVE),
        offer=np.zeros(offers, MOVE), least=np.zeros(offers),
        acc=one(SUMS), bound=one(BOUND), alone=alone, kept=np.zeros(room, KEPT),
        kept_move=np.zeros(of_moves, MOVE), kept_cost=np.zeros(of_moves))


def _row(length: int) -> IntArray:
    return np.zeros(length, np.int64)


def _sizes(problem: Problem, world: World, solution: Solution) -> tuple[int, int, int, int]:
    """Return how many routes, and stops, trips and sorties of one, are provided for."""
    types, number = world.type[:world.num_types], problem.num_customers
    delivered, picked = (np.array(amounts, np.int64).reshape(number, problem.num_dimensions)
                         for amounts in ([customer.demand for customer in problem.customers],
                                         [customer.taken_in for customer in problem.customers]))
    asked = np.maximum(delivered.sum(axis=0), picked.sum(axis=0))
    most, fewest = 0, number
    for kind in types:
        capacity = kind.capacity[:len(asked)] * min(int(kind.max_trips), number)
        if kind.drones:
            # Part of a trip is written anew before more than what it delivers is looked at.
            most = max(most, _most_of(delivered[:, :TIER], capacity[:TIER]))
        else:
            most = max(most, min(_most_carried(delivered, picked, capacity), _most_served(kind)))
        needed = int(np.ceil(asked / np.maximum(capacity, 1)).max()) if number else 0
        fewest = min(fewest, max(needed, -(-number // max(1, _most_served(kind)))))
    # What is given may keep fewer rules than what the search makes of it.
    most = max((most, *(sum(len(trip.stops) + len(trip.sorties) for trip in route.trips)
                        for route in solution.routes)))
    count = int(types["count"].sum())
    wanted = 2 * max(len(solution.routes), 2 * fewest) + SPARE_SLOTS
    if not solution.routes:
        wanted = number
    trips = min(int(types["max_trips"].max()), max(1, most)) + 1
    flown = most if world.visits.any() else 0
    return (max(1, min(count, number, wanted), len(solution.routes)),
            most + 2 * trips + STOPS_OPENED, trips, flown + 1)


def _most_carried(delivered: IntArray, picked: IntArray, capacity: IntArray) -> int:
    """Return how many customers a vehicle carries for at most; amounts are (customer, dimension).
    """
    has, had = delivered.any(axis=1), picked.any(axis=1)
    carried = _most_of(delivered[has], capacity) + _most_of(picked[had], capacity)
    return min(len(delivered), carried + int((~(has | had)).sum()))


def _most_of(amounts: IntArray, capacity: IntArray) -> int:
    """Return how many of these (customer, dimension) a capacity holds at most."""
    return int((np.sort(amounts, axis=0).cumsum(axis=0) <= capacity).all(axis=1).sum())


def _most_served(kind: Record) -> int:
    """Return how many customers a vehicle of a type serves at most, by stops and sorties."""
    flown = int(kind.max_sorties) * MOST_VISITS if kind.drones else 0
    return int(kind.max_trips) * (int(kind.max_stops) + flown)


@compiled
def alone_costs(world: World, fleet: Fleet, acc: Record, alone: FloatArray) -> None:
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
    for node in range(world.num_nodes):
        now.where[node].slot = NOWHERE
    cost = 0.0
    for slot in range(num_routes):
        if refresh(world, now, slot, searcher.acc):
            now.used[now.route[slot].type] += 1
            cost += now.cost[slot]
            locate(now, slot)
        else:
            now.route[slot].length = now.route[slot].sorties = now.route[slot].trips = 0
            now.cost[slot] = 0.0
    for node in range(world.num_depots, world.num_nodes):
        if now.where[node].slot == NOWHERE:
            searcher.missing[count.missing] = node
            count.missing += 1
    for slot in range(len(searcher.active)):
        now.route[slot].stamp = 1
    count.stamp, count.customers, count.changed = 1, world.num_nodes - world.num_depots, ALL
    left_out = left_out_cost(world, searcher.missing, count.missing)
    searcher.value.cost = cost + left_out
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
        rate = world.rate[now.route[slot].type]
        for p in range(now.route[slot].length - 1):
            if now.stop[slot, p].kind == CUSTOMER and now.stop[slot, p + 1].kind == CUSTOMER:
                cost += (now.stop[slot, p].leg * rate.distance
                         + now.stop[slot, p].gap * rate.time)
                legs += 1
    if cost > 0.0:
        return cost / legs
    left_out = left_out_cost(world, searcher.missing, searcher.count.missing)
    return max(1e-9, (searcher.value.cost - left_out) / world.num_nodes)


def write_route(fleet: Fleet, slot: int, route: Route) -> None:
    """Write the sequence of a route. In place."""
    stops = [(stop.node, START if index == 0 else END if index == len(trip.stops) - 1 else CUSTOMER)
             for trip in route.trips for index, stop in enumerate(trip.stops)]
    written = fleet.stop[slot, : len(stops)]
    written["node"], written["kind"] = np.array(stops).T
    written["hold"] = NONE
    firsts = np.cumsum([0] + [len(trip.stops) for trip in route.trips])
    sorties = sorted(
        ((int(first) + sortie.launch_stop, sortie.launch_time, int(first) + sortie.recovery_stop,
          index, sortie)
         for first, trip in zip(firsts, route.trips, strict=False)
         for index, sortie in enumerate(trip.sorties)), key=lambda entry: entry[:4])
    for s, (launch, _, recovery, _, sortie) in enumerate(sorties):
        row = fleet.sortie[slot, s]
        nodes = [visit.node for visit in sortie.visits]
        row.launch, row.recovery, row.drone = launch, recovery, sortie.drone
        row.count, row.nodes[: len(nodes)] = len(nodes), nodes
    row = fleet.route[slot]
    row.type, row.length, row.sorties = route.vehicle_type, len(stops), len(sorties)


def left_out(searcher: Searcher) -> tuple[int, ...]:
    """Return the customers that the best plan leaves out."""
    return tuple(sorted(searcher.best_missing[: searcher.count.best_missing].tolist()))


def read_routes(world: World, searcher: Searcher) -> Iterator[Route]:
    """Yield the routes of the best plan found, each trip begun as late as costs nothing."""
    best = searcher.best
    slots = np.flatnonzero(best.route["length"][: len(searcher.active)]).tolist()
    for slot in slots:
        finish_route(world, best, slot, searcher.acc)
    numbers = [0] * world.num_types
    for slot, row in zip(slots, read_rows(best.route[slots]), strict=True):
        yield Route(row.type, numbers[row.type], _trips(world, best, slot, row))
        numbers[row.type] += 1


@compiled
def finish_route(world: World, fleet: Fleet, slot: int, acc: Record) -> None:
    """Write the times of a route whose trips begin as late as costs nothing. In place."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    trips, sorties = fleet.trip[slot], fleet.sortie[slot]
    load_trips(world, route, stops, trips, sorties)
    clear_holds(route, stops, trips)
    drive_forward(world, route, stops, sorties, acc)
    if time_aboard_counts(world):
        hold_trips(world, route, stops, trips, sorties, acc)
    settle(world, route, stops, trips, sorties, acc)


@compiled
def service_starts(place: Records, nodes: IntArray, arrivals: IntArray) -> IntArray:
    """Return when service begins at customers."""
    starts = np.empty_like(nodes)
    for index in range(len(nodes)):
        starts[index] = start_of_service(place[nodes[index]], arrivals[index])
    return starts


def setups_of(setup: Records, origins: IntArray, nodes: IntArray) -> IntArray:
    """Return how long whoever comes from some nodes to others sets up there."""
    if len(setup) == 0:
        return np.zeros_like(nodes)
    here, there = setup[origins], setup[nodes]
    setups: IntArray = np.where(here["site"] == there["site"], 0, there["setup_duration"])
    return setups


@compiled
def sortie_ends(places: Records, types: Records, k: int, drone: int, nodes: IntArray,
                arrivals: IntArray, begin: int) -> tuple[IntArray, int]:
    """Return when a truck's drone has served its customers, and when it is aboard.

    It is recovered from `begin`.
    """
    kind = types[row_of_drone(types, k, drone)]
    ends, by_air = np.empty_like(nodes), places_by_air(places, kind)
    for index in range(len(nodes)):
        ends[index] = end_of_service(by_air[nodes[index]], arrivals[index])
    return ends, recovery_end(kind, begin)


def _trips(world: World, fleet: Fleet, slot: int, route: Any) -> tuple[Trip, ...]:
    """Return the trips of a timed route, whose own row is given."""
    rows, trips = fleet.stop[slot, : route.length], fleet.trip[slot, : route.trips]
    starts = service_starts(world.place[0], rows["node"].copy(), rows["arrival"].copy())
    columns = (rows[name].tolist() for name in (
        "node", "kind", "arrival", "release", "hold", "leave"))
    setups = setups_of(world.setup, np.roll(rows["node"], 1), rows["node"].copy())
    halts = [_stop(*row) for row in zip(*columns, starts.tolist(), setups.tolist(), strict=True)]
    sorties = read_rows(fleet.sortie[slot, : route.sorties]) if route.sorties > 0 else []
    return tuple(
        Trip(tuple(halts[first:last + 1]),
             tuple(_sortie(world, route.type, row, halts[row.launch].node, first)
                   for row in sorties if first <= row.launch <= last))
        for first, last in zip(trips["first"].tolist(), trips["last"].tolist(), strict=True))


def _stop(node: int, kind: int, arrival: int, release: int, hold: int, leave: int,
          start: int, setup: int) -> Stop:
    """Return a timed stop; `start` is when service begins, `setup` of the arrival, if it is a
    customer's.
    """
    begin = arrival
    if kind == START:
        arrival = begin = max(arrival, release, hold)
    elif kind == CUSTOMER:
        begin, arrival = start, arrival - setup
    return Stop(node, arrival, begin, leave, setup if kind == CUSTOMER else 0)


def _sortie(world: World, k: int, row: Any, launch_node: int, first: int) -> Sortie:
    nodes = np.array(row.nodes[: row.count], np.int64)
    arrivals = np.array(row.arrivals[: row.count], np.int64)
    starts = service_starts(world.place[0], nodes, arrivals)
    ends, aboard = sortie_ends(world.place, world.type, k, row.drone, nodes, arrivals, row.begin)
    setups = setups_of(world.setup, np.array([launch_node, *nodes[:-1]], np.int64), nodes)
    visits = tuple(Visit(*visit) for visit in zip(
        nodes.tolist(), (arrivals - setups).tolist(), starts.tolist(), ends.tolist(),
        setups.tolist(), strict=True))
    return Sortie(row.drone, row.launch - first, row.recovery - first, visits, row.takeoff,
                  row.begin, int(aboard))
