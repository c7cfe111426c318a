"""What looks wrong with a problem is counted above the map, leads there, and can be dismissed."""

import json
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import open_file, open_tab, planned, state

pytestmark = pytest.mark.slow


def problem() -> dict[str, Any]:
    """Return three orders in a city, the last with latitude and longitude swapped."""
    places = [[11.55, 48.15], [11.6, 48.12], [48.13, 11.57]]
    return {"coordinate_system": "geographic",
            "depots": [{"id": "hub", "location": [11.56, 48.14]}],
            "customers": [{"id": name, "location": place, "demand": [1]}
                          for name, place in zip("ABC", places, strict=True)],
            "fleet": [{"id": "van", "count": 1, "capacity": [9]}],
            "options": {"time_limit": 0}}


def test_warnings_lead_to_what_they_are_about_and_are_dismissed(console: Page) -> None:
    open_file(console, "mine.json", json.dumps(problem()))
    planned(console, "of 3 served")
    bar = console.get_by_role("region", name="Warnings")
    chip = console.locator("#warnings-button")
    # That ways are straight is no warning, and stands on the map.
    expect(chip).to_have_text("1")
    expect(console.locator(".leaflet-control-attribution")).to_contain_text("as the crow flies")
    chip.click()
    expect(bar).to_contain_text("5,292 km, swapped 1.34 km")
    expect(bar.get_by_role("listitem")).to_have_count(1)
    bar.get_by_role("button", name="Customer C \u203a Location").click()
    assert state(console, "state.selection") == "c:C"
    assert state(console, "state.tab") == "customers"
    if not bar.is_visible():
        chip.click()
    bar.get_by_role("button", name="Dismiss").click()
    expect(chip).to_have_count(0)
    later = problem() | {"unassigned_cost": 1000}
    later["customers"][1]["location"] = [0, 0]
    open_file(console, "later.json", json.dumps(later))
    chip.click()
    expect(bar).to_contain_text("at [0, 0]")
    planned(console, "of 3 served")
    expect(chip).to_have_text("1")


def test_unassigned_are_grouped_and_their_remedy_priced_before_it_is_applied(
        console: Page) -> None:
    far = [{"id": name, "location": [x, 0], "demand": [5]} for name, x in [("A", 6), ("B", 7)]]
    request = {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
               "customers": far, "options": {"time_limit": 0},
               "fleet": [{"id": "van", "count": 1, "capacity": [20], "max_trip_distance": 9000}]}
    open_file(console, "far.json", json.dumps(request))
    planned(console, "0 of 2 served")
    open_tab(console, "unassigned")
    group = console.locator("section.group")
    expect(group).to_have_count(1)
    expect(group.get_by_role("heading")).to_contain_text("2 customers")
    expect(group.locator(".price")).to_have_text("Serves 2 more, cost +14.00.")
    group.get_by_role("button", name="Apply to all 2 and plan again").click()
    planned(console, "2 of 2 served")
    assert state(console, "state.request.fleet.0.max_trip_distance") == 14_000
