"""What one sees first: an example planned, at once, from this service alone."""

import json
import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.console.serving import new_context
from tests.console.steps import EXAMPLES, STATIC, awaited, idle, open_example, state

pytestmark = [pytest.mark.slow, pytest.mark.begins_with("table1")]

MAX_PAGE_BYTES = 450_000
MAX_FIRST_PLAN_SECONDS = 1.0


@pytest.mark.by_clock
def test_first_view_is_a_city_and_says_what_its_drones_do(
        browser: Browser, service: str) -> None:
    context = new_context(browser)
    page = context.new_page()
    page.goto(service)
    expect(page.locator(".result-line")).to_contain_text("40 of 40 served")
    idle(page)
    assert state(page, "state.request.coordinate_system") == "geographic"
    # Of the plan that is shown, not of any.
    served = sum(len(sortie["customers"]) for route in state(page, "state.plans.0.plan.routes")
                 for trip in route["trips"] for sortie in trip["sorties"])
    assert served > 0
    told = re.compile(rf"\d drones? serves? {served} of 40 customers"
                      r"( and saves? \d+\s%|; vans alone cost no more)\.")
    line = page.locator(".drones-line")
    for width in (1440, 1024, 390):
        page.set_viewport_size({"width": width, "height": 844})
        expect(line.get_by_role("button")).to_have_count(0)
        expect(line.get_by_role("status")).to_have_text(told)
        expect(page.get_by_label("Warnings")).to_have_count(0)
        assert page.evaluate("document.documentElement.scrollWidth") <= width
    context.close()


@pytest.mark.thorough
def test_address_names_an_example(browser: Browser, service: str) -> None:
    for name, served in (("smallest", "2 of 2 served"), ("constructor", "40 of 40 served")):
        context = new_context(browser)
        page = context.new_page()
        page.goto(f"{service}/#example={name}")
        expect(page.get_by_text(served)).to_be_visible()
        context.close()


def test_console_opens_with_an_example_planned(console: Page) -> None:
    expect(console.get_by_text("100 of 100 served")).to_be_visible()
    expect(console.locator(".map .leaflet-overlay-pane canvas")).to_be_visible()
    expect(console.locator(".rows canvas")).to_be_visible()
    idle(console)
    assert float(console.locator("#total-cost").inner_text()) < 890


def test_page_weighs_little(open_page: Callable[..., Page], service: str) -> None:
    # Who has never been there has nothing of it at hand.
    page = open_page(service, locale="en-GB")
    expect(page.locator("#total-cost")).to_be_visible()
    sizes = page.evaluate("performance.getEntriesByType('resource').map(entry => "
                          "[entry.name, entry.transferSize])")
    assert 200_000 < sum(size for _, size in sizes) < MAX_PAGE_BYTES, sizes


def test_what_the_first_plan_waits_for_is_asked_by_the_page_and_once(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, locale="de-AT")
    expect(page.locator("#total-cost")).to_be_visible()
    asked = page.evaluate("""() => {
      const [{ domInteractive }] = performance.getEntriesByType('navigation');
      return performance.getEntriesByType('resource').map(({ name, startTime }) =>
        [new URL(name).pathname.split('/').slice(-2).join('/'), startTime < domInteractive]);
    }""")
    # Modules run once the page is read: what they ask for comes round trips later.
    early = ["/openapi.json", "console/config.json", "health/ready", "texts/de.js",
             "granted/de.js", "reasons/de.js"]
    assert sorted(each for each in asked if each[0] in early) == sorted(
        [name, True] for name in early)
    assert "texts/en.js" not in dict(asked)


@pytest.mark.thorough
def test_who_comes_again_has_the_files_at_hand(page: Page, service: str) -> None:
    page.goto(f"{service}/?again")
    expect(page.locator("#total-cost")).to_be_visible()
    fetched = page.evaluate("performance.getEntriesByType('resource')"
                            ".filter((entry) => entry.transferSize > 0).map(({ name }) => name)")
    assert [name for name in fetched if re.search(r"\.(js|css|svg)$", name)] == []


@pytest.mark.by_clock
def test_first_plan_is_drawn_within_a_second_of_the_click(console: Page) -> None:
    idle(console)
    console.evaluate("""() => {
      const total = document.querySelector('.result-line');
      window.drawn = new Promise((resolve) => {
        let began = 0;
        document.getElementById('plan-button').addEventListener('click', () => {
          began = performance.now();
        });
        new MutationObserver(() => {
          if (total.textContent.includes('Improving')) {
            requestAnimationFrame(() => resolve(performance.now() - began));
          }
        }).observe(total, { childList: true, subtree: true, characterData: true });
      });
    }""")
    console.get_by_role("button", name="Plan", exact=True).click()
    assert awaited(console, "() => window.drawn") / 1000 < MAX_FIRST_PLAN_SECONDS


@pytest.mark.thorough
def test_every_example_opens(console: Page, service: str) -> None:
    for name in json.loads(console.request.get(f"{service}/openapi.json").text())["paths"]["/plan"][
            "post"]["requestBody"]["content"]["application/json"]["examples"]:
        customers = json.loads((EXAMPLES / f"{name}.json").read_text("utf-8"))["customers"]
        open_example(console, name)
        expect(console.locator(".result-line")).to_contain_text(f"of {len(customers)} served")


@pytest.mark.thorough
def test_what_drones_save_is_asked_by_a_click_elsewhere(console: Page) -> None:
    open_example(console, "drones")
    line = console.locator(".drones-line")
    expect(line).to_contain_text("of 4 customers.")
    line.get_by_role("button", name="What do they save?").click()
    expect(line.get_by_role("button")).to_have_count(0)
    open_example(console, "smallest")
    expect(line).to_have_count(0)


@pytest.mark.thorough
def test_tiles_are_drawn_if_an_address_is_set(open_page: Callable[..., Page],
                                              service: str) -> None:
    page = open_page(service)
    idle(page)
    page.route("**/config.json", lambda route: route.fulfill(json={
        "policies": ["attention"], "tile_url": f"{service}/tiles/{{z}}/{{x}}/{{y}}.png",
        "tile_attribution": "the <b>map</b> makers"}))
    page.route("**/tiles/**", lambda route: route.fulfill(path=STATIC / "icon.svg"))
    page.reload()
    open_example(page, "city_day")
    expect(page.locator("img.leaflet-tile").first).to_be_visible()
    expect(page.get_by_text("the <b>map</b> makers")).to_be_visible()


@pytest.mark.thorough
def test_starting_service_is_waited_for(open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("503",))
    page.route("**/health/ready", lambda route: route.fulfill(
        status=503, json={"status": "starting", "detail": "tables are being prepared"}))
    page.reload()
    expect(page.get_by_text("The service is starting. tables are being prepared")).to_be_visible()
    page.unroute("**/health/ready")
    expect(page.locator("#total-cost")).to_be_visible()
    expect(page.get_by_text("The service is starting.")).to_have_count(0)
