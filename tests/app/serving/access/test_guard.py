"""Requests with and without keys, over HTTP."""

import logging
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from prometheus_client.parser import text_string_to_metric_families
from sqlalchemy.exc import OperationalError

from app.serving.access.guard import REFRESH_SECONDS
from app.serving.access.keys import KeyStore, Scope
from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner, opened, ready
from tests.conftest import SOON, soon

pytestmark = pytest.mark.slow

Request = dict[str, Any]
Serve = Callable[..., httpx.Client]


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    """Return settings that let in none without a key."""
    return Settings(access="keys", data_dir=tmp_path, wrong_keys_per_minute=0,
                    metrics_open=True)


@pytest.fixture
def store(settings: Settings) -> Iterator[KeyStore]:
    """Return the keys of the service."""
    with opened(settings) as engine:
        yield KeyStore(engine)


@pytest.fixture
def guarded(serve: Serve, settings: Settings, store: KeyStore) -> httpx.Client:
    """Return a client of a service that needs keys."""
    client = serve(FirstFitPlanner(), settings)
    return ready(client)


def status(client: httpx.Client, request: Request, **headers: str) -> int:
    """Return the status of a plan asked for with headers."""
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    return client.post("/plan", json=request, headers=named).status_code


def refusals(client: httpx.Client) -> float:
    """Return how many refusals for want of a key metrics tell."""
    families = text_string_to_metric_families(client.get("/metrics").text)
    return sum(sample.value for family in families for sample in family.samples
               if sample.name == "tandem_refused_requests_total"
               and sample.labels["reason"] == "access")


def test_key_lets_in_by_either_header(
        guarded: httpx.Client, store: KeyStore, smallest: Request) -> None:
    key = store.create("ann", ["plan"])
    soon(lambda: status(guarded, smallest, authorization=f"Bearer {key}") == 200)
    assert status(guarded, smallest, x_api_key=key) == 200
    assert status(guarded, smallest, authorization=f"bearer {key}", x_api_key=key) == 200


def test_all_invalid_keys_get_the_same_reply(
        guarded: httpx.Client, store: KeyStore, smallest: Request) -> None:
    key, revoked = (store.create(name, ["plan"]) for name in "ab")
    soon(lambda: status(guarded, smallest, x_api_key=revoked) == 200)
    store.revoke(revoked.split("_")[1])
    soon(lambda: status(guarded, smallest, x_api_key=revoked) == 401)
    wrong = key[:-1] + ("0" if key[-1] != "0" else "1")
    before = time.monotonic()
    replies = [guarded.post("/plan", json=smallest, headers=headers) for headers in (
        {}, {"X-API-Key": revoked}, {"X-API-Key": wrong}, {"X-API-Key": "junk"},
        {"X-API-Key": key.replace(key[4:16], "0" * 12)}, {"Authorization": f"Basic {key}"},
        {"Authorization": f"Bearer {key}", "X-API-Key": wrong})]
    assert time.monotonic() - before < SOON
    assert {reply.status_code for reply in replies} == {401}
    assert len({reply.content for reply in replies}) == 1
    assert replies[0].headers["content-type"] == "application/problem+json"
    assert replies[0].headers["www-authenticate"].startswith("Bearer")


def test_refusals_are_counted(guarded: httpx.Client, smallest: Request) -> None:
    before = refusals(guarded)
    for _ in range(3):
        assert status(guarded, smallest, x_api_key="junk") == 401
    assert refusals(guarded) == before + 3


@pytest.mark.parametrize("scope", ["jobs", "admin"])
def test_key_without_the_scope_is_forbidden(
        guarded: httpx.Client, store: KeyStore, smallest: Request, scope: Scope) -> None:
    key = store.create("ann", [scope])
    soon(lambda: status(guarded, smallest, x_api_key=key) == 403)
    reply = guarded.post("/plan", json=smallest, headers={"X-API-Key": key})
    assert reply.json()["type"] == "urn:tandem:error:forbidden"
    assert "plan" in reply.json()["detail"]


@pytest.mark.by_clock
def test_revoked_key_works_no_longer_than_promised(
        guarded: httpx.Client, store: KeyStore, smallest: Request) -> None:
    key = store.create("ann", ["plan"])
    soon(lambda: status(guarded, smallest, x_api_key=key) == 200)
    store.revoke(key.split("_")[1])
    revoked_at = time.monotonic()
    soon(lambda: status(guarded, smallest, x_api_key=key) == 401)
    assert time.monotonic() - revoked_at < REFRESH_SECONDS + 1


def test_last_use_is_noted(guarded: httpx.Client, store: KeyStore, smallest: Request) -> None:
    key = store.create("ann", ["plan"])
    soon(lambda: status(guarded, smallest, x_api_key=key) == 200)
    (stored,) = store.load().values()
    assert stored.last_used_at is not None
    assert abs(stored.last_used_at - time.time()) < 60


def test_what_is_for_everybody_needs_no_key(guarded: httpx.Client) -> None:
    for path in ("/health/live", "/health/ready", "/docs", "/openapi.json"):
        assert guarded.get(path).status_code == 200


def test_keys_in_memory_serve_while_the_database_is_away(
        guarded: httpx.Client, store: KeyStore, smallest: Request,
        monkeypatch: pytest.MonkeyPatch) -> None:
    key = store.create("ann", ["plan"])
    soon(lambda: status(guarded, smallest, x_api_key=key) == 200)
    tried: list[bool] = []

    def fail(_: object) -> None:
        tried.append(True)
        raise OperationalError("SELECT", {}, OSError())

    monkeypatch.setattr(KeyStore, "load", fail)
    soon(lambda: status(guarded, smallest, x_api_key=key) == 200 and bool(tried))
    assert status(guarded, smallest, x_api_key=key + "0") == 401
    monkeypatch.setattr("app.serving.access.guard.STALE_SECONDS", 0.0)
    reply = guarded.post("/plan", json=smallest, headers={"X-API-Key": key})
    assert reply.status_code == 503
    assert reply.json()["type"] == "urn:tandem:error:keys-unreadable"
    assert int(reply.headers["retry-after"]) > 0


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("address", [
    "/plan?key=KEY", "/plan?a=1&api_key=KEY", "/plan?API-KEY=other", "/plan?access_token=other",
    "/plan?note=KEY", "/plan?note=%74dm_KEY", "/plan?%6bey=other", "/jobs/KEY", "/%74dm_x/plan"])
def test_key_in_an_address_is_refused_and_not_logged(
        guarded: httpx.Client, store: KeyStore, smallest: Request,
        caplog: pytest.LogCaptureFixture, address: str) -> None:
    caplog.set_level(logging.DEBUG)
    key = store.create("ann", ["plan"])
    # The client's own log isn't the service's.
    logging.getLogger("httpx").setLevel(logging.WARNING)
    logging.getLogger("httpcore").setLevel(logging.WARNING)
    reply = guarded.post(address.replace("KEY", key), json=smallest,
                         headers={"Authorization": f"Bearer {key}"})
    assert reply.status_code == 400
    assert reply.json()["type"] == "urn:tandem:error:key-in-url"
    # A request's line is written when its reply has left.
    soon(lambda: any(record.name == "tandem.access" for record in caplog.records))
    assert key not in caplog.text
    assert "tdm_" not in caplog.text
    assert "%74dm" not in caplog.text


def test_openapi_tells_how_to_send_keys(guarded: httpx.Client) -> None:
    description = guarded.get("/openapi.json").json()
    schemes = description["components"]["securitySchemes"]
    assert {scheme["type"] for scheme in schemes.values()} == {"http", "apiKey"}
    plan = description["paths"]["/plan"]["post"]
    assert {name for option in plan["security"] for name in option} == {"HTTPBearer",
                                                                        "APIKeyHeader"}
    shared = description["paths"]["/shared-plan"]["get"]
    assert shared["security"] == [{"ShareToken": []}]
    assert description["paths"]["/drive/day"]["get"]["security"] == [{"DriverLink": []}]
    assert description["paths"]["/visit/order"]["get"]["security"] == [{"CustomerLink": []}]
    assert set(schemes) == {"HTTPBearer", "APIKeyHeader", "ShareToken", "DriverLink",
                            "CustomerLink"}
    assert {"401", "403", "408", "429", "503"} <= set(plan["responses"])


def test_open_access_needs_no_key(serve: Serve, smallest: Request, tmp_path: Path) -> None:
    client = serve(FirstFitPlanner(), Settings(access="open", data_dir=tmp_path))
    ready(client)
    assert status(client, smallest) == 200
    assert status(client, smallest, x_api_key="junk") == 200
