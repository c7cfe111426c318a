"""Insertion places that are kept for as long as their route stays the same."""

from collections.abc import Iterator

import numpy as np
import pytest

from model.kernel.compiled import compiled_on_arrays
from model.kernel.instance import pack
from model.problem import Problem
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.insertion.evaluate import INFEASIBLE
from model.search.insertion.places import try_route
from model.search.moves.anneal import ANY, anneal
from model.search.route.layout import CHANGING, World
from model.search.route.state import Searcher
from model.search.world import make_world
from model.solution import Solution
from training.instances import generate

TURNS, ROUNDS = 40, 25


@compiled_on_arrays
def least_cost(world: World, searcher: Searcher, slot: int, node: int) -> float:
    """Return what a customer more on a route costs at least. In place: the searcher's scratch."""
    searcher.bound.best, searcher.bound.blink = INFEASIBLE, 0.0
    try_route(world, searcher, slot, node, False)
    return searcher.bound.best


def begun(problem: Problem, world: World) -> Searcher:
    """Return a search that has planned once by insertion."""
    searcher = make_searcher(problem, world, Solution((), ()), np.random.SeedSequence(5))
    begin_anew(world, searcher, True)
    searcher.value.temperature = searcher.value.cost / 2000
    return searcher


def kept_places(world: World, searcher: Searcher) -> Iterator[tuple[int, int]]:
    """Search in rounds; yield the routes and customers for which a place is kept after each."""
    for _ in range(ROUNDS):
        anneal(world, searcher, TURNS, ANY)
        for slot in searcher.active[: searcher.count.active]:
            stamp = searcher.now.route[slot].stamp
            assert stamp != CHANGING
            for node in np.flatnonzero(searcher.kept[:, slot]["stamp"] == stamp):
                if searcher.now.where[node].slot != slot:
                    yield int(slot), int(node)


def shortest(world: World, searcher: Searcher, slot: int, node: int) -> dict[int, int]:
    """Return the detour for a customer behind each stop of a route where no rule is broken."""
    stops = searcher.now.stop[slot]
    legs = world.leg[world.type[searcher.now.route[slot].type].travel]
    place, detours = world.place[0, node], {}
    for p in range(searcher.now.route[slot].length - 1):
        here, there = stops[p].node, stops[p + 1].node
        arrival = stops[p].leave + legs[here, node, 0]
        leave = max(arrival, place[0].window_earliest) + place[0].service_duration
        behind = leave + legs[node, there, 0]
        if arrival <= place[0].arrival_limit and behind <= stops[p + 1].latest:
            detours[p] = legs[here, node, 1] + legs[node, there, 1] - stops[p].leg
    return detours


@pytest.mark.parametrize("seed", [8, 9])
def test_places_kept_are_the_shortest_detours_on_routes_as_they_are(seed: int) -> None:
    problem = generate(np.random.default_rng(seed), 80, "vrptw")
    world = make_world(problem, pack([problem]))
    assert not world.general
    searcher = begun(problem, world)
    found = none = 0
    for slot, node in kept_places(world, searcher):
        _, detour, p = searcher.kept[node, slot]
        detours = shortest(world, searcher, slot, node)
        assert min(detours.values(), default=detour) >= detour
        if p >= 0:
            assert detours[p] == detour
            found += 1
        else:
            none += 1
    assert min(found, none) > ROUNDS


@pytest.mark.parametrize(("variant", "seed"), [
    ("soft", 3), ("soft", 4), ("multitrip", 4), ("drone", 3), ("mixed", 4)])
def test_places_kept_are_the_cheapest_where_more_than_distance_counts(variant: str,
                                                                      seed: int) -> None:
    problem = generate(np.random.default_rng(seed), 50, variant)
    world = make_world(problem, pack([problem]))
    assert world.general
    searcher = begun(problem, world)
    found = none = 0
    for slot, node in kept_places(world, searcher):
        least = least_cost(world, searcher, slot, node)
        if searcher.kept_move[node, slot].kind >= 0:
            assert searcher.kept_cost[node, slot] == pytest.approx(least)
            found += 1
        else:
            assert searcher.kept_cost[node, slot] <= least + 1e-9 * abs(least)
            none += 1
    assert min(found, none) > ROUNDS
