"""What requests share of where their places and areas are."""

import json
from typing import Any

import pytest

from app.requests.conversion.ground import Ground
from app.requests.conversion.places import PlacedRequest
from app.schemas.request import PlanRequest
from app.schemas.times import read_body
from tests.app.plans.test_closed_hours import HOUR, day, harbour


def placed(start: str, earliest: float, latest: float) -> PlacedRequest:
    """Return a day with a zone that has hours, and so a shift."""
    request: dict[str, Any] = day(harbour()) | {"plan_start": start}
    request["fleet"][0]["shift"] = {"earliest": earliest, "latest": latest}
    return PlacedRequest(read_body(PlanRequest, json.dumps(request).encode()))


@pytest.mark.parametrize(("start", "earliest", "latest", "is_shared"), [
    ("2026-11-26T08:00:00+00:00", HOUR, 10 * HOUR, True),
    ("2026-11-26T09:00:00+00:00", 0, 9 * HOUR, False),  # the same shift, told from another instant
    ("2026-11-26T08:00:00+00:00", 0, 10 * HOUR, False)])
def test_ground_is_shared_by_days_whose_zones_close_at_the_same_seconds(
        start: str, earliest: float, latest: float, is_shared: bool) -> None:
    ground = Ground(placed("2026-11-26T08:00:00+00:00", HOUR, 10 * HOUR))
    assert ground.is_that_of(placed(start, earliest, latest)) == is_shared
