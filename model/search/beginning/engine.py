"""What the engine does with the routes that a search begins with. As `route.engine`."""

import numpy as np

from model.engine.library import call
from model.engine.packing import Packed
from model.kernel.records import Record, Records
from model.problem import FloatArray, IntArray
from model.search.route.layout import Fleet, World
from model.search.route.state import Searcher


def disband(searcher: Searcher | Packed) -> None:
    """Take all routes apart. In place."""
    call("tandem_disband", searcher)


def write_nearest_types(world: World | Packed, nearest: IntArray) -> None:
    """Write which type's trucks drive least for a customer alone. In place: `nearest` (node,)."""
    call("tandem_write_nearest_types", world, nearest)


def write_excess(world: World | Packed, k: int, ranks: int, excess: IntArray) -> None:
    """Write how much more is driven if neighbours follow one another: less than 0, as a rule.

    In place: customer by customer, to the nearest `ranks`; 0 where there are not as many, and where
    the type may not serve both. The waiting or lateness that comes of it counts as a detour does
    that takes as long, at the speed of drives from where routes begin.
    """
    call("tandem_write_excess", world, k, ranks, excess)


def number_pairs(excess: IntArray, coarse: int) -> None:
    """Make keys of what pairs cost, but for its last `coarse` bits, and of their numbers. In place.

    Sorted as they are, which processors do many at a time.
    """
    call("tandem_number_pairs", excess, coarse)


def join(world: World | Packed, k: int, ranks: int, keys: IntArray, chain: Records,
         cargo: Records) -> None:
    """Join the route that ends at one and that which begins at the other, pair after pair.

    In place: `chain` (node,) and `cargo` (node, tier) are set up here.
    """
    call("tandem_join", world, k, ranks, keys, chain, cargo)


def join_either_way(world: World | Packed, k: int, ranks: int, keys: IntArray, chain: Records,
                    cargo: Records) -> None:
    """Join routes at either end, pair after pair. In place, as `join`."""
    call("tandem_join_either_way", world, k, ranks, keys, chain, cargo)


def length_of(world: World | Packed, k: int, chain: Records) -> int:
    """Return how far the routes of all whom a type may serve are."""
    return int(call("tandem_length_of", world, k, chain))


def alone_costs(world: World | Packed, fleet: Fleet | Packed, acc: Record,
                alone: FloatArray) -> None:
    """Write the cost of a route that serves one customer alone, (type, 2, node). In place."""
    call("tandem_alone_costs", world, fleet, acc, alone)


def begin(world: World | Packed, searcher: Searcher | Packed, num_routes: int) -> None:
    """Time the routes written; those that break a rule are left to be planned anew. In place."""
    call("tandem_begin", world, searcher, num_routes)


def finish_route(world: World | Packed, fleet: Fleet | Packed, slot: int, acc: Record) -> None:
    """Write the times of a route whose trips begin as late as costs nothing. In place.

    Raises
    ------
    RuntimeError
        If nobody can drive it.
    """
    call("tandem_finish_route", world, fleet, slot, acc)


def service_starts(place: Records, nodes: IntArray, arrivals: IntArray) -> IntArray:
    """Return when service begins at customers."""
    starts = np.empty_like(nodes)
    call("tandem_service_starts", place, nodes, arrivals, starts)
    return starts


def sortie_ends(places: Records, types: Records, k: int, drone: int, nodes: IntArray,
                arrivals: IntArray, begin: int) -> tuple[IntArray, int]:
    """Return when a truck's drone has served its customers, and when it is aboard.

    It is recovered from `begin`.
    """
    ends = np.empty_like(nodes)
    aboard = call("tandem_sortie_ends", places, types, k, drone, nodes, arrivals, begin, ends)
    return ends, int(aboard)
