"""Orders across vehicles in the decision process: vehicles closed bound when others serve."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.judge.relations import who_waits
from model.problem import Problem
from model.simulation.actions import NUM_KINDS, OPEN
from model.policy.extract import extract
from tests.model.mask_oracle import legal_codes
from tests.model.rollouts import roll
from tests.model.simulation.test_simulator import Change, Position, walk
from tests.model.tiny import draw_tiny, with_gaps
from tests.model.tiny_company import companions, with_order, with_order_across, with_relations

pytestmark = pytest.mark.slow


def legal_behind(problem: Problem, position: Position, closed: int) -> tuple[set[int], bool]:
    """Return what is legal behind what vehicles do by so many actions, and whether that binds."""
    plan, own = extract(problem, pack([problem]), position.actions[:closed]), problem
    served = [node for route in position.closed for node in route.served]
    gone = position.served | companions(problem, served)
    for node in sorted(problem.lags_across.keys() - position.served):
        _, bound = who_waits(own, plan, node)
        gone |= {node} if bound is None else set()
        own = bound or own
    return {*legal_codes(own, position.vehicle, gone, position.used)}, own is not problem


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("change", [with_gaps, with_relations, with_order])
def test_orders_across_vehicles_bound_when_others_serve(change: Change) -> None:
    bound = 0
    for seed in range(14):
        rng = np.random.default_rng((seed, 51))
        problem = with_order_across(rng, change(rng, draw_tiny(rng)))
        problem = replace(problem, customers=tuple([
            replace(each, late_cost_per_hour=None, late_cost=0.0, early_cost_per_hour=0.0)
            for each in problem.customers]))
        for codes, position in walk(problem, rng):
            expected, binds = legal_behind(problem, position, position.opened)
            if any(code % NUM_KINDS == OPEN for code in {*codes, *expected}):
                opens, _ = legal_behind(problem, position, len(position.actions))
                expected = {code for code in expected if code % NUM_KINDS != OPEN} | {
                    code for code in opens if code % NUM_KINDS == OPEN}
            assert {*codes} == expected, f"seed {seed}"
            bound += binds
        rollout = roll([problem], seed).rollouts[0]
        evaluation = check(problem, extract(problem, pack([problem]), rollout.actions))
        assert evaluation.violations == (), f"seed {seed}"
        assert rollout.cost.sum() == pytest.approx(evaluation.cost.total, rel=1e-9)
    assert bound > 0
