"""Every remedy that the service words is understood by the console, and serves the customer."""

import re
from typing import Any

import pytest
from playwright.sync_api import Page

from tests.console.steps import awaited

pytestmark = pytest.mark.slow


APPLY = """async (request) => {
  const { applyRemedy } = await loaded(`core/remedy-changes.js`);
  const plan = async (body) => (await fetch('plan', { method: 'POST', body: JSON.stringify(body),
    headers: { 'Content-Type': 'application/json' } })).json();
  const first = await plan(request);
  const [customer] = first.unassigned;
  const reason = customer.reasons.find(({ remedy }) => remedy);
  const second = await plan(applyRemedy(request, customer.id, reason, customer.kind));
  return [reason.remedy, second.unassigned];
}"""

DRONES = {"count": 1, "capacity": [5]}


def problem(customers: list[dict[str, Any]], **vehicle: Any) -> dict[str, Any]:
    """Return a problem with one type of vehicle."""
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
            "customers": [{"id": f"C{number}", "location": [6, 0], "demand": [5]} | customer
                          for number, customer in enumerate(customers)],
            "fleet": [{"id": "van", "count": 1, "capacity": [20]} | vehicle],
            # Few turns, and time to say why even on a machine that stalls.
            "options": {"time_limit": 60, "search_iterations": 50}}


LAGGING = problem([{"time_window": {"latest": 1200}},
                   {"time_window": {"earliest": 9000, "latest": 9600}}], count=2) | {
    "relations": [{"kind": "before", "customers": ["C0", "C1"], "max_lag": 1800}]}
"""The second is left out: his window opens too long after the first one's."""

PROBLEMS = {
    "one more vehicle": problem([{"demand": [20]}, {"demand": [20]}]),
    "unassigned_cost": problem([{}]) | {"unassigned_cost": 1},
    "had cooled": problem([{"skills": ["cooled"]}]),
    "if capacity": problem([{"demand": [25]}]),
    "drone capacity": problem([{"demand": [9], "served_by": "drone"}], drones=DRONES),
    "endurance": problem([{"served_by": "drone"}], drones=DRONES | {"endurance": 600}),
    "max_range": problem([{"served_by": "drone"}], drones=DRONES | {"max_range": 5000}),
    "without max_wind_kmh": problem([{"served_by": "drone"}], drones=DRONES | {
        "max_wind_kmh": 20}) | {"airspace": {"wind": {"speed_kmh": 30}}},
    "a battery of": problem([{"served_by": "drone"}], drones=DRONES | {
        "energy": {"battery_wh": 10.0, "power": {"cruise_w": 200.0}}}),
    "trips could be": problem([{}], max_trip_distance=9000),
    "window closed": problem([{"time_window": {"latest": 300}}]),
    "shift ended": problem([{}], shift={"latest": 600}),
    "could work": problem([{}], max_working_duration=600),
    "more overtime": problem([{}], max_working_duration=300,
                             overtime={"max_duration": 300, "cost_per_hour": 1}),
    "make 1 stop": problem([{}], max_stops=0),
    "launch 1 sortie": problem([{"served_by": "drone"}], drones=DRONES, max_sorties=0),
    "carried 1 battery": problem([{"served_by": "drone"}], drones=DRONES | {
        "turnaround": {"batteries": 0}}),
    "pick up at any time": problem([{"demand": [0], "pickup": [5]}], pickups="last"),
    "a truck may serve": problem([{"served_by": "drone"}]),
    "a drone may serve": problem([{"served_by": "truck"}], flies=True),
    "longer and if its window": problem([{"time_window": {"latest": 300}}],
                                        max_trip_distance=9000, shift={"latest": 800}),
    "may serve it and if its window": problem([{
        "time_window": {"latest": 300}, "vehicles": {"forbidden": ["van-1"]}}]),
    "max_lag of its orders": LAGGING,
    "max_lag of its orders were": LAGGING | {"relations": [
        LAGGING["relations"][0] | {"same_vehicle": False}]},
    "pickup farm closed": problem([]) | {"shipments": [{
        "id": "S", "delivery": {"location": [7, 0]}, "pickups": [
            {"id": "farm", "location": [3, 0], "amount": [1], "time_window": {"latest": 60}},
            {"id": "mill", "location": [6, 0], "amount": [1], "time_window": {"latest": 120}}]}]},
}


APPLY_OTHER = """async (request) => {
  const { applyRemedy } = await loaded(`core/remedy-changes.js`);
  const { otherReason } = await loaded(`core/remedies.js`);
  const plan = async (body) => (await fetch('plan', { method: 'POST', body: JSON.stringify(body),
    headers: { 'Content-Type': 'application/json' } })).json();
  const first = await plan(request);
  const [customer] = first.unassigned;
  const reason = otherReason(customer.reasons[0]);
  const second = await plan(applyRemedy(request, customer.id, reason));
  return [reason.remedy, second.unassigned];
}"""


def test_another_trip_is_applied_and_serves_the_customer(console: Page) -> None:
    remedy, unassigned = awaited(console, APPLY_OTHER, PROBLEMS["one more vehicle"])
    assert remedy == "fits if van could make another trip"
    assert unassigned == []


@pytest.mark.parametrize("words", PROBLEMS)
def test_remedy_is_applied_and_serves_the_customer(console: Page, words: str) -> None:
    remedy, unassigned = awaited(console, APPLY, PROBLEMS[words])
    assert re.search(words, remedy)
    assert unassigned == []


def test_unknown_remedy_changes_nothing(console: Page) -> None:
    assert console.evaluate("""async () => {
      const { applyRemedy } = await loaded(`core/remedy-changes.js`);
      const request = { fleet: [{ id: 'van' }], customers: [{ id: 'A' }] };
      return applyRemedy(request, 'A', { vehicle_type: 'van', remedy: 'fits on Sundays' });
    }""") is None
