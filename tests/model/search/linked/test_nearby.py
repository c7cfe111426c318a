"""Customers of many are tried beside all neighbours, among linked stops and others."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.linked.engine import insert_linked, tie, write_back
from model.search.linked.layout import Linked
from model.search.problem_data import are_timed, make_data
from model.search.route.engine import BY_FAR, anneal, leg_cost
from model.solution import Route, Solution
from tests.model.search.found import INFEASIBLE, beside_neighbours, copied, read_plan
from training.instances import generate

MANY = 2000
"""Customers from which on not all places are looked at, however early in a search."""

TRIED = 60


def without(routes: tuple[Route, ...], node: int) -> tuple[Route, ...]:
    """Return routes without a customer, who is among others."""
    found = []
    for route in routes:
        trip, = route.trips
        stops = tuple(stop for stop in trip.stops if stop.node != node)
        if len(stops) > 2:
            found.append(replace(route, trips=(replace(trip, stops=stops),)))
    return tuple(found)


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("is_linked", [True, False])
def test_no_cheaper_place_beside_a_neighbour_is_passed_over(is_linked: bool) -> None:
    problem = generate(np.random.default_rng(17), MANY, "cvrp")
    data = make_data(problem, pack([problem]))
    data = data._replace(strategy=data.strategy._replace(blink=0.0))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(3))
    linked = Linked(data, searcher, are_timed(data))
    begin_anew(data, searcher, False, linked=linked)
    assert searcher.count.missing == 0
    plan, found = read_plan(data, copied(data, searcher)), 0
    for node in np.random.default_rng(4).choice(MANY, TRIED, replace=False) + 1:
        routes = without(plan.routes, node)
        searcher = make_searcher(problem, data, Solution(routes), np.random.SeedSequence(3))
        searcher.alone[:] = INFEASIBLE
        assert searcher.count.missing == 1
        tie(data, searcher, linked)
        write_back(data, searcher, linked)
        cost = searcher.value.cost - leg_cost(data, searcher)[1]
        least = beside_neighbours(data, routes, int(node))
        if is_linked:
            insert_linked(data, searcher, linked, BY_FAR)
        else:
            anneal(data, searcher, 1, BY_FAR)
        assert searcher.count.missing == 0
        assert searcher.value.cost - cost <= least + 1e-6
        found += least < np.inf
    assert found > TRIED / 2
