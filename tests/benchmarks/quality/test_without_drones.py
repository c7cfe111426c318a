"""What drones save."""

from dataclasses import replace

import numpy as np
import pytest

from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.quality.without_drones import POLICY, SEARCH, Pair, grounded, plan_pairs, table
from model.planner import load_planner
from training.instances import generate

pytestmark = pytest.mark.slow


def test_trucks_serve_all_where_drones_are_taken_away() -> None:
    problem = generate(np.random.default_rng(1), 20, "table1")
    assert any(customer.served_by == "drone" for customer in problem.customers)
    alone = grounded(problem)
    assert {customer.served_by for customer in alone.customers} <= {"either", "truck"}
    assert all(kind.drones is None for kind in alone.vehicle_types)


def test_each_problem_is_planned_four_times() -> None:
    planner = load_planner(Settings().weights_dir, [DEFAULT_POLICY])
    pairs = list(plan_pairs(planner, DEFAULT_POLICY, [6], 1, 0.05))
    assert [pair.method for pair in pairs] == [POLICY, SEARCH] * 2
    assert all(pair.with_drones > 0 and pair.without > 0 for pair in pairs)


def test_table_leaves_out_problems_that_a_plan_does_not_serve_whole() -> None:
    pair = Pair("drone", 9, 0, POLICY, 50.0, 100.0, 0)
    pairs = [pair, replace(pair, method=SEARCH, with_drones=25.0),
             replace(pair, index=1, with_drones=1.0),
             replace(pair, index=1, method=SEARCH, unassigned=2)]
    assert table(pairs)[2] == "| drone | 9 | 1 | 50.0 | 75.0 |"
    assert len(table(pairs)) == 3
