"""Vehicles that fly from hubs, and launch sites, on the map and in lists."""

import json
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import EXAMPLES, open_file, open_tab, planned, state
from tests.console.test_everyone import findings

pytestmark = pytest.mark.slow


def hub_and_site() -> dict[str, Any]:
    """Return a problem with a drone of a hub, and a truck whose drone needs a launch site."""
    request: dict[str, Any] = json.loads((EXAMPLES / "launch_sites.json").read_text("utf-8"))
    request["depots"].append({"id": "roof", "location": [20, 0]})
    request["customers"].append(
        {"id": "attic", "location": [21, 1], "demand": [1], "served_by": "drone"})
    request["fleet"].append({
        "id": "quad", "flies": True, "depot": "roof", "count": 1, "capacity": [2],
        "endurance": 1200, "energy": {
            "battery_wh": 800, "power": {"cruise_w": 600, "cruise_w_per_kg": 120}}})
    request["options"] = {"search_iterations": 2000}
    return request


def test_hubs_drones_and_launch_sites_are_seen(page: Page) -> None:
    open_file(page, "hub.json", json.dumps(hub_and_site()))
    planned(page, "5 of 5 served")
    routes = state(page, "state.plans.0.plan.routes")
    assert {"quad-1", "truck-1"} == {route["vehicle"] for route in routes}
    open_tab(page, "routes")
    panel = page.locator(".panel")
    expect(panel.locator("summary strong", has_text="quad-1 (flies)")).to_be_visible()
    expect(panel).to_contain_text(" Wh")
    expect(page.locator(".map-legend")).to_contain_text("Flight of a drone")
    assert findings(page, ".panel") == []
