"""Looking at a plan: map, panel and timeline linked; rates, costs, and what was left out."""

import json
import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import (
    EXAMPLES, awaited, idle, open_example, open_file, open_tab, place_of, planned, state,
)

pytestmark = [pytest.mark.slow, pytest.mark.begins_with("table1")]

UNSERVABLE = {
    "planar_unit": 1000,
    "depots": [{"id": "hub", "location": [0, 0]}],
    "customers": [{"id": "near", "location": [1, 1], "demand": [0]},
                  {"id": "heavy", "location": [3, 4], "demand": [30]},
                  {"id": "early", "location": [30, 0], "demand": [0],
                   "time_window": {"latest": 1200}}],
    "fleet": [{"id": "van", "count": 1, "capacity": [20]}],
    # By turns: a machine that is busy has no time for turns in few tenths of a second.
    "options": {"time_limit": 20, "search_iterations": 500},
}


def test_stop_tells_arrival_window_lateness_and_load(console: Page) -> None:
    open_example(console, "drones")
    console.mouse.click(*place_of(console, "c:D"))
    assert state(console, "state.selection") == "c:D"
    details = console.get_by_role("region", name="Details")
    for text in ("Arrival", "until 0:15", "Served by", re.compile("Load on leaving|Payload")):
        expect(details).to_contain_text(text)
    open_tab(console, "routes")
    expect(console.locator("tr[data-key='c:D']")).to_have_attribute("data-selected", "true")


def test_late_stop_is_marked(console: Page) -> None:
    request = json.loads((EXAMPLES / "drones.json").read_text("utf-8"))
    request["customers"][3]["time_window"] = {"latest": 60, "late_cost_per_hour": 1}
    open_file(console, "late.json", json.dumps(request))
    planned(console, "4 of 4 served")
    open_tab(console, "routes")
    for vehicle in console.locator("details.card:not([open]) > summary").all():
        vehicle.click()
    expect(console.locator("tr.late[data-key='c:D'] .lateness")).to_contain_text("min")


def test_map_panel_and_timeline_are_linked_both_ways(page: Page) -> None:
    idle(page)
    page.mouse.move(*place_of(page, "c:50"))
    assert state(page, "state.hover") == "c:50"
    page.mouse.move(5, 5)
    canvas = page.locator(".rows canvas")
    box = canvas.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 40, box["y"] + 30)
    assert state(page, "state.hover") == "v:0"
    page.mouse.click(box["x"] + 40, box["y"] + 30)
    assert state(page, "state.selection") == "v:0"
    open_tab(page, "routes")
    page.locator("tr[data-key='t:1/0'] button").click()
    assert state(page, "state.selection") == "t:1/0"
    expect(page.locator(".stop-mark span").first).to_be_visible()


BESIDE_DETAILS = """() => {
  const { left } = document.querySelector('.details').getBoundingClientRect();
  return [...document.querySelectorAll('.stop-mark span')].every((stop) =>
    stop.getBoundingClientRect().right <= left);
}"""
"""Tells whether no number of a stop lies below what is told of its trip."""


@pytest.mark.thorough
def test_stops_have_numbers_where_there_is_room_and_all_of_whose_is_selected(page: Page) -> None:
    open_example(page, "smallest")
    numbers = page.locator(".stop-mark span")
    expect(numbers).to_have_text(["1", "2"])
    open_example(page, "table1")
    stops = state(page, "state.plans.0.plan.routes.0.trips.0.stops.length")
    page.evaluate("async () => (await loaded('actions.js')).select('t:0/0')")
    expect(numbers).to_have_text([str(number) for number in range(1, stops - 1)])
    page.wait_for_function(BESIDE_DETAILS)


@pytest.mark.thorough
def test_timeline_is_no_higher_than_its_rows(page: Page) -> None:
    open_example(page, "smallest")
    few = page.locator(".timeline").bounding_box()
    open_example(page, "table1")
    idle(page)
    many = page.locator(".timeline").bounding_box()
    assert few is not None
    assert many is not None
    assert few["height"] < many["height"] <= 220


def test_rates_are_shown_by_trip(console: Page) -> None:
    open_example(console, "hetero_day")
    open_tab(console, "routes")
    trips = state(console, "state.plans.0.plan.summary.trips")
    expect(console.get_by_role("img", name="Load rate")).to_have_count(trips)
    expect(console.get_by_role("img", name="Working rate")).to_have_count(trips)


def test_costs_are_shown_by_term_and_add_up(console: Page) -> None:
    open_example(console, "hetero_day")
    open_tab(console, "costs")
    rows = console.locator(".tab table").first.locator("tbody tr").all()
    values = [float(row.locator("td").first.inner_text().replace(",", "")) for row in rows]
    assert len(values) > 2
    assert abs(sum(values[:-1]) - values[-1]) < 0.05
    expect(console.get_by_text("Cost by vehicle")).to_be_visible()


def test_remedies_are_applied_with_one_click(console: Page) -> None:
    open_file(console, "hard.json", json.dumps(UNSERVABLE))
    planned(console, "1 of 3 served")
    open_tab(console, "unassigned")
    expect(console.get_by_text("Its demand of 30 exceeds the capacity of 20.")).to_be_visible()
    console.get_by_role("button", name="Apply and plan again: fits if capacity").click()
    planned(console, "2 of 3 served")
    console.get_by_role("button", name="Apply and plan again: fits if its window").click()
    planned(console, "3 of 3 served")
    expect(console.get_by_text("Every customer is served.")).to_be_visible()
    assert state(console, "state.request.fleet.0.capacity") == [30]
    assert state(console, "state.request.customers.2.time_window.latest") > 1200
    for _ in range(2):
        console.keyboard.press("Control+z")
    assert state(console, "state.request.fleet") == UNSERVABLE["fleet"]
    assert state(console, "state.request.customers") == UNSERVABLE["customers"]
    planned(console, "1 of 3 served")
    expect(console.locator(".result-line .stale")).to_have_count(0)
    console.keyboard.press("Control+y")
    planned(console, "2 of 3 served")


def test_flights_are_drawn_as_they_are_measured(console: Page) -> None:
    """A drone flies around a no-fly area, and the line on the map is as long as the reply says."""
    request = json.loads((EXAMPLES / "drones.json").read_text("utf-8"))
    request["customers"] = [{"id": "far", "location": [8, 0], "demand": [1],
                             "served_by": "drone"}]
    request["airspace"] = {"no_fly": [[[3, -2], [5, -3], [5, 4], [3, 3]]]}
    open_file(console, "around.json", json.dumps(request))
    planned(console, "1 of 1 served")
    drawn, measured = console.evaluate("""async () => {
      const load = (path) => loaded(`${path}.js`);
      const [{ store }, { indexOf, shownPlan }] = await Promise.all(['store', 'actions'].map(load));
      const [{ flownLegs }, { lengthOf }] = await Promise.all(
        ['core/flights', 'core/geometry'].map(load));
      const index = indexOf(shownPlan(store.get()));
      const [sortie] = index.vehicles[0].trips[0].sorties;
      const legs = flownLegs(sortie);
      return [legs.reduce((sum, leg) => sum + lengthOf(leg), 0) * 1000, sortie.reply.distance];
    }""")
    assert abs(drawn - measured) < 1
    assert measured > 16_500


@pytest.mark.thorough
def test_windows_and_lateness_of_a_city_are_on_the_timeline(console: Page) -> None:
    open_example(console, "city_day")
    windows = console.evaluate("""async () => {
      const load = (path) => loaded(`${path}.js`);
      const [{ store }, { indexOf, shownPlan }, { timelineRows, rowWindows }] =
        await Promise.all(['store', 'actions', 'core/timeline'].map(load));
      return timelineRows(indexOf(shownPlan(store.get()))).flatMap(rowWindows).length;
    }""")
    served_with_window = [customer for customer in state(console, "state.request.customers")
                          if "time_window" in customer]
    assert windows == len(served_with_window)


@pytest.mark.thorough
def test_problem_of_matrices_alone_is_planned_without_a_map(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service)
    idle(page)
    request = {"depots": [{"id": "hub", "location_index": 0}],
               "customers": [{"id": "A", "location_index": 1, "demand": [1]}],
               "fleet": [{"id": "van", "count": 1, "capacity": [2]}],
               "matrices": {"truck": {"durations": [[0, 600], [600, 0]],
                                      "distances": [[0, 5000], [5000, 0]]}},
               "options": {"time_limit": 0.1}}
    open_file(page, "matrix.json", json.dumps(request))
    planned(page, "1 of 1 served")
    expect(page.get_by_text("there is no map")).to_be_visible()


STRENGTH = """async (key) => {
  const { select } = await loaded(`actions.js`);
  select(key);
  await new Promise(requestAnimationFrame);
  const handle = () => document.querySelector('.map-handle');
  for (let frame = 0; frame === 0 || (!handle() && frame < 1000); frame++) {
    await new Promise(requestAnimationFrame);
  }
  const { left: x, top: y } = handle().getBoundingClientRect();
  const canvas = document.querySelector('.leaflet-overlay-pane canvas');
  const { left, top, width } = canvas.getBoundingClientRect();
  const ratio = canvas.width / width;
  return canvas.getContext('2d').getImageData((x - left) * ratio, (y - top) * ratio, 1, 1).data[3];
}"""
"""Selects a stop and returns how opaque its middle is."""


@pytest.mark.thorough
def test_the_stop_that_is_selected_does_not_step_back_with_other_trips(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("willReadFrequently",))
    open_example(page, "city_day")
    routes = state(page, "state.plans.0.plan.routes")
    # A trip may be from depot to depot, for its drones alone.
    served = [[stop["id"] for trip in route["trips"] for stop in trip["stops"]
               if stop["kind"] == "customer"] for route in routes]
    stops = [names[0] for names in served if names]
    assert stops
    assert [awaited(page, STRENGTH, f"c:{name}") for name in stops] == [255] * len(stops)
