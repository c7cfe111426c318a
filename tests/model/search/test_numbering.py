"""The search's own numbers for customers."""

import numpy as np
import pytest

from model.judge.check import check
from model.engine.instance import pack
from model.search.improve import SearchConfig, improve
from model.search.neighbourhood.neighbourhood import make_neighbourhood
from model.search.neighbourhood.numbering import along_neighbours
from model.search.problem_data import make_data
from model.solution import Solution
from tests.model.rollouts import random_problems
from training.instances import generate


def test_customers_on_a_line_are_numbered_along_it() -> None:
    place = np.array([3.0, 7.0, 1.0, 5.0, 2.0, 6.0, 4.0])
    ranks = np.abs(place[:, None] - place).argsort(axis=1)[:, 1:]
    near = np.vstack([np.full((2, 6), -1), ranks + 2]).astype(np.int32)
    numbering = along_neighbours(near, 2)
    assert numbering.node[:2].tolist() == [0, 1]
    assert sorted(numbering.node.tolist()) == list(range(9))
    assert place[numbering.node[2:] - 2].tolist() == [3.0, 2.0, 1.0, 4.0, 5.0, 6.0, 7.0]
    assert numbering.number[numbering.node].tolist() == list(range(9))


def test_customers_without_neighbours_are_numbered_as_they_come() -> None:
    assert along_neighbours(np.full((4, 1), -1, np.int32), 1).node.tolist() == [0, 1, 2, 3]


@pytest.mark.parametrize("variant", ["cvrp", "mixed"])
def test_neighbours_are_near_in_memory(variant: str) -> None:
    problem = generate(np.random.default_rng(3), 300, variant)
    distances = []
    for along in (False, True):
        made = make_neighbourhood(problem, pack([problem]), along=along)
        near = made.near[problem.num_depots:, :16]
        numbers = np.arange(problem.num_depots, problem.num_nodes)[:, None]
        distances.append(float(np.median(np.abs(near - numbers))))
    assert distances[1] < 0.3 * distances[0]


def test_every_table_is_in_the_order_of_the_numbers() -> None:
    for problem in random_problems(seed=11, count=60):
        instance = pack([problem])
        neighbourhoods = [make_neighbourhood(problem, instance, along=way) for way in (False, True)]
        stated, along = (make_data(problem, instance, neighbourhood=made)
                         for made in neighbourhoods)
        node = neighbourhoods[1].numbering.node
        for name, axes in (("node", (1,)), ("amount", (0,)), ("price", (0,)), ("goods", (0,)),
                           ("setup", (0,)), ("max_time_aboard", (0,)), ("must_serve", (0,)),
                           ("unassigned_more", (0,)), ("reload", (1,)), ("can", (2,)),
                           ("leg", (1, 2)), ("back", (1, 2))):
            table = getattr(stated, name)
            for axis in axes:
                table = np.take(table, node, axis) if table.shape[axis] else table
            assert np.array_equal(table, getattr(along, name)), name


def test_what_is_begun_with_and_what_is_found_have_the_numbers_of_the_problem() -> None:
    for number, problem in enumerate(random_problems(seed=13, count=30)):
        nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
        found = improve(problem, pack([problem]), nobody, SearchConfig(number, turns=20))
        assert check(problem, found.solution).violations == ()
        again = improve(problem, pack([problem]), found.solution, SearchConfig(number, turns=20))
        assert check(problem, again.solution).violations == ()
