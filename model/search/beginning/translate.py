"""Plans to and from the routes of a search."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from model.engine.alarm import Alarm
from model.engine.breaks import NONE, PLACES, BrokenRoute, resting_in_gap
from model.engine.library import call, packed
from model.engine.records import Records, read_rows
from model.engine.type_rows import NO_PROFILE
from model.problem import IntArray, Problem
from model.search.beginning.room import room_for
from model.search.route.engine import INFEASIBLE
from model.search.route.layout import (
    CUSTOMER, END, HALT, START, Fleet, ProblemData,
)
from model.search.route.state import Searcher
from model.solution import (
    Charge, Route, Solution, Sortie, Stop, TakenBreak, Trip, Visit, renumbered_routes,
    with_handling,
)


def make_searcher(problem: Problem, data: ProblemData, solution: Solution,
                  seed: np.random.SeedSequence) -> Searcher:
    """Begin a search from a plan; routes that it can't read are left to be planned anew."""
    alone = np.full(data.can.shape, INFEASIBLE)
    searcher = Searcher.opened(data, room_for(problem, data, solution), alone, seed)
    call("tandem_alone_costs", data, searcher.now, alone)
    for slot, route in enumerate(solution.routes):
        write_route(searcher.now, slot, route)
    call("tandem_begin", data, searcher, len(solution.routes))
    return searcher


def write_route(fleet: Fleet, slot: int, route: Route) -> None:
    """Write the sequence of a route. In place."""
    stops = [(stop.node, START if index == 0 else END if index == len(trip.stops) - 1
              else HALT if stop.is_launch_site else CUSTOMER)
             for trip in route.trips for index, stop in enumerate(trip.stops)]
    written = fleet.stop[slot, : len(stops)]
    written["node"], written["kind"] = np.array(stops).T
    written["hold"], written["free_start"] = NONE, 0
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
    written["free_start"][firsts[:-1]] = [trip.stops[0].arrival for trip in route.trips]
    # Who is charged in turn once before each trip at most: if in pieces, it is timed anew.
    charges = [trip.charges[0] if len(trip.charges) == 1 else (0, 0) for trip in route.trips]
    for name, times in zip(("charged_from", "charged_until"), zip(*charges, strict=True),
                           strict=True):
        fleet.trip[slot, : len(charges)][name] = times
    row = fleet.route[slot]
    row.type, row.length, row.sorties = route.vehicle_type, len(stops), len(sorties)


def left_out(data: ProblemData, searcher: Searcher) -> tuple[int, ...]:
    """Return the customers that the best plan leaves out, all ends of a shipment."""
    missing = searcher.best_missing[: searcher.count.best_missing].tolist()
    if len(data.pair):
        # Who stands for a shipment has all others of it behind.
        is_end, unit = data.pair["partner"] >= 0, data.pair["unit"]
        missing += np.flatnonzero(
            is_end & np.isin(unit, missing) & (unit != np.arange(len(unit)))).tolist()
    return tuple(sorted(missing))


def read_routes(data: ProblemData, searcher: Searcher) -> Iterator[Route]:
    """Yield the routes of the best plan found, each trip begun as late as costs nothing.

    That has its time however late it is: routes as they were searched for may begin too soon.
    """
    best = searcher.best
    given = packed(data._replace(deadline=Alarm().setting)), packed(best)
    slots = np.flatnonzero(best.route["length"][: len(searcher.active)]).tolist()
    for slot in slots:
        call("tandem_finish_route", *given, slot)
    numbers = [0] * data.num_types
    for slot, row in zip(slots, read_rows(best.route[slots]), strict=True):
        yield Route(row.type, numbers[row.type], _trips(data, best, slot, row))
        numbers[row.type] += 1


def service_starts(place: Records, nodes: IntArray, arrivals: IntArray) -> IntArray:
    """Return when service begins at customers."""
    starts = np.empty_like(nodes)
    call("tandem_service_starts", place, nodes, arrivals, starts)
    return starts


def setups_of(setup: Records, origins: IntArray, nodes: IntArray) -> IntArray:
    """Return how long whoever comes from some nodes to others sets up there."""
    if len(setup) == 0:
        return np.zeros_like(nodes)
    here, there = setup[origins], setup[nodes]
    setups: IntArray = np.where(here["site"] == there["site"], 0, there["setup_duration"])
    return setups


def _trips(data: ProblemData, fleet: Fleet, slot: int, route: Any) -> tuple[Trip, ...]:
    """Return the trips of a timed route, whose own row is given."""
    rows, trips = fleet.stop[slot, : route.length], fleet.trip[slot, : route.trips]
    served = rows["arrival"].copy()
    if len(data.lag):
        served = np.where(rows["kind"] == CUSTOMER, np.maximum(served, rows["start"]), served)
    starts = service_starts(data.place[0], rows["node"].copy(), served)
    columns = (rows[name].tolist() for name in (
        "node", "kind", "arrival", "release", "hold", "leave"))
    setups = setups_of(data.setup, np.roll(rows["node"], 1), rows["node"].copy())
    halts = [_stop(*row) for row in zip(*columns, starts.tolist(), setups.tolist(), strict=True)]
    sorties = read_rows(fleet.sortie[slot, : route.sorties]) if route.sorties > 0 else []
    kind = data.type[route.type]
    handling = (kind.launch_duration, kind.recovery_duration) if kind.flies else (0, 0)
    broken = BrokenRoute(data.type, (data.profile_time, data.profile_factor), route.type,
                         halts[0].arrival) if kind.must_rest or kind.breaks else None
    return tuple(
        Trip(with_handling(halts[first:last + 1], *handling),
             tuple(_sortie(data, route.type, row, halts[row.launch].node, first)
                   for row in sorties if first <= row.launch <= last),
             _breaks(data, data.type[route.type], halts, rows, (first, last), broken)
             if broken else (),
             (Charge(since, until),) if kind.shares_chargers and since < until else ())
        for first, last, since, until in trips[
            ["first", "last", "charged_from", "charged_until"]].tolist())


def _breaks(data: ProblemData, kind: Any, halts: Sequence[Stop], rows: Records,
            trip: tuple[int, int], broken: BrokenRoute) -> tuple[TakenBreak, ...]:
    """Return the breaks of a trip, of which the first and the last stop are given."""
    first, last = trip
    rests, taken = rows["rests"].tolist(), list[TakenBreak]()
    for place in range(first, last):
        duration = int(rows[place]["gap"])
        if kind.speed_changes == NO_PROFILE:
            duration -= halts[place + 1].setup + resting_in_gap(kind, rests[place])
        taken += [TakenBreak(number, place - first, PLACES[where], arrival, start, end)
                  for number, where, arrival, start, end in broken.drive(
                      rests[place], halts[place].departure, duration,
                      _stood_at(data, kind, rows[place], place))]
    return tuple(taken)


def _stood_at(data: ProblemData, kind: Any, row: Any, place: int) -> int:
    """Return how long a driver is at other work at a stop, however long he waits."""
    if row["kind"] == CUSTOMER:
        return int(data.place[kind.variant][row["node"], 0]["service_duration"])
    return int(kind.reload_duration) if row["kind"] == START and place > 0 else 0


def _stop(node: int, kind: int, arrival: int, release: int, hold: int, leave: int,
          start: int, setup: int) -> Stop:
    """Return a timed stop; `start` is when service begins, or who comes back is let in; of
    the arrival, if it is a customer's, `setup`.
    """
    begin = arrival
    if kind == START:
        arrival = begin = max(arrival, release, hold)
    elif kind == CUSTOMER:
        begin, arrival = start, arrival - setup
    else:
        begin = start
    return Stop(node, arrival, begin, leave, setup if kind == CUSTOMER else 0, kind == HALT)


def _sortie(data: ProblemData, k: int, row: Any, launch_node: int, first: int) -> Sortie:
    nodes = np.array(row.nodes[: row.count], np.int64)
    arrivals = np.array(row.arrivals[: row.count], np.int64)
    starts = service_starts(data.place[0], nodes, arrivals)
    ends = np.empty_like(nodes)
    aboard = call("tandem_sortie_ends", data.place, data.type, k, row.drone, nodes, arrivals,
                  row.begin, ends)
    setups = setups_of(data.setup, np.array([launch_node, *nodes[:-1]], np.int64), nodes)
    visits = tuple(Visit(*visit) for visit in zip(
        nodes.tolist(), (arrivals - setups).tolist(), starts.tolist(), ends.tolist(),
        setups.tolist(), strict=True))
    return Sortie(row.drone, row.launch - first, row.recovery - first, visits, row.takeoff,
                  row.begin, int(aboard))


def best_plan(data: ProblemData, searcher: Searcher, node: Sequence[int]) -> Solution:
    """Return a search's best plan by the problem's numbers, which `node` has by the search's."""
    routes = renumbered_routes(read_routes(data, searcher), node.__getitem__)
    missing = sorted(node[each] for each in left_out(data, searcher))
    return Solution(tuple(routes), tuple(missing))
