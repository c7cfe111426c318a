"""Pictures that a client asks the service for."""

import httpx
import pytest
from pydantic_core import to_json

from app.requests.conversion.names import called
from app.requests.reading import read_request
from tests.app.plans.asking import documented, planned, refused


@pytest.mark.thorough
def test_a_plan_is_drawn_with_what_people_call_its_vehicles(client: httpx.Client) -> None:
    problem = documented("table1")
    problem["fleet"][0]["names"] = ["Ayşe"]
    reply = client.post("/picture", json={"problem": problem, "plan": planned(client, problem)})
    assert reply.status_code == 200
    assert reply.headers["content-type"] == "image/svg+xml"
    assert reply.text.startswith("<?xml")
    assert "Ayşe" in reply.text


def test_what_can_not_be_drawn_is_refused(client: httpx.Client) -> None:
    problem = documented("smallest")
    plan = planned(client, problem)
    plan["routes"][0]["vehicle"] = "nobody-1"
    found = refused(client, {"problem": problem, "plan": plan}, "/picture")
    assert found == [("WRONG_NAME", "$.plan.routes[0].vehicle")]


def test_vehicles_are_called_by_name_by_type_or_as_the_plan_does() -> None:
    two = documented("smallest")["fleet"][0] | {"id": "van", "count": 2}
    one = two | {"id": "bike", "count": 1}
    stated = documented("smallest") | {"fleet": [two | {"names": ["Ben"]}, one]}
    fleet = read_request(to_json(stated), None).fleet
    assert [called(fleet, name) for name in ("van-1", "van-2", "bike-1", "bike-2", "other-1")] == [
        "Ben", "van-2", "bike", "bike-2", "other-1"]
