from dataclasses import replace

import pytest

from model.judge.timing import TripDecision
from model.problem import IncompatibleGoods
from tests.model.judge.test_check import A_THEN_B, C_BY_DRONE, codes, plan


@pytest.mark.parametrize(("scope", "trips", "broken"), [
    ("trip", (A_THEN_B,), ["GOODS"]),
    ("trip", (C_BY_DRONE,), ["GOODS"]),
    ("trip", (TripDecision((0, 1, 0)), TripDecision((0, 2, 0))), []),
    ("vehicle", (TripDecision((0, 1, 0)), TripDecision((0, 2, 0))), ["GOODS"]),
    ("vehicle", (TripDecision((0, 1, 0)), TripDecision((0, 4, 0))), []),
])
def test_incompatible_goods_are_kept_apart(
    scope, trips, broken, tiny_problem, customers, truck, drones
):
    a, b, c, d = customers
    customers = (replace(a, goods=frozenset({"food", "ice"})),
                 replace(b, goods=frozenset({"paint"} if trips[0] != C_BY_DRONE else ())),
                 replace(c, goods=frozenset({"paint"})), replace(d, goods=frozenset({"food"})))
    problem = replace(
        tiny_problem(*customers, truck=replace(truck, max_trips=2, drones=drones)),
        incompatible_goods=(IncompatibleGoods(frozenset({"food", "paint", "acid"}), scope),))
    assert codes(problem, plan(problem, *trips)) == broken
