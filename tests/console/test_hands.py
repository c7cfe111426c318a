"""A plan is changed by hand: stops are moved, judged at once, taken back, locked and improved."""

import json
from typing import Any

import httpx
import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import open_file, open_tab, place_of, planned, state
from tests.console.test_everyone import findings
from tests.console.test_keeping import edit, first_customer
from tests.conftest import PATIENCE

pytestmark = pytest.mark.slow

PLACES = {"A": [2, 2], "B": [4, 2], "C": [6, 2], "D": [2, -2], "E": [4, -2], "F": [6, -2]}
PROBLEM: dict[str, Any] = {
    "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
    "customers": [{"id": name, "location": place, "demand": [1], "service_duration": 300}
                  for name, place in PLACES.items()],
    "fleet": [{"id": "truck", "count": 3, "capacity": [4], "speed_kmh": 60}],
    "options": {"time_limit": 0}}
SOLVER = {"policy": "attention", "decoding": "greedy", "seed": 0, "start": "policy",
          "decoded_cost": 0, "final_cost": 0, "search_iterations": 0, "threads": 1,
          "deterministic": True,
          "elapsed": dict.fromkeys(("validate", "decode", "search", "check", "total"), 0)}


def reply_of(service: str, *tours: str) -> dict[str, Any]:
    """Return a plan in which trucks serve these customers in this order, as `POST /plan` would."""
    hub = {"kind": "depot", "id": "hub"}
    routes = [{"vehicle": f"truck-{number}", "type": "truck", "trips": [
        {"stops": [hub, *({"kind": "customer", "id": name} for name in tour), hub]}]}
        for number, tour in enumerate(tours, 1)]
    told = httpx.post(f"{service}/check", trust_env=False, timeout=PATIENCE,
                      json={"problem": PROBLEM, "plan": {"routes": routes}}).json()
    assert told["feasible"]
    return {"status": "complete", "unassigned": [], "solver": SOLVER,
            **{name: told[name] for name in ("cost", "routes", "summary")}}


@pytest.fixture
def hands(console: Page, service: str) -> Page:
    """Return the console with a plan of two trucks, its routes shown."""
    reply = reply_of(service, "ABC", "DEF")
    console.route("**/plan", lambda route: route.fulfill(json=reply), times=1)
    open_file(console, "six.json", json.dumps(PROBLEM))
    planned(console, "6 of 6 served")
    open_tab(console, "routes")
    return console


def tours(page: Page) -> list[str]:
    """Return whom each truck of the plan that is shown serves, in order."""
    shown = state(page, "state.shown")
    (entry,) = [each for each in state(page, "state.plans") if each["number"] == shown]
    return ["".join(stop["id"] for stop in trip["stops"] if stop["kind"] == "customer")
            for route in entry["plan"]["routes"] for trip in route["trips"]]


def told(page: Page, text: str) -> None:
    """Wait until it is told what a change did."""
    expect(page.locator("#hand-outcome")).to_contain_text(text)


def test_stops_are_moved_by_keys_and_buttons_and_taken_back(hands: Page) -> None:
    hands.get_by_role("button", name="Move A", exact=True).focus()
    hands.keyboard.press("ArrowDown")
    told(hands, "A to truck-1, after B: +")
    assert tours(hands) == ["BAC", "DEF"]
    expect(hands.get_by_role("button", name="Move A", exact=True)).to_be_focused()
    hands.get_by_role("button", name="A", exact=True).click()
    hands.get_by_label("Give A to").select_option(label="truck-2")
    told(hands, "A to truck-2")
    expect(hands.locator(".result-line")).to_contain_text("6 of 6 served")
    assert tours(hands) == ["BC", "DAEF"]
    assert findings(hands, ".panel") == []
    hands.keyboard.press("u")
    hands.keyboard.press("u")
    assert tours(hands) == ["ABC", "DEF"]
    hands.keyboard.press("y")
    assert tours(hands) == ["BAC", "DEF"]


def test_a_change_made_again_leaves_edits_undone(hands: Page) -> None:
    hands.get_by_role("button", name="Move A", exact=True).focus()
    hands.keyboard.press("ArrowDown")
    told(hands, "A to truck-1, after B: +")
    edit(hands, "edited")
    hands.keyboard.press("u")
    hands.keyboard.press("u")
    assert tours(hands) == ["ABC", "DEF"]
    hands.keyboard.press("y")
    assert tours(hands) == ["BAC", "DEF"]
    assert first_customer(hands) == "A"
    hands.keyboard.press("y")
    assert first_customer(hands) == "edited"


def test_rules_that_a_change_breaks_are_told_and_kept(hands: Page) -> None:
    for name in "AB":
        hands.get_by_role("button", name=f"Move {name}", exact=True).hover()
        hands.mouse.down()
        target = hands.locator("tr[data-key='c:D']").bounding_box()
        assert target is not None
        hands.mouse.move(target["x"] + 12, target["y"] + 2, steps=4)
        hands.mouse.up()
        told(hands, f"{name} to truck-2")
    assert tours(hands) == ["C", "ABDEF"]
    bar = hands.get_by_role("region", name="Changes by hand")
    expect(bar).to_contain_text("Breaks 1 rule")
    expect(bar).to_contain_text("truck-2: load 5 exceeds 4.")
    assert findings(hands, ".panel") == []


def bar_of(page: Page, key: str) -> tuple[float, float]:
    """Return where the timeline shows the service of a customer."""
    x, y = page.evaluate("""async (key) => {
      const module = (path) => loaded(`${path}`);
      const { indexOf, shownPlan } = await module('actions.js');
      const { spanOf } = await module('core/plan.js');
      const { scaleOf } = await module('timeline/draw.js');
      const { store } = await module('store.js');
      const index = indexOf(shownPlan(store.get()));
      const halt = index.halts.get(key);
      const canvas = document.querySelector('.rows canvas').getBoundingClientRect();
      const [from, until] = spanOf(index);
      const edge = (until - from) * 0.01;
      const box = document.querySelector('.rows');
      const { x } = scaleOf([from - edge, until + edge], box.clientWidth);
      const row = 20 + 24 * halt.vehicle.index + 12;
      return [canvas.left + x((halt.serviceStart + halt.departure) / 2), canvas.top + row];
    }""", key)
    return x, y


def test_the_best_places_of_a_new_customer_are_a_click_away(hands: Page) -> None:
    hands.get_by_role("button", name="Draw", exact=True).click()
    hands.get_by_role("button", name="Best places", exact=True).click()
    (left, top), (right, bottom) = place_of(hands, "c:B"), place_of(hands, "c:C")
    hands.mouse.click((left + right) / 2, (top + bottom) / 2 - 40)
    bar = hands.get_by_role("region", name="Changes by hand")
    expect(bar.get_by_role("listitem")).to_have_count(3)
    expect(bar.get_by_role("listitem").first).to_contain_text("truck-1 after B")
    assert findings(hands, ".panel") == []
    bar.get_by_role("button", name="Take truck-1, after B").click()
    told(hands, "customer-7 to truck-1: +")
    expect(hands.locator(".result-line")).to_contain_text("7 of 7 served")
    hands.keyboard.press("Escape")
    hands.keyboard.press("u")
    expect(hands.locator(".result-line")).to_contain_text("6 of 6 served")
    assert len(state(hands, "state.request.customers")) == 6


def test_who_is_locked_stays_where_the_plan_is_improved(hands: Page) -> None:
    hands.get_by_role("button", name="A", exact=True).click()
    hands.get_by_label("Give A to").select_option(label="truck-2")
    told(hands, "A to truck-2")
    hands.get_by_role("button", name="Lock", exact=True).click()
    hands.get_by_role("button", name="Lock the customers of truck-1").click()
    expect(hands.locator("tr[data-key='c:A']")).to_contain_text("locked")
    with hands.expect_response("**/plan") as answer:
        hands.get_by_role("button", name="Improve around this").click()
    assert answer.value.status == 200, answer.value.text()
    body = answer.value.request.post_data_json
    assert body is not None
    asked = body["replan"]
    assert (asked["pinned"], len(asked["plan"]["routes"])) == (["A", "B", "C"], 2)
    assert asked["keep_order"] is True
    expect(hands.get_by_role("region", name="Changes by hand")).to_have_count(0)
    assert sorted("".join(sorted(tour)) for tour in tours(hands)) == ["ADEF", "BC"]
