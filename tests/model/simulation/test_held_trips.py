"""Trips that last too long are held until that helps, or can't."""

import numpy as np
import pytest

from tests.model.simulation.test_simulator import (
    Change, assert_exact, few_at_hubs_among_all, fliers_among_all,
)
from tests.model.tiny import draw_tiny, with_limits_aboard


@pytest.mark.parametrize(("change", "seed"), [
    (few_at_hubs_among_all, 1073),  # what lasts too long does so again in the next window
    (few_at_hubs_among_all, 2066), (with_limits_aboard, 2099),  # or at another speed
    (fliers_among_all, 1149), (fliers_among_all, 1376),  # who is lighter hovers at more
    (fliers_among_all, 1478),  # who waits for others hovers
    (few_at_hubs_among_all, 2054),  # who begins later is charged for longer, and waits less
])
def test_a_trip_is_held_until_nothing_turns_what_lasts_too_long(change: Change, seed: int) -> None:
    rng = np.random.default_rng(seed)
    assert_exact(change(rng, draw_tiny(rng)), rng, seed)
