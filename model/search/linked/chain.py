"""Stops that come into routes and go out of them, and back again."""

from model.kernel.compiled import inlined, spliced
from model.kernel.leg import (
    distance_from, distance_to, leg, leg_from, leg_to, legs_from, legs_of, legs_to,
)
from model.kernel.load import amount_of, demand_of, minus, plus, write_amount
from model.kernel.records import Record
from model.kernel.start import leaves_first
from model.kernel.stop import end_of_service, latest_arrival, places_of
from model.search.linked.layout import Linked
from model.search.linked.retype import take_types_back
from model.search.route.layout import NOWHERE, World
from model.search.route.state import Searcher, list_anew


@spliced
def open_run(world: World, searcher: Searcher, linked: Linked, slot: int, k: int) -> None:
    """Let a vehicle of a type drive from a free slot, to nobody as yet. In place."""
    run = linked.run[slot]
    run.type, run.count, run.distance = k, 0, 0
    run.first, run.last = world.type[k].ends_at, world.type[k].begins_at
    for dimension in range(len(run.load)):
        run.load[dimension] = 0
    searcher.now.used[k] += 1
    list_anew(searcher, slot, True)


@spliced
def close_run(searcher: Searcher, linked: Linked, slot: int) -> None:
    """Let a vehicle that serves nobody stay where it is. In place."""
    searcher.now.used[linked.run[slot].type] -= 1
    list_anew(searcher, slot, False)


@inlined
def onward_of(world: World, linked: Linked, slot: int, before: int) -> int:
    """Return who comes behind a customer, or first on a route if `before` is a depot."""
    if before < world.num_depots:
        return linked.run[slot].first
    return linked.link[before].behind


@spliced
def tie_in(world: World, linked: Linked, slot: int, before: int, node: int) -> None:
    """Insert a customer behind another, or first, and note it. In place; times stay as they are."""
    link, run, noted = linked.link, linked.run[slot], linked.noted
    behind = onward_of(world, linked, slot, before)
    m = world.type[run.type].travel
    inward, onward = legs_to(world.back, m, node), legs_from(world.leg, m, node)
    there, on = distance_from(inward, before), distance_to(onward, behind)
    entry, between, gap = linked.entry[noted.entries], 0, 0
    if behind >= world.num_depots:
        between, gap = link[behind].inward, link[behind].gap
    elif before >= world.num_depots:
        between = link[before].onward
    entry.node, entry.onward, entry.gap = node, between, gap
    noted.entries += 1
    here = link[node]
    here.slot, here.before, here.behind = slot, before, behind
    here.inward, here.onward = there, on
    join(world, linked, run, before, node, there)
    join(world, linked, run, node, behind, on)
    if linked.timed:
        here.gap = leg_from(inward, before).duration
        if behind >= world.num_depots:
            link[behind].gap = leg_to(onward, behind).duration
    run.count += 1
    run.distance += there + on - between
    write_amount(plus(amount_of(run.load), demand_of(world.place[0, node])), run.load)


@spliced
def join(world: World, linked: Linked, run: Record, before: int, behind: int,
         distance: int) -> None:
    """Let one customer, or the depot, come right behind another, so far away. In place."""
    if before >= world.num_depots:
        linked.link[before].behind, linked.link[before].onward = behind, distance
    else:
        run.first = behind
    if behind >= world.num_depots:
        linked.link[behind].before, linked.link[behind].inward = before, distance
    else:
        run.last = before


@spliced
def connect(world: World, linked: Linked, slot: int, before: int, behind: int) -> int:
    """Let one customer, or the depot, come right behind another on a route.

    In place; return how far that is.
    """
    distance = 0
    if before >= world.num_depots or behind >= world.num_depots:
        onward = legs_from(world.leg, world.type[linked.run[slot].type].travel, before)
        distance = distance_to(onward, behind)
        if linked.timed and behind >= world.num_depots:
            linked.link[behind].gap = leg_to(onward, behind).duration
    join(world, linked, linked.run[slot], before, behind, distance)
    return distance


@spliced
def cut_out(world: World, linked: Linked, slot: int, first: int, count: int) -> int:
    """Take customers in a row out of a route, and note them. In place; return what that saves.

    Times stay as they are.
    """
    link, run, noted = linked.link, linked.run[slot], linked.noted
    piece = linked.piece[noted.pieces]
    piece.slot, piece.type, piece.count, piece.gap = slot, run.type, count, 0
    noted.pieces += 1
    before, node, saved = link[first].before, first, link[first].inward
    for _ in range(count):
        linked.removed[noted.removed] = link[node]
        linked.removed_node[noted.removed] = node
        noted.removed += 1
        saved += link[node].onward
        write_amount(minus(amount_of(run.load), demand_of(world.place[0, node])), run.load)
        link[node].slot = NOWHERE
        node = link[node].behind
    run.count -= count
    distance = 0
    if run.count > 0:
        onward = legs_from(world.leg, world.type[run.type].travel, before)
        distance = distance_to(onward, node)
        if linked.timed and node >= world.num_depots:
            piece.gap = link[node].gap
            link[node].gap = leg_to(onward, node).duration
    join(world, linked, run, before, node, distance)
    piece.saved = saved - distance
    run.distance -= piece.saved
    return piece.saved


@spliced
def note_times(linked: Linked, node: int) -> None:
    """Note when a customer is left, and has to be reached, before that changes. In place."""
    noted = linked.noted
    if noted.moments == len(linked.moment):
        noted.over = 1
        return
    moment, here = linked.moment[noted.moments], linked.link[node]
    moment.node, moment.leave, moment.latest = node, here.leave, here.latest
    noted.moments += 1


@inlined
def leaves_at(world: World, linked: Linked, kind: Record, node: int) -> int:
    """Return when a vehicle of a type leaves a customer, or where it begins if that is a depot."""
    if node >= world.num_depots:
        return linked.link[node].leave
    return leaves_first(kind, kind.shift_earliest)


@inlined
def due_at(world: World, linked: Linked, kind: Record, node: int) -> int:
    """Return when a vehicle of a type has to come to a customer, or home, at the latest."""
    return linked.link[node].latest if node >= world.num_depots else kind.shift_latest


@spliced
def drive_on(world: World, linked: Linked, slot: int, node: int, number: int) -> None:
    """Bring departures from a customer on up to date, of so many even if none changes. In place."""
    link, kind = linked.link, world.type[linked.run[slot].type]
    places = places_of(world.place, kind)
    if node < world.num_depots:
        return
    time = leaves_at(world, linked, kind, link[node].before)
    while node >= world.num_depots:
        here = link[node]
        time = end_of_service(places[node], time + here.gap)
        if here.leave == time and number <= 0:
            return
        note_times(linked, node)
        here.leave = time
        node = here.behind
        number -= 1


@spliced
def look_back(world: World, linked: Linked, slot: int, node: int, number: int) -> None:
    """Bring latest arrivals from a customer back up to date. As `drive_on`."""
    link, kind = linked.link, world.type[linked.run[slot].type]
    places = places_of(world.place, kind)
    if node < world.num_depots:
        return
    behind = link[node].behind
    leave_by = due_at(world, linked, kind, behind)
    if behind >= world.num_depots:
        leave_by -= link[behind].gap
    else:
        leave_by -= leg(legs_of(world.leg, kind.travel), node, behind).duration
    while node >= world.num_depots:
        here = link[node]
        latest = latest_arrival(places[node], leave_by)
        if here.latest == latest and number <= 0:
            return
        note_times(linked, node)
        here.latest = latest
        leave_by = latest - here.gap
        node = here.before
        number -= 1


@spliced
def retime(world: World, linked: Linked, slot: int) -> None:
    """Write all times of a route. In place."""
    run = linked.run[slot]
    drive_on(world, linked, slot, run.first, run.count)
    look_back(world, linked, slot, run.last, run.count)


@spliced
def untie(world: World, searcher: Searcher, linked: Linked) -> None:
    """Take the customer inserted last out again. In place; times stay as they are."""
    link, noted = linked.link, linked.noted
    noted.entries -= 1
    entry = linked.entry[noted.entries]
    node = entry.node
    here = link[node]
    slot, run = here.slot, linked.run[here.slot]
    join(world, linked, run, here.before, here.behind, entry.onward)
    if here.behind >= world.num_depots:
        link[here.behind].gap = entry.gap
    write_amount(minus(amount_of(run.load), demand_of(world.place[0, node])), run.load)
    here.slot = NOWHERE
    run.count -= 1
    run.distance -= here.inward + here.onward - entry.onward
    if run.count == 0:
        close_run(searcher, linked, slot)


@spliced
def put_back(world: World, searcher: Searcher, linked: Linked) -> None:
    """Put the customers back that were taken out last. In place; times stay as they are."""
    link, noted = linked.link, linked.noted
    noted.pieces -= 1
    piece = linked.piece[noted.pieces]
    slot = piece.slot
    run = linked.run[slot]
    if run.count == 0:
        open_run(world, searcher, linked, slot, piece.type)
    begin = noted.removed - piece.count
    for index in range(begin, noted.removed):
        node = linked.removed_node[index]
        link[node] = linked.removed[index]
        write_amount(plus(amount_of(run.load), demand_of(world.place[0, node])), run.load)
    first, last = linked.removed_node[begin], linked.removed_node[noted.removed - 1]
    join(world, linked, run, link[first].before, first, link[first].inward)
    join(world, linked, run, last, link[last].behind, link[last].onward)
    if link[last].behind >= world.num_depots:
        link[link[last].behind].gap = piece.gap
    run.count += piece.count
    run.distance += piece.saved
    noted.removed = begin


@spliced
def take_back(world: World, searcher: Searcher, linked: Linked) -> None:
    """Let all be as it was before this turn. In place."""
    noted = linked.noted
    take_types_back(searcher, linked)
    while noted.entries > 0:
        untie(world, searcher, linked)
    while noted.pieces > 0:
        put_back(world, searcher, linked)
    while noted.moments > 0:
        noted.moments -= 1
        moment = linked.moment[noted.moments]
        here = linked.link[moment.node]
        here.leave, here.latest = moment.leave, moment.latest
    if noted.over:
        for index in range(searcher.count.active):
            retime(world, linked, searcher.active[index])
        noted.moments = noted.over = 0


@inlined
def forget(linked: Linked) -> None:
    """Let nothing be noted. In place."""
    noted = linked.noted
    for index in range(noted.retyped):
        linked.former[linked.retyped[index]] = NOWHERE
    noted.pieces = noted.removed = noted.entries = noted.moments = noted.retyped = noted.over = 0
