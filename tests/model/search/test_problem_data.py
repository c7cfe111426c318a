"""What the search lays out of a problem, in a time that grows no faster than the problem."""

import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import product

import numpy as np
import pytest

from model.engine.instance import pack
from model.problem import Problem
from model.search.neighbourhood.neighbourhood import make_neighbourhood
from model.search.problem_data import make_data
from training.instances import generate

MANY = 3000
ATTEMPTS = 4


def with_types(number: int, kinds: int) -> Problem:
    """Return customers for so many types, of which every `kinds`-th drives alike."""
    rng = np.random.default_rng(0)
    problem = generate(rng, 5, "cvrp")
    truck = problem.vehicle_types[0]
    types = tuple(replace(truck, id=str(index), fixed_cost=float(index),
                          latest=truck.latest - index % kinds)
                  for index in range(number))
    table = np.ones((number, 5), np.bool_)
    table[: number // 2, 0] = False
    return replace(problem, vehicle_types=types, may_serve=table)


def test_types_that_drive_alike_for_the_same_customers_may_swap_routes() -> None:
    swap = make_data(problem := with_types(12, 3), pack([problem])).swap
    for one, other in product(range(12), repeat=2):
        alike = one % 3 == other % 3 and (one < 6) == (other < 6) and one != other
        assert swap[one, other] == alike


def seconds_of(work: Callable[[], object]) -> float:
    """Return the least processor time of some attempts."""
    spent = []
    for _ in range(ATTEMPTS):
        began = time.thread_time()
        work()
        spent.append(time.thread_time() - began)
    return min(spent)


def test_many_types_take_no_longer_than_a_hundred_comparisons_of_each_with_each() -> None:
    problem = with_types(MANY, 1)
    instance = pack([problem], legs=False)
    neighbourhood = make_neighbourhood(problem, instance)
    numbers = np.arange(MANY)
    assert (seconds_of(lambda: make_data(problem, instance, neighbourhood=neighbourhood))
            < 100 * seconds_of(lambda: numbers == numbers[:, None]))


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("layout", ["one place", "all but few at one place"])
def test_neighbours_at_one_place_are_ranked_soon(layout: str) -> None:
    problem = generate(np.random.default_rng(0), 2000, "cvrp")
    x = np.zeros(problem.num_nodes)
    if layout != "one place":
        x[::50] = 1000.0
    metres = np.rint(1000 * np.abs(x[:, None] - x)).astype(np.int64)
    travel = replace(problem.travel[0], duration=metres, distance=metres)
    there = replace(problem, travel=(travel,) * len(problem.travel))
    spent = []
    for each in (problem, there):
        instance = pack([each], legs=False)
        assert (make_neighbourhood(each, instance).near[each.num_depots:] >= each.num_depots).all()
        spent.append(seconds_of(partial(make_neighbourhood, each, instance)))
    assert spent[1] < 3 * spent[0]
