"""Nothing lies over what is to be read or clicked, and nothing is cut where there is room."""

import json
from collections.abc import Callable
from itertools import combinations
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import EXAMPLES, idle, open_file, open_tab, planned, state

pytestmark = [pytest.mark.slow, pytest.mark.one_page, pytest.mark.thorough]

TABLET = {"width": 1024, "height": 768}
PHONE = {"width": 390, "height": 844}

COVERED = """(element) => {
  const { left, top, width, height } = element.getBoundingClientRect();
  const seen = document.elementFromPoint(left + width / 2, top + height / 2);
  return !(element.contains(seen) || seen?.contains(element));
}"""

BOXES = """(selectors) => [...document.querySelectorAll(selectors)]
  .map((each) => each.getBoundingClientRect()).filter(({ width, height }) => width && height)
  .map(({ left, top, right, bottom }) => [left, top, right, bottom])"""

OVER_MAP = (".draw-bar > button, .map-tools button:not(.menu *), .leaflet-control-zoom, "
            ".scale-bar, .leaflet-control-attribution, .map-legend")


def example(name: str) -> dict[str, Any]:
    """Return the request of an example."""
    return dict(json.loads((EXAMPLES / f"{name}.json").read_text("utf-8")))


def overlapping(page: Page) -> list[tuple[list[float], list[float]]]:
    """Return pairs of what lies over the map one of which lies over the other."""
    return [(one, other) for one, other in combinations(page.evaluate(BOXES, OVER_MAP), 2)
            if one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]]


def test_details_leave_notices_and_the_maps_controls_alone(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("422",), viewport=TABLET)
    idle(page)
    request = example("city_day")
    open_file(page, "city.json", json.dumps(request))
    idle(page)
    page.evaluate("async (id) => (await loaded(`actions.js`)).select(`c:${id}`)",
                  request["customers"][0]["id"])
    expect(page.locator(".details")).to_be_visible()
    assert overlapping(page) == []
    request["customers"][0]["demand"] = [-3, 4]
    request["fleet"][1]["depot"] = "west"
    open_file(page, "wrong.json", json.dumps(request))
    alert = page.get_by_role("alert")
    expect(alert).to_contain_text("Put right 2 things, then plan again.")
    expect(alert).to_contain_text("There is no depot of this name.")
    expect(page.locator(".details")).to_be_visible()
    assert not alert.get_by_role("button", name="Close").evaluate(COVERED)
    alert.get_by_role("button", name="Close").click()


def test_a_hint_on_an_empty_map_is_beside_the_panel(page: Page) -> None:
    page.set_viewport_size(TABLET)
    page.evaluate("""async () => (await loaded(`actions.js`)).openRequest(
      { depots: [], customers: [], fleet: [] }, { name: 'Monday', isSafe: true })""")
    [[left, *_]] = page.evaluate(BOXES, ".map-note")
    [[_, _, right, _]] = page.evaluate(BOXES, ".panel")
    assert left >= right
    page.locator(".panel").get_by_role("button", name="Open").click()
    expect(page.get_by_role("button", name="Open a file")).to_be_visible()
    page.keyboard.press("Escape")


def test_long_names_wrap_and_leave_room_for_figures(
        open_page: Callable[..., Page], service: str) -> None:
    request = example("berlin")
    for customer in request["customers"]:
        customer["id"] = f"Apotheke am Platz {customer['id']}, Hintereingang"
        customer["time_window"] = {"latest": 30600, "late_cost_per_hour": 20}
    request["fleet"][0]["names"] = ["Sprinter Kühlfahrzeug (Frau Wischnewski)"]
    # In German, whose headings are longer.
    page = open_page(service, locale="de")
    idle(page)
    open_file(page, "Long names of a tour on a Monday.json", json.dumps(request))
    planned(page, "40 von 40 bedient")
    open_tab(page, "routes")
    assert state(page, "state.plans.0.plan.cost.lateness") > 0
    for width in (1440, 1024):
        page.set_viewport_size({"width": width, "height": 900})
        [[_, _, right, _], *_] = page.evaluate(BOXES, ".panel details.card")
        cells = page.evaluate(BOXES, ".trip-stops :is(th, td)")
        assert max(cell[2] for cell in cells) <= right
        names = page.evaluate(BOXES, ".trip-stops tbody th")
        assert min(name[2] - name[0] for name in names) >= 120
    page.set_viewport_size(PHONE)
    cut = page.locator(".result-line").evaluate("each => each.scrollWidth > each.clientWidth")
    assert not cut
