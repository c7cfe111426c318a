"""Routes of a search as linked stops, and back."""

from model.kernel.compiled import compiled, inlined
from model.kernel.leg import legs_from, legs_to, nearness
from model.kernel.load import NOTHING, demand_of, plus, write_amount
from model.search.linked.chain import connect, forget, retime
from model.search.linked.layout import Linked
from model.search.route.edit import put
from model.search.route.layout import CUSTOMER, END, NOWHERE, OTHERS, START, Fleet, World
from model.search.route.refresh import locate, refresh
from model.search.route.state import ALL, Searcher, left_out_cost

FARTHEST = 2**31 - 1


@compiled
def measure_near(world: World, linked: Linked) -> None:
    """Write how near neighbours are. In place."""
    m = world.type[0].travel
    for node in range(world.num_depots, world.num_nodes):
        inward, onward = legs_to(world.back, m, node), legs_from(world.leg, m, node)
        for rank in range(world.fit.shape[1]):
            other = int(world.fit[node, rank])
            if other >= 0:
                linked.near[node, rank] = min(nearness(inward, onward, other), FARTHEST)


@compiled
def tie(world: World, searcher: Searcher, linked: Linked) -> None:
    """Link the routes of a search as they are, and of its best plan. In place."""
    now, best, count = searcher.now, searcher.best, searcher.count
    for node in range(world.num_depots, world.num_nodes):
        linked.link[node].slot = now.where[node].slot
    for slot in range(len(searcher.active)):
        if now.route[slot].length > 0:
            link_route(world, linked, now, slot)
        linked.best_first[slot] = NOWHERE
        if best.route[slot].length > 0:
            stops = best.stop[slot]
            linked.best_first[slot] = stops[1].node
            linked.best_type[slot] = best.route[slot].type
            for p in range(1, best.route[slot].length - 1):
                linked.best_behind[stops[p].node] = stops[p + 1].node
    forget(linked)
    count.changed = ALL


@inlined
def link_route(world: World, linked: Linked, fleet: Fleet, slot: int) -> None:
    """Link the stops of a route. In place."""
    route, run = fleet.route[slot], linked.run[slot]
    stops, load = fleet.stop[slot], NOTHING
    run.type, run.count, run.distance = route.type, route.length - 2, 0
    for p in range(1, route.length):
        run.distance += connect(world, linked, slot, stops[p - 1].node, stops[p].node)
        if p < route.length - 1:
            linked.link[stops[p].node].slot = slot
            load = plus(load, demand_of(world.place[0, stops[p].node]))
    write_amount(load, run.load)
    if linked.timed:
        retime(world, linked, slot)


@inlined
def write_stops(world: World, searcher: Searcher, fleet: Fleet, slot: int, k: int, count: int
                ) -> None:
    """Write the ends of a route whose customers are there, and all that follows. In place."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    route.type, route.length, route.sorties = k, count + 2, 0
    put(stops, 0, world.type[k].begins_at, START)
    put(stops, count + 1, world.type[k].ends_at, END)
    refresh(world, fleet, slot, searcher.acc)


@compiled
def write_back(world: World, searcher: Searcher, linked: Linked) -> None:
    """Let the routes of a search, and of its best plan, be those that are linked. In place."""
    now, best, count, value = searcher.now, searcher.best, searcher.count, searcher.value
    count.stamp += 1
    value.cost = left_out_cost(world, searcher.missing, count.missing)
    cost = left_out_cost(world, searcher.best_missing, count.best_missing)
    for slot in range(len(searcher.active)):
        for fleet in (now, best):
            fleet.route[slot].length = fleet.route[slot].trips = fleet.route[slot].sorties = 0
            fleet.cost[slot] = 0.0
        now.route[slot].stamp, best.route[slot].stamp = count.stamp, OTHERS
    for index in range(count.active):
        slot = searcher.active[index]
        run = linked.run[slot]
        node = run.first
        for p in range(1, run.count + 1):
            put(now.stop[slot], p, node, CUSTOMER)
            node = linked.link[node].behind
        write_stops(world, searcher, now, slot, run.type, run.count)
        locate(now, slot)
        value.cost += now.cost[slot]
    for slot in range(len(searcher.active)):
        node, p = linked.best_first[slot], 0
        if node < 0:
            continue
        while node >= world.num_depots:
            p += 1
            put(best.stop[slot], p, node, CUSTOMER)
            node = linked.best_behind[node]
        write_stops(world, searcher, best, slot, linked.best_type[slot], p)
        cost += best.cost[slot]
    # The sums of what turns changed differ in their last bits; the best cost never rises.
    value.best = min(value.best, cost)
    count.changed = ALL
