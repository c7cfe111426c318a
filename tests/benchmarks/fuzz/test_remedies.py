"""What a remedy says makes its customer fit.

The study of a thousand remedies is `python -m benchmarks.fuzz.remedies`.
"""

import json
import random
from typing import Any

import httpx
import pytest

from benchmarks.fuzz.problems import Study
from benchmarks.fuzz.remedies import Remedies, alone, late_drones
from benchmarks.fuzz.wild_problems import wild_request

pytestmark = pytest.mark.slow

Data = dict[str, Any]

PROBLEMS = 40

REASON = {"vehicle_type": "van", "code": "CAPACITY", "message": "…",
          "remedies": [{"code": "CAPACITY", "who": "van", "suffices": True, "text": "…",
                        "changes": [{"path": "$.fleet[0].capacity", "to": [9]}]}]}
REQUEST: Data = {
    "customers": [{"id": "A", "demand": [9]}, {"id": "B", "demand": [1]}],
    "fleet": [{"id": "van", "capacity": [5]}, {"id": "bus", "capacity": [1]}],
    "unassigned_cost": 3.0}


def test_remedies_hold(client: httpx.Client) -> None:
    false = []
    remedies = Remedies(Study(client))
    for seed in range(PROBLEMS):
        rng = random.Random(seed)
        false += remedies.try_plan(late_drones(rng) if seed % 2 else wild_request(rng))
    assert false == []
    assert remedies.applied.total() > PROBLEMS / 2
    assert len(remedies.applied) > 3


def test_one_customer_and_one_type_are_left() -> None:
    problem = alone(REQUEST, "A", REASON)
    assert [customer["id"] for customer in problem["customers"]] == ["A"]
    assert [kind["id"] for kind in problem["fleet"]] == ["van"]
    assert problem["unassigned_cost"] is None
    assert alone(REQUEST, "A", REASON | {"code": "COST"})["unassigned_cost"] == 3.0


def answering(second: Data) -> Study:
    """Return a study of a service that leaves A out, and then answers with something else."""
    def answer(request: httpx.Request) -> httpx.Response:
        body = json.loads(request.content)
        if request.url.path == "/check":
            return httpx.Response(200, json={"feasible": True, "cost": {"total": 1.0}})
        if len(body["customers"]) == 1:
            return httpx.Response(200, json=second)
        return httpx.Response(200, json={
            "routes": [], "unassigned": [{"id": "A", "reasons": [REASON]}],
            "cost": {"total": 1.0}, "summary": {"served": 1}})

    return Study(httpx.Client(transport=httpx.MockTransport(answer), base_url="http://service"))


@pytest.mark.parametrize(("left_out", "faults"), [
    ([], 0), ([{"id": "A", "reasons": [REASON]}], 1),
    ([{"id": "A", "reasons": [REASON | {"code": "COST"}]}], 0)])
def test_remedies_that_change_nothing_are_found(left_out: list[Data], faults: int) -> None:
    false = Remedies(answering({"unassigned": left_out})).try_plan(REQUEST)
    assert len(false) == faults
