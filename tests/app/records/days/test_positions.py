"""Where vehicles are, as their drivers' phones tell it."""

import uuid
from datetime import UTC, datetime, timedelta
from typing import Any

import httpx
import pytest

from tests.app.records.days.living import PROBLEM, begun, planned, standing
from tests.app.records.dispatches.days import holding, token_of

pytestmark = pytest.mark.slow

MUNICH: dict[str, Any] = {
    "coordinate_system": "geographic", "fleet": [{**PROBLEM["fleet"][0], "count": 1}],
    "depots": [{"id": "hub", "location": [11.5, 48.1]}],
    "customers": [{"id": "A", "location": [11.6, 48.1], "demand": [1]}]}


def day_on_the_road(client: httpx.Client, problem: dict[str, Any]) -> tuple[str, dict[str, str]]:
    """Begin a day by the service's clock, and return it with what opens its vehicle's link."""
    start = datetime.now(UTC) - timedelta(minutes=5)
    day = begun(client, {**problem, "plan_start": start.isoformat()}, clock=None)
    dispatch = standing(client, day).dispatch
    link = client.get(f"/dispatches/{dispatch}").json()["links"][0]
    made = client.post(f"/dispatches/{dispatch}/links/{link['id']}").json()
    return day, holding(token_of(made["links"][0]))


def tell(client: httpx.Client, driver: dict[str, str], **told: Any) -> httpx.Response:
    """Tell something as a phone does."""
    now = datetime.now(UTC).isoformat()
    return client.post("/drive/events", headers=driver, json={"now": now, "events": [
        {"id": str(uuid.uuid4()), "step": "position", "kind": "done", "time": now} | told]})


def test_last_position_counts_and_one_in_time_asks_for_no_plan(service: httpx.Client) -> None:
    day, driver = day_on_the_road(service, MUNICH)
    assert service.get("/drive/day", headers=driver).json()["asks_position"]
    plans = standing(service, day).plan_number
    assert tell(service, driver, location=[11.503, 48.1]).status_code == 200
    found = planned(service, day)
    assert found.plan_number == plans
    van = found.vehicles[0]
    assert van.position == (11.503, 48.1)
    assert van.position_at is not None
    assert 0 <= found.now - van.position_at < 60
    long_ago = (datetime.now(UTC) - timedelta(minutes=4)).isoformat()
    tell(service, driver, location=[11.9, 48.1], time=long_ago)
    assert planned(service, day).vehicles[0] == van


def test_position_is_not_kept_where_nobody_can_use_it(service: httpx.Client) -> None:
    day, driver = day_on_the_road(service, PROBLEM)
    assert not service.get("/drive/day", headers=driver).json()["asks_position"]
    revision = standing(service, day).revision
    assert tell(service, driver, location=[11.5, 48.1]).status_code == 200
    assert standing(service, day).revision == revision


def test_position_has_a_place_and_nothing_else_has(service: httpx.Client) -> None:
    _, driver = day_on_the_road(service, MUNICH)
    for told in ({}, {"step": "vehicle", "location": [11.5, 48.1]}, {"location": [11.5, 98.1]}):
        assert tell(service, driver, **told).status_code == 422
