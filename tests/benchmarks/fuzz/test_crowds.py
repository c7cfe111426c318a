"""Crowds are far more than fleets can take, and are planned soundly or refused."""

import random

import httpx
import pytest

from benchmarks.fuzz.crowds import FEWEST, MOST, CrowdStudy, crowded_request

pytestmark = pytest.mark.slow

CROWDS = 4


def test_crowds_mix_rules_and_launch_sites() -> None:
    requests = [crowded_request(random.Random(seed)) for seed in range(60)]
    assert all(FEWEST <= len(request["customers"]) <= MOST for request in requests)
    assert 10 < sum(bool(request.get("launch_sites")) for request in requests) < 50
    assert all(kind["count"] <= 3 for request in requests for kind in request["fleet"])


def test_crowds_are_planned_soundly_or_refused(client: httpx.Client) -> None:
    study = CrowdStudy(client)
    for seed in range(CROWDS):
        study.try_problem(seed)
    assert study.checked == study.left_out > 0
