"""Removal of strings of adjacent customers from linked stops."""

from model.kernel.compiled import spliced
from model.search.linked.chain import close_run, cut_out, drive_on, look_back
from model.search.linked.layout import MOST_REMOVED, Linked
from model.search.moves.ruin import (
    LONGEST_TRIP, MAKE_ROOM, SPLIT, SPLIT_MORE, WHOLE_TRIP, draw_strings, longest_string,
)
from model.search.route.layout import NOWHERE, World
from model.search.route.randomness import below, uniform
from model.search.route.refresh import draw_customer
from model.search.route.state import Searcher


@spliced
def first_of_string(world: World, linked: Linked, customer: int, span: int, searcher: Searcher
                    ) -> int:
    """Return where a string of so many customers begins, drawn from all with a customer in it."""
    link, first, before = linked.link, customer, 0
    while before < span - 1 and link[first].before >= world.num_depots:
        first = link[first].before
        before += 1
    last, behind = customer, 0
    while behind < span - 1 and link[last].behind >= world.num_depots:
        last = link[last].behind
        behind += 1
    # The first may come `before` places ahead, or as many as leave room for the last.
    latest = min(0, behind - (span - 1))
    for _ in range(below(searcher.rng, latest + before + 1)):
        first = link[first].behind
    return first


@spliced
def cut_string(world: World, searcher: Searcher, linked: Linked, customer: int, longest: float
               ) -> float:
    """Take out a string around a customer, or all but some within. In place; return the saving."""
    rng, link = searcher.rng, linked.link
    slot = link[customer].slot
    run = linked.run[slot]
    stops, rate = run.count, world.rate[run.type]
    size = 1 + int(uniform(rng) * min(longest, stops))
    if uniform(rng) < WHOLE_TRIP and stops <= LONGEST_TRIP:
        size = stops
    size = min(size, stops)
    spared, gap = 0, size
    if 1 < size < stops and uniform(rng) < SPLIT:
        spared = 1
        while size + spared < stops and uniform(rng) < SPLIT_MORE:
            spared += 1
    first = first_of_string(world, linked, customer, size + spared, searcher)
    if spared > 0:
        gap = 1 + below(rng, size - 1)
    before = link[first].before
    saved = cut_out(world, linked, slot, first, gap)
    first_left = run.first if before < world.num_depots else link[before].behind
    last_left = before
    if spared > 0:
        last_left = first_left
        for _ in range(spared - 1):
            last_left = link[last_left].behind
        saved += cut_out(world, linked, slot, link[last_left].behind, size - gap)
    if linked.timed and run.count > 0:
        drive_on(world, linked, slot, first_left, spared + 1)
        look_back(world, linked, slot, last_left, spared + 1)
    cost = saved * rate.distance + size * rate.stop
    if run.count == 0:
        cost += rate.fixed
        close_run(searcher, linked, slot)
    return cost


@spliced
def ruin_linked(world: World, searcher: Searcher, linked: Linked) -> tuple[float, int]:
    """Remove strings of customers near each other; they are absent then.

    In place; returns what that saves, and near whom it is.
    """
    link, count, rng = linked.link, searcher.count, searcher.rng
    longest, saved = longest_string(searcher), 0.0
    strings = draw_strings(longest, rng)
    seed = draw_customer(world, searcher.now, count.focus, rng)
    if count.absent > 0 and uniform(rng) < MAKE_ROOM:
        seed = searcher.absent[below(rng, count.absent)]
    rank, customer = -1, seed
    while strings > 0 and customer >= 0 and linked.noted.removed < MOST_REMOVED:
        slot = link[customer].slot
        if slot >= 0 and linked.hit[slot] != count.turn:
            linked.hit[slot] = count.turn
            saved += cut_string(world, searcher, linked, customer, longest)
            strings -= 1
        rank += 1
        customer = int(world.near[seed, rank]) if rank < world.near.shape[1] else NOWHERE
    for index in range(linked.noted.removed):
        searcher.absent[count.absent] = linked.removed_node[index]
        count.absent += 1
    return saved, seed
