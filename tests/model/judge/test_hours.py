"""Depots that open and close."""

from dataclasses import replace

import pytest

from tests.model.judge.test_check import A_THEN_B, codes, plan
from tests.model.tiny import MINUTE


@pytest.mark.parametrize(("kept", "broken"), [
    ({"latest": 18 * MINUTE}, {"latest": 18 * MINUTE - 1}), ({"earliest": 0}, {"earliest": 1})])
def test_trips_begin_and_end_while_the_depot_is_open(kept, broken, tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    solution, (depot,) = plan(problem, A_THEN_B), problem.depots
    assert codes(replace(problem, depots=(replace(depot, **kept),)), solution) == []
    assert codes(replace(problem, depots=(replace(depot, **broken),)), solution) == ["SHIFT"]
