"""Other types of vehicles for routes of linked stops."""

import math

from model.kernel.compiled import inlined, spliced
from model.kernel.load import amount_of, fits, holds
from model.kernel.records import Record
from model.search.linked.layout import Linked
from model.search.route.layout import NOWHERE, World
from model.search.route.randomness import below
from model.search.route.state import Searcher

MOST_TRADED = 64
"""With how many routes, drawn anew each time, a route may swap vehicles."""

LEAST_SAVED = 1e-9
"""What another vehicle saves at least, so that costs that differ in their last bits don't count."""


@inlined
def cost_of_run(world: World, k: int, run: Record) -> float:
    """Return what a route costs by a vehicle of type `k`."""
    rate = world.rate[k]
    return rate.fixed + run.distance * rate.distance + run.count * rate.stop


@inlined
def give_run(world: World, searcher: Searcher, linked: Linked, slot: int, k: int) -> None:
    """Let a vehicle of another type drive a route, and note that. In place."""
    run, noted = linked.run[slot], linked.noted
    if linked.former[slot] == NOWHERE:
        linked.former[slot] = run.type
        linked.retyped[noted.retyped] = slot
        noted.retyped += 1
    searcher.now.used[run.type] -= 1
    searcher.now.used[k] += 1
    run.type = k


@inlined
def is_left(world: World, searcher: Searcher, k: int) -> bool:
    """Tell whether there is a vehicle of a type that nobody drives."""
    return searcher.now.used[k] < world.type[k].count


@spliced
def larger_for(world: World, searcher: Searcher, run: Record, node: int) -> int:
    """Return the type for which a route would be exchanged to take a customer more.

    The cheapest that is left and holds them all; NOWHERE if there is none.
    """
    chosen, best = NOWHERE, math.inf
    for k in range(world.num_types):
        if (not world.swap[run.type, k] or not world.can[k, 0, node]
                or not is_left(world, searcher, k)):
            continue
        cost = cost_of_run(world, k, run) + world.rate[k].stop
        if cost < best and fits(world.type[k], amount_of(run.load), world.place[0, node]):
            chosen, best = k, cost
    return chosen


@spliced
def trade_run(world: World, searcher: Searcher, linked: Linked, slot: int) -> float:
    """Swap vehicles with other routes where that is cheaper. In place; return the saving."""
    run, number, saved = linked.run[slot], searcher.count.active, 0.0
    begin = below(searcher.rng, number)
    for index in range(begin, begin + min(number, MOST_TRADED)):
        another = searcher.active[index if index < number else index - number]
        other = linked.run[another]
        k, by = run.type, other.type
        if not world.swap[k, by]:
            continue
        spared = (cost_of_run(world, k, run) + cost_of_run(world, by, other)
                  - cost_of_run(world, by, run) - cost_of_run(world, k, other))
        if (spared > LEAST_SAVED and holds(world.type[by], amount_of(run.load))
                and holds(world.type[k], amount_of(other.load))):
            give_run(world, searcher, linked, slot, by)
            give_run(world, searcher, linked, another, k)
            saved += spared
    return saved


@spliced
def cheapen_run(world: World, searcher: Searcher, linked: Linked, slot: int) -> float:
    """Give a route the cheapest vehicle left, or another's. In place; return the saving."""
    run, saved = linked.run[slot], 0.0
    if run.count == 0:
        return 0.0
    for k in range(world.num_types):
        if not world.swap[run.type, k] or not is_left(world, searcher, k):
            continue
        spared = cost_of_run(world, run.type, run) - cost_of_run(world, k, run)
        if spared > LEAST_SAVED and holds(world.type[k], amount_of(run.load)):
            give_run(world, searcher, linked, slot, k)
            saved += spared
    return saved + trade_run(world, searcher, linked, slot)


@spliced
def cheapen_runs(world: World, searcher: Searcher, linked: Linked) -> float:
    """Give the routes of this turn cheaper vehicles. In place; return the saving."""
    noted, saved = linked.noted, 0.0
    for index in range(noted.pieces):
        saved += cheapen_run(world, searcher, linked, linked.piece[index].slot)
    for index in range(noted.entries):
        slot = linked.link[linked.entry[index].node].slot
        saved += cheapen_run(world, searcher, linked, slot)
    return saved


@inlined
def take_types_back(searcher: Searcher, linked: Linked) -> None:
    """Let all routes be driven by the vehicles that did before this turn. In place."""
    noted, used = linked.noted, searcher.now.used
    for index in range(noted.retyped):
        slot = linked.retyped[index]
        used[linked.run[slot].type] -= 1
        used[linked.former[slot]] += 1
        linked.run[slot].type = linked.former[slot]
        linked.former[slot] = NOWHERE
    noted.retyped = 0
