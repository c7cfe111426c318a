"""Removal of strings of adjacent customers."""

from model.kernel.compiled import inlined, spliced
from model.kernel.records import Record
from model.problem import BoolArray, IntArray, UIntArray
from model.search.route.edit import close_ranks, keep_sorties
from model.search.route.layout import CUSTOMER, NOWHERE, Fleet, World
from model.search.route.randomness import below, uniform
from model.search.route.refresh import draw_customer, refresh, stop_beside
from model.search.route.state import Searcher

AVERAGE_REMOVED = 10
LONGEST_STRING = 10
STRING_OF_LONG = 0.25
"""Share of a long route that a string is at most, where `Searcher.value` allows longer ones."""
SPLIT = 0.5
SPLIT_MORE = 0.01
WHOLE_TRIP = 0.05
"""How often a trip is removed whole, if it has no more stops than `LONGEST_TRIP`."""
LONGEST_TRIP = 25
MAKE_ROOM = 0.5
"""How often strings are removed around a customer left out, if there is one."""
FLIGHT_ONLY = 0.5
"""How often a customer of a drone goes alone, as a string of its own."""


@spliced
def mark(marked: BoolArray, absent: IntArray, num_absent: int, node: int) -> int:
    """Mark a customer for removal. In place; return how many there are."""
    if marked[node]:
        return num_absent
    marked[node] = True
    absent[num_absent] = node
    return num_absent + 1


@spliced
def mark_string(fleet: Fleet, slot: int, index: int, p: int, size: int, marked: BoolArray,
                absent: IntArray, num_absent: int, rng: UIntArray) -> int:
    """Mark `size` adjacent stops of a trip around stop `p`, or all but some within. As `mark`."""
    stops = fleet.stop[slot]
    first, last = fleet.trip[slot, index].first, fleet.trip[slot, index].last
    stops_there = last - first - 1
    spared = 0
    if 1 < size < stops_there and uniform(rng) < SPLIT:
        spared = 1
        while size + spared < stops_there and uniform(rng) < SPLIT_MORE:
            spared += 1
    span = size + spared
    lowest, highest = max(first + 1, p - span + 1), min(p, last - span)
    begin = lowest + below(rng, highest - lowest + 1)
    gap = size
    if spared > 0:
        gap = 1 + below(rng, size - 1)
    for offset in range(span):
        if offset < gap or offset >= gap + spared:
            num_absent = mark(marked, absent, num_absent, stops[begin + offset].node)
    return num_absent


@spliced
def mark_around(fleet: Fleet, customer: int, longest: float, marked: BoolArray, absent: IntArray,
                num_absent: int, rng: UIntArray) -> int:
    """Mark a string around a customer, or the customer alone if a drone serves it. As `mark`."""
    slot, p = fleet.where[customer].slot, stop_beside(fleet, customer)
    if fleet.where[customer].position < 0:
        num_absent = mark(marked, absent, num_absent, customer)
    index = fleet.stop[slot, p].trip
    first, last = fleet.trip[slot, index].first, fleet.trip[slot, index].last
    stops_there = last - first - 1
    if stops_there == 0:
        return num_absent
    size = 1 + int(uniform(rng) * min(longest, stops_there))
    if uniform(rng) < WHOLE_TRIP and stops_there <= LONGEST_TRIP:
        size = stops_there
    # A drone may have been launched at either of the depot's stops.
    middle = min(max(p, first + 1), last - 1)
    return mark_string(fleet, slot, index, middle, min(size, stops_there), marked, absent,
                       num_absent, rng)


@spliced
def longest_string(searcher: Searcher) -> float:
    """Return how many stops a string has at most: as many as a trip has on average, or less.

    Up to `LONGEST_STRING`, and on long routes up to what `Searcher.value` says.
    """
    count, trips = searcher.count, searcher.count.active
    if not count.lean:
        trips = 0
        for index in range(count.active):
            trips += searcher.now.route[searcher.active[index]].trips
    stops = (count.customers - count.absent) / max(1, trips)
    return min(stops, max(LONGEST_STRING, min(searcher.value.longest, STRING_OF_LONG * stops)))


@spliced
def draw_strings(longest: float, rng: UIntArray) -> int:
    """Return how many strings are removed: fewer if they are long."""
    removed = max(float(AVERAGE_REMOVED), longest)
    return 1 + int(uniform(rng) * (4 * removed / (1 + longest) - 1))


@spliced
def choose(world: World, searcher: Searcher, longest: float, absent: IntArray, num_absent: int,
           touched: IntArray) -> tuple[int, int, int]:
    """Mark strings near a random customer, at most one a trip.

    In place; returns how many customers are marked, how many routes are listed in `touched`, and
    the customer.
    """
    fleet, marked, hit, rng = searcher.now, searcher.marked, searcher.hit, searcher.rng
    num_touched, turn = 0, searcher.count.turn
    strings = draw_strings(longest, rng)
    customer = draw_customer(world, fleet, searcher.count.focus, rng)
    if num_absent > 0 and uniform(rng) < MAKE_ROOM:
        customer = absent[below(rng, num_absent)]
    rank, seed = -1, customer
    while strings > 0 and customer >= 0:
        slot = fleet.where[customer].slot
        if slot >= 0 and not marked[customer]:
            trip = fleet.stop[slot, stop_beside(fleet, customer)].trip
            before = num_absent
            if fleet.where[customer].position < 0 and uniform(rng) < FLIGHT_ONLY:
                num_absent = mark(marked, absent, num_absent, customer)
            elif hit[slot, trip] != turn:
                hit[slot, trip] = turn
                num_absent = mark_around(fleet, customer, longest, marked, absent, num_absent,
                                         rng)
            if num_absent > before:
                strings -= 1
                if not listed(touched, num_touched, slot):
                    touched[num_touched] = slot
                    num_touched += 1
        rank += 1
        customer = int(world.near[seed, rank]) if rank < world.near.shape[1] else NOWHERE
    return num_absent, num_touched, seed


@spliced
def listed(slots: IntArray, count: int, slot: int) -> bool:
    """Tell whether a slot is in a list."""
    found = False
    for index in range(count):
        found = found or slots[index] == slot
    return found


@inlined
def mark_all(fleet: Fleet, slot: int, marked: BoolArray, absent: IntArray,
             num_absent: int) -> int:
    """Mark all customers of a route. As `mark`."""
    for p in range(fleet.route[slot].length):
        if fleet.stop[slot, p].kind == CUSTOMER:
            num_absent = mark(marked, absent, num_absent, fleet.stop[slot, p].node)
    for s in range(fleet.route[slot].sorties):
        for visit in range(fleet.sortie[slot, s].count):
            num_absent = mark(marked, absent, num_absent,
                              fleet.sortie[slot, s].nodes[visit])
    return num_absent


@spliced
def remove_marked(world: World, fleet: Fleet, slot: int, marked: BoolArray, absent: IntArray,
                  num_absent: int, moved: IntArray, acc: Record) -> int:
    """Take the marked customers out of a route; all, if the rest breaks a rule. As `mark`."""
    route, stops, sorties = fleet.route[slot], fleet.stop[slot], fleet.sortie[slot]
    num_absent = keep_sorties(route, stops, sorties, marked, absent, num_absent)
    close_ranks(route, stops, sorties, marked, moved)
    if route.length > 0 and not refresh(world, fleet, slot, acc):
        num_absent = mark_all(fleet, slot, marked, absent, num_absent)
        route.length = 0
    if route.length == 0:
        route.sorties = route.trips = 0
        fleet.cost[slot] = 0.0
        fleet.used[route.type] -= 1
    return num_absent
