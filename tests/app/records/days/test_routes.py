"""Days told over HTTP, and the plans that follow."""

from collections.abc import Iterator

import httpx
import pytest

from app.serving.settings import Settings
from tests.app.conftest import SearchingPlanner, ready, serving
from tests.app.records.days.living import (
    PROBLEM, begun, clock, order, plan_of, served_by, standing, told,
)

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """Return a client of a service with a database of this module's own."""
    settings = Settings(data_dir=tmp_path_factory.mktemp("days"), drain_seconds=0)
    with serving(SearchingPlanner(), settings) as client:
        yield ready(client)


def test_orders_come_in_and_are_cancelled(service: httpx.Client) -> None:
    day = begun(service)
    assert set(served_by(plan_of(service, day))) == set("ABCDEF")
    told(service, day, clock(), order("G", 1, 1), {"kind": "order.cancelled", "order": "F"}, at=10)
    assert set(served_by(plan_of(service, day))) == set("ABCDEG")
    assert standing(service, day).now == 10
    told(service, day, {"kind": "order.changed", "customer": {
        **PROBLEM["customers"][0], "demand": [2]}}, at=20)
    plan = plan_of(service, day)
    assert [trip["load"] for route in plan["routes"] for trip in route["trips"]
            if any(stop["id"] == "A" for stop in trip["stops"])] == [[2]]
    checked = service.post("/check", json={"problem": {**PROBLEM, "customers": [
        *({**each, "demand": [2]} if each["id"] == "A" else each
          for each in PROBLEM["customers"] if each["id"] != "F"),
        order("G", 1, 1)["customer"]]}, "plan": plan}).json()
    assert checked["feasible"], checked
