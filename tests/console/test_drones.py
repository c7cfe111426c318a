"""Drones: what they do is said, why they do nothing too, and another is a click away."""

import json
import re
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import idle, open_example, open_file, open_tab, planned, state
from tests.console.test_everyone import findings

pytestmark = [pytest.mark.slow, pytest.mark.one_page]

DRONES = {"count": 1, "capacity": [2], "endurance": 1800}


def street(**vehicle: Any) -> str:
    """Return a problem of three customers along a street, and one van."""
    return json.dumps({
        "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": name, "location": [2 * number, 0], "demand": [number]}
                      for number, name in enumerate("ABC", 1)],
        "fleet": [{"id": "van", "count": 1, "capacity": [9], "costs": {"per_km": 1}} | vehicle],
        "options": {"time_limit": 60, "search_iterations": 300}})


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize(("drones", "why"), [
    # All lie on the van's way, so that a flight saves nothing of it.
    (DRONES | {"costs": {"per_km": 9}}, "No flight would save: the best, to"),
    (DRONES | {"capacity": [0.5]}, "No order is light enough"),
    (DRONES | {"endurance": 20}, "within reach"),
])
def test_van_whose_drone_flies_nothing_says_why(page: Page, drones: dict[str, Any],
                                                why: str) -> None:
    open_file(page, "street.json", street(drones=drones))
    planned(page, "3 of 3 served")
    line = page.locator(".drones-line")
    expect(line).to_contain_text("van: no drone flies.")
    expect(line).to_contain_text(why)
    open_tab(page, "routes")
    expect(page.locator(".tab .idle-drones")).to_contain_text(why)
    assert findings(page, ".panel") == []


@pytest.mark.thorough
def test_what_if_has_another_drone(page: Page) -> None:
    open_file(page, "street.json", street())
    planned(page, "3 of 3 served")
    expect(page.locator(".drones-line")).to_have_count(0)
    open_tab(page, "changes")
    page.get_by_role("button", name="A drone more on each van").click()
    idle(page)
    assert state(page, "state.request.fleet.0.drones.count") == 1
    expect(page.locator(".plan-name").nth(1)).to_have_value("drones of van on")
    expect(page.locator("#differences")).to_be_visible()
    page.get_by_role("button", name="A drone more on each van").click()
    idle(page)
    assert state(page, "state.request.fleet.0.drones.count") == 2
    expect(page.get_by_text("now 1, 2 drones each")).to_be_visible()


@pytest.mark.thorough
def test_failing_to_find_out_is_no_alarm(open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("503",))
    page.route("**/explain", lambda route: route.fulfill(
        status=503, content_type="application/problem+json", body='{"title": "Busy"}'))
    open_file(page, "street.json", street(drones=DRONES | {"costs": {"per_km": 9}}))
    planned(page, "3 of 3 served")
    expect(page.locator(".drones-line").get_by_role("button", name="Why?")).to_be_visible()
    expect(page.get_by_role("alert")).to_have_count(0)
    page.unroute("**/explain")
    page.locator(".drones-line").get_by_role("button", name="Why?").click()
    expect(page.locator(".drones-line")).to_contain_text("No flight would save")


@pytest.mark.thorough
def test_what_drones_do_fits_every_width(page: Page) -> None:
    open_example(page, "berlin")
    line = page.locator(".drones-line")
    open_tab(page, "changes")
    for width in (1440, 1024, 390):
        page.set_viewport_size({"width": width, "height": 844})
        expect(line).to_contain_text(re.compile(r"\d drones? serves? \d+ of 40"))
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        expect(page.get_by_role("button", name="A drone more on each van")).to_be_visible()
        assert findings(page, ".panel") == [], width


@pytest.mark.thorough
def test_sortie_is_drawn_from_the_side(page: Page) -> None:
    open_example(page, "city_day")
    open_tab(page, "routes")
    page.locator("details.card").evaluate_all("cards => cards.forEach((card) => card.open = true)")
    page.get_by_role("button", name=re.compile("flies", re.IGNORECASE)).first.click()
    profile = page.locator(".height-profile")
    expect(profile.get_by_role("img")).to_be_visible()
    expect(profile).to_contain_text("At 100 m from")
    assert findings(page, ".panel") == []
