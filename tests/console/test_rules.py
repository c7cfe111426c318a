"""The rules of a working day, stated in the form as people do, sent and seen in the plan."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.console.steps import open_file, open_tab, planned, show_rules, state
from tests.console.test_everyone import findings

pytestmark = [pytest.mark.slow, pytest.mark.one_page, pytest.mark.thorough]

PLACES = {"A": [6, 1], "B": [5, -2], "C": [-4, 3], "D": [-5, -1], "E": [0, 6]}

REQUEST: dict[str, Any] = {
    "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
    "customers": [{"id": name, "location": place, "demand": [1]}
                  for name, place in PLACES.items()],
    "fleet": [{"id": "van", "count": 3, "capacity": [9],
               "costs": {"fixed": 5, "per_km": 1, "per_hour": 20}}],
    "options": {"time_limit": 60, "search_iterations": 500}}


def fill(field: Locator, text: str) -> None:
    """Write in a field as people do, and leave it. In place."""
    field.fill(text)
    field.press("Enter")


def state_relations(page: Page) -> None:
    """Tick two to go together, and add an order and two who are kept apart."""
    panel = page.locator(".panel")
    for name in ("A", "C"):
        panel.get_by_label(f"Pick {name}", exact=True).check()
    panel.get_by_role("button", name="Go together").click()
    panel.locator("summary", has_text="Who goes with whom").click()
    for _ in range(2):
        panel.get_by_role("button", name="Add a relation").click()
    order, apart = panel.locator("fieldset.list .entry").all()[1:3]
    order.get_by_label("Kind").select_option("in this order")
    expect(order.get_by_label("Scope")).to_have_count(0)
    fill(order.get_by_label("Customers"), "C, A")
    fill(order.get_by_label("Min lag"), "1:30")
    fill(order.get_by_label("Max lag"), "2:00")
    apart.get_by_label("Kind").select_option("apart")
    expect(apart.get_by_label("Min lag")).to_have_count(0)
    fill(apart.get_by_label("Customers"), "B, A")
    panel.get_by_role("button", name="Add to goods kept apart").click()
    goods = panel.locator("fieldset.list", has_text="Goods kept apart").locator(".entry").last
    fill(goods.get_by_label("Goods"), "food, paint")
    goods.get_by_label("Scope").select_option("vehicle")


def state_customers(page: Page) -> None:
    """Give one another place, one a preferred vehicle, and add a shipment."""
    panel = page.locator(".panel")
    panel.get_by_role("button", name="D", exact=True).click()
    show_rules(page)
    panel.get_by_role("button", name="Add to other places").click()
    other = panel.locator("fieldset.list", has_text="Other places").locator(".entry")
    expect(other.get_by_label("Location", exact=True)).to_have_value("-5, -1")
    expect(other.get_by_label("Location index")).to_have_count(0)
    fill(other.get_by_label("Location", exact=True), "-1, 1")
    fill(other.get_by_label("Cost", exact=True), "0.5")
    panel.get_by_role("button", name="E", exact=True).click()
    show_rules(page)
    costs = panel.get_by_label("Costs by vehicle")
    costs.fill("van-1: 40\nvan-2: many")
    costs.blur()
    expect(panel.get_by_text("Write lines such as van-1: 5.")).to_be_visible()
    costs.fill("van-1: 40\nvan-2: 40")
    costs.blur()
    panel.locator("summary", has_text="Shipments").click()
    panel.get_by_role("button", name="Add to shipments").click()
    entry = panel.locator("fieldset.list", has_text="Shipments").locator(".entry").first
    for end, place in (("pickup", "2, 2"), ("delivery", "0, 3")):
        fill(entry.locator(f"#field-shipments-0-{end}-location"), place)
    fill(entry.get_by_label("Max time between"), "30 min")


def state_fleet(page: Page) -> None:
    """Give drivers a break and rests, and say what is fair."""
    panel = page.locator(".panel")
    show_rules(page)
    panel.get_by_role("button", name="Add to breaks").click()
    break_ = panel.locator("fieldset.list", has_text="Breaks").locator(".entry")
    fill(break_.get_by_label("Duration"), "20 min")
    fill(break_.get_by_label("Latest"), "0:30")
    break_.get_by_label("Paid").uncheck()
    rules = panel.locator("fieldset.group", has_text="Driving rules").last
    rules.get_by_label("Driving rules").check()
    expect(rules.get_by_label("Preset").locator("option:checked")).to_have_text("EU 561/2006")
    expect(rules.get_by_label("Max driving", exact=True)).to_have_attribute(
        "placeholder", "as ruled")
    fill(rules.get_by_label("Max driving", exact=True), "25 min")
    fill(rules.get_by_label("Break duration"), "15 min")
    fill(rules.get_by_label("Split"), "5 min, 10 min")
    fill(panel.get_by_label("Least number of vehicles"), "3")
    fill(panel.get_by_label("Cost of the latest end"), "6")
    panel.get_by_label("Unequal work").check()
    panel.get_by_label("Measure").select_option("stops")


EXPECTED: dict[str, Any] = {
    "incompatible_goods": [{"goods": ["food", "paint"], "scope": "vehicle"}],
    "relations": [
        {"kind": "together", "customers": ["A", "C"]},
        {"kind": "before", "customers": ["C", "A"], "min_lag": 5400, "max_lag": 7200},
        {"kind": "apart", "customers": ["B", "A"]}],
    "shipments": [{"id": "shipment-1", "amount": [1], "pickup": {"location": [2, 2]},
                   "delivery": {"location": [0, 3]}, "max_time_between": 1800}],
    "fairness": {"min_vehicles": 3, "makespan_cost_per_hour": 6,
                 "balance": {"measure": "stops", "cost": 1}}}


def test_every_rule_is_stated_in_the_form_and_kept_by_the_plan(page: Page) -> None:
    open_file(page, "day.json", json.dumps(REQUEST))
    planned(page, "5 of 5 served")
    open_tab(page, "customers")
    state_relations(page)
    state_customers(page)
    assert findings(page, ".panel") == []
    open_tab(page, "fleet")
    state_fleet(page)
    assert findings(page, ".panel") == []
    with page.expect_request("**/plan") as sent:
        page.get_by_role("button", name="Plan", exact=True).click()
    request: dict[str, Any] = json.loads(sent.value.post_data or "")
    assert {name: request[name] for name in EXPECTED} == EXPECTED
    assert request["customers"][3]["alternatives"] == [
        {"id": "place-1", "location": [-1, 1], "cost": 0.5}]
    assert request["customers"][4]["vehicle_costs"] == {"van-1": 40, "van-2": 40}
    [kind] = request["fleet"]
    assert kind["breaks"] == [{"id": "break-1", "duration": 1200, "start": {"latest": 1800},
                               "after_departure": True, "paid": False}]
    assert kind["driving_rules"] == {"preset": "eu-561", "max_driving": 1500,
                                     "break_duration": 900, "split": [300, 600]}
    planned(page, "7 of 7 served")
    keeps(state(page, "state.plans")[-1]["plan"])
    open_tab(page, "customers")
    panel = page.locator(".panel")
    panel.get_by_label("Pick B", exact=True).check()
    panel.get_by_role("button", name="Cancel 1 order").click()
    assert [len(each["customers"]) for each in state(page, "state.request.relations")] == [2, 2]


def test_a_relation_is_mended_where_it_is_and_turned_into_another(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("422",))
    open_file(page, "day.json", json.dumps(REQUEST))
    planned(page, "5 of 5 served")
    open_tab(page, "customers")
    panel = page.locator(".panel")
    panel.locator("summary", has_text="Who goes with whom").click()
    panel.get_by_role("button", name="Add a relation").click()
    page.get_by_role("button", name="Plan", exact=True).click()
    entry = panel.locator("fieldset.list .entry").last
    expect(entry).to_contain_text("at least 2 needed")
    fill(entry.get_by_label("Customers"), "A, B")
    entry.get_by_label("Kind").select_option("in this order")
    fill(entry.get_by_label("Min lag"), "0:05")
    entry.get_by_label("Kind").select_option("apart")
    expect(entry.get_by_label("Min lag")).to_have_count(0)
    page.get_by_role("button", name="Plan", exact=True).click()
    planned(page, "5 of 5 served")
    assert state(page, "state.request.relations.0") == {"kind": "apart", "customers": ["A", "B"]}


def keeps(plan: dict[str, Any]) -> None:
    """Require that a plan shows each of the rules."""
    stops = {stop["id"]: (route["vehicle"], stop) for route in plan["routes"]
             for trip in route["trips"] for stop in trip["stops"]}
    assert stops["A"][0] == stops["C"][0] != stops["B"][0]
    lag = stops["A"][1]["service_start"] - stops["C"][1]["service_start"]
    assert 5400 <= lag <= 7200
    assert stops["E"][0] == "van-3"
    assert "place-1" in json.dumps(plan)
    assert len(plan["routes"]) == 3
    assert any(stop["kind"] == "break" for _, stop in stops.values())
    kinds = [stop["kind"] for route in plan["routes"] for trip in route["trips"]
             for stop in trip["stops"]]
    assert kinds.count("pickup") == kinds.count("delivery") == 1
    assert plan["cost"]["makespan"] > 0
