"""A dispatcher's day by clicks, each path in as few as a dispatcher has time for."""

import json
import re
from collections.abc import Callable, Iterator
from datetime import UTC, datetime, timedelta
from typing import Any

import pytest
from playwright.sync_api import APIResponse, Browser, Page, Route, expect

from tests.console.serving import new_context
from tests.console.steps import open_file, open_tab, planned
from tests.console.test_drivers import PHONE
from tests.console.test_everyone import findings

pytestmark = pytest.mark.slow

SHEET = """Customer,Lat,Lon,kg,From,To
Anna,47.38,8.54,5,8:00,10:00
Ben,47.39,8.51,7,,12:15
Cleo,47.41,8.55,4,,
"""
BEHIND = timedelta(minutes=10)
"""How late drivers leave."""

DROP = """([name, text]) => {
  const transfer = new DataTransfer();
  transfer.items.add(new File([text], name, { type: 'text/csv' }));
  for (const kind of ['dragenter', 'dragover', 'drop']) {
    document.querySelector('.map').dispatchEvent(
      new DragEvent(kind, { dataTransfer: transfer, bubbles: true, cancelable: true }));
  }
}"""


def day() -> dict[str, Any]:
    """Return a day that began ten minutes ago: two places in the east, two in the west."""
    start = (datetime.now(UTC) - BEHIND).replace(microsecond=0)
    return {
        "plan_start": start.isoformat(), "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": f"{side}{number}", "location": [sign * (30 + 5 * number), number],
                       "demand": [1], "service_duration": 60}
                      for side, sign in (("E", 1), ("W", -1)) for number in (1, 2)],
        "fleet": [{"id": "van", "count": 3, "capacity": [3], "speed_kmh": 60,
                   "names": ["Ayşe", "Ben", "Cem"], "max_working_duration": 14_400}],
        "options": {"time_limit": 60, "search_iterations": 300}}


class Clicks:
    """Clicks, counted since they were last asked for."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self._count = 0

    def on(self, name: str, within: str = "body", role: Any = "button") -> None:
        """Click what has a name."""
        area = self._page.locator(within)
        found = area.get_by_role(role, name=name) if role else area.get_by_text(name, exact=True)
        found.first.click()
        self._count += 1

    def counted(self) -> int:
        """Return how many there were since this was called last."""
        count, self._count = self._count, 0
        return count


def test_a_sheet_is_dropped_and_planned_in_two_clicks(page: Page) -> None:
    page.evaluate(DROP, ["today.csv", SHEET])  # as much as a click
    shown = page.get_by_role("dialog")
    expect(shown.get_by_role("cell", name="8:00 from 8:00")).to_be_visible()
    expect(shown.get_by_role("cell", name="12:15 by 12:15")).to_be_visible()
    clicks = Clicks(page)
    clicks.on("Plan", "dialog .import-end")
    planned(page, "3 of 3 served")
    expect(page.get_by_role("button", name="Anna", exact=True)).to_be_visible()
    assert clicks.counted() + 1 == 2


@pytest.fixture
def drivers(page: Page, browser: Browser) -> Iterator[Callable[[str], Page]]:
    """Return a function that opens the phone of a driver, once the day is on the road."""
    context = new_context(browser, **PHONE)

    def phone(name: str) -> Page:
        address = page.get_by_role("link", name=f"Open the day of {name}").get_attribute("href")
        opened = context.new_page()
        opened.goto(address or "")
        expect(opened.get_by_role("heading", name=name)).to_be_visible()
        return opened

    yield phone
    context.close()


def leave(phone: Page) -> None:
    """Tell that the van has left."""
    phone.get_by_role("button", name="Left", exact=True).first.click()
    expect(phone.get_by_role("status")).to_have_text("All is sent.")


def changed(phone: Page) -> Page:
    """Return a phone that was told that its day is another."""
    phone.evaluate("dispatchEvent(new Event('online'))")
    expect(phone.get_by_role("alert")).to_contain_text("Your day was changed")
    phone.get_by_role("button", name="I have seen it").click()
    return phone


def go_out(page: Page, clicks: Clicks) -> None:
    """Plan the day and send it to its drivers."""
    open_file(page, "day.json", json.dumps(day()))
    planned(page, "4 of 4 served")
    clicks.on("Drivers", ".rail", "tab")
    clicks.on("Send to drivers", ".panel")
    expect(page.locator(".links > li")).to_have_count(2)
    assert clicks.counted() == 2


def send(page: Page, clicks: Clicks) -> None:
    """Send the changed plan, and wait until phones can have it."""
    clicks.on("Send to their phones", ".head")
    expect(page.get_by_role("button", name="Send to their phones")).to_have_count(0)


def order(page: Page, clicks: Clicks) -> None:
    """Take an order that comes in, from the call to the phone of who serves it."""
    clicks.on("Orders", ".rail", "tab")
    clicks.on("New order", ".panel", None)
    expect(page.locator("#order-place")).to_be_focused()
    page.keyboard.type("33, 2")
    page.locator("#order-name").fill("Late")
    page.locator("#order-name").press("Enter")
    clicks.on("Take Cem", ".places")
    expect(page.locator("#hand-outcome")).to_contain_text("Late to Cem")
    send(page, clicks)
    expect(page.locator(".links > li")).to_have_count(3)
    assert clicks.counted() <= 4


def go_on_late(page: Page, clicks: Clicks) -> None:
    """Plan on as drivers are late, from another room."""
    open_tab(page, "customers")
    expect(page.locator("#room-drivers .count")).to_have_text("2")
    clicks.on("Drivers", ".rail", "tab")
    card = page.locator(".links > li").filter(has_text="Ayşe")
    expect(card.locator(".late-text")).to_have_text(re.compile(r"\+1\d min"))
    clicks.on("Replan from what drivers told", ".panel")
    planned(page, "5 of 5 served")
    send(page, clicks)
    assert clicks.counted() == 3


def go_on_without(page: Page, clicks: Clicks) -> None:
    """Plan on without a van that broke down, from another room."""
    open_tab(page, "customers")
    clicks.on("Drivers", ".rail", "tab")
    clicks.on("Ben has broken down", ".panel")
    planned(page, "3 of 5 served")
    expect(page.locator("#replan-outcome")).to_contain_text("Ben does nothing more")
    # Fewer are served for less, which is no saving.
    expect(page.locator("#replan-verdict .delta-good")).to_have_count(0)
    send(page, clicks)
    assert clicks.counted() == 3


@pytest.mark.thorough
def test_link_told_once_outlasts_a_look_that_was_under_way(page: Page) -> None:
    clicks = Clicks(page)
    go_out(page, clicks)
    held: list[tuple[Route, APIResponse]] = []

    def hold(route: Route) -> None:
        held.append((route, route.fetch()))

    page.route("**/dispatches/*", hold)
    with page.expect_request("**/dispatches/*"):
        pass
    order(page, clicks)
    route, before = held[0]
    with page.expect_response("**/dispatches/*"):
        route.fulfill(response=before)
    page.evaluate("new Promise((done) => requestAnimationFrame(() => setTimeout(done)))")
    expect(page.get_by_role("link", name="Open the day of Cem")).to_be_visible()


def test_the_day_goes_on_in_few_clicks(
        page: Page, drivers: Callable[[str], Page]) -> None:
    clicks = Clicks(page)
    go_out(page, clicks)
    east, west = drivers("Ayşe"), drivers("Ben")
    order(page, clicks)
    expect(drivers("Cem").get_by_text("Late")).to_be_visible()
    leave(east)
    leave(west)
    first = east.locator("li.stop .head").first
    before = first.inner_text()
    go_on_late(page, clicks)
    east.evaluate("dispatchEvent(new Event('online'))")
    expect(first).not_to_have_text(before)
    go_on_without(page, clicks)
    expect(changed(west).get_by_text("Nothing is planned for you any more.")).to_be_visible()
    assert findings(page, ".head") == []
    clicks.on("Undo the last change", ".head")
    planned(page, "5 of 5 served")
    expect(page.get_by_role("button", name="Send to their phones")).to_be_visible()
    assert clicks.counted() == 1
