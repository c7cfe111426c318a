"""Fleets that just suffice are drawn from plans, which are still plans of them."""

import math

import numpy as np
import pytest

from benchmarks.quality.tight_fleets import just_sufficing, nobody_served
from model.engine.instance import pack
from model.judge.check import check
from model.search.improve import SearchConfig, improve
from training.instances import generate


@pytest.mark.parametrize("variant", ["hetero", "multitrip", "drone", "shipments"])
@pytest.mark.parametrize("slack", [0.0, 0.03])
def test_plan_needs_all_that_is_left_of_its_fleet(variant: str, slack: float) -> None:
    problem = generate(np.random.default_rng(5), 20, variant)
    plan = improve(problem, pack([problem], legs=False), nobody_served(problem),
                   SearchConfig(5, turns=300), math.inf).solution
    tight = just_sufficing(problem, plan, slack)
    assert check(tight, plan).violations == ()
    used = {route.vehicle_type for route in plan.routes}
    for number in used:
        kind, before = tight.vehicle_types[number], problem.vehicle_types[number]
        assert kind.count == sum(route.vehicle_type == number for route in plan.routes)
        assert all(now <= most for now, most in zip(kind.capacity, before.capacity, strict=True))
    unused = [kind for number, kind in enumerate(tight.vehicle_types) if number not in used]
    assert all(kind.latest == kind.earliest for kind in unused)
    least = just_sufficing(problem, plan, -0.01)
    assert check(least, plan).violations != ()
