"""Prices of the plan as a whole, over HTTP."""

from typing import Any

import httpx
import pytest
from tests.app.plans.asking import planned
from tests.app.plans.test_hubs import searched
from tests.app.plans.test_routes import errors_of

Request = dict[str, Any]


def street(fairness: Request | None) -> Request:
    """Return a request of six customers beside each other, far from the depot."""
    return {"depots": [{"id": "hub", "location": [0, 0]}], "planar_unit": 1000,
            "customers": [{"id": str(number), "location": [8, number / 10], "demand": [1]}
                          for number in range(6)],
            "fleet": [{"id": "van", "count": 2, "capacity": [5]}],
            "options": {"search_iterations": 300, "time_limit": 60},
            **({} if fairness is None else {"fairness": fairness})}


def stops_of(plan: Request) -> list[int]:
    """Return how many customers each vehicle serves."""
    return sorted(len(route["trips"][0]["stops"]) - 2 for route in plan["routes"])


@pytest.mark.parametrize(("measure", "cost"), [("stops", 5), ("load", 5), ("duration", 500)])
def test_work_is_shared_at_a_price(client: httpx.Client, searching: httpx.Client, measure: str,
                                   cost: float) -> None:
    plan = searched(client, searching, street({"balance": {"measure": measure, "cost": cost}}))
    assert stops_of(plan) == [3, 3]
    assert 0 <= plan["cost"]["balance"] < 1
    alone = sum(route["cost"] for route in plan["routes"])
    assert plan["cost"]["total"] == pytest.approx(alone + plan["cost"]["balance"])


def test_the_latest_end_has_a_price(client: httpx.Client) -> None:
    plan = planned(client, street({"makespan_cost_per_hour": 36}))
    assert plan["cost"]["makespan"] == pytest.approx(plan["summary"]["makespan"] / 100)
    free = planned(client, street(None))
    assert free["cost"]["makespan"] == free["cost"]["balance"] == 0


def test_a_day_under_way_is_not_shared_fairly_yet(client: httpx.Client) -> None:
    plan = planned(client, street(None))
    request = street({"makespan_cost_per_hour": 1}) | {"replan": {"plan": plan, "freeze_before": 5}}
    assert errors_of(client, request) == {("FAIRNESS_REPLANNED", "$.fairness")}
