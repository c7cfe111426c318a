"""What a dispatcher settles by hand, in the plans of a day."""

from typing import Any

import httpx
import pytest

from app.records.days.fold import Pin, fold
from app.records.days.rows import Begun, DayTerms, LoggedEvent
from app.records.days.schemas import PinReply
from model.problem import MOST_RELATIONS
from tests.app.records.days.living import (
    PROBLEM, begun, clock, order, plan_of, served_by, standing, told,
)

VANS = ("van-1", "van-2", "van-3")
ROOMY = PROBLEM | {"fleet": [{**PROBLEM["fleet"][0], "capacity": [9]}],
                   "options": {"search_iterations": 1000}}
UNHURRIED = {"plan_within": 60.0}
"""Plans end by their turns, however busy the machine is."""


def pin(name: str, vehicle: str, **more: Any) -> dict[str, Any]:
    """Return the event that an order is settled by hand."""
    return {"kind": "order.pinned", "order": name, "vehicle": vehicle, **more}


def tour(plan: dict[str, Any], vehicle: str) -> list[str]:
    """Return whom a vehicle serves, in order."""
    return [stop["id"] for route in plan["routes"] if route["vehicle"] == vehicle
            for trip in route["trips"] for stop in trip["stops"] if stop["kind"] == "customer"]


@pytest.mark.slow
def test_pinned_order_stays_with_its_vehicle_until_that_is_lifted(service: httpx.Client) -> None:
    day = begun(service, ROOMY, **UNHURRIED)
    free = plan_of(service, day)
    other = next(van for van in VANS if van != served_by(free)["A"])
    told(service, day, clock(), pin("A", other), at=10)
    assert served_by(plan_of(service, day))["A"] == other
    told(service, day, order("G", 1, 1), at=20)
    held = plan_of(service, day)
    assert served_by(held)["A"] == other
    assert {each.id: each.pinned for each in standing(service, day).orders} == {
        **dict.fromkeys("BCDEFG"), "A": PinReply(vehicle=other)}
    told(service, day, {"kind": "order.pinned", "order": "A", "undone": True},
         {"kind": "order.cancelled", "order": "G"}, at=30)
    assert standing(service, day).orders[0].pinned is None
    assert plan_of(service, day)["cost"]["total"] <= free["cost"]["total"]


@pytest.mark.slow
@pytest.mark.parametrize("names", ["AB", "BA", "FD"])
def test_who_is_pinned_behind_another_is_served_after_it(service: httpx.Client,
                                                         names: str) -> None:
    day = begun(service, ROOMY, **UNHURRIED)
    first, second = tuple(names)
    told(service, day, clock(), pin(second, "van-2", after=first), at=10)
    for at in (20, 30):
        stops = tour(plan_of(service, day), "van-2")
        assert stops.index(first) < stops.index(second)
        told(service, day, order(f"G{at}", 1, 1), at=at)


@pytest.mark.slow
def test_who_is_on_the_way_stays_with_its_vehicle(service: httpx.Client) -> None:
    day = begun(service)
    route = plan_of(service, day)["routes"][0]
    vehicle, first = route["vehicle"], route["trips"][0]["stops"][1]["id"]
    other = next(van for van in VANS if van != vehicle)
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": vehicle, "at": 110},
         pin(first, other), at=120)
    assert served_by(plan_of(service, day))[first] == vehicle


def test_of_pins_in_a_circle_the_last_counts() -> None:
    begin = Begun({"customers": [{"id": name} for name in "ABC"]}, DayTerms(2, 600, 0, ""))
    events = [LoggedEvent(number, "", str(number), "order.pinned", number, "van-1", None, None,
                          None, f'{{"order": "{behind}", "after": "{before}"}}')
              for number, (before, behind) in enumerate([("A", "B"), ("B", "C"), ("C", "A")])]
    assert fold(begin, events, 0).pins == {
        "B": Pin("van-1"), "C": Pin("van-1", "B"), "A": Pin("van-1", "C")}


@pytest.mark.slow
@pytest.mark.parametrize(("stated", "path"), [
    (pin("Z", "van-1"), "$[0].order"), (pin("A", "van-9"), "$[0].vehicle"),
    (pin("A", "van-1/drone-1"), "$[0].vehicle"), (pin("A", "van-1", after="Z"), "$[0].after"),
    (pin("A", "van-1", after="A"), "$[0]"), ({"kind": "order.pinned", "order": "A"}, "$[0]")])
def test_pins_of_what_is_not_there_are_refused(service: httpx.Client, stated: dict[str, Any],
                                               path: str) -> None:
    day = begun(service)
    reply = service.post(f"/days/{day}/events", json=[{"event_id": "e", "at": 1} | stated])
    assert (reply.status_code, reply.json()["errors"][0]["path"]) == (422, path), reply.text


@pytest.mark.slow
def test_new_orders_come_behind_all_that_drivers_were_told(service: httpx.Client) -> None:
    day = begun(service, ROOMY | {"options": {"change_limits": {"new_orders": "behind"}}})
    told(service, day, clock(), order("G", 1, 0), order("H", -1, 0), at=10)
    plan = plan_of(service, day)
    assert {"G", "H"} <= set(served_by(plan))
    for van in VANS:
        is_new = [name in {"G", "H"} for name in tour(plan, van)]
        assert is_new == sorted(is_new)


@pytest.mark.slow
def test_only_routes_of_vehicles_change_of_which_something_was_told(
        service: httpx.Client) -> None:
    day = begun(service, PROBLEM | {"options": {
        "search_iterations": 1200, "change_limits": {"vehicles": "concerned"}}}, plan_within=30)
    before = plan_of(service, day)
    one = served_by(before)["A"]
    changed = {**PROBLEM["customers"][0], "location": [9, 0]}
    told(service, day, clock(), {"kind": "order.changed", "customer": changed},
         order("G", 1, 0), at=10)
    plan = plan_of(service, day)
    for van in VANS:
        stays = [name for name in tour(plan, van) if name != "G"]
        assert (sorted(stays) if van == one else stays) == (
            sorted(tour(before, van)) if van == one else tour(before, van))
    assert "G" in served_by(plan)
    # Whoever is settled by hand moves all the same.
    other = next(van for van in VANS if van != one)
    told(service, day, pin("B", other), at=20)
    assert served_by(plan_of(service, day))["B"] == other


@pytest.mark.slow
def test_more_orders_behind_others_than_plans_hold_are_refused(service: httpx.Client) -> None:
    rules = [{"kind": "before", "customers": ["A", "B"]}] * (MOST_RELATIONS - 1)
    day = begun(service, ROOMY | {"relations": rules}, **UNHURRIED)
    told(service, day, pin("C", "van-1", after="D"), at=10)
    another = {"event_id": "another", "at": 20, **pin("E", "van-1", after="F")}
    refused = service.post(f"/days/{day}/events", json=[another])
    assert refused.status_code == 422
    assert [(each["code"], each["path"]) for each in refused.json()["errors"]] == [
        ("OUT_OF_RANGE", "$[0].after")]
    told(service, day, {"kind": "order.pinned", "order": "C", "undone": True}, another, at=30)
    stops = tour(plan_of(service, day), "van-1")
    assert stops.index("F") < stops.index("E")


@pytest.mark.slow
def test_who_is_left_out_by_hand_waits_until_that_is_lifted(service: httpx.Client) -> None:
    day = begun(service, ROOMY, **UNHURRIED)
    told(service, day, clock(), {"kind": "order.pinned", "order": "A", "left_out": True}, at=10)
    for at in (20, 30):
        assert "A" not in served_by(plan_of(service, day))
        found = next(each for each in standing(service, day).orders if each.id == "A")
        assert (found.state, found.pinned) == ("left_out", PinReply(vehicle=None))
        told(service, day, order(f"G{at}", 1, 1), at=at)
    told(service, day, {"kind": "order.pinned", "order": "A", "undone": True}, at=40)
    assert "A" in served_by(plan_of(service, day))


@pytest.mark.slow
def test_who_is_on_the_way_is_served_though_left_out_by_hand(service: httpx.Client) -> None:
    day = begun(service)
    route = plan_of(service, day)["routes"][0]
    first = route["trips"][0]["stops"][1]["id"]
    told(service, day, clock(),
         {"kind": "vehicle.departed", "vehicle": route["vehicle"], "at": 110},
         {"kind": "order.pinned", "order": first, "left_out": True}, at=120)
    assert served_by(plan_of(service, day))[first] == route["vehicle"]
