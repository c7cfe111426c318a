"""What is told of customers comes back at their stops."""

from typing import Any

import httpx
import pytest

from app.schemas.fields import MAX_INFO_ENTRIES, MAX_INFO_LENGTH
from app.schemas.response import PlanReply

Request = dict[str, Any]

TOLD = {"address": "Mozartstraße 17, Augsburg", "phone": "0821 1234", "notes": "=cmd|'x'!A1"}


def halts(plan: Request) -> dict[str, Any]:
    trips = [trip for route in plan["routes"] for trip in route["trips"]]
    return {halt["id"]: halt for trip in trips
            for halt in [*trip["stops"][1:-1], *(customer for sortie in trip["sorties"]
                                                 for customer in sortie["customers"])]}


def test_what_is_told_stands_at_the_stop_and_goes_on(client: httpx.Client,
                                                     smallest: Request) -> None:
    smallest["customers"][0]["info"] = TOLD
    plan = client.post("/plan", json=smallest).json()
    PlanReply.model_validate(plan)
    told = {name: halt.get("info") for name, halt in halts(plan).items()}
    assert told == {"A": TOLD, "B": None}
    checked = client.post("/check", json={"problem": smallest, "plan": plan}).json()
    assert checked["feasible"], checked
    smallest["customers"][0]["info"] = {"notes": "ring twice"}
    on = client.post("/plan", json=smallest | {"replan": {"plan": plan, "freeze_before": 100}})
    assert on.status_code == 200, on.text
    assert halts(on.json())["A"]["info"] == {"notes": "ring twice"}


def test_what_is_told_stands_at_a_flight_and_at_no_depot(client: httpx.Client,
                                                         smallest: Request) -> None:
    smallest["fleet"][0]["drones"] = {"count": 1, "capacity": [20]}
    first = smallest["customers"][0]
    first |= {"id": smallest["depots"][0]["id"], "served_by": "drone", "info": TOLD}
    plan = client.post("/plan", json=smallest).json()
    trip = plan["routes"][0]["trips"][0]
    assert trip["sorties"][0]["customers"][0]["info"] == TOLD
    assert "info" not in trip["stops"][0]


@pytest.mark.parametrize("told", [
    {str(number): "" for number in range(MAX_INFO_ENTRIES + 1)},
    {"notes": "x" * (MAX_INFO_LENGTH + 1)}, {"": "x"}, {"phone": 821}, ["x"],
], ids=["many", "long", "nameless", "number", "list"])
def test_what_is_told_is_bounded(client: httpx.Client, smallest: Request, told: Any) -> None:
    smallest["customers"][0]["info"] = told
    reply = client.post("/plan", json=smallest)
    assert reply.status_code == 422
    assert reply.json()["errors"][0]["path"].startswith("$.customers[0].info")
