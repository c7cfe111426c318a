"""For everyone: by keyboard, on a phone, light and dark, with assistive tools, with a key."""

from collections.abc import Callable, Sequence

import pytest
from axe_playwright_python.base import AXE_SCRIPT
from playwright.sync_api import Page, expect

from tests.console.steps import (
    awaited, idle, let_search, state, stop_button,
)

pytestmark = [pytest.mark.slow, pytest.mark.begins_with("table1")]

SERIOUS = ["serious", "critical"]
"""Impacts of what hinders people much."""

FINDINGS = """async ([part, without, impacts]) => {
  const passing = document.getAnimations().filter((each) => each instanceof CSSTransition);
  await Promise.allSettled(passing.map(({ finished }) => finished));
  const rules = Object.fromEntries(without.map((rule) => [rule, { enabled: false }]));
  const found = await axe.run(part ?? document, { resultTypes: ['violations'], rules });
  return found.violations.filter(({ impact }) => !impacts || impacts.includes(impact))
    .flatMap(({ id, help, nodes }) => nodes.map(({ html }) =>
      `${id}: ${help}: ${html.slice(0, 160)}`));
}"""
"""Colours that are changing are waited for. Only what counts leaves the page: axe tells of all that
it looked at."""


def findings(page: Page, part: str | None = None, without: Sequence[str] = (),
             impacts: list[str] | None = SERIOUS) -> list[str]:
    """Return what axe finds in the page, or in the part that is selected, of impacts or of any.

    Rules are left out by name.
    """
    if not page.evaluate("'axe' in window"):
        page.evaluate(AXE_SCRIPT)
    return list(awaited(page, FINDINGS, [part, list(without), impacts]))


@pytest.mark.thorough_after(1)
@pytest.mark.begins_with("city_day")
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_serious_in_tools_and_dialogs(open_page: Callable[..., Page],
                                                        service: str, scheme: str) -> None:
    # What is in tabs is looked at in both languages: see `test_languages`.
    page = open_page(service, color_scheme=scheme)
    idle(page)
    page.get_by_role("button", name="Draw", exact=True).click()
    page.locator("#settings-button").click()
    page.get_by_role("button", name="Keys").click()
    assert findings(page) == []


def test_everything_is_reached_by_keyboard(page: Page) -> None:
    idle(page)
    page.keyboard.press("?")
    expect(page.get_by_role("dialog", name="Keys")).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    page.keyboard.press("4")
    expect(page.locator("#room-day")).to_have_attribute("aria-selected", "true")
    page.locator("#room-day").focus()
    page.keyboard.press("ArrowUp")
    expect(page.locator("#room-routes")).to_be_focused()
    page.locator("#tab-routes").focus()
    page.keyboard.press("ArrowRight")
    expect(page.locator("#tab-costs")).to_be_focused()
    page.keyboard.press("t")
    expect(page.locator(".rows canvas")).to_be_focused()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    first = state(page, "state.selection")
    assert first.startswith("c:")
    page.keyboard.press("ArrowDown")
    assert state(page, "state.selection") != first
    page.keyboard.press("Escape")
    assert state(page, "state.selection") is None
    let_search(page, 60)
    page.keyboard.press("p")
    expect(page.locator(".result-line")).to_contain_text("Improving")
    page.keyboard.press("s")
    idle(page)
    page.keyboard.press("l")
    expect(page.locator("html")).to_have_attribute("data-theme", "dark")


def test_focus_goes_through_the_page_in_order(page: Page) -> None:
    idle(page)
    labels = []
    for _ in range(7):
        page.keyboard.press("Tab")
        labels.append(page.evaluate("""() => document.activeElement.getAttribute('aria-label')
            ?? document.activeElement.innerText"""))
    assert labels[:6] == ["Orders", "Settings", "Help", "A hundred customers", "Save", "Open"]
    assert labels[6].startswith("Cost ")


def test_phone_shows_map_panel_and_timeline_without_scrolling_sideways(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, viewport={"width": 390, "height": 844}, has_touch=True)
    idle(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    for place in (".map", ".panel"):
        expect(page.locator(place).first).to_be_in_viewport()
    header = page.locator("header.head").bounding_box()
    assert header is not None
    assert header["height"] == 48
    page.get_by_role("button", name="Height of the panel").tap()
    expect(page.locator(".rows canvas")).to_be_in_viewport()
    page.locator("#room-export").tap()
    expect(page.get_by_role("button", name="Plan as JSON")).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_theme_follows_the_system_and_the_choice(open_page: Callable[..., Page],
                                                 service: str) -> None:
    page = open_page(service, color_scheme="dark")
    expect(page.locator("html")).to_have_attribute("data-theme", "dark")
    page.locator("#settings-button").click()
    page.get_by_role("button", name="Light").click()
    page.reload()
    expect(page.locator("html")).to_have_attribute("data-theme", "light")


def test_service_with_keys_asks_for_one_and_forgets_it(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("401",))
    idle(page)

    def guard(route) -> None:
        if route.request.headers.get("authorization") == "Bearer tdm_right":
            route.fallback()
        else:
            route.fulfill(status=401, content_type="application/problem+json",
                          body='{"title": "A valid API key is needed", "detail": "Send one."}')

    page.route("**/plan", guard)
    page.route("**/jobs**", guard)
    let_search(page, 60)
    page.get_by_role("button", name="Plan", exact=True).click()
    dialog = page.get_by_role("dialog", name="API key")
    dialog.get_by_label("Key").fill("tdm_wrong")
    dialog.get_by_role("button", name="Use this key").click()
    expect(dialog).to_contain_text("The service refused the key.")
    dialog.get_by_label("Key").fill("tdm_right")
    dialog.get_by_label("Key").press("Enter")
    expect(page.locator(".result-line")).to_contain_text("Improving")
    stop_button(page).click()
    idle(page)
    assert page.evaluate("sessionStorage.getItem('tandem-api-key')") == "tdm_right"
    assert "tdm" not in page.evaluate("JSON.stringify(localStorage)")
