"""Changes of a route's sequence: insertions, and the removal of marked customers."""

from model.kernel.compiled import inlined
from model.kernel.instance import NONE
from model.kernel.records import Record, Records, record
from model.problem import BoolArray, IntArray
from model.search.route.layout import CUSTOMER, END, START, copy_sequence

MOVE = record("kind", "slot", "first", "last", "drone", "sortie", "type")

(AT_STOP, BY_SORTIE, ON_SORTIE, NEW_TRIP, FLIGHT_TRIP, TRIP_FROM, TRIP_UNTIL, NEW_ROUTE,
 NEW_FLIGHT) = range(9)
"""Where a customer goes: behind stop `first`; on a sortie of its own from stop `first` to `last`;
on sortie number `sortie` before its customer `first`; on a trip of its own behind stop `first`, by
truck or drone; behind `first`, where a new trip begins, or where one ends; on a route of its own;
by drone from there."""


@inlined
def copy_move(move: Record, to: Record) -> None:
    """Copy a move. In place."""
    to.kind, to.slot, to.first, to.last = move.kind, move.slot, move.first, move.last
    to.drone, to.sortie, to.type = move.drone, move.sortie, move.type

BY_TRUCK, FROM_START, ACROSS, FROM_END = range(4)
WAYS = 4
"""How a route serves one customer alone: by truck, or by a drone from the start and back, from the
start to the end, or from the end and back."""


@inlined
def put(stops: Records, p: int, node: int, kind: int) -> None:
    """Write a stop's place in the sequence. In place."""
    stops[p].node, stops[p].kind = node, kind
    stops[p].release, stops[p].hold = NONE, NONE


@inlined
def make_room(route: Record, stops: Records, sorties: Records, p: int, room: int) -> None:
    """Move all stops from `p` on by `room` places. In place."""
    for q in range(route.length - 1, p - 1, -1):
        copy_sequence(stops[q], stops[q + room])
        stops[q + room].hold = stops[q].hold
    route.length += room
    for s in range(route.sorties):
        if sorties[s].launch >= p:
            sorties[s].launch += room
        if sorties[s].recovery >= p:
            sorties[s].recovery += room


@inlined
def add_sortie(route: Record, sorties: Records, launch: int, recovery: int, drone: int,
               node: int) -> None:
    """Add a sortie to one customer, in its place in the order. In place."""
    s = route.sorties
    while s > 0 and (sorties[s - 1].launch > launch or (
            sorties[s - 1].launch == launch and sorties[s - 1].recovery > recovery)):
        sorties[s] = sorties[s - 1]
        s -= 1
    sorties[s].launch, sorties[s].recovery, sorties[s].drone = launch, recovery, drone
    sorties[s].count, sorties[s].nodes[0] = 1, node
    route.sorties += 1


@inlined
def join_sortie(sortie: Record, place: int, node: int) -> None:
    """Let a sortie serve a customer before its customer number `place`. In place."""
    for index in range(sortie.count, place, -1):
        sortie.nodes[index] = sortie.nodes[index - 1]
    sortie.nodes[place] = node
    sortie.count += 1


@inlined
def apply(depot: int, route: Record, stops: Records, sorties: Records, move: Record,
          node: int, offset: int, skipped: int) -> None:
    """Insert a customer, in a part that begins `offset` stops and `skipped` sorties later.

    In place.
    """
    kind, first = move.kind, move.first - offset
    if kind == AT_STOP:
        make_room(route, stops, sorties, first + 1, 1)
        put(stops, first + 1, node, CUSTOMER)
    elif kind == BY_SORTIE:
        add_sortie(route, sorties, first, move.last - offset, move.drone, node)
    elif kind == ON_SORTIE:
        join_sortie(sorties[move.sortie - skipped], move.first, node)
    elif kind == NEW_TRIP:
        make_room(route, stops, sorties, first + 1, 3)
        put(stops, first + 1, depot, START)
        put(stops, first + 2, node, CUSTOMER)
        put(stops, first + 3, depot, END)
    elif kind == FLIGHT_TRIP:
        make_room(route, stops, sorties, first + 1, 2)
        put(stops, first + 1, depot, START)
        put(stops, first + 2, depot, END)
        add_sortie(route, sorties, first + 1, first + 1, move.drone, node)
    elif kind == TRIP_FROM:
        make_room(route, stops, sorties, first + 1, 3)
        put(stops, first + 1, depot, END)
        put(stops, first + 2, depot, START)
        put(stops, first + 3, node, CUSTOMER)
    elif kind == TRIP_UNTIL:
        make_room(route, stops, sorties, first + 1, 3)
        put(stops, first + 1, node, CUSTOMER)
        put(stops, first + 2, depot, END)
        put(stops, first + 3, depot, START)


@inlined
def begin_route(route: Record, stops: Records, sorties: Records, k: int, start: int, end: int,
                node: int, way: int, drone: int) -> None:
    """Write a route that serves one customer in one of the `WAYS`, by a `drone`. In place."""
    route.trips = route.sorties = route.end = route.cum = route.working = 0
    route.offset = route.stamp = 0
    route.type = k
    put(stops, 0, start, START)
    if way != BY_TRUCK:
        put(stops, 1, end, END)
        route.length = 2
        add_sortie(route, sorties, int(way == FROM_END), int(way != FROM_START), drone, node)
    else:
        put(stops, 1, node, CUSTOMER)
        put(stops, 2, end, END)
        route.length = 3


@inlined
def keep_sorties(route: Record, stops: Records, sorties: Records, marked: BoolArray,
                 absent: IntArray, num_absent: int) -> int:
    """Drop marked customers from sorties, and sorties that begin or end at marked stops.

    In place; their other customers are marked and listed in `absent`. Returns how many are there.
    """
    kept = 0
    for s in range(route.sorties):
        sortie = sorties[s]
        grounded = False
        for p in (sortie.launch, sortie.recovery):
            if stops[p].kind == CUSTOMER and marked[stops[p].node]:
                grounded = True
        left = 0
        for visit in range(sortie.count):
            node = sortie.nodes[visit]
            if grounded and not marked[node]:
                marked[node] = True
                absent[num_absent] = node
                num_absent += 1
            if not marked[node]:
                sortie.nodes[left] = node
                left += 1
        sortie.count = left
        if left > 0:
            sorties[kept] = sorties[s]
            kept += 1
    route.sorties = kept
    return num_absent


@inlined
def is_empty_trip(route: Record, stops: Records, sorties: Records, marked: BoolArray,
                  p: int) -> bool:
    """Tell whether the trip that begins at stop `p` serves nobody any more."""
    q = p + 1
    while stops[q].kind == CUSTOMER:
        if not marked[stops[q].node]:
            return False
        q += 1
    empty = True
    for s in range(route.sorties):
        empty = empty and not p <= sorties[s].launch <= q
    return empty


@inlined
def close_ranks(route: Record, stops: Records, sorties: Records, marked: BoolArray,
                moved: IntArray) -> None:
    """Remove marked stops and empty trips; sorties have been dealt with. In place.

    `moved` is scratch for a position per stop.
    """
    kept = 0
    dropping = False
    for p in range(route.length):
        kind = stops[p].kind
        if kind == START:
            dropping = is_empty_trip(route, stops, sorties, marked, p)
        drop = dropping or (kind == CUSTOMER and marked[stops[p].node])
        moved[p] = kept
        if not drop:
            if kept < p:
                copy_sequence(stops[p], stops[kept])
                stops[kept].hold = stops[p].hold
            kept += 1
    route.length = kept
    for s in range(route.sorties):
        sorties[s].launch = moved[sorties[s].launch]
        sorties[s].recovery = moved[sorties[s].recovery]
