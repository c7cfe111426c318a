"""Trips that last too long are held until that helps, or can't."""

import numpy as np
import pytest

from tests.model.simulation.test_simulator import (
    Change, assert_exact, few_at_hubs_among_all, fliers_among_all, shipments_among_all,
)
from tests.model.tiny import draw_tiny, with_limits_aboard


@pytest.mark.parametrize(("change", "seed"), [
    (few_at_hubs_among_all, 1073),  # what lasts too long does so again in the next window
    (few_at_hubs_among_all, 2066), (with_limits_aboard, 2099),  # or at another speed
    (fliers_among_all, 1149), (fliers_among_all, 1376),  # who is lighter hovers at more
    (fliers_among_all, 1478),  # who waits for others hovers
    (few_at_hubs_among_all, 2054),  # who begins later is charged for longer, and waits less
    (fliers_among_all, 3028),  # two drones come back in another order once their trip is held
])
def test_a_trip_is_held_until_nothing_turns_what_lasts_too_long(change: Change, seed: int) -> None:
    rng = np.random.default_rng(seed)
    assert_exact(change(rng, draw_tiny(rng)), rng, seed)


@pytest.mark.parametrize("seed", [2079, 2205])
def test_who_flies_works_from_its_launch_on_however_long_it_is_busy_before(seed: int) -> None:
    rng = np.random.default_rng(seed)
    assert_exact(shipments_among_all(rng, draw_tiny(rng)), rng, seed)
