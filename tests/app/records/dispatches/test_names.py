"""Drivers are called by what people call their vehicles."""

from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner, ready, serving
from tests.app.records.dispatches.days import PLAN, PROBLEM, dispatched, holding, token_of


@pytest.fixture
def service(tmp_path: Path) -> Iterator[httpx.Client]:
    """Return a client of a service that plans nothing."""
    with serving(FirstFitPlanner(), Settings(data_dir=tmp_path, role="api",
                                             drain_seconds=0)) as client:
        yield ready(client)


def called(*names: str) -> dict[str, object]:
    """Return the problem whose vans have names."""
    truck, van = PROBLEM["fleet"]
    return PROBLEM | {"fleet": [truck, van | {"names": list(names)}]}


def test_links_and_days_tell_names_and_follow_another_plan(service: httpx.Client) -> None:
    sent = dispatched(service, problem=called("Ayşe"))
    assert [link["name"] for link in sent["links"]] == ["truck", "Ayşe"]
    van = holding(token_of(sent["links"][1]))
    assert service.get("/drive/day", headers=van).json()["name"] == "Ayşe"
    changed = service.post(f"/dispatches/{sent['id']}/plan", json={
        "problem": called("Dora"), "plan": {"routes": PLAN["routes"][:1]}}).json()
    assert [link["name"] for link in changed["links"]] == ["truck", "Dora"]
    day = service.get("/drive/day", headers=van).json()
    assert (day["name"], day["vehicle"], day["steps"]) == ("Dora", "van-1", [])
    link = changed["links"][1]["id"]
    renewed = service.post(f"/dispatches/{sent['id']}/links/{link}").json()
    assert renewed["links"][1]["name"] == "Dora"
