"""What any plan costs at most, by the dearest of many tariffs."""

import numpy as np
import pytest

from model.dialects.vroom.convert import dearest_plan
from model.problem import MM_PER_KM, Travel, VehicleType


def test_what_a_plan_costs_at_most_is_found_without_a_look_at_each_tariff() -> None:
    rng = np.random.default_rng(0)
    duration, distance = rng.integers(0, 10**7, (2, 6, 6))
    kinds = [VehicleType(str(number), 1, (1,), 0, fixed_cost=3.0, cost_per_km=0.1 * number)
             for number in range(50)]
    looks: list[None] = []
    bound = dearest_plan(kinds, [Travel(duration, distance)], 1, lambda: looks.append(None))
    costs = [distance * (kind.cost_per_km / MM_PER_KM) for kind in kinds]
    to_nodes = np.max(costs, axis=(0, 1))
    assert bound == pytest.approx(1 + to_nodes[1:].sum() + 5 * (to_nodes[0] + 3))
    assert len(looks) == 1
