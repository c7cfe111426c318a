"""Changes of a route's sequence: insertions, and the removal of marked customers."""

from model.kernel.compiled import inlined
from model.kernel.copying import clear, copy_row
from model.kernel.instance import NONE
from model.problem import BoolArray, IntArray
from model.search.route.layout import (
    CUSTOMER, END, F_COUNT, F_DRONE, F_LAUNCH, F_NODE, F_RECOVERY, R_LENGTH, R_SORTIES, R_TYPE,
    SEQUENCE_COLUMNS, START, S_HOLD, S_KIND, S_NODE, S_RELEASE,
)

(M_KIND, M_SLOT, M_FIRST, M_LAST, M_DRONE, M_SORTIE, M_TYPE) = range(7)
MOVE_COLUMNS = 8

(AT_STOP, BY_SORTIE, ON_SORTIE, NEW_TRIP, FLIGHT_TRIP, TRIP_FROM, TRIP_UNTIL, NEW_ROUTE,
 NEW_FLIGHT) = range(9)
"""Where a customer goes: behind stop M_FIRST; on a sortie of its own from stop M_FIRST to M_LAST;
on sortie M_SORTIE before its customer M_FIRST; on a trip of its own behind stop M_FIRST, by truck
or drone; behind M_FIRST, where a new trip begins, or where one ends; on a route of its own; by
drone from there."""

BY_TRUCK, FROM_START, ACROSS, FROM_END = range(4)
WAYS = 4
"""How a route serves one customer alone: by truck, or by a drone from the start and back, from the
start to the end, or from the end and back."""


@inlined
def put(stops: IntArray, p: int, node: int, kind: int) -> None:
    """Write a stop's place in the sequence. In place."""
    stops[p, S_NODE], stops[p, S_KIND] = node, kind
    stops[p, S_RELEASE], stops[p, S_HOLD] = NONE, NONE


@inlined
def make_room(route: IntArray, stops: IntArray, sorties: IntArray, p: int, room: int) -> None:
    """Move all stops from `p` on by `room` places. In place."""
    for q in range(route[R_LENGTH] - 1, p - 1, -1):
        for column in range(SEQUENCE_COLUMNS):
            stops[q + room, column] = stops[q, column]
        stops[q + room, S_HOLD] = stops[q, S_HOLD]
    route[R_LENGTH] += room
    for s in range(route[R_SORTIES]):
        if sorties[s, F_LAUNCH] >= p:
            sorties[s, F_LAUNCH] += room
        if sorties[s, F_RECOVERY] >= p:
            sorties[s, F_RECOVERY] += room


@inlined
def add_sortie(route: IntArray, sorties: IntArray, launch: int, recovery: int, drone: int,
               node: int) -> None:
    """Add a sortie to one customer, in its place in the order. In place."""
    s = route[R_SORTIES]
    while s > 0 and (sorties[s - 1, F_LAUNCH] > launch or (
            sorties[s - 1, F_LAUNCH] == launch and sorties[s - 1, F_RECOVERY] > recovery)):
        copy_row(sorties[s - 1], sorties[s])
        s -= 1
    clear(sorties[s])
    sorties[s, F_LAUNCH], sorties[s, F_RECOVERY], sorties[s, F_DRONE] = launch, recovery, drone
    sorties[s, F_COUNT], sorties[s, F_NODE] = 1, node
    route[R_SORTIES] += 1


@inlined
def join_sortie(sortie: IntArray, place: int, node: int) -> None:
    """Let a sortie serve a customer before its customer number `place`. In place."""
    for index in range(sortie[F_COUNT], place, -1):
        sortie[F_NODE + index] = sortie[F_NODE + index - 1]
    sortie[F_NODE + place] = node
    sortie[F_COUNT] += 1


@inlined
def apply(depot: int, route: IntArray, stops: IntArray, sorties: IntArray, move: IntArray,
          node: int, offset: int, skipped: int) -> None:
    """Insert a customer, in a part that begins `offset` stops and `skipped` sorties later.

    In place.
    """
    kind, first = move[M_KIND], move[M_FIRST] - offset
    if kind == AT_STOP:
        make_room(route, stops, sorties, first + 1, 1)
        put(stops, first + 1, node, CUSTOMER)
    elif kind == BY_SORTIE:
        add_sortie(route, sorties, first, move[M_LAST] - offset, move[M_DRONE], node)
    elif kind == ON_SORTIE:
        join_sortie(sorties[move[M_SORTIE] - skipped], move[M_FIRST], node)
    elif kind == NEW_TRIP:
        make_room(route, stops, sorties, first + 1, 3)
        put(stops, first + 1, depot, START)
        put(stops, first + 2, node, CUSTOMER)
        put(stops, first + 3, depot, END)
    elif kind == FLIGHT_TRIP:
        make_room(route, stops, sorties, first + 1, 2)
        put(stops, first + 1, depot, START)
        put(stops, first + 2, depot, END)
        add_sortie(route, sorties, first + 1, first + 1, 0, node)
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
def begin_route(route: IntArray, stops: IntArray, sorties: IntArray, k: int, start: int, end: int,
                node: int, way: int) -> None:
    """Write a route that serves one customer in one of the `WAYS`. In place."""
    clear(route)
    route[R_TYPE] = k
    put(stops, 0, start, START)
    if way != BY_TRUCK:
        put(stops, 1, end, END)
        route[R_LENGTH] = 2
        add_sortie(route, sorties, int(way == FROM_END), int(way != FROM_START), 0, node)
    else:
        put(stops, 1, node, CUSTOMER)
        put(stops, 2, end, END)
        route[R_LENGTH] = 3


@inlined
def keep_sorties(route: IntArray, stops: IntArray, sorties: IntArray, marked: BoolArray,
                 absent: IntArray, num_absent: int) -> int:
    """Drop marked customers from sorties, and sorties that begin or end at marked stops.

    In place; their other customers are marked and listed in `absent`. Returns how many are there.
    """
    kept = 0
    for s in range(route[R_SORTIES]):
        sortie = sorties[s]
        grounded = False
        for end in (F_LAUNCH, F_RECOVERY):
            p = sortie[end]
            if stops[p, S_KIND] == CUSTOMER and marked[stops[p, S_NODE]]:
                grounded = True
        left = 0
        for visit in range(sortie[F_COUNT]):
            node = sortie[F_NODE + visit]
            if grounded and not marked[node]:
                marked[node] = True
                absent[num_absent] = node
                num_absent += 1
            if not marked[node]:
                sortie[F_NODE + left] = node
                left += 1
        sortie[F_COUNT] = left
        if left > 0:
            copy_row(sortie, sorties[kept])
            kept += 1
    route[R_SORTIES] = kept
    return num_absent


@inlined
def is_empty_trip(route: IntArray, stops: IntArray, sorties: IntArray, marked: BoolArray,
                  p: int) -> bool:
    """Tell whether the trip that begins at stop `p` serves nobody any more."""
    q = p + 1
    while stops[q, S_KIND] == CUSTOMER:
        if not marked[stops[q, S_NODE]]:
            return False
        q += 1
    empty = True
    for s in range(route[R_SORTIES]):
        empty = empty and not p <= sorties[s, F_LAUNCH] <= q
    return empty


@inlined
def close_ranks(route: IntArray, stops: IntArray, sorties: IntArray, marked: BoolArray,
                moved: IntArray) -> None:
    """Remove marked stops and empty trips; sorties have been dealt with. In place.

    `moved` is scratch for a position per stop.
    """
    kept = 0
    dropping = False
    for p in range(route[R_LENGTH]):
        kind = stops[p, S_KIND]
        if kind == START:
            dropping = is_empty_trip(route, stops, sorties, marked, p)
        drop = dropping or (kind == CUSTOMER and marked[stops[p, S_NODE]])
        moved[p] = kept
        if not drop:
            if kept < p:
                for column in range(SEQUENCE_COLUMNS):
                    stops[kept, column] = stops[p, column]
                stops[kept, S_HOLD] = stops[p, S_HOLD]
            kept += 1
    route[R_LENGTH] = kept
    for s in range(route[R_SORTIES]):
        sorties[s, F_LAUNCH] = moved[sorties[s, F_LAUNCH]]
        sorties[s, F_RECOVERY] = moved[sorties[s, F_RECOVERY]]
