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


@pytest.mark.parametrize(("least", "customers", "used", "lacking"), [
    (0, 6, 1, 0), (3, 6, 3, 0), (3, 2, 2, 0), (3, 1, 1, 0)])
def test_at_least_so_many_vehicles_are_used(client: httpx.Client, searching: httpx.Client,
                                            least: int, customers: int, used: int,
                                            lacking: int) -> None:
    request = street({"min_vehicles": least}) | {"fleet": [
        {"id": "van", "count": 3, "capacity": [9], "costs": {"fixed": 40, "per_km": 1}}]}
    request["customers"] = request["customers"][:customers]
    plan = searched(client, searching, request)
    assert (plan["summary"]["vehicles"], plan["summary"]["vehicles_lacking"]) == (used, lacking)
    assert plan["cost"]["too_few_vehicles"] == 0


def test_a_shipment_and_a_customer_with_two_places_ask_for_one_vehicle_each(
        searching: httpx.Client) -> None:
    request = street({"min_vehicles": 3})
    request["customers"] = [{"id": "A", "location": [8, 0], "demand": [1], "alternatives": [
        {"id": "locker", "location": [2, 0]}, {"id": "shop", "location": [3, 0]}]}]
    request["shipments"] = [{"id": "s", "amount": [1], "pickup": {"location": [1, 0]},
                             "delivery": {"location": [2, 0]}}]
    request["fleet"][0]["count"] = 3
    plan = planned(searching, request)
    assert (plan["summary"]["vehicles"], plan["summary"]["vehicles_lacking"]) == (2, 0)
    assert plan["cost"]["too_few_vehicles"] == 0


def test_vehicles_that_lack_are_told_where_no_plan_uses_as_many(client: httpx.Client) -> None:
    request = street({"min_vehicles": 2})
    request["fleet"].append({"id": "truck", "count": 1, "capacity": [5]})
    for customer in request["customers"]:
        customer["vehicles"] = {"allowed": ["truck"]}
    plan = planned(client, request)
    assert (plan["summary"]["served"], plan["summary"]["vehicles"]) == (5, 1)
    assert plan["summary"]["vehicles_lacking"] == 1
    assert 0 < plan["cost"]["too_few_vehicles"] < plan["cost"]["unassigned"]
    request["fairness"]["min_vehicles"] = 4
    assert errors_of(client, request) == {("TOO_FEW_VEHICLES", "$.fairness.min_vehicles")}


@pytest.mark.parametrize(("least", "used"), [(0, 2), (3, 3)])
def test_what_was_done_counts_on_a_day_under_way(client: httpx.Client, searching: httpx.Client,
                                                 least: int, used: int) -> None:
    request = street({"balance": {"measure": "stops", "cost": 2}, "min_vehicles": least})
    request["fleet"] = [{"id": "van", "count": 3, "capacity": [9], "costs": {"fixed": 99}}]
    plan = searched(client, searching, request | {"fairness": {}})
    assert stops_of(plan) == [6]
    begun = plan["routes"][0]["trips"][0]["stops"][0]["departure"] + 1
    request["customers"] += [{"id": f"new {number}", "location": [-8, number], "demand": [1]}
                             for number in range(4)]
    request["replan"] = {"plan": plan, "freeze_before": begun}
    later = planned(searching, request)
    assert stops_of(later) == {2: [4, 6], 3: [2, 2, 6]}[used]
    assert (later["summary"]["vehicles"], later["summary"]["vehicles_lacking"]) == (used, 0)
    assert later["cost"]["balance"] == pytest.approx(2 * {2: 2 / 5, 3: 32 / 10}[used])
