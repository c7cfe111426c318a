"""What is said of ends of shipments that are called as others, or lie too far away."""

from typing import Any

import httpx
import pytest

Request = dict[str, Any]


@pytest.fixture
def paired(smallest: Request) -> Request:
    """Return the smallest request with a shipment."""
    smallest["options"] = {"search_iterations": 500, "time_limit": 60}
    smallest["shipments"] = [{"id": "s1", "amount": [1], "pickup": {"location": [3, 0]},
                              "delivery": {"location": [1, 0]}}]
    return smallest


def messages(reply: httpx.Response) -> list[tuple[str, str]]:
    """Return where the errors of a refusal are, and what they say."""
    assert reply.status_code == 422, reply.text
    return [(error["path"], error["message"]) for error in reply.json()["errors"]]


def test_a_customer_called_as_a_pickup_is_told_so(searching: httpx.Client,
                                                  paired: Request) -> None:
    (shipment,) = paired["shipments"]
    pickup, amount = shipment.pop("pickup"), shipment.pop("amount")
    shipment["pickups"] = [pickup | {"id": name, "amount": amount} for name in "pq"]
    paired["customers"][0]["id"] = "s1/pickup/p"
    errors = searching.post("/plan", json=paired).json()["errors"]
    assert [(error["code"], error["path"], error["message"]) for error in errors] == [
        ("DUPLICATE_ID", "$.shipments[0].pickups[0].id",
         "customers[0] has the same id: give each its own.")]
    paired["customers"][0]["id"] = shipment["pickups"][1]["id"] = "p"
    errors = searching.post("/plan", json=paired).json()["errors"]
    assert [(error["path"], error["message"]) for error in errors] == [
        ("$.shipments[0].pickups[1].id",
         "Pickup 'p' of shipment 's1' has the same id: give each its own.")]


@pytest.mark.parametrize("far", ["pickup", "delivery"])
def test_what_flies_is_told_how_far_the_farther_end_lies(
        searching: httpx.Client, paired: Request, far: str) -> None:
    paired["customers"], paired["planar_unit"] = [], 1000
    paired["fleet"][0] |= {"flies": True, "max_range": 2000, "drones": None}
    (shipment,) = paired["shipments"]
    for end in ("pickup", "delivery"):
        shipment[end] = {"location": [0, 5 if end == far else 1], "served_by": "either"}
    paired["depots"] = [{"id": "hub", "location": [0, 0]}]
    (left,) = searching.post("/plan", json=paired).json()["unassigned"]
    (reason,) = left["reasons"]
    assert reason["message"] == "It lies 3 km farther away than the max_range."
    assert reason["remedy"] == "fits if max_range were 3 km longer"


def test_whoever_names_a_shipment_is_told_how_its_ends_are_named(searching: httpx.Client,
                                                                 paired: Request) -> None:
    place, first = {"location": [1, 1]}, paired["customers"][0]["id"]
    paired["relations"] = [{"kind": "together", "customers": [first, "s1"]}]
    ends = "named each for itself: write 's1/pickup' or 's1/delivery'."
    path, told = "$.relations[0].customers[1]", f"'s1' is a shipment, whose ends are {ends}"
    assert messages(searching.post("/plan", json=paired)) == [(path, told)]
    paired["relations"] = []
    asked = {"problem": paired, "plan": {"routes": []}, "customer": "s1"}
    assert messages(searching.post("/fit", json=asked)) == [
        ("$.customer", f"{told} For all of it state shipment.")]
    paired["replan"] = {"plan": {"routes": []}, "pinned": ["s1"]}
    assert messages(searching.post("/plan", json=paired)) == [("$.replan.pinned[0]", told)]
    parts = [{"id": name, "amount": [1], **place} for name in "xy"]
    del paired["replan"]
    paired |= {"shipments": [{"id": "s1", "pickups": parts, "delivery": place}],
               "relations": [{"kind": "together", "customers": [first, "s1/pickup"]}]}
    assert messages(searching.post("/plan", json=paired)) == [
        (path, "'s1/pickup' is fetched at several places, which are named each for itself: write "
         "'s1/pickup/y' or 's1/pickup/x'.")]
