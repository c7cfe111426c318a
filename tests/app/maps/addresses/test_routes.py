"""Addresses over HTTP: looked up by themselves, and in a plan."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx

from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner, ready

Serve = Callable[..., httpx.Client]


def test_addresses_are_looked_up(serve: Serve, helsinki: Path, tmp_path: Path) -> None:
    client = ready(serve(FirstFitPlanner(), Settings(geocoder=f"extract:{helsinki}",
                                                     data_dir=tmp_path)))
    reply = client.post("/addresses", json={"addresses": [
        "Mikonkatu 18", "Hauptstr. 1, Berlin", "Bulevardi 1000"]}).json()
    assert (reply["known"], reply["error"]) == (3, None)
    house, nowhere, street = reply["addresses"]
    assert (house["places"][0]["quality"], house["doubt"]) == ("house", None)
    assert (nowhere["is_known"], nowhere["places"]) == (True, [])
    assert "street alone" in street["doubt"]
    assert "OpenStreetMap" in reply["attribution"]
    assert client.get("/console/config.json").json()["finds_addresses"] is True
    wrong = client.post("/addresses", json={"addresses": [""], "second": 1}).json()
    assert {error["path"] for error in wrong["errors"]} == {"$.addresses[0]", "$.second"}
    _plan_with_addresses(client)


def _plan_with_addresses(client: httpx.Client) -> None:
    stated: dict[str, Any] = {
        "coordinate_system": "geographic",
        "depots": [{"id": "d", "location": {"address": "Kaivokatu 1, Helsinki"}}],
        "customers": [{"id": "a", "location": {"address": "Mikonk. 18"}, "demand": [1]}],
        "fleet": [{"id": "t", "count": 1, "capacity": [10]}]}
    plan = client.post("/plan", json=stated).json()
    assert [each["label"] for each in plan["addresses"]] == [
        "Kaivokatu 1, 00100 Helsinki", "Mikonkatu 18, 00100 Helsinki"]
    assert 200 < plan["summary"]["distance"] < 2000
    verdict = client.post("/check", json={"problem": stated, "plan": plan}).json()
    assert (verdict["feasible"], verdict["violations"]) == (True, [])


def test_service_without_geocoder_says_so(client: httpx.Client) -> None:
    reply = client.post("/addresses", json={"addresses": ["Mikonkatu 18"]})
    assert (reply.status_code, reply.json()["errors"][0]["code"]) == (422, "NO_GEOCODER")
    assert client.get("/console/config.json").json()["finds_addresses"] is False
