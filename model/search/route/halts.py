"""What is aboard at the stops of a route, where that has to be looked at from stop to stop."""

from model.kernel.compiled import inlined, spliced
from model.kernel.drone_types import row_of_drone
from model.kernel.load import (
    EMPTY, NOTHING, Cargo, add_come, add_left, cargo_for, delivered_of, demand_of, followed,
    has_room, holds_in, lifts, may_follow, most_of, picked_of, plus, total_delivered, total_picked,
    weigh_trip, write_amount,
)
from model.kernel.plain import is_plain
from model.kernel.records import Record, Records
from model.problem import IntArray
from model.search.route.layout import CUSTOMER, NOWHERE, START, Fleet, World
from model.search.route.rarer import tiers_aboard, tiers_of
from model.search.route.vehicles import may_make


@inlined
def flown(world: World, k: int, sortie: Record, place: int, node: int,
          tier: int) -> tuple[Cargo, bool]:
    """Return the cargo of a sortie that serves a customer more before its number `place`.

    And whether a drone of a row `k` may carry it. NOWHERE: nobody more.
    """
    kind, cargo, in_order = world.type[k], EMPTY, True
    for visit in range(sortie.count + 1):
        if visit == place:
            more = cargo_for(world.amount, node, tier)
            in_order = in_order and may_follow(kind, cargo, more)
            cargo = followed(cargo, more)
        if visit < sortie.count:
            more = cargo_for(world.amount, sortie.nodes[visit], tier)
            in_order = in_order and may_follow(kind, cargo, more)
            cargo = followed(cargo, more)
    return cargo, in_order and lifts(kind, cargo[2], tier)


@inlined
def can_carry(world: World, k: int, sortie: Record, place: int, node: int) -> bool:
    """Tell whether a drone of a row `k` may carry what a sortie does, as in `flown`."""
    if tiers_of(world) == 0:
        load = demand_of(world.place[0, node]) if place >= 0 else NOTHING
        for visit in range(sortie.count):
            load = plus(load, demand_of(world.place[0, sortie.nodes[visit]]))
        return lifts(world.type[k], load, 0)
    for tier in range(tiers_of(world)):
        _, may = flown(world, k, sortie, place, node, tier)
        if not may:
            return False
    return True


@inlined
def note_amounts(world: World, fleet: Fleet, slot: int, tier: int) -> bool:
    """Write what leaves and comes aboard at each stop. In place; False if a drone may not fly."""
    route, stops, halts = fleet.route[slot], fleet.stop[slot], fleet.halt[slot, tier]
    for p in range(route.length):
        halt = halts[p]
        halt.leaves = halt.comes = 0
        write_amount(NOTHING, halt.leaving)
        write_amount(NOTHING, halt.coming)
        if stops[p].kind == CUSTOMER:
            node = stops[p].node
            add_left(halt, delivered_of(world.amount, node, tier),
                     total_delivered(world.amount, node))
            add_come(halt, picked_of(world.amount, node, tier), total_picked(world.amount, node))
    allowed = True
    for s in range(route.sorties):
        sortie = fleet.sortie[slot, s]
        row = row_of_drone(world.type, route.type, sortie.drone)
        cargo, may = flown(world, row, sortie, NOWHERE, NOWHERE, tier)
        allowed = allowed and may
        add_left(halts[sortie.launch], cargo[0], cargo[3])
        add_come(halts[sortie.recovery], cargo[1], cargo[4])
    return allowed


@inlined
def weigh(world: World, fleet: Fleet, slot: int) -> bool:
    """Write what is aboard at each stop of a route. In place; False if that breaks a rule."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    allowed = True
    for tier in range(tiers_aboard(fleet)):
        allowed = note_amounts(world, fleet, slot, tier) and allowed
        halts, first, driven = fleet.halt[slot, tier], 0, 0
        for p in range(route.length):
            if stops[p].kind == START:
                first, driven = p, 0
            halts[p].driven = driven
            driven += stops[p].leg
            if p + 1 == route.length or stops[p + 1].kind == START:
                allowed = weigh_trip(world.type[route.type], halts, first, p, tier) and allowed
    return allowed


@spliced
def load_cost(world: World, fleet: Fleet, slot: int) -> float:
    """Return what it costs to drive what is aboard, on a route that was weighed."""
    k, carried = fleet.route[slot].type, 0.0
    for p in range(fleet.route[slot].length):
        load = fleet.halt[slot, 0, p].load + world.type[k].carried
        carried += float(load) * float(fleet.stop[slot, p].leg)
    return carried * world.rate[k].load


@spliced
def load_more(world: World, fleet: Fleet, slot: int, left: int, came: int, node: int) -> float:
    """Return what it costs more to drive a customer's amounts, but for legs that are changed.

    The parcel leaves the truck at stop `left`, what is picked up comes aboard at stop `came`.
    """
    halts, trip = fleet.halt[slot, 0], fleet.trip[slot, fleet.stop[slot, left].trip]
    k = fleet.route[slot].type
    parcel, taken = delivered_of(world.amount, node, 0)[0], picked_of(world.amount, node, 0)[0]
    return (float(parcel) * float(halts[left].driven)
            + float(taken) * float(trip.distance - halts[came].driven)) * world.rate[k].load


@spliced
def load_more_behind(world: World, fleet: Fleet, slot: int, p: int, node: int, out: int,
                     on: int) -> float:
    """Return what driving loads costs more with a customer behind stop `p`, `out` and `on` away."""
    k, halt = fleet.route[slot].type, fleet.halt[slot, 0, p]
    parcel, taken = delivered_of(world.amount, node, 0)[0], picked_of(world.amount, node, 0)[0]
    load, detour = halt.load + world.type[k].carried, out + on - fleet.stop[slot, p].leg
    legs = float(load) * float(detour) + float(parcel) * float(out) + float(taken) * float(on)
    return load_more(world, fleet, slot, p, p + 1, node) + legs * world.rate[k].load


Room = tuple[Records, int, Records, IntArray, int]
"""Where a customer may be served: all types, by which, what is aboard at stops, amounts, whose."""


@spliced
def room_on(world: World, fleet: Fleet, slot: int, k: int, node: int) -> Room:
    """Return what says where a customer may be served on a route by a vehicle of type `k`."""
    return world.type, k, fleet.halt[slot], world.amount, node


@spliced
def room_behind(room: Room, p: int) -> bool:
    """Tell whether a truck may serve the customer behind stop `p`."""
    types, k, halts, amounts, node = room
    return (is_plain(types[k]) or len(halts) == 0
            or has_room(types[k], halts, p + 1, p, amounts, node))


@spliced
def room_between(room: Room, launch: int, recovery: int) -> bool:
    """Tell whether a drone may serve the customer from stop `launch` to `recovery`."""
    types, k, halts, amounts, node = room
    return (is_plain(types[k]) or len(halts) == 0
            or has_room(types[k], halts, launch, recovery, amounts, node))


@inlined
def can_take(world: World, fleet: Fleet, slot: int, k: int) -> bool:
    """Tell whether a vehicle of type `k` holds what a lean route carries, and may stop so often."""
    kind = world.type[k]
    if not may_make(kind, fleet.trip[slot, 0]):
        return False
    for tier in range(tiers_aboard(fleet)):
        if not holds_in(kind, most_of(fleet.halt[slot, tier, 0]), tier):
            return False
    return True
