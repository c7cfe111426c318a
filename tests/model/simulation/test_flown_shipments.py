"""Which shipments drones may fetch and deliver, held to the checker."""

import numpy as np
import pytest

from model.simulation.actions import LAUNCH, encode_action
from tests.model.search.test_optimum import one_drone
from tests.model.simulation.test_simulator import assert_exact, flown_both_ways, walk
from tests.model.tiny import draw_tiny
from tests.model.tiny_shipments import with_flown_parts, with_flown_shipments


@pytest.mark.thorough
def test_drones_fetch_and_deliver_exactly_what_can_be_brought() -> None:
    launched = [0, 0, 0]
    for seed in range(72):
        rng = np.random.default_rng((seed, 9))
        problem = one_drone(rng) if seed % 3 else flown_both_ways(rng, draw_tiny(rng))
        problem = (with_flown_parts if seed % 6 == 1 else with_flown_shipments)(rng, problem)
        assert_exact(problem, rng, seed)
        for codes, _ in walk(problem, np.random.default_rng(seed)):
            for each in problem.shipments:
                launched[0] += encode_action(LAUNCH, each.pickup) in codes
                launched[1] += encode_action(LAUNCH, each.delivery) in codes
                launched[2] += any(encode_action(LAUNCH, part.pickup) in codes
                                   for part in each.more)
    assert min(launched) > 5


def test_what_a_drone_delivers_is_priced_aboard_its_truck_until_the_launch() -> None:
    for seed in (466, 686):
        rng = np.random.default_rng((seed, 9))
        problem = flown_both_ways(rng, draw_tiny(rng))
        problem = (with_flown_parts if seed % 3 == 1 else with_flown_shipments)(rng, problem)
        assert any(kind.cost_per_load_km for kind in problem.vehicle_types)
        assert_exact(problem, rng, seed)
