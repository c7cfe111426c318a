"""A day as it happens, in the console."""

import re
from collections.abc import Callable

import httpx
import pytest
from playwright.sync_api import Page, expect

from tests.app.records.days.living import (
    PROBLEM, begun, order, plan_of, planned, served_by, standing, told,
)
from tests.app.records.days.test_lateness import FAR
from tests.console.test_everyone import findings
from tests.console.steps import open_example, open_tab, place_of, state
from tests.conftest import eventually

pytestmark = pytest.mark.slow


def test_day_is_begun_with_the_plan_and_opened_again(page: Page) -> None:
    open_tab(page, "drivers")
    served = state(page, "state.plans.0.plan.summary.served")
    page.get_by_role("button", name="Begin the day").click()
    expect(page.get_by_role("timer")).to_be_visible()
    expect(page.locator(".links li").first).to_be_visible()
    expect(page.locator("#total-cost")).to_be_visible()
    assert "#day=" in page.url
    expect(page.locator("#problem-name")).to_have_text("Two customers")
    assert state(page, "state.plans.0.plan.summary.served") == served
    page.reload()
    expect(page.locator(".links li").first).to_be_visible()
    assert findings(page, ".panel") == []


@pytest.mark.thorough
def test_what_changes_is_shown_and_orders_in_doubt_are_asked(
        client: httpx.Client, service: str, open_page: Callable[..., Page]) -> None:
    day = begun(client)
    page = open_page(f"{service}/#day={day}")
    opened(page)
    expect(page.locator("[data-list=changed]")).to_have_count(0)
    told(client, day, order("G", 1, 1), at=10)
    expect(page.locator("[data-list=changed]")).to_contain_text("G")
    expect(page.locator(".map-label.news.new")).to_have_text("new")
    page.get_by_role("button", name="Seen").click()
    expect(page.locator(".map-label.news:is(.new, .moved, .later)")).to_have_count(0)
    told(client, day, {"kind": "clock", "at": 400.0})
    doubts = page.locator("[data-list=doubts]")
    asked = {each.id for each in standing(client, day).orders if each.state == "doubtful"}
    assert asked
    for name in sorted(asked):
        doubts.get_by_role("button", name=f"{name} was served", exact=True).click()
    expect(doubts).to_have_count(0)
    states = {each.id: each.state for each in standing(client, day).orders}
    assert {states[name] for name in asked} == {"served"}
    assert findings(page, ".panel") == []


@pytest.mark.thorough
def test_order_is_placed_by_a_click_on_the_map_and_a_slot(
        client: httpx.Client, service: str, open_page: Callable[..., Page]) -> None:
    day = begun(client, {**PROBLEM, "fleet": [{**PROBLEM["fleet"][0], "shift": {
        "earliest": 0, "latest": 20_000}}]})
    page = open_page(f"{service}/#day={day}")
    page.get_by_text("New order").click()
    page.get_by_role("button", name="Show it on the map").click()
    x, y = place_of(page, "c:A")
    page.mouse.click(x + 30, y + 40)
    page.get_by_role("button", name="Find the best vans").click()
    slots = page.locator(".quote li")
    expect(slots.first).to_contain_text("van-")
    assert findings(page, ".panel") == []
    page.locator(".quote button.primary").click()
    expect(page.locator(".map-label.news.new")).to_have_count(1)
    assert len(standing(client, day).orders) == len(PROBLEM["customers"]) + 1


def test_who_may_be_late_is_served_sooner_by_one_click(
        client: httpx.Client, service: str, open_page: Callable[..., Page]) -> None:
    slow, promised = FAR["customers"]
    day = begun(client, {**FAR, "customers": [
        {**slow, "service_duration": 400}, {**promised, "time_window": {"latest": 1750}}],
        # However busy the machine is, there is time for a remedy.
        "options": {"search_iterations": 1000}}, plan_within=60)
    page = open_page(f"{service}/#day={day}")
    late = page.locator("[data-list=late]")
    expect(late).to_contain_text(re.compile("B.*may be late.*van serves it at 0:22 .0.00"))
    assert findings(page, ".panel") == []
    late.get_by_role("button", name="B: van serves it").click()
    expect(late).to_have_count(0)
    found = {each.id: each for each in standing(client, day).orders}["B"]
    assert (found.arrival, found.at_risk) == (1300, False)


def test_what_is_not_told_yet_is_undone_and_told_with_one_click(
        client: httpx.Client, service: str, open_page: Callable[..., Page]) -> None:
    day = begun(client)
    page = open_page(f"{service}/#day={day}")
    opened(page)
    cancel(page, "F")
    tell = page.locator("#tell-edits")
    expect(tell).to_have_text(re.compile("Tell 1 change"))
    page.keyboard.press("Control+z")
    expect(tell).to_have_count(0)
    cancel(page, "F")
    told(client, day, order("G", 1, 1), at=10)
    expect(page.locator(".map-label.news.new")).to_have_count(1)
    tell.click()
    expect(tell).to_have_count(0)
    assert {each.id for each in standing(client, day).orders} == set("ABCDEG")


@pytest.mark.thorough
def test_what_is_put_elsewhere_by_hand_is_told_and_kept_until_it_is_let_go(
        client: httpx.Client, service: str, open_page: Callable[..., Page]) -> None:
    day = begun(client, {**PROBLEM, "fleet": [{**PROBLEM["fleet"][0], "capacity": [9]}]})
    page = open_page(f"{service}/#day={day}")
    expect(page.get_by_role("timer")).to_be_visible()
    tell = page.locator("#tell-edits")
    other = given(page, "A")
    expect(page.locator("#hand-outcome")).to_contain_text(f"A to {other}")
    expect(tell).to_contain_text("Tell")
    assert findings(page, ".head") == []
    # What others tell meanwhile takes nothing of it away; nor does it hinder undoing.
    told(client, day, order("G", 1, 1), at=10)
    expect(page.locator(".map-label.news.new")).to_have_count(1)
    page.keyboard.press("Control+z")
    expect(tell).to_have_count(0)
    other = given(page, "A")
    tell.click()
    expect(tell).to_have_count(0)
    expect(page.locator(".hand-bar")).to_be_empty()
    assert served_by(plan_of(client, planned(client, day).id))["A"] == other
    told(client, day, order("H", 2, 1), at=20)
    assert served_by(plan_of(client, day))["A"] == other
    page.get_by_role("group", name="Move A").get_by_role("button", name="Locked").click()
    eventually(lambda: all(each.pinned is None for each in standing(client, day).orders
                           if each.id == "A"))


@pytest.mark.thorough
def test_who_is_left_out_by_hand_waits_until_planned_again(
        client: httpx.Client, service: str, open_page: Callable[..., Page]) -> None:
    day = begun(client)
    page = open_page(f"{service}/#day={day}")
    opened(page)
    open_tab(page, "routes")
    page.get_by_role("button", name="A", exact=True).first.click()
    page.get_by_role("group", name="Move A").get_by_role("button", name="Leave out").click()
    tell = page.locator("#tell-edits")
    expect(tell).to_have_text(re.compile("Tell 1 change"))
    tell.click()
    open_tab(page, "drivers")
    waiting = page.locator("[data-list=waiting]")
    expect(waiting).to_contain_text("Left out by hand")
    assert "A" not in served_by(plan_of(client, planned(client, day).id))
    assert findings(page, ".panel") == []
    waiting.get_by_role("button", name="Plan A again").click()
    expect(waiting).to_have_count(0)
    assert "A" in served_by(plan_of(client, planned(client, day).id))


@pytest.mark.thorough
def test_day_is_rehearsed_by_a_clock_that_is_stepped(page: Page) -> None:
    open_tab(page, "drivers")
    page.get_by_role("button", name="Rehearse the day").click()
    title = page.get_by_role("heading", name="A rehearsal")
    expect(title).to_be_visible()
    began = title.inner_text()
    assert findings(page, ".panel") == []
    page.get_by_role("button", name="+5 min").click()
    expect(title).not_to_have_text(began)


def given(page: Page, name: str) -> str:
    """Give an order to another vehicle by hand, and return which."""
    open_tab(page, "routes")
    choice = page.get_by_label(f"Give {name} to")
    if not choice.is_visible():
        page.get_by_role("button", name=name, exact=True).first.click()
    other = choice.locator("option").last.inner_text()
    choice.select_option(label=other)
    return other.partition(" ")[0]


@pytest.mark.thorough
def test_wall_shows_the_day_without_a_panel_to_work_in(
        client: httpx.Client, service: str, open_page: Callable[..., Page]) -> None:
    day = begun(client)
    page = open_page(f"{service}/#day={day}&wall")
    opened(page)
    expect(page.locator(".rail")).to_be_hidden()
    told(client, day, order("G", 1, 1), at=10)
    expect(page.locator("[data-list=changed]")).to_contain_text("G")
    assert page.locator(".panel button:not(.link)").count() == 0
    size = page.get_by_role("timer").evaluate("each => parseFloat(getComputedStyle(each).fontSize)")
    assert size >= 30


@pytest.mark.thorough
def test_link_to_the_day_shows_it_as_it_goes_on_and_the_list_opens_it(
        client: httpx.Client, service: str, open_page: Callable[..., Page]) -> None:
    day = begun(client)
    page = open_page(f"{service}/#day={day}")
    opened(page)
    page.locator("#share").click()
    visitor = open_page(page.locator("#share-url").input_value())
    expect(visitor.get_by_text("You look at a day as it goes on")).to_be_visible()
    told(client, day, order("G", 1, 1), at=10)
    eventually(lambda: "G" in served_by(state(visitor, "state.plans.0.plan")))
    expect(visitor.get_by_text("You look at a day as it goes on")).to_be_visible()
    page.keyboard.press("Escape")
    open_example(page, "smallest")
    expect(page.get_by_role("timer")).to_have_count(0)
    page.locator("#open-menu-button").click()
    page.locator("#saved-plans").click()
    row = page.get_by_role("list", name="Saved plans").get_by_role("listitem").filter(
        has_text="A day, as it goes on")
    row.get_by_role("button", name=re.compile("^Open")).click()
    opened(page)
    assert page.url.endswith(f"#day={day}")


def test_what_cannot_be_planned_is_said_and_the_plan_before_stays(
        client: httpx.Client, service: str, open_page: Callable[..., Page]) -> None:
    day = begun(client)
    page = open_page(f"{service}/#day={day}")
    opened(page)
    # No event that is accepted does so: the service says it in its place.
    page.route(f"**/days/{day}", lambda route: route.fulfill(json={
        **client.get(f"/days/{day}").json(), "failure": "It can't be planned."}))
    client.post(f"/days/{day}/events", json=[{"event_id": "later", "kind": "clock", "at": 10}])
    expect(page.get_by_role("alert")).to_contain_text("the plan before stays")
    expect(page.locator("#total-cost")).to_be_visible()


def opened(page: Page) -> None:
    """Wait for the day's plan: what is told before it is there changes nothing that was seen."""
    expect(page.get_by_role("timer")).to_be_visible()
    expect(page.get_by_role("button", name=re.compile("served"))).to_be_visible()


def cancel(page: Page, name: str) -> None:
    """Take an order out, which isn't told yet."""
    open_tab(page, "customers")
    page.get_by_role("button", name=name, exact=True).first.click()
    page.get_by_role("button", name="Remove this customer").last.click()
