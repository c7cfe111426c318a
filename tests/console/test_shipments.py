"""Shipments on the map, in lists and in their form."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import open_file, open_tab, place_of, planned, state
from tests.console.test_everyone import findings
from tests.console.test_importing import dialog, use

pytestmark = [pytest.mark.slow, pytest.mark.one_page]

REQUEST: dict[str, Any] = {
    "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
    "customers": [{"id": "A", "location": [2, 1], "demand": [1]}],
    "shipments": [
        {"id": "parcel", "amount": [2], "pickup": {"location": [3, 0]},
         "delivery": {"location": [1, -1], "time_window": {"latest": 7200}}},
        {"id": "safe", "amount": [90], "pickup": {"location": [4, 0]},
         "delivery": {"location": [0, 2]}}],
    "fleet": [{"id": "van", "count": 1, "capacity": [5]}],
    "options": {"time_limit": 60, "search_iterations": 200}}


def test_shipments_are_seen_and_told_of(page: Page) -> None:
    open_file(page, "parcel.json", json.dumps(REQUEST))
    planned(page, "3 of 5 served")
    open_tab(page, "routes")
    panel = page.locator(".panel")
    for end, window in (("pickup", "any time"), ("delivery", "until 2:00")):
        row = panel.get_by_role("row", name=f"parcel {end}")
        expect(row).to_be_visible()
        expect(row.get_by_role("cell").nth(1)).to_have_text(window.replace("any time", ""))
    page.mouse.click(*place_of(page, "c:parcel/delivery"))
    assert state(page, "state.selection") == "c:parcel/delivery"
    about = panel.locator("section", has_text="parcel/delivery").first
    expect(about).to_contain_text("Served byvan")
    expect(about.get_by_role("button", name="Lock")).to_have_count(0)
    # A click on an end asks of the whole.
    about.get_by_role("button", name="Why here?").click()
    table = about.get_by_role("table", name="Instead, for parcel")
    expect(table.get_by_role("row", name="Not at all")).to_contain_text("+")
    expect(table.get_by_role("row", name="Elsewhere with van")).to_contain_text("; delivery ")
    about.get_by_role("button", name="Best places").click()
    expect(page.locator(".hand-bar")).to_contain_text("parcel")
    expect(page.locator(".places li").first).to_contain_text("pickup after")
    page.get_by_role("button", name="Take van").first.click()
    expect(page.locator("#hand-outcome")).to_contain_text("parcel to van")
    expect(page.locator("#hand-outcome")).not_to_contain_text("Breaks")
    [route] = state(page, "state.plans.1.plan.routes")
    kinds = [stop["kind"] for trip in route["trips"] for stop in trip["stops"]]
    assert sorted(kinds) == ["customer", "delivery", "depot", "depot", "pickup"]
    open_tab(page, "unassigned")
    card = panel.locator("article", has_text="safe")
    card.get_by_role("button", name="What would it cost?").click()
    expect(card.get_by_role("table", name="Instead, for safe")).to_contain_text("not allowed")
    assert findings(page, ".panel") == []


@pytest.mark.thorough
def test_a_shipment_is_added_and_what_is_wrong_is_said_at_its_field(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("422",))
    open_file(page, "parcel.json", json.dumps(REQUEST))
    planned(page, "3 of 5 served")
    open_tab(page, "customers")
    panel = page.locator(".panel")
    panel.locator("summary", has_text="Shipments").click()
    panel.get_by_role("button", name="Add to shipments").click()
    added = state(page, "state.request.shipments.2")
    assert added == {"id": "shipment-3", "amount": [1], "pickup": {"location": [0, 0]},
                     "delivery": {"location": [0, 0]}}
    last = panel.locator("fieldset.list .entry").nth(2)
    last.get_by_label("Name").fill("parcel")
    last.get_by_label("Name").press("Tab")
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(last).to_contain_text("Another has the same name")
    assert findings(page, ".panel") == []


@pytest.mark.thorough
def test_a_sheet_of_pickups_and_deliveries_is_planned(console: Page) -> None:
    open_file(console, "transport.csv", (
        "Order,Pickup lat,Pickup lon,Delivery lat,Delivery lon,Qty\n"
        "A1,48.10,11.50,48.2,11.6,3\nA2,48.11,11.51,48.3,11.6,4\nA3,,,48.3,11.7,4\n"))
    shown = dialog(console)
    expect(shown.get_by_role("status").first).to_contain_text("2 shipments.")
    meaning = shown.get_by_label("Meaning of Pickup lat")
    expect(meaning.locator("option:checked")).to_have_text("Pickup: Latitude")
    use(console)
    expect(console.locator(".result-line")).to_contain_text("of 5 served")
    assert state(console, "state.request.shipments.1.id") == "A2"


@pytest.mark.thorough
def test_several_pickups_are_seen_and_added(page: Page) -> None:
    [parcel, _] = REQUEST["shipments"]
    parts = [{"id": "farm", "location": [3, 0], "amount": [1]},
             {"id": "mill", "location": [2, -2], "amount": [1]}]
    several = {"id": "parcel", "pickups": parts, "delivery": parcel["delivery"]}
    open_file(page, "parcel.json", json.dumps(REQUEST | {"shipments": [several]}))
    planned(page, "4 of 4 served")
    open_tab(page, "routes")
    page.mouse.click(*place_of(page, "c:parcel/pickup/mill"))
    assert state(page, "state.selection") == "c:parcel/pickup/mill"
    panel = page.locator(".panel")
    about = panel.locator("section", has_text="parcel/pickup/mill").first
    expect(about).to_contain_text("Part")
    open_tab(page, "customers")
    panel.get_by_role("button", name="Add to pickups").click()
    assert state(page, "state.request.shipments.0.pickups.2") == {
        "id": "pickup-3", "amount": [1], "location": [0, 0]}
    assert findings(page, ".panel") == []
