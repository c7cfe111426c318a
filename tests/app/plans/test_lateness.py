"""Chances of being late, in every reply that asks for them."""

from typing import Any

import httpx
import pytest

from tests.app.plans.asking import planned

Request = dict[str, Any]
RISK = {"spread": {"travel": 0.25, "service": 0.3}, "cost_per_expected_late_hour": 60}


@pytest.fixture
def promised(smallest: Request) -> Request:
    """Return two customers of a van, 10 minutes away, the second of whom is promised little room.
    """
    smallest["customers"] = [
        {"id": "A", "location": [0, 10], "demand": [1], "service_duration": 300,
         "time_window": {"earliest": 0, "latest": 800}},
        {"id": "B", "location": [0, 10], "demand": [1],
         "time_window": {"earliest": 900, "latest": 930}}]
    smallest["fleet"][0] |= {"id": "van", "count": 1, "capacity": [5], "speed_kmh": 60}
    smallest["options"] = {"time_limit": 0.2, "lateness_risk": RISK}
    return smallest


def halts(plan: Request) -> dict[str, Request]:
    """Return a plan's customers by their ids."""
    return {halt["id"]: halt["lateness"] for route in plan["routes"] for trip in route["trips"]
            for halt in (*trip["stops"], *(visit for sortie in trip["sorties"]
                                           for visit in sortie["customers"]))
            if halt.get("kind", "customer") == "customer"}


def test_stops_tell_their_chance(service: httpx.Client, promised: Request) -> None:
    plan = planned(service, promised)
    late = halts(plan)

    assert 0 < late["A"]["chance"] < 0.2
    assert late["A"]["earliest"] < 600 < late["A"]["latest"]
    assert 0.3 < late["B"]["chance"] < 0.5
    assert late["B"]["seconds"] == 0
    hours = plan["lateness"]["expected_hours"]
    assert plan["lateness"]["spread"] == RISK["spread"]
    assert plan["cost"]["lateness_risk"] == pytest.approx(60 * hours, abs=1e-5) != 0
    terms = {name: each for name, each in plan["cost"].items() if name != "total"}
    assert plan["cost"]["total"] == pytest.approx(sum(terms.values()))


def test_a_plan_is_told_the_same_again_and_is_judged_so(service: httpx.Client,
                                                        promised: Request) -> None:
    plan = planned(service, promised)
    reply = service.post("/check", json={"problem": promised, "plan": plan}).json()

    assert reply["feasible"]
    assert reply["routes"] == plan["routes"]
    assert (reply["cost"], reply["lateness"]) == (plan["cost"], plan["lateness"])


def test_instants_are_told_as_asked(service: httpx.Client, promised: Request) -> None:
    promised |= {"plan_start": "2026-06-01T08:00:00+02:00"}
    late = halts(planned(service, promised))

    assert "2026-06-01T08:09:00+02:00" > late["A"]["earliest"] > "2026-06-01T08:06:00+02:00"


def test_what_has_happened_has_no_chance(service: httpx.Client, promised: Request) -> None:
    plan = planned(service, promised)
    promised["replan"] = {"plan": plan, "freeze_before": 950}
    late = halts(planned(service, promised))

    assert (late["B"]["chance"], late["B"]["earliest"]) == (0, late["B"]["latest"])


def test_nobody_is_told_who_does_not_ask(service: httpx.Client, promised: Request) -> None:
    del promised["options"]["lateness_risk"]
    plan = planned(service, promised)

    assert halts(plan) == {"A": 0.0, "B": 0.0}
    assert "lateness" not in plan
    assert "lateness_risk" not in plan["cost"]


@pytest.mark.parametrize("wrong", [{"spread": {"travel": -0.1}}, {"spread": {"fuel": 1}},
                                   {"cost_per_expected_late_hour": -1}])
def test_what_is_no_spread_is_refused(service: httpx.Client, promised: Request,
                                      wrong: Request) -> None:
    promised["options"]["lateness_risk"] = wrong
    assert service.post("/plan", json=promised).status_code == 422


@pytest.fixture
def passed(smallest: Request) -> Request:
    """Return two customers on one way that ends with the last of them.

    Whom the van passes first it serves first, and then may be late.
    """
    smallest["customers"] = [
        {"id": "near", "location": [0, 5], "demand": [1], "service_duration": 240},
        {"id": "far", "location": [0, 10], "demand": [1], "time_window": {"latest": 900}}]
    smallest["fleet"][0] |= {"id": "van", "count": 1, "capacity": [5], "speed_kmh": 60,
                             "end": "open", "costs": {"per_km": 1}}
    smallest["options"] = {"time_limit": 60, "search_iterations": 3000}
    return smallest


def test_price_buys_room_where_it_costs_least(service: httpx.Client, passed: Request) -> None:
    cheap = planned(service, passed)
    passed["options"]["lateness_risk"] = RISK | {"cost_per_expected_late_hour": 0}
    told = planned(service, passed)
    passed["options"]["lateness_risk"] = RISK | {"cost_per_expected_late_hour": 2000}
    safe = planned(service, passed)

    assert told["cost"] == cheap["cost"] | {"lateness_risk": 0.0}
    assert [stop["id"] for stop in told["routes"][0]["trips"][0]["stops"]] == [
        "hub", "near", "far"]
    assert [stop["id"] for stop in safe["routes"][0]["trips"][0]["stops"]] == [
        "hub", "far", "near"]
    assert (told["cost"]["distance"], safe["cost"]["distance"]) == (10, 15)
    assert 0.2 < halts(told)["far"]["chance"] < 0.5
    assert halts(safe)["far"]["chance"] < 0.05
    reply = service.post("/check", json={"problem": passed, "plan": safe}).json()
    assert reply["feasible"], reply["violations"]
    assert reply["cost"] == safe["cost"]


def test_price_counts_on_a_plan_gone_on_from(service: httpx.Client, passed: Request) -> None:
    plan = planned(service, passed)
    passed["options"]["lateness_risk"] = RISK | {"cost_per_expected_late_hour": 2000}
    passed["replan"] = {"plan": plan}
    safe = planned(service, passed)

    assert [stop["id"] for stop in safe["routes"][0]["trips"][0]["stops"]] == [
        "hub", "far", "near"]
