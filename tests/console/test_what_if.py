"""Change one thing, compare fleets, sweep two fields, play the day."""

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import idle, open_example, open_tab, state

pytestmark = [pytest.mark.slow, pytest.mark.one_page]


def test_change_shows_plan_and_cost_beside_the_former(page: Page) -> None:
    open_example(page, "drones")
    open_tab(page, "changes")
    page.get_by_role("button", name="Drones off").click()
    idle(page)
    differences = page.locator("#differences")
    expect(differences).to_contain_text("drones off, beside first plan")
    expect(differences).to_contain_text("truck: drones 1 each \u2192 none")
    expect(differences.locator("tr").filter(has_text="Flights")).to_contain_text("\u2212")
    page.get_by_role("button", name="Former plan beside").click()
    expect(page.locator(".map")).to_have_count(2)
    page.get_by_label("Show first plan").check()
    assert state(page, "state.request.fleet.0.drones.count") == 1
    expect(differences).to_contain_text("first plan, beside drones off")


def test_vehicle_fewer_and_a_window_are_one_click_each(page: Page) -> None:
    open_example(page, "drones")
    open_tab(page, "changes")
    page.get_by_role("button", name="One truck fewer").click()
    idle(page)
    assert state(page, "state.request.fleet.0.count") == 1
    page.get_by_label("Customer", exact=True).select_option("B")
    page.get_by_label("closes").fill("0:40")
    page.get_by_role("button", name="Change this window").click()
    idle(page)
    assert state(page, "state.request.customers.1.time_window.latest") == 2400
    expect(page.locator("#differences")).to_contain_text("B: time window, latest")
    names = page.locator(".plan-name")
    expect(names.nth(1)).to_have_value("one truck fewer")
    expect(names.nth(2)).to_have_value("B's window 0:10\u20130:40")
    names.nth(2).fill("B earlier")
    names.nth(2).press("Enter")
    expect(page.locator("#differences h3")).to_have_text("B earlier, beside one truck fewer")


@pytest.mark.thorough
def test_fleets_are_compared(page: Page) -> None:
    open_example(page, "hetero_day")
    open_tab(page, "scenarios")
    page.get_by_label("Seconds of search for each scenario").fill("0.2")
    page.get_by_label("Seconds of search for each scenario").press("Enter")
    page.get_by_label("only van-200").uncheck()
    page.get_by_role("button", name="Compare 3 fleets").click()
    table = page.locator("#compare-table")
    expect(page.locator("#scenario-state")).to_contain_text("done")
    expect(table.locator("thead th")).to_have_count(4)
    expect(table.locator("tr").filter(has_text="Load rate, mean")).to_contain_text("%")
    page.get_by_role("button", name="Show the plan of only van-150").click()
    idle(page)
    assert [entry["id"] for entry in state(page, "state.request.fleet")] == ["van-150"]
    expect(page.locator("#differences")).to_be_visible()


@pytest.mark.thorough
def test_hours_and_capacity_are_swept_into_a_heat_map(page: Page) -> None:
    open_example(page, "hetero_day")
    open_tab(page, "scenarios")
    page.get_by_label("Seconds of search for each scenario").fill("0.1")
    page.get_by_label("Seconds of search for each scenario").press("Enter")
    page.get_by_label("Values of axis 1").fill("6:00, 8:00")
    page.get_by_label("Values of axis 2").fill("100, 150")
    page.get_by_role("button", name="Sweep 4 scenarios").click()
    expect(page.locator("#scenario-state")).to_contain_text("done")
    heat = page.locator("#heat-map")
    expect(heat.locator("tbody tr")).to_have_count(2)
    # Scenarios may cost the same.
    heat.locator("td.least button").first.click()
    expect(page.locator("#differences")).to_be_visible()
    assert state(page, "state.request.fleet.0.max_working_duration") in (21600, 28800)


def test_day_is_played(page: Page) -> None:
    open_example(page, "drones")
    page.get_by_role("button", name="Play the day").click()
    expect(page.locator(".truck-mover span").first).to_be_visible()
    expect(page.locator(".drone-mover span").first).to_be_visible()
    page.get_by_role("button", name="Pause").click()
    slider = page.get_by_label("Time of day")
    before = page.locator(".truck-mover span").first.bounding_box()
    slider.fill("1200")
    assert page.locator(".truck-mover span").first.bounding_box() != before
    page.get_by_role("button", name="End", exact=True).click()
    expect(page.locator(".truck-mover")).to_have_count(0)
