"""Every remedy that the service tells is applied and said by the console, and serves the customer.
"""

import json
import re
import subprocess
from typing import Any

import pytest
from playwright.sync_api import Page

from model.counsel.remedy import CLAUSES
from tests.console.steps import STATIC, awaited

pytestmark = pytest.mark.slow


APPLY = """async ([request, number]) => {
  const { applied } = await loaded(`core/remedies.js`);
  const { remedyInWords } = await loaded(`core/remedy-words.js`);
  const plan = async (body) => (await fetch('plan', { method: 'POST', body: JSON.stringify(body),
    headers: { 'Content-Type': 'application/json' } })).json();
  const first = await plan(request);
  const [customer] = first.unassigned;
  const remedy = customer.reasons.find(({ remedies }) => remedies.length).remedies[number];
  const second = await plan(applied(request, remedy.changes));
  return [remedy.text, remedyInWords(remedy, request), second.unassigned];
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


WORDS = """
const { choose } = await import(`${process.argv[1]}/texts.js`);
const { remedyInWords } = await import(`${process.argv[1]}/core/remedy-words.js`);
globalThis.localStorage = { setItem() {} };
await choose(process.argv[2]);
const told = JSON.parse(process.argv[3]).map((remedy) => remedyInWords(remedy, {}));
console.log(JSON.stringify(told));
"""

BY_LIST = {"CAPACITY": [5], "DRONE_CAPACITY": [5], "BREAK_LOAD": [5], "SKILLS": ["lift"]}


@pytest.mark.parametrize("language", ["en", "de"])
def test_every_remedy_has_words(language: str) -> None:
    codes = [limit.upper() for limit in CLAUSES]
    remedies = [{"code": code, "who": "van", "text": "", "suffices": True,
                 "changes": [{"path": "$.fleet[0].x", "to": BY_LIST.get(code, 60)}]}
                for code in codes]
    done = subprocess.run(["node", "--input-type=module", "-e", WORDS, (STATIC / "js").as_uri(),
                           language, json.dumps(remedies)], capture_output=True, text=True)
    words = dict(zip(codes, json.loads(done.stdout), strict=True))
    begin = {"en": "fits if ", "de": "passt, wenn "}[language]
    assert [code for code, said in words.items() if not said.startswith(begin)] == []
    assert len({*words.values()}) == len(words)


def test_another_trip_is_applied_and_serves_the_customer(console: Page) -> None:
    text, words, unassigned = awaited(console, APPLY, [PROBLEMS["one more vehicle"], 1])
    assert (text, words) == ("fits if van could make another trip",) * 2
    assert unassigned == []


@pytest.mark.thorough_after(6)
@pytest.mark.parametrize("words", PROBLEMS)
def test_remedy_is_applied_and_serves_the_customer(console: Page, words: str) -> None:
    text, said, unassigned = awaited(console, APPLY, [PROBLEMS[words], 0])
    assert re.search(words, text)
    assert said.startswith("fits if ")
    assert unassigned == []
