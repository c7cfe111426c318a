"""What any plan costs at most, by the dearest of many tariffs."""

import numpy as np
import pytest

from model.dialects.vroom.convert import dearest_plan
from model.problem import MM_PER_KM, MS_PER_HOUR, Travel, VehicleType


def test_what_a_plan_costs_at_most_is_found_without_a_look_at_each_tariff() -> None:
    rng = np.random.default_rng(0)
    duration, distance = rng.integers(0, 10**7, (2, 6, 6))
    kinds = [VehicleType(str(number), 1, (1,), 0, fixed_cost=3.0, cost_per_km=per_km,
                         cost_per_hour=per_hour)
             for number, (per_km, per_hour) in enumerate(
                 [*((0.1 * rate, 0.0) for rate in range(50)), (1.0, 7.0), (0.5, 7.0)])]
    looks: list[None] = []
    bound = dearest_plan(kinds, [Travel(duration, distance)], 1, lambda: looks.append(None))
    costs = [distance * (kind.cost_per_km / MM_PER_KM)
             + duration * (kind.cost_per_hour / MS_PER_HOUR) for kind in kinds]
    to_nodes = np.max(costs, axis=(0, 1))
    assert bound == pytest.approx(1 + to_nodes[1:].sum() + 5 * (to_nodes[0] + 3))
    assert len(looks) == 2
