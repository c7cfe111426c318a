"""Kept plans that are a day's: they, and links to them, show the day as it goes on."""

from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from sqlalchemy import delete

from app.database.connections import make_engine
from app.database.tables import DAYS
from app.serving.settings import Settings
from tests.app.conftest import SearchingPlanner, ready, serving
from tests.app.records.days.living import PROBLEM, begun, order, plan_of, planned, told
from tests.app.records.kept.conftest import content
from tests.app.records.kept.test_links import see

pytestmark = pytest.mark.slow

START = "2026-06-01T08:00:00+02:00"


@pytest.fixture(scope="module")
def settings(tmp_path_factory: pytest.TempPathFactory) -> Settings:
    """Return those of a service with a database of this module's own."""
    return Settings(data_dir=tmp_path_factory.mktemp("views"), drain_seconds=0, role="api")


@pytest.fixture(scope="module")
def service(settings: Settings) -> Iterator[httpx.Client]:
    """Return a client of the service."""
    with serving(SearchingPlanner(), settings) as client:
        yield ready(client)


def keep(service: httpx.Client, day: str, name: str = "Monday") -> httpx.Response:
    """Keep a day's plan by the day's id."""
    return service.put(f"/plans/{day}", json={"name": name, "day": day})


def customers(shown: dict[str, Any]) -> set[str]:
    """Return whom a plan's request has, and whom its routes have."""
    served = {stop["id"] for route in shown["plan"]["routes"] for trip in route["trips"]
              for stop in trip["stops"] if stop["kind"] == "customer"}
    asked = {each["id"] for each in shown["request"]["customers"]}
    assert served <= asked
    return served


def test_link_to_a_day_shows_it_as_it_is_now(service: httpx.Client) -> None:
    day = begun(service, {**PROBLEM, "plan_start": START})
    kept = keep(service, day)
    assert kept.status_code == 201, kept.text
    assert (kept.json()["day"], kept.json()["customers"]) == (
        service.get(f"/days/{day}").json()["dispatch"], 6)
    token = service.post(f"/plans/{day}/links").json()["token"]
    assert customers(see(service, token).json()) == set("ABCDEF")
    told(service, day, order("G", 1, 1), at=10)
    shown = see(service, token).json()
    assert shown["is_live"]
    assert customers(shown) == set("ABCDEFG")
    assert shown["plan"] == service.get(f"/plans/{day}").json()["plan"] == plan_of(service, day)
    assert "webhook" not in shown["request"]


def test_kept_again_it_is_the_same_and_another_name_needs_the_version(
        service: httpx.Client) -> None:
    day = begun(service)
    first = keep(service, day)
    told(service, day, order("G", 1, 1), at=10)
    again = keep(service, day)
    assert (again.status_code, again.json()["version"]) == (200, first.json()["version"])
    assert keep(service, day, "Tuesday").status_code == 428


def test_deleted_day_leaves_the_plan_as_it_was_kept(
        service: httpx.Client, settings: Settings) -> None:
    day = begun(service)
    keep(service, day)
    told(service, day, order("G", 1, 1), at=10)
    engine = make_engine(settings.database)
    with engine.begin() as connection:
        connection.execute(delete(DAYS).where(DAYS.c.id == day))
    engine.dispose()
    assert customers(service.get(f"/plans/{day}").json()) == set("ABCDEF")


def test_no_plan_yet_is_none(service: httpx.Client) -> None:
    reply = service.post("/days", json={"problem": PROBLEM, "clock": 0, "plan_within": 60})
    day = reply.json()["id"]
    assert keep(service, day).status_code == 201
    planned(service, day)
    assert customers(service.get(f"/plans/{day}").json()) == set("ABCDEF")


@pytest.mark.parametrize(("body", "status", "path"), [
    ({"name": "a", "day": "nobody's"}, 404, None),
    ({"name": "a"}, 422, "$"),
    (content(day="monday"), 422, "$"),
    ({"name": "a", "day": "x", "plan": content()["plan"]}, 422, "$"),
    ({"name": "a", "day": 1}, 422, "$.day")])
def test_what_is_no_plan_or_two_is_refused(
        service: httpx.Client, body: dict[str, Any], status: int, path: str | None) -> None:
    reply = service.put("/plans/p", json=body)
    assert reply.status_code == status
    if path is not None:
        assert [each["path"] for each in reply.json()["errors"]] == [path]
