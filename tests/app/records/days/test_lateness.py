"""Who is late before it is too late: ranges of arrivals, chances, and where vehicles are."""

from typing import Any

import httpx
import pytest

from tests.app.records.days.living import (
    PROBLEM, begun, clock, followed, order, plan_of, standing, told,
)

pytestmark = pytest.mark.slow

Data = dict[str, Any]

FAR: Data = {**PROBLEM, "customers": [
    {"id": "A", "location": [6, 0], "demand": [1], "service_duration": 60},
    {"id": "B", "location": [12, 0], "demand": [1], "service_duration": 60,
     "time_window": {"latest": 1900}}],
    "fleet": [{**PROBLEM["fleet"][0], "count": 1}]}
"""Two orders ahead of one van: 600 s to the first, 600 s to the second."""


def about(service: httpx.Client, day: str, kind: str, name: str = "") -> list[Data]:
    """Return what was told of an order, or of all, by events of a kind."""
    events = followed(service, day, standing(service, day).revision)
    return [each["about"] for each in events
            if each["kind"] == kind and each["about"].get("order", "") == name]


def test_arrivals_are_told_with_a_range(service: httpx.Client) -> None:
    day = begun(service, FAR)
    first, second = (about(service, day, "eta.changed", name)[0] for name in "AB")
    assert first["earliest"] < first["arrival"] < first["latest"]
    assert second["latest"] - second["earliest"] > first["latest"] - first["earliest"]
    found = {each.id: each for each in standing(service, day).orders}["B"]
    assert (found.earliest, found.latest, found.chance) == (
        second["earliest"], second["latest"], second["chance"])
    # Who asked for no chances gets a plan without.
    plan = plan_of(service, day)
    assert "lateness" not in plan
    assert {stop["lateness"] for stop in plan["routes"][0]["trips"][0]["stops"]} == {0.0}


def test_stated_spreads_hold(service: httpx.Client) -> None:
    risk = {"spread": {"travel": 0.0, "service": 0.0}}
    day = begun(service, {**FAR, "options": {"lateness_risk": risk}})
    first, = about(service, day, "eta.changed", "A")
    assert first["earliest"] == first["latest"] == first["arrival"]
    assert plan_of(service, day)["lateness"]["spread"] == risk["spread"]


def test_position_moves_arrivals_of_a_vehicle_that_is_late(service: httpx.Client) -> None:
    day = begun(service, FAR)
    left_at = plan_of(service, day)["routes"][0]["trips"][0]["stops"][0]["departure"]
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": "van-1", "at": left_at},
         at=left_at)
    before = {each.id: each.arrival for each in standing(service, day).orders}
    # Half of the way to A is left when it should be there.
    told(service, day, {"kind": "vehicle.position", "vehicle": "van-1", "location": [3, 0]},
         at=left_at + 600)
    after = {each.id: each for each in standing(service, day).orders}
    assert {name: each.arrival for name, each in after.items()} == {
        name: pytest.approx((arrival or 0.0) + 300) for name, arrival in before.items()}
    # Where it should be counts no more: it is told once.
    told(service, day, clock(), at=left_at + 601)
    assert {each.id: each.arrival for each in standing(service, day).orders} == {
        name: each.arrival for name, each in after.items()}
    assert standing(service, day).vehicles[0].position == (3, 0)


def test_order_is_at_risk_before_its_window_is_missed(service: httpx.Client) -> None:
    day = begun(service, FAR, risk_threshold=0.25)
    assert about(service, day, "order.at_risk", "B") == []
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": "van-1", "at": 100},
         {"kind": "vehicle.delayed", "vehicle": "van-1", "by": 500}, at=120)
    risk, = about(service, day, "order.at_risk", "B")
    assert (risk["at_risk"], risk["why"]) == (True, "chance")
    assert 0.25 <= risk["chance"] < 1
    told(service, day, {"kind": "order.changed", "customer": {
        **FAR["customers"][1], "time_window": {"latest": 4000}}}, at=121)
    assert [each["at_risk"] for each in about(service, day, "order.at_risk", "B")] == [True, False]


def test_remedy_is_another_place_in_the_plan_at_its_price(service: httpx.Client) -> None:
    slow, promised = FAR["customers"]
    day = begun(service, {**FAR, "fleet": [{**FAR["fleet"][0], "count": 2}], "customers": [
        {**slow, "service_duration": 400}, {**promised, "time_window": {"latest": 1750}}],
        # However busy the machine is, there is time for a remedy.
        "options": {"search_iterations": 1000}}, plan_within=60)
    risk, = about(service, day, "order.at_risk", "B")
    # The same van serves it 400 s sooner, before the other, and drives as far.
    remedy: Data = {
        "code": "serve_sooner", "vehicle": "van-1", "arrival": 1300,
        "cost": pytest.approx(0, abs=1e-6), "events": [
            {"kind": "order.pinned", "order": "B", "vehicle": "van-1"},
            {"kind": "order.pinned", "order": "A", "vehicle": "van-1", "after": "B"}]}
    assert risk["remedy"] == remedy
    found = {each.id: each for each in standing(service, day).orders}["B"]
    assert found.remedy is not None
    assert found.remedy.model_dump() == remedy
    told(service, day, clock(), *remedy["events"], at=10)
    found = {each.id: each for each in standing(service, day).orders}["B"]
    assert (found.arrival, found.at_risk, found.remedy) == (1300, False, None)
    day = begun(service, {**FAR, "fleet": [{**FAR["fleet"][0], "count": 2}], "customers": [
        {**slow, "service_duration": 400, "time_window": {"latest": 750}},
        {**promised, "time_window": {"latest": 1750}}],
        "options": {"search_iterations": 1000}}, plan_within=60)
    risk, = about(service, day, "order.at_risk", "B")
    # Another van has to, for 10 and the way there and back.
    assert (risk["remedy"]["vehicle"], risk["remedy"]["arrival"]) == ("van-2", 1300)
    assert risk["remedy"]["cost"] > 10
    # Nobody else has the parcel any more.
    day = begun(service, FAR)
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": "van-1", "at": 100},
         {"kind": "vehicle.delayed", "vehicle": "van-1", "by": 520}, at=120)
    risk, = about(service, day, "order.at_risk", "B")
    assert "remedy" not in risk


def test_what_vehicles_tell_moves_spreads(service: httpx.Client) -> None:
    day = begun(service, {**PROBLEM, "fleet": [{**PROBLEM["fleet"][0], "count": 1,
                                                "capacity": [6]}]})
    stops = plan_of(service, day)["routes"][0]["trips"][0]["stops"]
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": "van-1", "at": 100},
         *[{"kind": "vehicle.served", "vehicle": "van-1", "order": stop["id"],
            "at": stop["departure"]} for stop in stops[1:4]], at=stops[3]["departure"])
    told(service, day, order("G", 1, 1), at=stops[3]["departure"] + 1)
    first, *_, last = (each["spread"]["travel"]
                       for each in about(service, day, "plan.changed"))
    # All were to the second.
    assert last == pytest.approx(first * (10 / 13) ** 0.5)
