"""Plans sent out to drivers, over HTTP."""

import logging
from collections.abc import Callable, Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import httpx
import pytest
from sqlalchemy import text, update

from app.database.tables import DAYS
from app.records.clock import now_ms
from app.records.dispatches.schemas import DispatchReply, DriverDay, EventsReply, StepReply
from app.records.dispatches.standing import ToldStep, standing_reply
from app.records.dispatches.store import delete_expired
from app.serving.access.keys import KeyStore
from app.serving.access.tokens import digest_of
from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner, opened, ready, serving
from tests.app.records.dispatches.days import (
    ADDRESS, DEPART, DOOR, FIRST, LAUNCH, PHONE, PLAN, PROBLEM, SECOND, Data, dispatched, event,
    holding, token_of,
)
from tests.conftest import PATIENCE, eventually

pytestmark = pytest.mark.slow

Serve = Callable[..., httpx.Client]

BEGAN = datetime.now(UTC).replace(microsecond=0) - timedelta(hours=3)


@pytest.fixture(scope="module")
def settings(tmp_path_factory: pytest.TempPathFactory) -> Settings:
    """Return settings with a database of this module's own."""
    return Settings(data_dir=tmp_path_factory.mktemp("dispatches"), drain_seconds=0)


@pytest.fixture(scope="module")
def service(settings: Settings) -> Iterator[httpx.Client]:
    """Return a client of a service."""
    with serving(FirstFitPlanner(), settings) as client:
        yield ready(client)


def told(client: httpx.Client, token: str, *events: Data, now: str | None = None) -> Data:
    """Tell events and return the reply."""
    reply = client.post("/drive/events", headers=holding(token), json={
        "now": now or datetime.now(UTC).isoformat(), "events": list(events)})
    assert reply.status_code == 200, reply.text
    EventsReply.model_validate_json(reply.text)
    return dict(reply.json())


def under_way(client: httpx.Client) -> Data:
    """Send out a plan that began some hours ago, whatever time it is."""
    return dispatched(client, plan_start=BEGAN.isoformat())


def today(seconds: float) -> str:
    """Return an instant of such a plan as a phone tells it."""
    return (BEGAN + timedelta(seconds=seconds)).isoformat()


def test_each_vehicle_gets_a_link_that_shows_its_day_alone(service: httpx.Client) -> None:
    reply = dispatched(service, time_zone="Europe/Berlin")
    DispatchReply.model_validate(reply)
    truck, van = reply["links"]
    assert [link["vehicle"] for link in reply["links"]] == ["truck-1", "van-1"]
    assert truck["url"].startswith(str(service.base_url.join("/drive/#tdm_drive_")))
    assert truck["qr"].startswith("data:image/svg+xml")
    days = [service.get("/drive/day", headers=holding(token_of(link))) for link in (truck, van)]
    for day in days:
        DriverDay.model_validate_json(day.text)
    assert ADDRESS in days[0].text
    assert "Secret Street" not in days[0].text
    assert "van-1" not in days[0].text
    assert ADDRESS not in days[1].text
    assert {step["place"] for step in days[1].json()["steps"]} == {"hub", "D", "E"}


def test_day_says_what_its_amounts_are_in(service: httpx.Client) -> None:
    for dimension, unit in (({"name": "weight", "unit": "kg"}, "kg"), ({"name": "boxes"}, "boxes")):
        problem = PROBLEM | {"load_dimensions": [dimension]}
        link = dispatched(service, problem=problem)["links"][0]
        steps = service.get("/drive/day", headers=holding(token_of(link))).json()["steps"]
        assert {tuple(step["load_units"]) for step in steps} == {(unit,)}


def test_day_has_all_that_a_driver_does_in_order(service: httpx.Client) -> None:
    link = dispatched(service)["links"][0]
    steps = service.get("/drive/day", headers=holding(token_of(link))).json()["steps"]
    assert [(step["kind"], step["place"]) for step in steps] == [
        ("depart", "hub"), ("launch", "A"), ("stop", "A"), ("stop", "B"), ("recover", "B"),
        ("return", "hub")]
    (depart, launch, first, second, _, _) = steps
    assert depart["load"] == [2.3]
    assert launch["drone"] == "truck-1/drone-1"
    assert [customer["id"] for customer in launch["customers"]] == ["C"]
    assert first["location"] == {"latitude": 48.1, "longitude": 11.51}
    assert first["windows"] == [{"earliest": 30_000, "latest": 40_000}]
    (customer,) = first["customers"]
    assert (customer["hand_over"], customer["take_in"]) == ([2], None)
    assert (customer["info"]["phone"], customer["info"]["order"]) == (PHONE, "4711")
    assert second["customers"][0]["take_in"] == [3]


def test_steps_say_what_the_vehicle_avoids_on_its_way(service: httpx.Client) -> None:
    truck, van = PROBLEM["fleet"]
    avoiding = PROBLEM | {"fleet": [truck, van | {"avoid": ["ferries", "tolls"]}]}
    for link, avoided in zip(dispatched(service, problem=avoiding)["links"],
                             ([], ["tolls", "ferries"]), strict=True):
        steps = service.get("/drive/day", headers=holding(token_of(link))).json()["steps"]
        assert all(step["avoid"] == avoided for step in steps)


def test_who_tells_late_is_as_late_as_it_says(service: httpx.Client) -> None:
    token = token_of(under_way(service)["links"][0])
    day = service.get("/drive/day", headers=holding(token)).json()
    steps = {step["id"]: StepReply.model_validate(step) for step in day["steps"]}
    ends = {name: step.time + step.duration for name, step in steps.items()}
    told_of = {DEPART: ToldStep("done", ends[DEPART] - 60),
               FIRST: ToldStep("done", ends[FIRST] + 720)}
    assert [step.late for step in standing_reply(told_of, [*steps.values()])] == [0, 720]


def test_events_count_once_in_order_and_are_followed(service: httpx.Client) -> None:
    sent = under_way(service)
    token = token_of(sent["links"][0])
    first = event("e1", DEPART, today(1))
    second = event("e2", FIRST, today(2))
    told(service, token, first)
    reply = told(service, token, first, second)
    assert reply["accepted"] == ["e1", "e2"]
    assert [(step["id"], step["state"], step["time"]) for step in reply["standing"]] == [
        (DEPART, "done", 1), (FIRST, "done", 2)]
    again = told(service, token, event("e3", FIRST, today(3), "undone"),
                 event("e4", SECOND, today(4), "failed", reason="Nobody there"))
    assert [(step["id"], step["state"], step["reason"]) for step in again["standing"]] == [
        (DEPART, "done", None), (SECOND, "failed", "Nobody there")]
    followed = service.get(f"/dispatches/{sent['id']}").json()
    DispatchReply.model_validate(followed)
    truck, van = followed["links"]
    assert (truck["done"], truck["failed"], truck["next"]) == (1, 1, LAUNCH)
    assert (truck["url"], truck["qr"]) == (None, None)
    assert (van["done"], van["opened_at"], van["told_at"]) == (0, None, None)


def test_breakdown_is_told_followed_and_taken_back(service: httpx.Client) -> None:
    sent = under_way(service)
    token = token_of(sent["links"][1])
    broken = event("a", "vehicle", today(5), "failed", reason="Broken down")
    reply = told(service, token, event("b", DEPART, today(4)), broken)
    assert [(step["kind"], step["state"]) for step in reply["standing"]] == [
        ("vehicle", "failed"), ("depart", "done")]
    _, van = service.get(f"/dispatches/{sent['id']}").json()["links"]
    assert (van["done"], van["failed"]) == (1, 0)
    path = f"/dispatches/{sent['id']}/replan?now=30400"
    assert service.get(path).json()["replan"]["unavailable"] == [van["vehicle"]]
    told(service, token, event("c", "vehicle", today(6), "undone"))
    again = service.get(path).json()
    assert ("unavailable" in again["replan"], again["broken"]) == (False, [])


def test_what_comes_late_from_another_phone_is_not_taken_for_the_latest(
        service: httpx.Client) -> None:
    token = token_of(under_way(service)["links"][1])
    told(service, token, event("b", DOOR, today(9), "failed", reason="Closed"))
    reply = told(service, token, event("a", DOOR, today(5)))
    assert [(step["state"], step["time"]) for step in reply["standing"]] == [("failed", 9)]


def test_clock_that_is_wrong_is_set_right(service: httpx.Client) -> None:
    token = token_of(under_way(service)["links"][1])
    wrong = datetime.now(UTC) + timedelta(hours=5)
    reply = told(service, token, event("a", DOOR, (wrong - timedelta(hours=1)).isoformat()),
                 now=wrong.isoformat())
    expected = (datetime.now(UTC) - BEGAN).total_seconds() - 3600
    assert reply["standing"][0]["time"] == pytest.approx(expected, abs=60)


def test_revoked_link_opens_nothing_and_another_goes_on(service: httpx.Client) -> None:
    sent = under_way(service)
    link = sent["links"][0]
    token = token_of(link)
    told(service, token, event("e1", DEPART, today(1)))
    renewed = service.post(f"/dispatches/{sent['id']}/links/{link['id']}")
    assert renewed.status_code == 201
    other = renewed.json()["links"][0]
    for reply in (service.get("/drive/day", headers=holding(token)),
                  service.post("/drive/events", headers=holding(token),
                               json={"now": today(1), "events": []})):
        assert reply.status_code == 410
        assert reply.json()["type"] == "urn:tandem:error:link-over"
        assert "steps" not in reply.json()
    day = service.get("/drive/day", headers=holding(token_of(other))).json()
    assert [step["id"] for step in day["standing"]] == [DEPART]
    revoked = service.delete(f"/dispatches/{sent['id']}/links/{other['id']}").json()
    assert [link["state"] for link in revoked["links"]] == ["revoked", "open"]
    assert service.get("/drive/day", headers=holding(token_of(other))).status_code == 410
    van = sent["links"][1]
    assert service.get("/drive/day", headers=holding(token_of(van))).status_code == 200


def test_ended_day_shows_nothing_but_takes_what_was_told_without_network(
        service: httpx.Client, settings: Settings) -> None:
    sent = under_way(service)
    token = token_of(sent["links"][0])
    ended = service.delete(f"/dispatches/{sent['id']}").json()
    assert {link["state"] for link in ended["links"]} == {"over"}
    assert service.get("/drive/day", headers=holding(token)).status_code == 410
    told(service, token, event("e1", DEPART, today(1)))
    followed = service.get(f"/dispatches/{sent['id']}").json()
    assert followed["links"][0]["done"] == 1
    assert service.post(f"/dispatches/{sent['id']}/links/{sent['links'][0]['id']}"
                        ).status_code == 409


def test_changed_plan_reaches_phones_by_the_same_links(service: httpx.Client) -> None:
    sent = under_way(service)
    truck, van = (token_of(link) for link in sent["links"])
    told(service, van, event("e1", DEPART, today(1)), event("e2", DOOR, today(2)))
    other = [{**PLAN["routes"][1], "vehicle": "van-2"}, PLAN["routes"][0]]
    reply = service.post(f"/dispatches/{sent['id']}/plan", json={
        "problem": PROBLEM, "plan": {"routes": [
            {**PLAN["routes"][1], "trips": [{
                **trip, "stops": [trip["stops"][0], *trip["stops"][:0:-1][1:], trip["stops"][-1]]}
                for trip in PLAN["routes"][1]["trips"]]}]}})
    assert reply.status_code == 200, reply.text
    assert [(link["vehicle"], link["url"]) for link in reply.json()["links"]] == [
        ("truck-1", None), ("van-1", None)]
    day = service.get("/drive/day", headers=holding(van)).json()
    assert [step["place"] for step in day["steps"]] == ["hub", "E", "D", "hub"]
    assert {step["id"] for step in day["standing"]} == {DEPART, DOOR}
    assert service.get("/drive/day", headers=holding(truck)).json()["steps"] == []
    # What is told of a step that is no more doesn't hold up the rest.
    assert told(service, truck, event("e3", FIRST, today(3)))["accepted"] == ["e3"]
    more = service.post(f"/dispatches/{sent['id']}/plan", json={
        "problem": PROBLEM, "plan": {"routes": other}}).json()
    new = next(link for link in more["links"] if link["vehicle"] == "van-2")
    assert service.get("/drive/day", headers=holding(token_of(new))).status_code == 200


def test_link_ends_with_the_day_of_the_plan(service: httpx.Client) -> None:
    tomorrow = (datetime.now(UTC) + timedelta(days=1)).date()
    sent = dispatched(service, plan_start=f"{tomorrow}T00:00:00+02:00",
                      time_zone="Europe/Berlin")
    ends = datetime.fromisoformat(sent["ends_at"])
    assert ends.astimezone(UTC) - datetime.fromisoformat(sent["plan_start"]) in (
        timedelta(hours=23), timedelta(hours=24), timedelta(hours=25))
    over = service.post("/dispatches", json={
        "problem": PROBLEM, "plan": PLAN, "plan_start": "2020-01-01T00:00:00Z"})
    assert over.status_code == 422
    assert over.json()["errors"][0]["path"] == "$.plan_start"


def test_who_comes_home_just_before_midnight_keeps_the_link_for_hours(
        service: httpx.Client) -> None:
    tomorrow = (datetime.now(UTC) + timedelta(days=1)).date()
    home = timedelta(seconds=30_700)
    for hour, left in ((15, timedelta(hours=4)), (10, timedelta(hours=14) - home)):
        sent = dispatched(service, plan_start=f"{tomorrow}T{hour}:00:00Z")
        ends = datetime.fromisoformat(sent["ends_at"])
        assert ends - datetime.fromisoformat(sent["plan_start"]) == home + left


def test_all_is_deleted_when_it_expires(service: httpx.Client, settings: Settings) -> None:
    sent, kept = under_way(service), under_way(service)
    told(service, token_of(sent["links"][0]), event("e1", DEPART, today(1)))
    with opened(settings) as engine:
        with engine.begin() as connection:
            connection.execute(update(DAYS).where(DAYS.c.id == sent["id"])
                               .values(expires_at=now_ms()))
        delete_expired(engine)
        with engine.connect() as connection:
            for table, column in (("driver_links", "dispatch"), ("day_events", "day")):
                rows = connection.execute(text(
                    f"SELECT count(*) FROM {table} WHERE {column} = :id"), {"id": sent["id"]})
                assert rows.scalar() == 0
    assert service.get(f"/dispatches/{sent['id']}").status_code == 404
    token = token_of(sent["links"][0])
    assert service.get("/drive/day", headers=holding(token)).status_code == 401
    assert service.get(f"/dispatches/{kept['id']}").status_code == 200


def test_tokens_are_kept_as_hashes_and_told_to_no_log(
        service: httpx.Client, settings: Settings, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)
    logging.getLogger("httpx").setLevel(logging.WARNING)
    logging.getLogger("httpcore").setLevel(logging.WARNING)
    link = dispatched(service)["links"][0]
    token = token_of(link)
    assert service.get("/drive/day", headers=holding(token)).status_code == 200
    with opened(settings) as engine, engine.connect() as connection:
        rows = connection.execute(text("SELECT * FROM driver_links WHERE id = :id"),
                                  {"id": link["id"]}).mappings().one()
    assert rows["digest"] == digest_of(token)
    secret = token.rpartition("_")[2]
    assert secret not in str(dict(rows))
    eventually(lambda: f"drive:{link['id']}" in str([vars(line) for line in caplog.records]))
    assert secret not in str([vars(line) for line in caplog.records])


@pytest.mark.parametrize("token", ["", "x", "tdm_drive_0123456789ab_" + 64 * "0"])
def test_wrong_token_is_refused_alike(service: httpx.Client, token: str) -> None:
    reply = service.get("/drive/day", headers=holding(token) if token else {})
    assert (reply.status_code, reply.json()["type"]) == (
        401, "urn:tandem:error:unknown-driver-link")
    assert reply.headers["cache-control"] == "no-store"


def test_page_needs_no_token_and_may_load_nothing_from_elsewhere(service: httpx.Client) -> None:
    page = service.get("/drive/")
    assert page.status_code == 200
    policy = page.headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "'unsafe" not in policy
    assert "http" not in policy
    assert page.headers["referrer-policy"] == "no-referrer"
    worker = service.get("/drive/sw.js")
    assert worker.headers["content-type"].startswith("text/javascript")
    assert worker.text.startswith("const VERSION = '")


def changed(path: str, value: Any) -> Data:
    """Return a request with one wrong part."""
    body: Data = {"problem": PROBLEM, "plan": PLAN}
    return body | {path: value}


@pytest.mark.parametrize(("body", "error"), [
    (changed("time_zone", "Mars/Olympus"), ("UNKNOWN_VALUE", "$.time_zone")),
    (changed("plan_start", "2026-11-23T08:00:00"), ("WRONG_TYPE", "$.plan_start")),
    (changed("plan_start", "9999-12-31T23:59:59+14:00"), ("OUT_OF_RANGE", "$.plan_start")),
    (changed("plan_start", "9999-12-31T23:59:59-12:00"), ("OUT_OF_RANGE", "$.plan_start")),
    (changed("plan_start", "0001-01-01T00:00:00+14:00"), ("OUT_OF_RANGE", "$.plan_start")),
    (changed("problem", PROBLEM | {"plan_start": "0001-01-01T00:00:00+14:00",
                                   "time_zone": "Europe/Berlin"}),
     ("OUT_OF_RANGE", "$.problem.plan_start")),
    (changed("plan", {"routes": [PLAN["routes"][1] | {"vehicle": "van-3"}]}),
     ("UNKNOWN_VEHICLE", "$.plan.routes[0].vehicle")),
    (changed("plan", {"routes": [PLAN["routes"][1] | {"type": "bus"}]}),
     ("UNKNOWN_VEHICLE_TYPE", "$.plan.routes[0].type")),
    (changed("problem", PROBLEM | {"depots": [{"id": "yard", "location": [11.5, 48.1]}]}),
     ("UNKNOWN_DEPOT", "$.plan.routes[0].trips[0].stops[0].id")),
    (changed("x", 1), ("UNKNOWN_FIELD", "$.x")),
])
def test_what_is_wrong_with_a_plan_is_named(service: httpx.Client, body: Data,
                                            error: tuple[str, str]) -> None:
    reply = service.post("/dispatches", json=body)
    assert reply.status_code == 422
    assert error in {(item["code"], item["path"]) for item in reply.json()["errors"]}


@pytest.mark.usefixtures("same_minute")
def test_drivers_need_no_key_and_owners_see_their_own_alone(serve: Serve, tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path, access="keys", drain_seconds=0,
                        max_dispatches_per_client=1, driver_requests_per_minute=2)
    client = ready(serve(FirstFitPlanner(), settings))
    with opened(settings) as engine:
        mine, other = [{"X-API-Key": KeyStore(engine).create(name, ["jobs"])}
                       for name in ("ann", "bob")]
    assert client.post("/dispatches", json={"problem": PROBLEM, "plan": PLAN}).status_code == 401
    client.headers = {**client.headers, **mine}
    sent = dispatched(client)
    refused = client.post("/dispatches", json={"problem": PROBLEM, "plan": PLAN})
    assert (refused.status_code, refused.json()["type"]) == (
        429, "urn:tandem:error:too-many-dispatches")
    address, link = f"/dispatches/{sent['id']}", sent["links"][0]
    for method, path in (("GET", address), ("DELETE", address), ("GET", f"{address}/replan"),
                         ("POST", f"{address}/links/{link['id']}"),
                         ("DELETE", f"{address}/links/{link['id']}")):
        assert client.request(method, path, headers=other).status_code == 404
    assert client.get("/dispatches", headers=other).json() == {"dispatches": []}
    assert [item["id"] for item in client.get("/dispatches").json()["dispatches"]] == [sent["id"]]
    driver = httpx.Client(base_url=client.base_url, trust_env=False, timeout=PATIENCE,
                          headers=holding(token_of(link)))
    with driver:
        assert [driver.get("/drive/day").status_code for _ in range(3)] == [200, 200, 429]


def test_day_of_the_problem_is_that_of_its_drivers(service: httpx.Client) -> None:
    day = {"plan_start": today(25 * 3600), "time_zone": "Europe/Berlin"}
    reply = dispatched(service, problem=PROBLEM | day)
    assert datetime.fromisoformat(reply["plan_start"]) == datetime.fromisoformat(day["plan_start"])
    assert reply["time_zone"] == "Europe/Berlin"
