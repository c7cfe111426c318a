"""Flights of a vehicle's drones by its driver's link."""

import json
from typing import Any

import httpx
import pytest

from tests.app.plans.flights.asking import files_of
from tests.app.records.dispatches.days import PLAN, PROBLEM, dispatched, holding, token_of

pytestmark = pytest.mark.slow

Data = dict[str, Any]


def links_of(client: httpx.Client, **changes: Any) -> list[dict[str, str]]:
    """Send the day out and return the headers of the truck's and of the van's link."""
    return [holding(token_of(link)) for link in dispatched(client, **changes)["links"]]


def test_flights_are_those_of_the_vehicle_alone(client: httpx.Client) -> None:
    truck, van = links_of(client)
    assert client.get("/drive/day", headers=truck).json()["flights"] == 1
    assert client.get("/drive/day", headers=van).json()["flights"] == 0
    files = files_of(client.get("/drive/flights?format=geojson", headers=truck))
    (name, content), = files.items()
    assert name == "truck-1-drone-1-flight-1.geojson"
    flight = json.loads(content)["features"][0]["properties"]
    assert flight["customers"] == ["C"]
    assert flight["launch_time"].endswith("08:22:10+00:00")
    reply = client.get("/drive/flights?format=kml", headers=van)
    assert reply.status_code == 422
    assert reply.json()["errors"][0]["code"] == "NO_FLIGHTS"


def test_day_of_a_vehicle_that_flies_says_so(client: httpx.Client) -> None:
    truck, van = PROBLEM["fleet"]
    links = links_of(client, problem=PROBLEM | {"fleet": [truck, van | {"flies": True}]})
    driven, flown = (client.get("/drive/day", headers=link).json() for link in links)
    assert not driven["flies"]
    assert flown["flies"]
    assert flown["flights"] == 1


def test_flights_follow_a_change_of_the_day_and_a_new_link(client: httpx.Client) -> None:
    sent = dispatched(client)
    link = sent["links"][0]
    renewed = client.post(f"/dispatches/{sent['id']}/links/{link['id']}").json()["links"][0]
    headers = holding(token_of(renewed))
    assert client.get("/drive/day", headers=headers).json()["flights"] == 1
    old = client.get("/drive/flights?format=kml", headers=holding(token_of(link)))
    assert old.status_code == 410
    client.post(f"/dispatches/{sent['id']}/plan", json={
        "problem": PROBLEM, "plan": {"routes": PLAN["routes"][1:]}}).raise_for_status()
    assert client.get("/drive/day", headers=headers).json()["flights"] == 0


def test_day_on_a_plane_has_no_flights(client: httpx.Client) -> None:
    plane = PROBLEM | {"coordinate_system": "planar"}
    truck, _ = links_of(client, problem=plane)
    assert client.get("/drive/day", headers=truck).json()["flights"] == 0


def test_wrong_tokens_and_formats_are_refused(client: httpx.Client) -> None:
    truck, _ = links_of(client)
    assert client.get("/drive/flights?format=kml").status_code == 401
    assert client.get("/drive/flights?format=gpx", headers=truck).status_code == 422
    # At 60 km/h a drone is too fast for DJI's format.
    reply = client.get("/drive/flights?format=dji-wpml", headers=truck)
    assert reply.json()["errors"][0] | {"message": ""} == {
        "code": "BEYOND_FORMAT", "path": "query.format", "message": ""}
