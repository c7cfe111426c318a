"""Wind by the hour: typed, or from a file of Open-Meteo; drones stay aboard in strong gusts."""

import json
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import EXAMPLES, open_file, open_tab, planned, state
from tests.console.test_everyone import findings

pytestmark = [pytest.mark.slow, pytest.mark.one_page, pytest.mark.thorough]

HOURS = 12


def windy_day(**airspace: Any) -> dict[str, Any]:
    """Return a dated problem whose drones stay aboard above 30 km/h."""
    request: dict[str, Any] = json.loads((EXAMPLES / "smallest.json").read_text("utf-8"))
    request |= {"plan_start": "2026-11-27T08:00:00+01:00", "time_zone": "Europe/Berlin",
                "airspace": airspace, "options": {"time_limit": 60, "search_iterations": 200}}
    request["fleet"][0]["drones"] = {"count": 1, "capacity": [9], "max_wind_kmh": 30}
    return request


def forecast() -> str:
    """Return a file of Open-Meteo, whose gusts grow by the hour."""
    return json.dumps({
        "latitude": 52.5, "longitude": 13.4, "utc_offset_seconds": 3600,
        "hourly_units": {"time": "iso8601", "wind_speed_10m": "km/h", "wind_gusts_10m": "km/h"},
        "hourly": {"time": [f"2026-11-27T{hour:02}:00" for hour in range(8, 8 + HOURS)],
                   "wind_speed_10m": [10.0 + hour for hour in range(HOURS)],
                   "wind_direction_10m": [270] * HOURS,
                   "wind_gusts_10m": [20.0 + 4 * hour for hour in range(HOURS)]}})


def test_a_forecast_is_dropped_planned_with_and_changed(page: Page) -> None:
    open_file(page, "day.json", json.dumps(windy_day()))
    planned(page, "2 of 2 served")
    open_file(page, "wind.json", forecast())
    table = page.get_by_role("table", name="Wind by the hour")
    expect(table.get_by_role("row")).to_have_count(HOURS + 1)
    expect(table.get_by_role("row").nth(1)).to_contain_text("8:00")
    # From the fourth hour on gusts are above 30 km/h.
    down = table.get_by_role("row").filter(has_text=state(page, "state.request.fleet.0.id"))
    expect(down).to_have_count(HOURS - 3)
    page.get_by_role("button", name="Plan", exact=True).click()
    planned(page, "2 of 2 served")
    assert state(page, "state.plans.1.request.airspace.wind.open_meteo.hourly.time.0")
    open_tab(page, "fleet")
    page.get_by_role("button", name="Change these hours").click()
    gusts = page.get_by_label("Gusts km/h, hour 2")
    gusts.fill("44")
    gusts.press("Enter")
    assert state(page, "state.request.airspace.wind.1.gust_kmh") == 44
    expect(down).to_have_count(HOURS - 2)
    assert findings(page, ".panel") == []


def test_wind_by_the_hour_is_typed_and_what_is_wrong_is_said_at_its_hour(page: Page) -> None:
    open_file(page, "day.json", json.dumps(windy_day(wind={"speed_kmh": 20, "direction_deg": 90})))
    planned(page, "2 of 2 served")
    open_tab(page, "fleet")
    page.get_by_label("It blows").select_option("hourly")
    page.get_by_role("button", name="Add an hour").click()
    page.get_by_role("button", name="Add an hour").click()
    hour = page.get_by_label("From, hour 2")
    expect(hour).to_have_value("9:00")
    hour.fill("soon")
    hour.press("Enter")
    expect(page.locator("#field-airspace-wind-1-from-error")).to_be_visible()
    hour.fill("11:00")
    hour.press("Enter")
    expect(page.locator("#field-airspace-wind-1-from-error")).to_have_count(0)
    page.get_by_role("button", name="Remove entry 3").click()
    assert state(page, "state.request.airspace.wind") == [
        {"from": 0, "speed_kmh": 20, "direction_deg": 90},
        {"from": 10800, "speed_kmh": 20, "direction_deg": 90}]
    page.get_by_label("It blows").select_option("steady")
    expect(page.locator("#field-airspace-wind-speed_kmh")).to_have_value("20")


def test_a_forecast_needs_a_day(page: Page) -> None:
    open_file(page, "wind.json", forecast())
    expect(page.get_by_text("wind.json tells the wind of certain days")).to_be_visible()
    assert state(page, "state.request.airspace.wind.open_meteo") is None
