"""Requests as in practice, answered by Tandem and by VROOM."""

import json
import math
from typing import Any

import numpy as np
import pytest

from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.peers.vroom_requests import (
    CLASSES, by_tandem, by_vroom, compare, cvrp, priorities, setups, skills, windows,
)
from model.planner import Planner, load_planner
from tests.app.formats.vroom.judge import judge

pytestmark = pytest.mark.slow

Data = dict[str, Any]

SIZE, SECONDS = 30, 1.0


@pytest.fixture(scope="module")
def planner() -> Planner:
    """Return the planner that the service has by default."""
    return load_planner(Settings().weights_dir, (DEFAULT_POLICY,))


@pytest.mark.parametrize("make", CLASSES, ids=lambda make: make.__name__)
def test_requests_repeat_by_their_seed(make: Any) -> None:
    one, same, other = (json.dumps(make(np.random.default_rng(seed), 12)) for seed in (1, 1, 2))
    assert one == same != other


@pytest.mark.parametrize("make", [cvrp, windows, skills, setups], ids=lambda make: make.__name__)
def test_tandem_serves_no_fewer_at_about_the_same_cost(planner: Planner, make: Any) -> None:
    request = make(np.random.default_rng(7), SIZE)
    judge(request, by_tandem(planner, request, SECONDS))
    done = compare(planner, request, SECONDS)
    assert done.tandem_value >= done.vroom_value
    assert math.isnan(done.ratio) or done.ratio <= 1.04


def test_priorities_are_served_about_as_well_as_by_vroom(planner: Planner) -> None:
    request = priorities(np.random.default_rng(3), SIZE)
    theirs, _ = by_vroom(request, None)
    ours = by_tandem(planner, request, SECONDS)
    judge(request, ours)
    assert ours["summary"]["priority"] >= 0.98 * theirs["summary"]["priority"]
