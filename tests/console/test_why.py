"""Why a customer is served where it is, and what drones save, asked in the console."""

import json

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import (
    EXAMPLES, open_example, open_file, open_tab, place_of, planned, state,
)
from tests.console.test_everyone import findings
from tests.console.test_looking import UNSERVABLE

pytestmark = pytest.mark.slow


def test_clicked_customer_tells_what_else_it_would_cost(console: Page) -> None:
    open_example(console, "drones")
    console.mouse.click(*place_of(console, "c:D"))
    open_tab(console, "routes")
    button = console.get_by_role("button", name="Why here?")
    button.focus()
    console.keyboard.press("Enter")
    table = console.get_by_role("table", name="Instead, for D")
    expect(table.get_by_role("row", name="Not at all")).to_contain_text("+")
    assert table.get_by_role("row").count() > 2
    expect(console.get_by_text("All others stay where they are")).to_be_visible()
    assert findings(console, ".panel") == []
    # Another customer is another question; the answer stays with the first.
    console.mouse.click(*place_of(console, "c:A"))
    expect(table).to_have_count(0)
    open_tab(console, "customers")
    console.get_by_role("button", name="D", exact=True).click()
    expect(table).to_be_visible()


def test_customer_left_out_has_prices_beside_its_reasons(console: Page) -> None:
    open_file(console, "left-out.json", json.dumps(UNSERVABLE))
    planned(console, "1 of 3 served")
    open_tab(console, "unassigned")
    card = console.locator("article[data-key='c:heavy']")
    card.get_by_role("button", name="What would it cost?").click()
    expect(card.get_by_role("table")).to_contain_text("not allowed")
    expect(card.get_by_role("table")).to_contain_text("exceeds")
    expect(card).to_contain_text("fits if capacity", ignore_case=True)


@pytest.mark.thorough
def test_drones_are_compared_with_trucks_alone_and_useless_sorties_marked(console: Page) -> None:
    request = json.loads((EXAMPLES / "explain.json").read_text("utf-8"))["problem"]
    # Whoever flies to C pays more than the truck that would drive there.
    request["customers"][2] |= {"served_by": "drone"}
    request["fleet"][0]["drones"]["costs"] = {"per_km": 5}
    open_file(console, "dear.json", json.dumps(request))
    planned(console, "4 of 4 served")
    open_tab(console, "costs")
    section = console.locator("#drones-worth")
    section.get_by_role("button", name="Compare with trucks alone").click()
    expect(section).to_contain_text("1 sortie has to be flown")
    expect(section).to_contain_text("Trucks alone would leave out more customers")


@pytest.mark.thorough
def test_sortie_that_saves_nothing_is_listed_and_marked(page: Page) -> None:
    open_example(page, "drones")
    routes = state(page, "state.plans.0.plan.routes")
    vehicle, trip = next((route["vehicle"], number) for route in routes
                         for number, trip in enumerate(route["trips"]) if trip["sorties"])
    told = {"drones": {
        "saves": -2.0, "saves_at_most": -1.0, "seconds": 1.0, "with_drones": None,
        "trucks_alone": None, "sorties": [{
            "vehicle": vehicle, "trip": trip, "sortie": 0, "customers": ["C"], "saves": -1.5,
            "tried": True}]}}
    page.route("**/explain", lambda route: route.fulfill(json=told))
    open_tab(page, "costs")
    section = page.locator("#drones-worth")
    section.get_by_role("button", name="Compare with trucks alone").click()
    expect(section.get_by_role("listitem")).to_contain_text("by truck 1.50 less")
    section.get_by_role("button", name=f"{vehicle} to C").click()
    open_tab(page, "routes")
    expect(page.get_by_text("saves nothing")).to_be_visible()
