"""Drivers: their page on a phone, with and without network, and what the console makes of it."""

import json
import re
import zlib
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import httpx
import pytest
from playwright.sync_api import Browser, BrowserContext, Page, Route, expect
from sqlalchemy import text

from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner, opened, ready, serving
from tests.app.records.dispatches.days import (
    DEPART, FIRST, LAUNCH, PLAN, PROBLEM, dispatched, event, holding,
)
from tests.conftest import PATIENCE, eventually
from tests.console.serving import new_context
from tests.console.steps import (
    follow, open_example, open_file, open_tab, planned, state,
)
from tests.console.test_everyone import findings

pytestmark = pytest.mark.slow

Data = dict[str, Any]

PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "locale": "en-GB"}
STATIC = Path(__file__).parents[2] / "app" / "records" / "dispatches" / "static"


@pytest.fixture(scope="module")
def settings(tmp_path_factory: pytest.TempPathFactory) -> Settings:
    """Return settings of a service that plans nothing."""
    return Settings(data_dir=tmp_path_factory.mktemp("drivers"), role="api", drain_seconds=0)


@pytest.fixture(scope="module")
def client(settings: Settings) -> Iterator[httpx.Client]:
    """Return a client of that service."""
    with serving(FirstFitPlanner(), settings) as client:
        yield ready(client)


@pytest.fixture
def phone(browser: Browser) -> Iterator[BrowserContext]:
    """Return a phone's browser."""
    context = new_context(browser, **PHONE)
    yield context
    context.close()


def open_page(phone: BrowserContext, link: Data) -> Page:
    """Open a link as a page that was not open before."""
    page = phone.new_page()
    page.goto(link["url"])
    expect(page.get_by_role("heading", name=link["name"])).to_be_visible()
    return page


def mark(page: Page, step: str, button: str) -> None:
    """Mark the step that is next."""
    row = page.locator("li[aria-current=step]")
    expect(row).to_contain_text(step)
    row.get_by_role("button", name=button, exact=True).click()


def test_day_is_driven_without_network_and_caught_up(
        client: httpx.Client, settings: Settings, phone: BrowserContext) -> None:
    sent = dispatched(client, time_zone="Europe/Berlin")
    link = sent["links"][0]
    page = open_page(phone, link)
    expect(page.get_by_role("status")).to_have_text("All is sent.")
    page.evaluate("navigator.serviceWorker.ready.then(() => true)")
    phone.set_offline(True)
    mark(page, "Leave hub", "Left")
    mark(page, "Launch drone-1 to C", "Launched")
    expect(page.get_by_role("status")).to_contain_text("2 not sent yet")
    page.close()
    page = open_page(phone, link)
    expect(page.get_by_role("status")).to_contain_text("2 not sent yet")
    mark(page, "A", "Failed")
    page.get_by_role("button", name="Nobody there").click()
    expect(page.get_by_role("status")).to_contain_text("3 not sent yet")
    other = open_page(phone, link)
    phone.set_offline(False)
    # Both may send, and both do when they hear of the network.
    for tab in (page, other):
        tab.evaluate("dispatchEvent(new Event('online'))")
        expect(tab.get_by_role("status")).to_have_text("All is sent.")
    standing = client.get(f"/dispatches/{sent['id']}").json()["links"][0]["standing"]
    assert [(step["id"], step["state"], step["reason"]) for step in standing] == [
        (DEPART, "done", None), (LAUNCH, "done", None),
        (FIRST, "failed", "Nobody there")]
    with opened(settings) as engine, engine.connect() as connection:
        rows = connection.execute(text(
            "SELECT step FROM day_events WHERE day = :id ORDER BY number"), sent).all()
    assert [step for step, in rows] == [DEPART, LAUNCH, FIRST]


def test_change_of_the_day_reaches_the_phone(client: httpx.Client, phone: BrowserContext) -> None:
    sent = dispatched(client)
    page = open_page(phone, sent["links"][0])
    expect(page.locator("li.step")).to_have_count(6)
    client.post(f"/dispatches/{sent['id']}/plan", json={
        "problem": PROBLEM, "plan": {"routes": PLAN["routes"][1:]}}).raise_for_status()
    page.evaluate("dispatchEvent(new Event('online'))")
    expect(page.get_by_role("alert")).to_contain_text("Your day was changed")
    expect(page.get_by_text("Nothing is planned for you any more.")).to_be_visible()
    page.get_by_role("button", name="I have seen it").click()
    expect(page.get_by_role("alert")).to_have_count(0)


@pytest.mark.thorough
def test_flights_of_the_drone_are_saved_by_its_driver(
        client: httpx.Client, phone: BrowserContext) -> None:
    truck, van = dispatched(client)["links"]
    page = open_page(phone, truck)
    expect(page.locator("footer")).to_contain_text("no permission to fly")
    with page.expect_download() as download:
        page.get_by_role("button", name="Save flights").click()
    assert download.value.suggested_filename == "truck-1-drone-1-flight-1.plan"
    mission = json.loads(Path(download.value.path()).read_bytes())
    assert mission["mission"]["plannedHomePosition"] == [48.1, 11.51, 0]
    page.get_by_label("Flights as").select_option("dji-wpml")
    page.get_by_role("button", name="Save flights").click()
    expect(page.get_by_role("alert")).to_contain_text("choose another")
    expect(open_page(phone, van).get_by_role("button", name="Save flights")).to_have_count(0)


def test_page_shows_all_that_a_driver_needs_to_everyone(
        client: httpx.Client, phone: BrowserContext) -> None:
    link = dispatched(client, time_zone="Asia/Tokyo")["links"][0]
    page = open_page(phone, link)
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.locator("li.launch .head").click()
    page.locator("li.stop .head").first.click()
    card = page.locator("li.stop").first
    expect(card).to_contain_text("Ring twice")
    expect(card).to_contain_text("Tal 1, München")
    expect(card).to_contain_text("4711")
    expect(card).to_contain_text("8:20 to 11:06")
    expect(card.get_by_role("link", name="Call")).to_have_attribute("href", "tel:+498912345")
    navigate = card.get_by_role("link", name="Navigate")
    expect(navigate).to_have_attribute("href", "geo:48.1,11.51?q=48.1,11.51")
    page.get_by_label("Navigate with").select_option("google")
    expect(navigate).to_have_attribute(
        "href", "https://www.google.com/maps/dir/?api=1&destination=48.1%2C11.51")
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    small = page.evaluate("""[...document.querySelectorAll('button, a, select')]
        .filter((part) => part.getBoundingClientRect().height < 44).length""")
    assert small == 0
    seen = findings(page)
    page.emulate_media(color_scheme="dark")
    assert seen + findings(page) == []
    assert all(address.startswith(str(client.base_url)) for address in asked)


@pytest.mark.thorough
def test_day_is_told_in_the_language_of_the_phone_and_loads_in_their_units(
        client: httpx.Client, browser: Browser) -> None:
    dimensions = [{"name": "weight", "unit": "kg"}]
    sent = dispatched(client, problem=PROBLEM | {"load_dimensions": dimensions})
    phone = new_context(browser, **PHONE | {"locale": "de-AT"})
    page = open_page(phone, sent["links"][0])
    expect(page.locator("html")).to_have_attribute("lang", "de")
    expect(page.get_by_role("status")).to_have_text("Alles ist gesendet.")
    first = page.locator("li.depart")
    expect(first).to_contain_text("Abfahrt hub")
    expect(first).to_contain_text("2,3\u00a0kg")
    mark(page, "Abfahrt hub", "Abgefahren")
    mark(page, "drone-1 starten zu C", "Gescheitert")
    page.get_by_role("button", name="Zu viel Wind").click()
    expect(page.locator("li.launch")).to_contain_text("gescheitert")
    expect(page.get_by_role("status")).to_have_text("Alles ist gesendet.")
    assert findings(page) == []
    page.get_by_label("Sprache").select_option("en")
    expect(page.get_by_role("status")).to_have_text("All is sent.")
    page.locator("li.launch .head").click()
    expect(page.locator("li.launch")).to_contain_text("Too much wind")
    page.reload()
    expect(page.locator("html")).to_have_attribute("lang", "en")
    standing = client.get(f"/dispatches/{sent['id']}").json()["links"][0]["standing"]
    # The service knows some reasons, whatever the language in which they were tapped.
    assert standing[1]["reason"] == "Too much wind"
    phone.close()


@pytest.mark.thorough
@pytest.mark.parametrize("locale", ["en-GB", "de-AT"])
def test_nothing_moves_under_the_thumb_when_it_is_sent(
        client: httpx.Client, browser: Browser, locale: str) -> None:
    sent = dispatched(client)
    phone = new_context(browser, **PHONE | {"locale": locale})
    waiting: list[Route] = []
    phone.route("**/events", lambda route: waiting.append(route))
    page = open_page(phone, sent["links"][0])
    page.locator("li[aria-current=step] .good").click()
    status = page.get_by_role("status")
    expect(status).to_have_class("unsent")
    failed = page.locator("li.launch .bad")
    before = failed.bounding_box()
    eventually(lambda: page.evaluate("1") and waiting)
    waiting[0].continue_()
    expect(status).not_to_have_class("unsent")
    assert failed.bounding_box() == before
    phone.close()


def test_failing_takes_two_taps_and_what_is_being_written_is_kept(
        client: httpx.Client, phone: BrowserContext) -> None:
    sent = dispatched(client)
    page = open_page(phone, sent["links"][0])
    mark(page, "Leave hub", "Left")
    mark(page, "Launch drone-1 to C", "Failed")
    page.get_by_label("In your words").fill("Crowd on the square")
    page.reload()
    expect(page.get_by_label("In your words")).to_have_value("Crowd on the square")
    page.get_by_role("button", name="It failed").click()
    expect(page.locator("li.launch")).to_contain_text("failed")
    expect(page.get_by_label("In your words")).to_have_count(0)
    mark(page, "A", "Failed")
    page.get_by_role("button", name="Back", exact=True).click()
    page.reload()
    mark(page, "A", "Failed")
    page.get_by_role("button", name="Nobody there").click()
    expect(page.locator("li.stop").first).to_contain_text("failed")
    expect(page.get_by_role("status")).to_have_text("All is sent.")
    standing = client.get(f"/dispatches/{sent['id']}").json()["links"][0]["standing"]
    assert [step["reason"] for step in standing] == [
        None, "Crowd on the square", "Nobody there"]


def test_link_that_is_over_leaves_nothing_on_the_phone(
        client: httpx.Client, phone: BrowserContext) -> None:
    sent = dispatched(client)
    link = sent["links"][0]
    page = open_page(phone, link)
    client.delete(f"/dispatches/{sent['id']}/links/{link['id']}")
    page.reload()
    expect(page.get_by_role("alert")).to_contain_text("revoked")
    kept = page.evaluate("""async () => {
        const days = await import(`${location.origin}/drive/js/days.js`);
        return (await days.keptDay(location.hash.split('_')[2])) ?? null;
    }""")
    assert kept is None
    expect(page.get_by_text("Tal 1")).to_have_count(0)


def test_page_is_small_and_is_kept_whole() -> None:
    files = [path for path in STATIC.rglob("*") if path.is_file()]
    worker = (STATIC / "sw.js").read_text("utf-8")
    console = STATIC.parents[2] / "console" / "static"
    shared = [console / name for name in re.findall(r"'\.\./console/(.+)'", worker)]
    assert {path.relative_to(console).as_posix() for path in shared} == {
        "vendor/htm-3.1.1/standalone.module.js", "vendor/i18next-26.7.2/i18next.js",
        "js/language.js", "texts/reasons/de.js", "texts/reasons/en.js"}
    assert sum(len(zlib.compress(path.read_bytes())) for path in [*files, *shared]) < 60_000
    # The last tells Node, which runs tests of the modules, that they are some.
    left_out = {"sw.js", "index.html", "package.json"}
    assert [path.name for path in files
            if path.name not in left_out
            and f"'{path.relative_to(STATIC).as_posix()}'" not in worker] == []


def replan_as_told(page: Page) -> None:
    """Go on from what drivers told, and from the plan for whom nobody told by this time of day."""
    page.get_by_role("button", name="Replan from what drivers told").click()
    asked = page.get_by_role("button", name="Go on so")  # of whom nobody told by this time of day
    going_on = page.get_by_role("heading", name="Go on from the plan that came")
    expect(asked.or_(going_on)).to_be_visible()
    if asked.is_visible():
        asked.click()
    expect(going_on).to_be_visible()


def test_plan_is_sent_out_followed_and_planned_on_from(page: Page) -> None:
    open_example(page, "drones")
    open_tab(page, "drivers")
    page.get_by_role("button", name="Send to drivers").click()
    card = page.locator(".links li").first
    expect(card).to_contain_text("not opened yet")
    address = card.get_by_role("link", name="Open the day").get_attribute("href") or ""
    token = address.partition("#")[2]
    with httpx.Client(base_url=page.url, trust_env=False, timeout=PATIENCE,
                      headers=holding(token)) as driver:
        day = driver.get("drive/day").json()
        reply = driver.post("drive/events", json={"now": "2026-11-23T00:00:00Z", "events": []})
        assert reply.status_code == 200
        now = page.evaluate("new Date().toISOString()")
        driver.post("drive/events", json={"now": now, "events": [
            event("1", day["steps"][0]["id"], now)]})
    expect(card).to_contain_text(f"1 of {len(day['steps'])}")
    assert findings(page, ".panel") == []
    page.evaluate("window.print = () => {}")
    page.get_by_role("button", name="Print sheets with links").click()
    assert page.locator(".sheet-page .qr img").count() == page.locator(".sheet-page").count()
    page.reload()
    open_tab(page, "drivers")
    expect(card).to_contain_text(f"1 of {len(day['steps'])}")
    dispatch = state(page, "state.dispatch.reply.id")
    page.evaluate("sessionStorage.removeItem('tandem-dispatch')")  # as in another tab
    page.reload()
    open_tab(page, "drivers")
    follow(page, dispatch)
    expect(card).to_contain_text(f"1 of {len(day['steps'])}")
    open_example(page, "drones")
    open_tab(page, "drivers")
    page.get_by_role("button", name="to their phones").click()
    expect(page.get_by_role("button", name="to their phones")).to_have_count(0)
    replan_as_told(page)
    open_tab(page, "drivers")
    card.get_by_role("button", name="Revoke").click()
    expect(card).to_contain_text("revoked")


@pytest.mark.thorough
def test_orders_of_which_nobody_told_are_asked_for_and_undo_brings_the_plan_back(
        page: Page) -> None:
    start = datetime.now(UTC) - timedelta(hours=2)
    place = {"service_duration": 60, "demand": [1]}
    problem = {
        "plan_start": start.isoformat(timespec="seconds"), "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": "near", "location": [1, 0], **place},
                      {"id": "far", "location": [2, 0], **place}],
        "fleet": [{"id": "van", "count": 2, "capacity": [9]}], "options": {"time_limit": 0}}
    open_file(page, "day.json", json.dumps(problem))
    planned(page, "2 of 2 served")
    before = state(page, "state.shown")
    open_tab(page, "drivers")
    page.get_by_role("button", name="Send to drivers").click()
    expect(page.locator(".links li").first).to_contain_text("not opened yet")
    page.get_by_role("button", name="Replan from what drivers told").click()
    question = page.locator(".untold")
    expect(question).to_contain_text("near, planned for")
    assert findings(page, ".panel") == []
    question.get_by_role("button", name="Cancel").click()
    expect(question).to_have_count(0)
    page.get_by_role("button", name="Replan from what drivers told").click()
    question.get_by_role("checkbox", name="All of them").uncheck()
    expect(question.get_by_role("checkbox", name="far")).not_to_be_checked()
    question.get_by_role("checkbox", name="near").check()
    question.get_by_role("button", name="Go on so").click()
    expect(page.get_by_role("heading", name="Go on from the plan that came")).to_be_visible()
    served = "state.request.replan.plan.routes.0.trips.0.stops.1.id"
    assert state(page, served) == "near"
    page.locator(".tab").get_by_role("button", name="Plan on").click()
    planned(page, "2 of 2 served")
    expect(page.locator(".result-line")).to_be_visible()
    assert state(page, "state.shown") != before
    page.keyboard.press("Control+z")
    assert state(page, "state.request.replan") is None
    assert state(page, "state.shown") == before
    page.keyboard.press("Control+Shift+Z")
    assert state(page, "state.shown") != before
