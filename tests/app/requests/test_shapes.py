"""What is refused by its shape, before anything is made of it."""

import json
import time
from typing import Any

import pytest

from app.requests.reading import read_request
from app.schemas.errors import InvalidRequestError
from app.schemas.plan import MAX_DETAILS

PARTS = "cost", "summary", "solver", "airspace", "replan"


def request_of(plan: dict[str, Any]) -> bytes:
    """Return a request that goes on from a plan."""
    return json.dumps({
        "depots": [{"id": "d", "location": [0, 0]}], "fleet": [{"id": "t", "count": 1,
                                                                "capacity": [1]}],
        "customers": [{"id": "c", "location": [1, 1], "demand": [1]}],
        "replan": {"plan": {"routes": [], "unassigned": []} | plan}}).encode()


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize("entries", [MAX_DETAILS + 1, 300_000])
def test_parts_of_a_plan_that_are_not_read_hold_few_entries(part: str, entries: int) -> None:
    body = request_of({part: {f"key {number}": number for number in range(entries)}})
    began = time.process_time()
    with pytest.raises(InvalidRequestError) as error:
        read_request(body, None)
    assert time.process_time() - began < 1.5
    assert [(each.code, each.path) for each in error.value.errors] == [
        ("WRONG_LENGTH", f"$.replan.plan.{part}")]


@pytest.mark.parametrize("part", PARTS)
def test_parts_of_a_plan_that_are_not_read_may_hold_anything(part: str) -> None:
    details = {f"key {number}": {"deep": [number, None, "text" * 50]} for number in range(500)}
    assert read_request(request_of({part: details}), None).replan is not None
    with pytest.raises(InvalidRequestError) as error:
        read_request(request_of({part: [details]}), None)
    assert [each.path for each in error.value.errors] == [f"$.replan.plan.{part}"]
