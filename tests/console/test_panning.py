"""Panning changes no plan; a customer is moved by the handle of a selected one."""

import json
import random
from collections.abc import Callable, Iterator
from itertools import pairwise

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.console.conftest import opening
from tests.console.steps import (
    awaited, idle, open_example, open_file, place_of, planned, state,
)
from tests.console.test_hands import bar_of, hands, told, tours
from tests.console.test_speed import large_problem
from tests.seeds import often

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

__all__ = ["hands"]

DRAGS, COUNT = often(20), 300
Stroke = Callable[[list[tuple[float, float]]], None]

POSITION = """() => {
  const place = (one) => one.getBoundingClientRect();
  const pane = place(document.querySelector('.leaflet-map-pane'));
  return [pane.left, pane.top];
}"""


def by_mouse(page: Page) -> Stroke:
    """Return what drags with the mouse from place to place."""
    def stroke(places: list[tuple[float, float]]) -> None:
        page.mouse.move(*places[0])
        page.mouse.down()
        for place in places[1:]:
            page.mouse.move(*place, steps=3)
        page.mouse.up()

    return stroke


def by_finger(page: Page) -> Stroke:
    """Return what drags with a finger from place to place."""
    session = page.context.new_cdp_session(page)

    def touch(kind: str, *places: tuple[float, float]) -> None:
        session.send("Input.dispatchTouchEvent",
                     {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in places]})

    def stroke(places: list[tuple[float, float]]) -> None:
        touch("touchStart", places[0])
        for (x, y), (to_x, to_y) in pairwise(places):
            for step in (0.25, 0.5, 0.75, 1):
                touch("touchMove", (x + (to_x - x) * step, y + (to_y - y) * step))
        touch("touchEnd")

    return stroke


def random_drags(page: Page, selector: str, stroke: Stroke) -> int:
    """Drag often within an element; return how often the map stood elsewhere after it."""
    page.locator(selector).scroll_into_view_if_needed()
    box = page.locator(selector).bounding_box()
    assert box is not None
    rng = random.Random(7)
    moved = 0
    for _ in range(DRAGS):
        ends = [(box["x"] + rng.uniform(0.2, 0.8) * box["width"],
                 box["y"] + rng.uniform(0.25, 0.75) * box["height"]) for _ in range(2)]
        before = page.evaluate(POSITION)
        stroke(ends)
        moved += page.evaluate(POSITION) != before
    return moved


def plan_shown(page: Page) -> str:
    """Return which plan is shown, its routes, and what was done by hand."""
    return str(page.evaluate("""async () => {
      const { shown, plans, steps, request } = (await loaded(`store.js`)).store.get();
      const routes = plans.map(({ plan }) => plan.routes);
      return JSON.stringify([shown, routes, steps, request.customers]);
    }"""))


@pytest.fixture(scope="module")
def crowd(browser: Browser, service: str) -> Iterator[Page]:
    """Return a console with three hundred customers planned."""
    with opening(browser) as opener:
        page = opener(service, has_touch=True)
        idle(page)
        problem = large_problem(COUNT) | {"options": {"time_limit": 0}}
        open_file(page, "large.json", json.dumps(problem))
        planned(page, f"{COUNT:,} of {COUNT:,} served")
        yield page


@pytest.mark.parametrize(("width", "height", "way"), [
    (1440, 900, by_mouse), (1024, 768, by_mouse), (390, 844, by_finger)])
def test_panning_among_many_customers_changes_nothing(
        crowd: Page, width: int, height: int, way: Callable[[Page], Stroke]) -> None:
    before = plan_shown(crowd)
    stroke = way(crowd)
    crowd.set_viewport_size({"width": width, "height": height})
    grip = crowd.get_by_role("button", name="Height of the panel")
    if width < 700:
        grip.press("ArrowDown")
    assert random_drags(crowd, ".map", stroke) > DRAGS / 2
    for _ in range(2 if width < 700 else 0):
        grip.press("ArrowUp")
    crowd.get_by_role("button", name="Zoom into the timeline").click()
    random_drags(crowd, ".rows canvas", stroke)
    assert plan_shown(crowd) == before
    assert state(crowd, "state.judging") is None


def handle_of(page: Page, key: str) -> tuple[float, float]:
    """Return where the handle of a customer is, who is selected with it."""
    page.evaluate("""async (key) => {
      const { select } = await loaded(`actions.js`);
      select(key);
    }""", key)
    box = page.locator(".map-handle span").bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@pytest.mark.parametrize("way", [by_mouse, by_finger])
def test_a_handle_moves_a_selected_customer_by_mouse_or_finger(
        hands: Page, way: Callable[[Page], Stroke]) -> None:
    hands.mouse.move(1, 1)
    (left, top), (right, bottom) = place_of(hands, "c:D"), place_of(hands, "c:E")
    leg = ((left + right) / 2, (top + bottom) / 2)
    way(hands)([handle_of(hands, "c:A"), leg])
    told(hands, "A to truck-2, after D")
    assert tours(hands) == ["BC", "DAEF"]
    hands.keyboard.press("u")
    assert tours(hands) == ["ABC", "DEF"]
    hands.keyboard.press("Escape")
    expect(hands.locator(".map-handle")).to_have_count(0)


def test_a_handle_is_still_there_after_a_click_on_it(hands: Page) -> None:
    hands.mouse.click(*handle_of(hands, "c:A"))
    expect(hands.locator(".map-handle span")).to_be_visible()
    assert state(hands, "state.selection") == "c:A"


def test_a_drag_by_the_handle_is_given_up_with_escape(hands: Page) -> None:
    x, y = place_of(hands, "c:E")
    hands.mouse.move(*handle_of(hands, "c:A"))
    hands.mouse.down()
    hands.mouse.move(x, y, steps=4)
    expect(hands.locator(".map-handle .held")).to_have_count(1)
    hands.keyboard.press("Escape")
    hands.mouse.up()
    assert tours(hands) == ["ABC", "DEF"]


def test_a_bar_moves_its_customer_once_that_is_selected(hands: Page) -> None:
    stroke = by_mouse(hands)
    x, y = bar_of(hands, "c:F")
    stroke([bar_of(hands, "c:B"), (x + 30, y)])
    assert state(hands, "state.judging") is None
    assert tours(hands) == ["ABC", "DEF"]
    hands.mouse.click(*bar_of(hands, "c:B"))
    assert state(hands, "state.selection") == "c:B"
    stroke([bar_of(hands, "c:B"), (x + 30, y)])
    told(hands, "B to truck-2, after F")


def test_a_finger_gives_a_customer_another_place_by_the_handle(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, viewport={"width": 700, "height": 844}, has_touch=True)
    open_example(page, "smallest")
    page.get_by_role("button", name="Draw", exact=True).tap()
    page.get_by_role("button", name="Move", exact=True).tap()
    before = state(page, "state.request.customers.0.location")
    page.touchscreen.tap(*place_of(page, "c:A"))
    assert state(page, "state.selection") == "c:A"
    assert state(page, "state.request.customers.0.location") == before
    x, y = handle_of(page, "c:A")
    by_finger(page)([(x, y), (x - 60, y + 30)])
    after = state(page, "state.request.customers.0.location")
    assert after[0] < before[0]
    assert after[1] < before[1]


def test_a_map_that_is_closed_before_its_next_frame_draws_no_more(page: Page) -> None:
    """`page` fails its test if the frame that was asked for finds no canvas."""
    drawn = awaited(page, """async () => {
      const { MapView } = await loaded(`map/view.js`);
      const element = document.body.appendChild(document.createElement('div'));
      element.style.cssText = 'width: 200px; height: 200px';
      const nothing = () => {};
      const { map, resizes, destroy } = new MapView(element, {
        geographic: false, config: {}, planarUnit: 1, onHover: nothing, onSelect: nothing,
      });
      const line = window.L.polyline([[0, 0], [1, 1]]).addTo(map);
      map.setView([1, 1], 3, { animate: false }); // draws at once what a frame was asked for
      const isDrawn = map.hasLayer(line);
      destroy.call({ map, resizes });
      for (const _ of [1, 2]) await new Promise(requestAnimationFrame);
      return isDrawn;
    }""")
    assert drawn
