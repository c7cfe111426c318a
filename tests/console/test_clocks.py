"""Times of day, a currency and units: what one sees and types by the clock."""

import json
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import EXAMPLES, open_file, open_tab, planned, state

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


def problem_saved(page: Page) -> Any:
    open_tab(page, "export")
    with page.expect_download() as saved:
        page.get_by_role("button", name="Problem as JSON").click()
    return json.loads(saved.value.path().read_text("utf-8"))


def test_a_day_is_planned_by_its_clock(page: Page) -> None:
    stated = json.loads((EXAMPLES / "clocks.json").read_text("utf-8"))
    open_file(page, "clocks.json", json.dumps(stated))
    planned(page, "2 of 2 served")
    expect(page.locator("#total-cost")).to_contain_text("EUR")
    row = page.locator("tr", has=page.get_by_role("button", name="Bakery", exact=True)).first
    expect(row).to_contain_text("7:30\N{EN DASH}9:00")
    expect(row).to_contain_text("40\N{NO-BREAK SPACE}kg")
    assert state(page, "state.request.customers.0.time_window.earliest") == 6.5 * 3600
    assert problem_saved(page) == stated

    open_tab(page, "customers")
    row.get_by_role("button", name="Bakery").click()
    service = page.get_by_label("Service duration", exact=True)
    expect(service).to_have_value("10 min")
    service.fill("0:20")
    service.press("Enter")
    latest = page.locator("#field-customers-0-time_window-latest")
    expect(latest).to_have_value("9:00")
    latest.fill("9:15")
    latest.press("Enter")
    page.locator("#day > summary").click()
    page.get_by_label("Date", exact=True).fill("2026-10-25")
    expect(latest).to_have_value("9:15")
    page.get_by_role("button", name="Plan", exact=True).click()
    planned(page, "2 of 2 served")
    changed = problem_saved(page)
    assert changed["plan_start"] == "2026-10-25T00:00:00"
    first = changed["customers"][0]
    assert first["service_duration"] == 1200
    assert first["time_window"] == {"earliest": 8.5 * 3600, "latest": 10.25 * 3600}
