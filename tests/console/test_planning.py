"""Planning as it happens: the decoded plan, improvements, the cost curve, stopping."""

import json
import re
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Page, Route, expect

from tests.console.steps import (
    idle, let_search, open_advanced, open_file, open_tab, state, stop_button,
)
from tests.conftest import soon

pytestmark = [pytest.mark.slow, pytest.mark.begins_with("table1")]


def set_option(page: Page, name: str, value: str) -> None:
    """Set one of the options of planning."""
    field = page.locator(f"#field-options-{name}")
    field.fill(value)
    field.press("Enter")


def test_decoded_plan_comes_at_once_and_improvements_follow(page: Page) -> None:
    idle(page)
    open_tab(page, "solve")
    set_option(page, "time_limit", "60")
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(page.locator(".result-line")).to_contain_text("Improving")
    first = state(page, "state.run.points.0.cost")
    soon(lambda: state(page, "state.run.points")[-1]["cost"] < first)
    stop_button(page).click()
    idle(page)
    points = state(page, "state.run.points")
    assert points[-1]["cost"] == min(point["cost"] for point in points)
    expect(page.get_by_text(re.compile(r"^From \d"))).to_be_visible()
    expect(page.locator(".curve canvas")).to_be_visible()
    assert abs(float(page.locator("#total-cost").inner_text()) - points[-1]["cost"]) < 0.01


def test_planning_is_stopped_with_the_best_plan_so_far(page: Page) -> None:
    idle(page)
    open_tab(page, "solve")
    set_option(page, "time_limit", "50")
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(page.locator(".result-line")).to_contain_text("Improving")
    stop_button(page).click()
    idle(page)
    assert state(page, "state.run.state") == "idle"
    expect(page.get_by_text("100 of 100 served")).to_be_visible()


NOTED = """() => {
  window.told = new Set();
  new MutationObserver(() => {
    const text = document.getElementById('chosen-limit')?.textContent;
    if (text) window.told.add(text.replaceAll(/\\s+/g, ' ').trim());
  }).observe(document.body, { childList: true, subtree: true, characterData: true });
}"""
"""Notes how long is planned whenever that is told: on a busy machine planning ends unseen."""


@pytest.mark.thorough
def test_a_limit_that_fits_the_size_is_chosen_and_told(page: Page) -> None:
    idle(page)
    page.evaluate(NOTED)
    open_file(page, "many.json", json.dumps(crowd(1800)))
    told = page.locator("#chosen-limit")
    page.wait_for_function("() => window.told.has('for up to 6 s, which fits 1,800 customers')")
    expect(page.locator("#total-cost")).to_be_visible()
    # On a machine that is busy the six seconds may be over by now.
    page.evaluate("document.querySelector('header.head button.stop')?.click()")
    idle(page)
    expect(told).to_have_count(0)
    open_tab(page, "solve")
    field = page.locator("#field-options-time_limit")
    expect(field).to_have_attribute("placeholder", "else 6")
    expect(page.locator("#field-options-time_limit-help")).to_contain_text(
        "Empty: 6, which fits 1,800 customers")
    set_option(page, "time_limit", "1.5")
    with page.expect_request("**/jobs") as asked:
        page.get_by_role("button", name="Plan", exact=True).click()
    sent = asked.value.post_data_json
    assert sent is not None
    assert sent["options"]["time_limit"] == 1.5
    expect(told).to_have_count(0)
    idle(page)


def crowd(count: int) -> dict[str, Any]:
    """Return customers on a grid, for trucks without drones."""
    customers = [{"id": f"c{number}", "demand": [1],
                  "location": [number % 50, number // 50]} for number in range(count)]
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [25, 25]}],
            "customers": customers,
            "fleet": [{"id": "truck", "count": count // 20, "capacity": [30]}]}


@pytest.mark.thorough
def test_policy_and_decoding_are_chosen(page: Page) -> None:
    idle(page)
    open_tab(page, "solve")
    expect(page.locator("#field-options-policy")).to_be_hidden()
    open_advanced(page)
    page.locator("#field-options-policy").select_option("pointer")
    page.locator("#field-options-decoding").select_option("sample")
    set_option(page, "num_samples", "4")
    set_option(page, "time_limit", "0")
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(page.locator(".developers")).to_contain_text("pointer, sample")
    idle(page)


def test_lost_connection_is_told_in_words(open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("ERR_FAILED", "Failed to load"))
    expect(page.locator("#total-cost")).to_be_visible()
    idle(page)
    page.route("**/plan", lambda route: route.abort())
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(page.get_by_role("alert")).to_contain_text("The service does not answer.")


@pytest.mark.thorough
def test_stream_that_breaks_is_taken_up_again(open_page: Callable[..., Page],
                                              service: str) -> None:
    page = open_page(service, allow=("ERR_FAILED", "Failed to load"))
    idle(page)
    tries: list[str] = []

    def break_once(route: Route) -> None:
        tries.append(route.request.url)
        if len(tries) == 1:
            route.abort()
        else:
            route.continue_()

    page.route("**/events", break_once)
    let_search(page, 60)
    page.get_by_role("button", name="Plan", exact=True).click()
    expect(page.locator(".result-line")).to_contain_text("Improving")
    soon(lambda: state(page, "state.run.share"))  # which the stream tells
    stop_button(page).click()
    idle(page)
    assert len(tries) == 2
    assert state(page, "state.failure") is None
    assert float(page.locator("#total-cost").inner_text()) < 880
