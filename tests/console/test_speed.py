"""Two thousand customers on the map, moved about."""

import json
import random
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import idle, open_file, planned, state, stop_button

pytestmark = [pytest.mark.slow, pytest.mark.begins_with("table1"), pytest.mark.thorough]

MIN_FRAMES_PER_SECOND = 30
"""Where the machine draws twice as many of a hundred customers; else half of those."""

COUNT = 2000
FRAMES = """() => {
  window.frames = [];
  const note = (now) => {
    window.frames.push(now);
    window.frameRequest = requestAnimationFrame(note);
  };
  requestAnimationFrame(note);
}"""


def large_problem(count: int = COUNT) -> dict[str, Any]:
    """Return many customers around a depot."""
    rng = random.Random(4)
    customers = [{"id": f"c{number}", "demand": [rng.randint(1, 20)],
                  "location": [round(rng.gauss(50, 22), 3), round(rng.gauss(50, 22), 3)]}
                 for number in range(count)]
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [50, 50]}],
            "customers": customers, "options": {"time_limit": 1.5},
            "fleet": [{"id": "truck", "count": 80, "capacity": [400],
                       "drones": {"count": 1, "capacity": [5]}}]}


def frames_while_moving(page: Page, is_pressed: bool) -> float:
    """Return the frames a second while the pointer moves over the map."""
    box = page.locator(".map").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    if is_pressed:
        page.mouse.down()
    page.evaluate(FRAMES)
    for step in range(100):
        page.mouse.move(x + 2 * (step % 50), y + (step % 40))
    times = page.evaluate("""() => {
      cancelAnimationFrame(window.frameRequest);
      return window.frames;
    }""")
    page.mouse.up()
    return 1000 * (len(times) - 1) / (times[-1] - times[0])


@pytest.mark.by_clock
def test_two_thousand_customers_are_panned_without_stutter(page: Page) -> None:
    idle(page)
    few = frames_while_moving(page, is_pressed=True)
    open_file(page, "large.json", json.dumps(large_problem()))
    planned(page, f"{COUNT:,} of {COUNT:,} served")
    expect(stop_button(page)).to_have_count(0)
    assert state(page, "state.request.customers.length") == COUNT
    frames = frames_while_moving(page, is_pressed=True)
    assert frames > min(MIN_FRAMES_PER_SECOND, few / 2)
