"""Who is served late stands out on the map."""

import json

import pytest
from playwright.sync_api import Page

from tests.console.steps import awaited, open_file, planned

pytestmark = pytest.mark.slow

RINGED = """async () => {
  const load = (path) => loaded(`${path}.js`);
  const [{ store }, { indexOf, shownPlan }, { customerMarks }] = await Promise.all(
    ['store', 'actions', 'map/layers'].map(load));
  const entry = shownPlan(store.get());
  const marks = customerMarks(entry.request, indexOf(entry), new Map(), false);
  return marks.filter(({ base }) => base.color !== '#ffffff').map(({ key }) => key);
}"""
"""Keys of customers whose marks have a ring of another colour than the ground."""


def test_who_is_late_has_a_red_ring(page: Page) -> None:
    window = {"latest": 60, "late_cost_per_hour": 1}
    open_file(page, "day.json", json.dumps({
        "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": "late", "location": [6, 8], "demand": [1], "time_window": window},
                      {"id": "in time", "location": [3, 4], "demand": [1]}],
        "fleet": [{"id": "van", "count": 1, "capacity": [5], "speed_kmh": 60}],
        "options": {"search_iterations": 100}}))
    page.get_by_role("button", name="Plan", exact=True).click()
    planned(page, "2 of 2")
    assert awaited(page, RINGED) == ["c:late"]
