"""The day goes on: new and cancelled orders, broken vehicles, what has departed stays."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import idle, open_advanced, open_file, open_tab, place_of, planned, state
from tests.console.test_everyone import findings

pytestmark = [pytest.mark.slow, pytest.mark.one_page]

# Three customers east and three west of the hub, 5 km apart, a minute each kilometre; windows
# have them visited from the nearest on.
PROBLEM: dict[str, Any] = {
    "planar_unit": 1000,
    "depots": [{"id": "hub", "location": [0, 0]}],
    "customers": [{"id": f"{side}{number}", "location": [sign * 5 * number, number % 2],
                   "demand": [1], "service_duration": 60,
                   "time_window": {"latest": (600, 700, 9000)[number - 1]}}
                  for side, sign in (("E", 1), ("W", -1)) for number in (1, 2, 3)],
    "fleet": [{"id": "truck", "count": 3, "capacity": [3], "speed_kmh": 60}],
    "options": {"time_limit": 60, "search_iterations": 500},
}
NOW = 480  # both trucks are between their first and their second customer


def begin(page: Page, problem: dict[str, Any] = PROBLEM) -> None:
    """Plan a problem and say at its clock that it is eight minutes past the start."""
    open_file(page, "day.json", json.dumps(problem))
    planned(page, "6 of 6 served")
    page.get_by_label("Time of day").fill(str(NOW))
    page.get_by_role("button", name="Replan from here").first.click()
    expect(page.get_by_role(
        "heading", name="Go on from \u201cfirst plan\u201d, at 0:08")).to_be_visible()


def plan_on(page: Page) -> dict[str, Any]:
    """Plan on and return the new plan."""
    page.locator(".tab").get_by_role("button", name="Plan on").click()
    expect(page.locator("#replan-verdict")).to_be_visible()
    idle(page)
    reply: dict[str, Any] = state(page, "state.plans.1.plan")
    return reply


def select(page: Page, customer: str) -> None:
    """Select a customer on the map, which the details of another may lie over."""
    page.keyboard.press("Escape")
    page.mouse.click(*place_of(page, f"c:{customer}"))
    details = page.get_by_role("region", name="Details")
    expect(details.get_by_role("heading", name=customer, exact=True)).to_be_visible()


def customers_of(plan: dict[str, Any]) -> dict[str, str]:
    """Return the vehicle of each customer."""
    return {stop["id"]: route["vehicle"] for route in plan["routes"] for trip in route["trips"]
            for stop in trip["stops"] if stop["kind"] == "customer"}


def test_orders_come_in_and_are_cancelled_while_trucks_are_under_way(page: Page) -> None:
    begin(page)
    former = state(page, "state.plans.0.plan")
    row = page.locator(".replan-vehicles tr").filter(has_text="truck-1")
    expect(row).to_contain_text("on its way to")
    expect(row).to_contain_text("1 customer to go")
    expect(page.locator(".map-legend")).to_contain_text("Settled: it has departed")
    page.get_by_role("button", name="Add orders on the map").click()
    box = page.locator(".map").first.bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + 120)
    page.keyboard.press("Escape")
    expect(page.get_by_text("customer-7 is a new order")).to_be_visible()
    expect(page.locator(".map-legend")).to_contain_text("New, not planned yet")
    select(page, "E3")
    page.get_by_role("button", name="Cancel this order").click()
    expect(page.get_by_text("E3 is cancelled")).to_be_visible()
    reply = plan_on(page)
    served = customers_of(reply)
    assert set(served) == {"E1", "E2", "W1", "W2", "W3", "customer-7"}
    assert all(served[name] == customers_of(former)[name] for name in ("E1", "E2", "W1", "W2"))
    difference = reply["cost"]["total"] - former["cost"]["total"]
    expect(page.locator("#replan-verdict")).to_contain_text(f"{abs(difference):.2f}")
    expect(page.locator("#differences")).to_contain_text(
        "customer-7 added, without E3, replanned at 0:08, beside first plan")
    outcome = page.locator("#replan-outcome")
    expect(outcome).to_contain_text("2 vehicles had departed by 0:08")
    expect(outcome).to_contain_text("up to W2")
    page.get_by_role("button", name="Former plan beside").click()
    expect(page.locator(".map")).to_have_count(2)
    assert findings(page) == []
    page.get_by_role("button", name="Go on from the new plan").click()
    expect(page.get_by_role("heading", name="Go on from \u201ccustomer-7 added")).to_be_visible()
    page.locator(".tab").get_by_role("button", name="Plan on").click()
    expect(page.locator("#replan-verdict")).to_contain_text("beside \u201ccustomer-7 added")


@pytest.mark.thorough
def test_driver_sheet_marks_what_is_settled(page: Page) -> None:
    begin(page)
    served = customers_of(plan_on(page))
    open_tab(page, "export")
    page.evaluate("window.print = () => undefined")
    page.get_by_role("button", name=f"Print the driver sheet of {served['W1']}").click()
    page.emulate_media(media="print")
    done = page.locator(".sheet-page tbody tr td:last-child")
    assert done.all_text_contents() == ["settled"] * 3 + ["", ""]


def test_others_serve_whom_a_broken_truck_had_not_reached(page: Page) -> None:
    begin(page)
    vehicle = customers_of(state(page, "state.plans.0.plan"))
    page.get_by_label(f"{vehicle['W1']} is broken").check()
    page.get_by_label("Parcels are back at").fill("0:20")
    page.get_by_label("Parcels are back at").press("Enter")
    select(page, "E3")
    page.get_by_role("button", name=f"Pin to {vehicle['E3']}").click()
    expect(page.get_by_role("list", name="Pinned customers")).to_contain_text("E3")
    select(page, "E1")
    expect(page.get_by_text("Settled: it is served")).to_be_visible()
    expect(page.get_by_role("button", name="Cancel this order")).to_be_disabled()
    page.get_by_label("closes").fill("0:01")
    page.get_by_role("button", name="Change this window").click()
    expect(page.locator(".map-legend")).to_contain_text("Lost with a broken vehicle")
    reply = plan_on(page)
    served = customers_of(reply)
    assert served["W1"] == vehicle["W1"]
    assert served["W3"] != vehicle["W1"]
    assert [left_out["id"] for left_out in reply["unassigned"]] == ["W2"]
    assert served["E3"] == vehicle["E3"]
    begins = [trip["stops"][0]["departure"] for route in reply["routes"]
              for trip in route["trips"] if trip["stops"][1]["id"] == "W3"]
    assert begins[0] >= 1200
    expect(page.locator("#replan-verdict")).to_contain_text("1 left out")
    outcome = page.locator("#replan-outcome")
    expect(outcome).to_contain_text(f"{vehicle['W1']} does nothing more")
    expect(outcome).to_contain_text("Broken already, by what had happened")
    expect(outcome.locator("li").filter(has_text="E1:")).to_contain_text("0:05")


@pytest.mark.thorough
def test_lost_drone_is_launched_no_more(page: Page) -> None:
    drones = {"count": 1, "capacity": [1], "speed_kmh": 60, "endurance": 1800}
    later = {"served_by": "drone", "time_window": {"earliest": 3000, "latest": 9000}}
    customers = [customer | (later if customer["id"] == "W3" else {})
                 for customer in PROBLEM["customers"]]
    truck = PROBLEM["fleet"][0] | {"drones": drones}
    begin(page, PROBLEM | {"customers": customers, "fleet": [truck]})
    (flight,) = [sortie["drone"] for route in state(page, "state.plans.0.plan")["routes"]
                 for trip in route["trips"] for sortie in trip["sorties"]
                 if sortie["customers"][0]["id"] == "W3"]
    page.get_by_label("A drone is lost").select_option(flight)
    row = page.locator(".replan-vehicles tr").filter(has_text=flight)
    expect(row).to_contain_text("launched no more")
    expect(page.get_by_label("Parcels are back at")).to_have_count(0)
    reply = plan_on(page)
    assert flight not in [sortie["drone"] for route in reply["routes"] for trip in route["trips"]
                          for sortie in trip["sorties"] if sortie["launch_time"] > NOW]
    expect(page.locator("#replan-outcome")).to_contain_text(f"{flight} is launched no more")


@pytest.mark.thorough
def test_what_can_not_be_replanned_is_said_where_it_belongs(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("422",))
    idle(page)
    begin(page)
    # The console cancels nobody to whom a vehicle drives; another program may.
    page.evaluate("""async () => {
      const { edit } = await loaded(`actions.js`);
      edit((request) => ({ ...request,
        customers: request.customers.filter(({ id }) => id !== 'E2') }));
    }""")
    page.get_by_label("truck-1 is broken").check()
    page.get_by_label("Parcels are back at").fill("0:01")
    page.get_by_label("Parcels are back at").press("Enter")
    page.locator(".tab").get_by_role("button", name="Plan on").click()
    alert = page.get_by_role("alert")
    expect(alert).to_contain_text("Put right 2 things, then plan again.")
    expect(page.locator("#room-day .count")).to_have_text("2")
    late = page.locator(".replan-vehicles tr").filter(has_text="too late to cancel")
    expect(late).to_have_count(1)
    expect(page.locator(".field").filter(has_text="Parcels are back at")).to_contain_text(
        "raise it")
    open_tab(page, "costs")
    alert.get_by_role("button", name="Parcels back").click()
    expect(page.get_by_label("Parcels are back at")).to_be_focused()
    page.keyboard.press("Control+a")
    page.keyboard.press("Delete")
    page.keyboard.press("Enter")
    expect(page.locator("#room-day .count")).to_have_text("1")


def test_plan_is_improved_and_replanned_by_keyboard(page: Page) -> None:
    open_file(page, "day.json", json.dumps(PROBLEM | {"options": {"time_limit": 0}}))
    planned(page, "6 of 6 served")
    open_advanced(page)
    field = page.locator("#field-options-search_iterations")
    field.fill("500")
    field.press("Enter")
    field = page.locator("#field-options-time_limit")
    field.fill("2")
    field.press("Enter")
    page.locator(".map").first.focus()
    page.keyboard.press("i")
    expect(page.locator(".developers")).to_contain_text("a given plan")
    idle(page)
    first, second = (state(page, f"state.plans.{number}.plan.cost.total") for number in (0, 1))
    assert second <= first
    assert "replan" not in state(page, "state.request")
    page.keyboard.press("r")
    expect(page.get_by_role("heading", name="The day is under way")).to_be_visible()
    page.get_by_label("Now").fill("noon")
    expect(page.get_by_text("State a time of day")).to_be_visible()
    page.get_by_label("Now").fill("0:08")
    page.get_by_label("Now").press("Enter")
    expect(page.get_by_role(
        "heading", name="Go on from \u201cimproved\u201d, at 0:08")).to_be_visible()
    page.get_by_label("keeps all its customers").first.check()
    expect(page.get_by_role("list", name="Pinned customers")).to_be_visible()
    expect(page.locator(".pin-mark")).to_have_count(1)
    page.locator(".map").first.focus()
    page.keyboard.press("p")
    expect(page.locator("#replan-verdict")).to_be_visible()
    idle(page)
    page.get_by_role("button", name="Stop replanning").click()
    assert "replan" not in state(page, "state.request")


@pytest.mark.thorough
def test_replanning_fits_a_phone(open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, viewport={"width": 390, "height": 844}, has_touch=True)
    idle(page)
    page.get_by_role("button", name="Height of the panel").tap()
    begin(page)
    page.get_by_label("truck-1 is broken").check()
    plan_on(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    assert findings(page) == []
