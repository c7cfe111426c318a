"""The cheapest stop on the way from a depot to where a route begins, or back from where it ends.

A route that serves a town far away passes customers to whom nobody on it is near: a stop there
costs next to nothing, and no neighbour shows it. Who has neighbours alone to go beside is tried on
some such legs as well, of routes that are drawn.
"""

from model.kernel.compiled import spliced
from model.kernel.leg import leg_from, leg_to, legs_from, legs_to
from model.kernel.records import Record
from model.kernel.stop import end_of_service, places_of, too_late
from model.problem import IntArray, UIntArray
from model.search.insertion.cheapest_stop import serving_type
from model.search.route.edit import AT_STOP
from model.search.route.halts import room_behind, room_on
from model.search.route.layout import Fleet, World
from model.search.route.randomness import below, uniform

EACH_DRAWN, MOST_DRAWN = 4, 16
"""Of how many routes one is drawn, and how many are at most."""


@spliced
def scan_passing_lean(world: World, fleet: Fleet, active: IntArray, num_active: int, node: int,
                      best: float, enlarge: bool, move: Record, rng: UIntArray) -> float:
    """Find the cheapest stop first or last on routes drawn, where all are lean. As `scan_lean`.

    Most routes are full, so they are asked for room before their legs.
    """
    begin = below(rng, num_active)
    for index in range(begin, begin + min(MOST_DRAWN, num_active // EACH_DRAWN)):
        slot = active[index if index < num_active else index - num_active]
        k = fleet.route[slot].type
        if not world.can[k, 0, node]:
            continue
        by, base = serving_type(world, fleet, slot, 0, node, enlarge)
        if by < 0 or (by != k and base >= best):
            continue
        m, stops = world.type[k].travel, fleet.stop[slot]
        inward, onward = legs_to(world.back, m, node), legs_from(world.leg, m, node)
        rate, place = world.rate[by].distance, places_of(world.place, world.type[k])[node]
        room = room_on(world, fleet, slot, by, node)
        for p in (0, fleet.trip[slot, 0].last - 1):
            out, on = leg_from(inward, stops[p].node), leg_to(onward, stops[p + 1].node)
            cost = (out.distance + on.distance - stops[p].leg) * rate + base
            arrival = stops[p].leave + out.duration
            following = end_of_service(place, arrival) + on.duration
            if (cost < best and not too_late(place, arrival) and following <= stops[p + 1].latest
                    and room_behind(room, p) and uniform(rng) >= world.blink):
                best = cost
                move.kind, move.slot, move.first, move.type = AT_STOP, slot, p, by
    return best
