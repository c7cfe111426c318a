"""Ten minutes of a day at sixty times its speed: what a dispatcher, a driver and a customer see."""

import re
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any

import httpx
import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect

from tests.app.records.days.living import PROBLEM, begun, order, plan_of, standing
from tests.console.serving import new_context
from tests.console.test_drivers import PHONE, mark

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

SPEED = 60
TICK = 30.0
"""Seconds of the day from one look at the clock to the next."""

VAN = "van-1"
LONE: dict[str, Any] = {
    **PROBLEM, "depots": [{"id": "hub", "location": [0, 0]}],
    "fleet": [{**PROBLEM["fleet"][0], "count": 1, "capacity": [9]}]}


@dataclass
class Living:
    """A day whose clock goes by a faster one, told what happens as it does."""

    client: httpx.Client
    day: str
    now: float = 0.0
    began: float = field(default_factory=time.monotonic)

    def until(self, at: float) -> None:
        """Live on until a time of the day. In place."""
        while self.now < at:
            self.now += TICK
            ahead = self.began + self.now / SPEED - time.monotonic()
            if ahead > 0:
                time.sleep(ahead)
            self.tell({"kind": "clock"})

    def tell(self, *events: dict[str, Any]) -> None:
        """Tell what happens now."""
        self.client.post(f"/days/{self.day}/events", json=[
            {"event_id": f"{each['kind']}:{self.now}", "at": self.now, **each} for each in events
        ]).raise_for_status()


@pytest.fixture
def phone(browser: Browser) -> Iterator[BrowserContext]:
    """Return the phone of a driver or a customer."""
    context = new_context(browser, **PHONE)
    yield context
    context.close()


def test_ten_minutes_of_a_day_are_seen_by_all_whom_they_concern(
        client: httpx.Client, service: str, open_page: Callable[..., Page],
        phone: BrowserContext) -> None:
    day = begun(client, {**LONE, "plan_start": datetime.now(UTC).isoformat(), "time_zone": "UTC"})
    first, *_, last = [stop["id"] for stop in plan_of(client, day)["routes"][0]["trips"][0]["stops"]
                       if stop["kind"] == "customer"]
    desk = open_page(f"{service}/#day={day}")
    driver, customer = phone.new_page(), phone.new_page()
    driver.goto(link_of_driver(client, day))
    customer.goto(next(each["url"] for each in client.get(f"/days/{day}/links").json()["links"]
                       if each["order"] == last))
    expect(customer.get_by_text("brings it")).to_be_visible()
    expect(desk.locator(".links li").first).to_contain_text("opened")

    living = Living(client, day)
    mark(driver, "Leave hub", "Left")
    expect(desk.locator(".links li").first).to_contain_text("1 of")
    living.until(120)
    living.tell(order("G", 1, 1))
    expect(desk.locator(".map-label.news.new")).to_have_text("new")
    expect(desk.locator(".links li").first).to_contain_text("not seen yet")
    driver.evaluate("dispatchEvent(new Event('online'))")
    expect(driver.get_by_role("alert")).to_contain_text("G")
    driver.get_by_role("button", name="I have seen it").click()
    expect(desk.locator("[data-list=told]")).to_contain_text("has seen the change")

    living.until(300)
    living.tell({"kind": "vehicle.served", "vehicle": VAN, "order": first})
    living.until(360)
    living.tell({"kind": "vehicle.delayed", "vehicle": VAN, "by": 1500})
    expect(desk.locator("[data-list=changed]")).to_contain_text(re.compile(r"\+2[5-9] min"))
    expect(desk.locator(".map-label.news:is(.late, .later)").first).to_contain_text("min")

    living.until(600)
    hold_to_the_day(client, day, desk, first)
    assert living.began + 600 / SPEED <= time.monotonic()
    driver.evaluate("dispatchEvent(new Event('online'))")
    expect(driver.locator("li.done")).to_have_count(2)
    customer.reload()
    expect(customer.get_by_role("heading", name="What changed")).to_be_visible()


def hold_to_the_day(client: httpx.Client, day: str, desk: Page, served: str) -> None:
    """Hold what the desk shows, and the day, to what was told until ten minutes."""
    expect(desk.get_by_role("timer")).to_have_text(clock_at(client, day))
    expect(desk.get_by_label("Time of day")).to_have_value("600")
    told = standing(client, day)
    assert told.is_planned or told.failure is None
    assert {each.id: each.state for each in told.orders}[served] == "served"
    assert {each.id for each in told.orders} == {*"ABCDEFG"}


def link_of_driver(client: httpx.Client, day: str) -> str:
    """Return a new link of the day's van."""
    dispatch = standing(client, day).dispatch
    (link,) = client.get(f"/dispatches/{dispatch}").json()["links"]
    return str(client.post(f"/dispatches/{dispatch}/links/{link['id']}").json()["links"][0]["url"])


def clock_at(client: httpx.Client, day: str) -> str:
    """Return what a clock shows on the day, to the nearest minute as the console tells it."""
    found = standing(client, day)
    seconds = found.plan_start.timestamp() + found.now + 30
    instant = datetime.fromtimestamp(seconds, UTC)
    return f"{instant.hour}:{instant.minute:02}"
