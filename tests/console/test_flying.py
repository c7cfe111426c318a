"""Vehicles that fly from hubs, and launch sites, on the map and in lists."""

import json
import re
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.console.steps import (
    EXAMPLES, idle, open_file, open_tab, place_of, planned, show_rules, state,
)
from tests.console.test_everyone import findings
from tests.console.test_panning import Stroke, by_finger, by_mouse

pytestmark = [pytest.mark.slow, pytest.mark.one_page]


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
    request["options"] = {"time_limit": 60, "search_iterations": 2000}
    return request


def test_hubs_drones_and_launch_sites_are_seen(page: Page) -> None:
    open_file(page, "hub.json", json.dumps(hub_and_site()))
    planned(page, "5 of 5 served")
    routes = state(page, "state.plans.0.plan.routes")
    assert {"quad-1", "truck-1"} == {route["vehicle"] for route in routes}
    open_tab(page, "routes")
    panel = page.locator(".panel")
    expect(panel.locator("summary strong", has_text="quad (flies)")).to_be_visible()
    expect(panel).to_contain_text(" Wh")
    panel.get_by_role("row", name="quad").get_by_role("button").first.click()
    profile = panel.locator(".height-profile")
    expect(profile).to_contain_text("landing at attic")
    trip = next(route for route in routes if route["vehicle"] == "quad-1")["trips"][0]
    expect(profile.get_by_role("definition")).to_have_text(
        [re.compile(rf"^{stop['energy_left_wh']:.1f} Wh".replace(".0 ", " "))
         for stop in trip["stops"]])
    legend = page.locator(".map-legend")
    expect(legend).to_contain_text("Flight of a drone")
    expect(legend).to_contain_text("Launch site")
    marks = page.locator(".site-mark")
    expect(marks).to_have_text(["pier", "car park"])
    assert findings(page, ".panel") == []


@pytest.mark.thorough
def test_drones_of_hubs_that_fly_nothing_are_counted(page: Page) -> None:
    request = hub_and_site()
    request["fleet"][1]["count"] = 3
    open_file(page, "hub.json", json.dumps(request))
    planned(page, "5 of 5 served")
    line = page.locator(".drones-line")
    expect(line).to_contain_text("quad: 2 of 3 stay on the ground.")
    expect(line.get_by_role("status")).to_contain_text("2 drones serve ")
    expect(line.get_by_role("button", name="What do they save?")).to_have_count(0)


def middle(mark: Locator) -> tuple[float, float]:
    """Return where on the screen the middle of a mark is."""
    box = mark.locator("span").bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@pytest.mark.thorough
def test_launch_sites_are_drawn_moved_and_erased(page: Page) -> None:
    request = hub_and_site()
    request["launch_sites"].pop()
    open_file(page, "hub.json", json.dumps(request))
    idle(page)
    page.get_by_role("button", name="Draw", exact=True).click()
    tools = page.get_by_role("group", name="Drawing tools")
    marks = page.locator(".site-mark")
    pier = middle(marks.first)
    tools.get_by_role("button", name="Launch site").click()
    page.mouse.click(pier[0] + 150, pier[1] + 30)
    expect(marks).to_have_text(["pier", "site-2"])
    tools.get_by_role("button", name="Move").click()
    drawn = state(page, "state.request.launch_sites.1.location")
    page.mouse.move(*middle(marks.nth(1)))
    page.mouse.down()
    page.mouse.move(pier[0] + 200, pier[1] + 60, steps=4)
    page.mouse.up()
    moved = state(page, "state.request.launch_sites.1.location")
    assert moved[0] > drawn[0]
    assert moved[1] < drawn[1]
    assert state(page, "state.request.launch_sites.0.location") == [1, 7]
    tools.get_by_role("button", name="Erase").click()
    page.mouse.click(*middle(marks.nth(1)))
    expect(marks).to_have_text(["pier"])


@pytest.mark.thorough
@pytest.mark.parametrize("way", [by_mouse, by_finger])
def test_a_launch_site_follows_mouse_or_finger_while_the_map_stays(
        open_page: Callable[..., Page], service: str, way: Callable[[Page], Stroke]) -> None:
    page = open_page(service, has_touch=True)
    open_file(page, "hub.json", json.dumps(hub_and_site()))
    planned(page, "5 of 5 served")
    page.get_by_role("button", name="Draw", exact=True).click()
    page.get_by_role("button", name="Move", exact=True).click()
    page.get_by_role("button", name="Fit", exact=True).click()
    pier, park = (middle(page.locator(".site-mark").nth(place)) for place in (0, 1))
    stroke = way(page)
    stroke([pier, (pier[0] + 60, pier[1] + 30)])
    (x, y) = state(page, "state.request.launch_sites.0.location")
    assert x > 1
    assert y < 7
    assert middle(page.locator(".site-mark").nth(1)) == park
    # A finger that does not move, moves nothing.
    stroke([park, (park[0] + 2, park[1])])
    assert state(page, "state.request.launch_sites.1") == hub_and_site()["launch_sites"][1]


@pytest.mark.thorough
def test_launch_sites_and_vehicles_that_fly_have_fields(page: Page) -> None:
    open_file(page, "hub.json", json.dumps(hub_and_site()))
    idle(page)
    open_tab(page, "customers")
    page.locator("summary", has_text="Coordinates, depots and launch sites").click()
    page.get_by_role("button", name="Add to launch sites").click()
    page.locator("#field-launch_sites-2-id").fill("quay")
    page.locator("#field-launch_sites-2-id").press("Enter")
    expect(page.locator(".site-mark")).to_have_text(["pier", "car park", "quay"])
    open_tab(page, "fleet")
    page.locator("summary", has_text="quad").click()
    show_rules(page)
    expect(page.locator("#field-fleet-1-flies")).to_be_checked()
    for field in ("altitude", "max_range", "max_wind_kmh", "preset", "endurance"):
        expect(page.locator(f"#field-fleet-1-{field}")).to_be_visible()
    page.locator("#field-fleet-1-max_range").fill("5000")
    page.locator("#field-fleet-1-max_range").press("Enter")
    expect(page.locator("#field-fleet-1-truck_waits")).to_have_count(0)
    page.locator("#field-fleet-1-flies").uncheck()
    expect(page.locator("#field-fleet-1-altitude")).to_have_count(0)
    # What is stated stays, so that it can be taken out.
    expect(page.locator("#field-fleet-1-max_range")).to_be_visible()
    assert state(page, "state.request.fleet.1.max_range") == 5000
    assert state(page, "state.request.fleet.1.flies") is False
    expect(page.locator("#field-fleet-0-truck_waits")).to_be_visible()


@pytest.mark.thorough
def test_customer_served_by_truck_tells_why_no_drone_comes(page: Page) -> None:
    request = hub_and_site()
    request["customers"][1] |= {"demand": [3], "served_by": "either"}
    request["fleet"][1]["max_range"] = 3000
    open_file(page, "hub.json", json.dumps(request))
    planned(page, "5 of 5 served")
    page.mouse.click(*place_of(page, "c:farm"))
    open_tab(page, "routes")
    page.get_by_role("button", name="Why here?").click()
    panel = page.locator(".panel")
    expect(panel.get_by_role("heading", name="Why no drone here")).to_be_visible()
    why = panel.locator("li", has_text="quad: ")
    expect(why).to_contain_text("exceeds 2")
    expect(why).to_contain_text("at most 3000 m are allowed")
    assert findings(page, ".panel") == []
