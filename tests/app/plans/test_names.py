"""Names of single vehicles, which people see and plans don't use."""

from typing import Any

import httpx


def request(names: list[str]) -> dict[str, Any]:
    """Return a problem of two vans with names."""
    return {"depots": [{"id": "hub", "location": [0, 0]}],
            "customers": [{"id": "A", "location": [1, 1], "demand": [1]}],
            "fleet": [{"id": "van", "count": 2, "capacity": [9], "names": names}],
            "options": {"time_limit": 0}}


def test_vehicles_with_names_keep_their_ids(client: httpx.Client) -> None:
    reply = client.post("/plan", json=request(["Anna", "Ben"]))
    assert [route["vehicle"] for route in reply.json()["routes"]] == ["van-1"]


def test_more_names_than_vehicles_are_refused(client: httpx.Client) -> None:
    reply = client.post("/plan", json=request(["Anna", "Ben", "Cem"]))
    assert reply.status_code == 422
    (error,) = reply.json()["errors"]
    assert error["path"] == "$.fleet[0]"
    assert "3 names for 2 vehicles" in error["message"]
