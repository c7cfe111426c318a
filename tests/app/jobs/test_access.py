"""Jobs belong to the key that made them."""

import time
from collections.abc import Callable
from pathlib import Path

import httpx
import pytest

from app.access.keys import KeyStore
from app.database import make_engine
from app.settings import Settings
from tests.app.jobs.stepping import SteppingPlanner, eventually, request_of, submit

Headers = dict[str, str]


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    """Return settings that demand keys."""
    return Settings(data_dir=tmp_path, access="keys", drain_seconds=0)


@pytest.fixture
def client(serve: Callable[..., httpx.Client], settings: Settings) -> httpx.Client:
    """Return a client of a service that demands keys, without one."""
    client = serve(SteppingPlanner(), settings)
    eventually(lambda: client.get("/health/ready").status_code == 200)
    return client


def key_for(settings: Settings, *scopes: str) -> Headers:
    """Make a key and return the header that sends it."""
    engine = make_engine(settings)
    key = KeyStore(engine).create("test", scopes)
    engine.dispose()
    return {"Authorization": f"Bearer {key}"}


def test_job_is_visible_to_the_key_that_made_it_alone(
        client: httpx.Client, settings: Settings) -> None:
    mine, other = key_for(settings, "jobs"), key_for(settings, "jobs")
    key = {"Idempotency-Key": "the same"}
    job = submit(client, request_of(1), headers=mine | key)
    assert client.get(f"/jobs/{job}", headers=mine).status_code == 200
    for method, path in (("GET", ""), ("GET", "/events"), ("GET", "/plan.svg"),
                         ("DELETE", "")):
        assert client.request(method, f"/jobs/{job}{path}", headers=other).status_code == 404
    assert client.get("/jobs", headers=other).json()["jobs"] == []
    assert submit(client, request_of(1), headers=other | key) != job
    assert client.get(f"/jobs/{job}", headers=mine).json()["state"] == "queued"


def test_jobs_need_a_key_with_their_scope(client: httpx.Client, settings: Settings) -> None:
    planner = key_for(settings, "plan")
    for method, path in (("POST", "/jobs"), ("GET", "/jobs"), ("GET", "/jobs/x"),
                         ("DELETE", "/jobs/x"), ("GET", "/jobs/x/events"),
                         ("GET", "/jobs/x/plan.svg"), ("POST", "/compare"),
                         ("POST", "/sweep")):
        assert client.request(method, path).status_code == 401
        assert client.request(method, path, headers=planner).status_code == 403


def test_stream_of_a_revoked_key_ends(client: httpx.Client, settings: Settings) -> None:
    mine = key_for(settings, "jobs")
    job = submit(client, request_of(1), headers=mine)
    with client.stream("GET", f"/jobs/{job}/events", headers=mine) as stream:
        lines = stream.iter_lines()
        assert next(lines).startswith("id:")
        engine = make_engine(settings)
        assert KeyStore(engine).revoke(mine["Authorization"].split("_")[1])
        engine.dispose()
        began = time.monotonic()
        rest = list(lines)
        # As promised, with some patience for a busy machine.
        assert time.monotonic() - began < 5
    assert "event: end" not in rest
    assert client.get(f"/jobs/{job}/events", headers=mine).status_code == 401


def test_stream_of_a_valid_key_goes_on(client: httpx.Client, settings: Settings) -> None:
    mine, other = key_for(settings, "jobs"), key_for(settings, "jobs")
    job = submit(client, request_of(1), headers=mine)
    with client.stream("GET", f"/jobs/{job}/events", headers=mine) as stream:
        lines = stream.iter_lines()
        assert next(lines).startswith("id:")
        engine = make_engine(settings)
        KeyStore(engine).revoke(other["Authorization"].split("_")[1])
        engine.dispose()
        client.delete(f"/jobs/{job}", headers=mine)
        assert "event: end" in list(lines)
