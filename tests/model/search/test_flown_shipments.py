"""Shipments that drones fetch or deliver, searched for and tried one by one."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.solution import Solution
from tests.model.search.test_optimum import (
    MINUTE, TURNS, long_sorties, missed_seeds, one_drone, searched_cost,
)
from tests.model.tiny import with_energy, with_gaps
from tests.model.tiny_breaks import with_breaks
from tests.model.tiny_driving import with_driving
from tests.model.tiny_shipments import with_flown_parts, with_flown_shipments


def drawn_problem(rng: np.random.Generator) -> Problem:
    return with_flown_shipments(rng, one_drone(rng))


def drawn_parts(rng: np.random.Generator) -> Problem:
    return with_flown_parts(rng, one_drone(rng))


def drawn_in_part(rng: np.random.Generator) -> Problem:
    """Return a problem of shipments with which something is delivered that comes from the depot."""
    problem = drawn_problem(rng)
    customers = list(problem.customers)
    for each in problem.shipments:
        opened = int(rng.integers(0, 8)) * MINUTE
        for node in each.nodes:
            index, brought = node - problem.num_depots, rng.integers(0, 3, problem.num_dimensions)
            customers[index] = replace(
                customers[index], release_time=opened,
                demand=tuple(brought.tolist()) if node == each.delivery else (
                    customers[index].demand))
    return replace(problem, customers=tuple(customers))


@pytest.mark.thorough
@pytest.mark.parametrize(("draw", "seeds"), [
    (drawn_problem, (0, 1)), (drawn_parts, (0, 5)), (drawn_in_part, (0, 3))])
def test_search_finds_the_cheapest_way_to_fly_shipments(
        draw: Callable[[np.random.Generator], Problem], seeds: tuple[int, ...]) -> None:
    assert missed_seeds(draw, seeds) == []


@pytest.mark.parametrize(("draw", "seed", "cheapest"), [
    (drawn_problem, 31, 61.8), (drawn_problem, 166, 50.5), (drawn_problem, 286, 29.8),
    (drawn_parts, 27, 52.0), (drawn_parts, 31, 47.1)])
def test_search_finds_ways_in_which_ends_depend_on_each_other(
        draw: Callable[[np.random.Generator], Problem], seed: int, cheapest: float) -> None:
    """Compare with what brute force found: a drone brings one from where another is delivered.

    Or fetches a part to where another is picked up, or leaves the depot again once it is there.
    """
    problem = draw(np.random.default_rng(seed))
    assert any(searched_cost(problem, turns) <= cheapest + 1e-6 for turns in TURNS)


def test_search_flies_both_ends_on_one_sortie() -> None:
    within = 0
    for seed in range(8):
        rng = np.random.default_rng(seed)
        problem = with_energy(rng, with_flown_shipments(rng, long_sorties(rng)), 0.5)
        found = improve(problem, pack([problem]), Solution((), problem.left_out(())),
                        SearchConfig(turns=150)).solution
        assert check(problem, found).violations == ()
        flights = [{visit.node for visit in sortie.visits} for route in found.routes
                   for trip in route.trips for sortie in trip.sorties]
        within += any({each.pickup, each.delivery} <= flight
                      for each in problem.shipments for flight in flights)
    assert within >= 2


@pytest.mark.parametrize("draw", [drawn_problem, drawn_parts])
def test_drones_fetch_and_deliver_shipments(
        draw: Callable[[np.random.Generator], Problem]) -> None:
    brought = fetched = 0
    for seed in range(8):
        problem = draw(np.random.default_rng(seed))
        found = improve(problem, pack([problem]), Solution((), problem.left_out(())),
                        SearchConfig(turns=150)).solution
        assert check(problem, found).violations == ()
        served = {visit.node for route in found.routes for trip in route.trips
                  for sortie in trip.sorties for visit in sortie.visits}
        brought += any(each.delivery in served for each in problem.shipments)
        fetched += any(not served.isdisjoint(each.pickups) for each in problem.shipments)
    assert min(brought, fetched) >= 2


@pytest.mark.parametrize("seed", [3153, 3653, 4676])
def test_a_route_found_is_driven_as_it_was_timed(seed: int) -> None:
    """Timed once more at the end, its driver would find no way to rest while drones fly."""
    rng = np.random.default_rng([seed, 10])
    problem = with_flown_shipments(rng, one_drone(rng) if rng.random() < 0.5 else long_sorties(rng))
    problem = with_energy(rng, problem, 0.5) if rng.random() < 0.4 else problem
    problem = with_driving(rng, with_breaks(rng, problem))
    problem = with_gaps(rng, problem) if rng.random() < 0.3 else problem
    found = improve(problem, pack([problem]), Solution((), problem.left_out(())),
                    SearchConfig(seed, turns=8)).solution
    assert check(problem, found).violations == ()
