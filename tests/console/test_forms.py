"""The fleet and the long list of customers, by hands and keys alone."""

from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import open_tab, show_rules, state

pytestmark = pytest.mark.slow

NUM_CUSTOMERS = 60
ROW_PIXELS = 36


def open_customers(page: Page) -> None:
    """Open a problem with many customers of long names, without planning it."""
    page.evaluate("""async (number) => {
      const { openRequest } = await loaded(`actions.js`);
      const customers = Array.from({ length: number }, (_, index) => ({
        id: `Getränkemarkt Schmidt-Hohenfels ${index + 1}`, location: [index % 9, index],
        demand: [index + 1], time_window: { earliest: 28800, latest: 43200 } }));
      openRequest({ depots: [{ id: 'hub', location: [4, 4] }], customers,
        fleet: [{ id: 'van', count: 3, capacity: [900] }] });
    }""", NUM_CUSTOMERS)


def focused_row(page: Page) -> int:
    """Return the row of the list of customers that has the focus."""
    row: str = page.evaluate("document.activeElement.closest('tr')?.dataset.row ?? '-1'")
    return int(row)


def boxes(page: Page, selector: str) -> list[dict[str, Any]]:
    """Return where elements stand."""
    found: list[dict[str, Any]] = page.evaluate(
        """(selector) => [...document.querySelectorAll(selector)].map(
            (element) => element.getBoundingClientRect().toJSON())""", selector)
    return found


def test_a_new_vehicle_type_is_in_view_and_ready_to_be_named(console: Page) -> None:
    open_customers(console)
    open_tab(console, "fleet")
    for number in (1, 2):
        console.get_by_role("button", name="Add a type").click()
        field = console.locator(f"#field-fleet-{number}-id")
        expect(field).to_be_focused()
        expect(field).to_be_in_viewport()
    console.keyboard.type("trike")
    console.keyboard.press("Enter")
    assert state(console, "state.request.fleet.2.id") == "trike"


def test_drones_begin_with_what_a_drone_is_assumed_to_do(console: Page) -> None:
    open_customers(console)
    open_tab(console, "fleet")
    console.locator("#field-fleet-0-drones").check()
    assert state(console, "state.request.fleet.0.drones") == {
        "count": 1, "capacity": [15], "endurance": 1800, "launch_duration": 60,
        "recovery_duration": 60}
    assumed = console.get_by_text("Assumed: one drone, which carries 15")
    expect(assumed).to_be_visible()
    field = console.locator("#field-fleet-0-drones-capacity")
    field.fill("4")
    field.press("Enter")
    expect(assumed).to_have_count(0)


def test_what_vehicles_avoid_and_sides_of_streets_are_chosen(console: Page) -> None:
    open_customers(console)
    open_tab(console, "fleet")
    show_rules(console)
    for name in ("motorways", "tolls"):
        console.locator(f"#field-fleet-0-avoid-{name}").check()
    assert state(console, "state.request.fleet.0.avoid") == ["tolls", "motorways"]
    console.locator("#field-fleet-0-avoid-tolls").uncheck()
    assert state(console, "state.request.fleet.0.avoid") == ["motorways"]
    console.evaluate("async () => (await loaded(`actions.js`)).select('c:Getränkemarkt "
                     "Schmidt-Hohenfels 1')")
    open_tab(console, "customers")
    show_rules(console)
    side = console.locator("#field-customers-0-approach")
    expect(side.locator("option")).to_have_text(["as for all", "from either side",
                                                 "on its own side"])
    side.select_option("curb")
    assert state(console, "state.request.customers.0.approach") == "curb"


@pytest.mark.thorough
def test_the_focus_goes_through_all_customers(console: Page) -> None:
    open_customers(console)
    open_tab(console, "customers")
    console.locator("tr[data-row='0'] button").focus()
    for _ in range(NUM_CUSTOMERS - 1):
        console.keyboard.press("Tab")
    assert focused_row(console) == NUM_CUSTOMERS - 1
    expect(console.locator(f"tr[data-row='{NUM_CUSTOMERS - 1}']")).to_be_in_viewport()
    for _ in range(5):
        console.keyboard.press("ArrowUp")
    assert focused_row(console) == NUM_CUSTOMERS - 6
    table = console.locator(".long-table")
    table.evaluate("(element) => { element.scrollTop = 0; }")
    expect(console.locator("tr[data-row='0']")).to_be_in_viewport()
    assert focused_row(console) == NUM_CUSTOMERS - 6


def test_the_list_scrolls_to_who_is_selected(console: Page) -> None:
    open_customers(console)
    open_tab(console, "customers")
    for row in (50, 3):
        console.evaluate("""async (row) => {
          const { select } = await loaded(`actions.js`);
          select(`c:Getränkemarkt Schmidt-Hohenfels ${row + 1}`);
        }""", row)
        expect(console.locator(f"tr[data-row='{row}'][data-selected='true']")).to_be_in_viewport()


def test_names_do_not_overlap_on_a_small_screen(console: Page) -> None:
    size = console.viewport_size
    assert size is not None
    try:
        console.set_viewport_size({"width": 1024, "height": 768})
        open_customers(console)
        open_tab(console, "customers")
        names = boxes(console, "tr[data-row] th button")
        demands = boxes(console, "tr[data-row] td:nth-child(2)")
        assert len(names) > 10
        for name, demand in zip(names, demands, strict=True):
            assert name["right"] <= demand["left"]
            assert name["width"] > 100
        rows = boxes(console, "tr[data-row]")
        assert {round(row["height"]) for row in rows} == {ROW_PIXELS}
        assert console.evaluate("""() => {
          const { scrollWidth, clientWidth } = document.querySelector('.long-table');
          return scrollWidth <= clientWidth;
        }""")
    finally:
        console.set_viewport_size(size)
