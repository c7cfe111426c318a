"""Orders come in and are cancelled: in few clicks, priced, never against what has happened."""

import datetime
import json
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import idle, open_file, open_tab, place_of, planned, state
from tests.console.test_everyone import findings
from tests.console.test_replanning import PROBLEM, begin, customers_of, plan_on

pytestmark = [pytest.mark.slow, pytest.mark.one_page]

ONE_VAN: dict[str, Any] = {
    "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
    "customers": [{"id": "A", "location": [6, 0], "demand": [5], "service_duration": 60}],
    "fleet": [{"id": "van", "count": 1, "capacity": [5], "speed_kmh": 60}],
    "options": {"time_limit": 60, "search_iterations": 200},
}
BACK = 7200
"""When the van has been back for long."""


class Clicks:
    """Clicks, counted."""

    def __init__(self, page: Page) -> None:
        self.count = 0
        self._page = page

    def button(self, name: str, within: str = "body") -> None:
        """Click a button."""
        self._page.locator(within).get_by_role("button", name=name).first.click()
        self.count += 1


def type_order(page: Page, **texts: str) -> None:
    """Type an order into the box that is open, and ask for places by Enter."""
    for name, text in texts.items():
        page.locator(f"#order-{name}").fill(text)
    page.locator("#order-place").press("Enter")


@pytest.mark.thorough
def test_an_order_that_could_not_be_priced_is_still_typed(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("503",))
    begin(page)
    open_tab(page, "customers")
    page.route("**/fit", lambda route: route.fulfill(status=503, json={"title": "Busy"}))
    page.locator(".new-order summary").click()
    type_order(page, place="0, 6", amount="1", name="Late")
    expect(page.locator(".notice[role=alert]")).to_be_visible()
    expect(page.locator("#order-name")).to_have_value("Late")


@pytest.mark.thorough
def test_places_of_an_order_belong_to_the_plan_that_they_were_asked_for(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service)
    begin(page)
    open_tab(page, "customers")
    page.locator(".new-order summary").click()
    type_order(page, place="0, 6", amount="1", name="Late")
    expect(page.locator(".places li")).to_have_count(3)
    page.evaluate("loaded(`planning.js`).then(({ plan }) => plan())")
    expect(page.locator(".places li")).to_have_count(0)
    idle(page)
    assert len(state(page, "state.plans")) == 2


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("widths", [(1024, 1440), (390,)])
def test_an_order_is_priced_taken_and_sent_in_three_clicks(
        open_page: Callable[..., Page], service: str, widths: tuple[int, ...]) -> None:
    page = open_page(service, viewport={"width": widths[0], "height": 844})
    if widths[0] < 700:
        page.get_by_role("button", name="Height of the panel").click()
    begin(page)
    open_tab(page, "customers")
    clicks = Clicks(page)
    page.locator(".new-order summary").click()
    type_order(page, place="0, 6", amount="1", opens="0:20", closes="3:00", name="Late")
    places = page.locator(".places li")
    expect(places).to_have_count(3)
    for width in widths:
        page.set_viewport_size({"width": width, "height": 844})
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        assert findings(page, ".panel") == [], width
    # Two trucks are under way on their only trip, and may go out again; the third is idle.
    expect(places.filter(has_text="one trip more")).to_have_count(2)
    expect(places.filter(has_text="stands at home")).to_contain_text("truck-3")
    clicks.button("Take truck-3", ".places")
    expect(page.locator("#hand-outcome")).to_contain_text("Late to truck-3")
    plan = state(page, "state.plans.1.plan")
    assert customers_of(plan)["Late"] == "truck-3"
    assert plan["routes"][0] == state(page, "state.plans.0.plan.routes.0")
    order = next(customer for customer in state(page, "state.request.customers")
                 if customer["id"] == "Late")
    assert (order["location"], order["demand"]) == ([0, 6], [1])
    assert (order["time_window"], order["service_duration"]) == (
        {"earliest": 1200, "latest": 10800}, 60)
    clicks.button("Send to drivers", ".hand-bar")
    expect(page.get_by_role("heading", name="On the road")).to_be_visible()
    expect(page.locator(".links > li")).to_have_count(3)
    assert clicks.count + 1 == 3


@pytest.mark.thorough
def test_a_van_that_is_back_goes_out_again_for_an_order(page: Page) -> None:
    open_file(page, "day.json", json.dumps(ONE_VAN))
    planned(page, "1 of 1 served")
    open_tab(page, "replan")
    page.get_by_label("Now").fill("2:00")
    page.get_by_role("button", name="Replan from here").first.click()
    type_order(page, place="A", amount="5")
    expect(page.locator(".places li")).to_contain_text("one trip more than its type makes")
    page.get_by_role("button", name="Take van").click()
    expect(page.locator("#hand-outcome")).not_to_contain_text("Breaks")
    (route,) = state(page, "state.plans.1.plan.routes")
    assert len(route["trips"]) == 2
    assert route["trips"][1]["stops"][0]["departure"] >= BACK
    assert state(page, "state.request.fleet.0.max_trips") == 2
    page.get_by_role("button", name="Undo", exact=True).click()
    assert "max_trips" not in state(page, "state.request.fleet.0")


@pytest.mark.thorough
def test_who_is_left_out_beside_a_van_that_is_back_is_served_by_a_click(page: Page) -> None:
    open_file(page, "day.json", json.dumps(ONE_VAN))
    planned(page, "1 of 1 served")
    open_tab(page, "replan")
    page.get_by_label("Now").fill("2:00")
    page.get_by_role("button", name="Replan from here").first.click()
    page.evaluate("""async () => {
      const { edit } = await loaded(`actions.js`);
      edit((request) => ({ ...request, customers: [...request.customers,
        { id: 'B', location: [3, 0], demand: [5] }] }));
    }""")
    plan_on(page)
    expect(page.get_by_text("1 of 2 served")).to_be_visible()
    open_tab(page, "unassigned")
    page.get_by_role("button", name="Apply and plan again: fits if van could make another trip"
                     ).click()
    planned(page, "2 of 2 served")
    trips = state(page, "state.plans.2.plan.routes.0.trips")
    assert [len(trip["stops"]) for trip in trips] == [3, 3]
    assert trips[1]["stops"][0]["departure"] >= BACK


@pytest.mark.thorough
@pytest.mark.begins_with("table1")
def test_what_can_not_be_read_is_said_at_its_field(page: Page) -> None:
    idle(page)
    page.locator(".new-order summary").click()
    type_order(page, place="nowhere", amount="much", opens="noon", name="7")
    for name in ("place", "amount", "opens", "name"):
        expect(page.locator(f"#order-{name}-error")).to_be_visible()
    expect(page.locator("#order-place")).to_be_focused()
    assert findings(page, ".panel") == []
    type_order(page, place="1", amount="", opens="", name="")
    expect(page.locator(".places li")).to_have_count(3)
    expect(page.locator(".order-field.invalid")).to_have_count(0)


@pytest.mark.thorough
@pytest.mark.begins_with("table1")
def test_the_place_of_an_order_is_shown_on_the_map(page: Page) -> None:
    idle(page)
    page.locator(".new-order summary").click()
    page.get_by_role("button", name="Show it on the map").click()
    x, y = place_of(page, "c:7")
    page.mouse.click(x, y)
    expect(page.locator("#order-place")).not_to_have_value("")
    expect(page.locator("#order-amount")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.locator(".places li")).to_have_count(3)


@pytest.mark.begins_with("table1")
def test_orders_of_a_list_are_cancelled_together(page: Page) -> None:
    idle(page)
    field = page.get_by_label("Find a customer by name")
    page.evaluate("""() => {
      const data = new DataTransfer();
      data.setData('text', '7\\n12\\n31\\n');
      const field = document.querySelector('[aria-label="Find a customer by name"]');
      field.focus();
      field.dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, bubbles: true }));
    }""")
    expect(field).to_have_value("7, 12, 31")
    page.get_by_label("Pick all 3 customers").check()
    page.get_by_role("button", name="Cancel 3 orders").click()
    names = {customer["id"] for customer in state(page, "state.request.customers")}
    assert len(names) == 97
    assert not names & {"7", "12", "31"}
    expect(page.get_by_role("button", name="Cancel 3 orders")).to_have_count(0)
    page.keyboard.press("Escape")
    field.fill("")
    page.get_by_role("button", name="8", exact=True).focus()
    page.keyboard.press("ArrowLeft")
    expect(page.get_by_label("Pick 8", exact=True)).to_be_focused()
    page.keyboard.press("Space")
    expect(page.get_by_role("button", name="Cancel 1 order")).to_be_visible()
    assert findings(page, ".panel") == []


@pytest.mark.thorough
def test_who_is_being_served_is_not_cancelled(page: Page) -> None:
    begin(page)
    page.get_by_role("button", name="Cancel orders on the map").click()
    page.mouse.click(*place_of(page, "c:E1"))
    expect(page.get_by_role("alert")).to_contain_text("E1 can\u2019t be cancelled")
    page.keyboard.press("Escape")
    open_tab(page, "customers")
    page.get_by_label("Pick all 6 customers").check()
    page.get_by_role("button", name="Cancel 6 orders").click()
    expect(page.get_by_role("alert")).to_contain_text("E1, E2, W1, W2 can\u2019t be cancelled")
    assert {each["id"] for each in state(page, "state.request.customers")} == {
        "E1", "E2", "W1", "W2"}
    open_tab(page, "replan")
    plan_on(page)
    expect(page.get_by_text("4 of 4 served")).to_be_visible()


@pytest.mark.thorough
def test_who_was_erased_before_the_day_goes_on_is_back_if_he_is_served(page: Page) -> None:
    open_file(page, "day.json", json.dumps(PROBLEM))
    planned(page, "6 of 6 served")
    for name in ("E1", "E3"):
        page.get_by_label(f"Pick {name}").check()
    page.get_by_role("button", name="Cancel 2 orders").click()
    open_tab(page, "replan")
    page.get_by_label("Now").fill("0:08")
    page.get_by_role("button", name="Replan from here").first.click()
    expect(page.get_by_role("alert")).to_contain_text("E1 is served by then")
    plan_on(page)
    expect(page.get_by_text("5 of 5 served")).to_be_visible()


@pytest.mark.thorough
def test_now_is_the_present_time_for_a_plan_of_today(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, timezone_id="Europe/Berlin")  # else all later pages have the clock
    zone = datetime.timezone(datetime.timedelta(hours=1))
    page.clock.set_fixed_time(datetime.datetime(2026, 11, 26, 10, 40, 30, tzinfo=zone))
    dated = PROBLEM | {"plan_start": "2026-11-26T00:00:00+01:00", "time_zone": "Europe/Berlin"}
    open_file(page, "today.json", json.dumps(dated))
    planned(page, "6 of 6 served")
    open_tab(page, "replan")
    expect(page.get_by_label("Now")).to_have_value("10:40")
    page.get_by_role("button", name="Replan from here").first.click()
    assert state(page, "state.request.replan.freeze_before") == 38400
    other = PROBLEM | {"plan_start": "2026-11-27T00:00:00+01:00", "time_zone": "Europe/Berlin"}
    open_file(page, "tomorrow.json", json.dumps(other))
    planned(page, "6 of 6 served")
    open_tab(page, "replan")
    expect(page.get_by_label("Now")).to_have_value("")
