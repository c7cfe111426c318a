"""Tests of the arrays that running plans are held in."""

import numpy as np

from model.engine.instance import pack
from model.simulation.actions import reset
from model.simulation.state import NO_VEHICLE, by_term, empty_costs
from model.solution import COST_TERMS
from tests.model.rollouts import random_problems


def test_costs_are_told_apart_by_the_terms_of_a_solution() -> None:
    cost = empty_costs(2)
    names = cost.dtype.names or ()
    assert (*names, "changes") == COST_TERMS
    cost["lateness"][1] = 3.0
    assert by_term(cost)[1].tolist() == [
        3.0 if term == "lateness" else 0.0 for term in names]


def test_rollouts_of_several_problems_begin_with_nobody_served_and_no_vehicle() -> None:
    problems = random_problems(seed=3, count=4)
    rows = np.array([2, 0, 0, 3, 1])
    state = reset(pack(problems), rows, num_scratch=2)
    assert state.num_unserved[:5].tolist() == [problems[row].num_customers for row in rows]
    assert [int(state.under_way(r).type) for r in range(7)] == [NO_VEHICLE] * 7
    assert not any(rows.any() for rows in (state.served, state.used, state.done))
