"""Jobs belong to the key that made them."""

import time
from collections.abc import Callable
from pathlib import Path

import httpx
import pytest

from app.database.connections import make_engine
from app.serving.access.keys import KeyStore
from app.serving.settings import Settings
from tests.app.records.jobs.stepping import SteppingPlanner, request_of, submit
from tests.conftest import SOON, eventually

pytestmark = pytest.mark.slow

Headers = dict[str, str]
Serve = Callable[..., httpx.Client]


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
    engine = make_engine(settings.database)
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
        engine = make_engine(settings.database)
        assert KeyStore(engine).revoke(mine["Authorization"].split("_")[1])
        engine.dispose()
        began = time.monotonic()
        rest = list(lines)
        # As promised, with some patience for a busy machine; the job itself never ends.
        assert time.monotonic() - began < SOON
    assert "event: end" not in rest
    assert client.get(f"/jobs/{job}/events", headers=mine).status_code == 401


def test_stream_of_a_valid_key_goes_on(client: httpx.Client, settings: Settings) -> None:
    mine, other = key_for(settings, "jobs"), key_for(settings, "jobs")
    job = submit(client, request_of(1), headers=mine)
    with client.stream("GET", f"/jobs/{job}/events", headers=mine) as stream:
        lines = stream.iter_lines()
        assert next(lines).startswith("id:")
        engine = make_engine(settings.database)
        KeyStore(engine).revoke(other["Authorization"].split("_")[1])
        engine.dispose()
        client.delete(f"/jobs/{job}", headers=mine)
        assert "event: end" in list(lines)


def test_a_key_has_its_share_of_the_open_jobs(serve: Serve, tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path, access="keys", drain_seconds=0, max_open_jobs=5,
                        max_open_jobs_per_client=3)
    client = serve(SteppingPlanner(), settings)
    eventually(lambda: client.get("/health/ready").status_code == 200)
    mine, other = key_for(settings, "jobs"), key_for(settings, "jobs")
    first = submit(client, request_of(1), headers=mine)
    sweep = {"base": request_of(1), "grid": {"unassigned_cost": [50, 60, 70]}}
    refused = client.post("/sweep", json=sweep, headers=mine)
    assert (refused.status_code, refused.json()["type"]) == (
        429, "urn:tandem:error:job-share-used-up")
    assert "TANDEM_MAX_OPEN_JOBS_PER_CLIENT" in refused.json()["detail"]
    assert int(refused.headers["retry-after"]) > 0
    assert client.post("/sweep", json=sweep, headers=other).status_code == 202
    submit(client, request_of(1), headers=mine)
    # As many as may, whosever they are; a sweep counts whole before its scenarios are begun.
    full = client.post("/jobs", json=request_of(1), headers=mine)
    assert (full.status_code, full.json()["type"]) == (503, "urn:tandem:error:too-many-jobs")
    client.delete(f"/jobs/{first}", headers=mine)
    submit(client, request_of(1), headers=mine)


def test_an_address_has_its_share_where_access_is_open(serve: Serve, tmp_path: Path) -> None:
    client = serve(SteppingPlanner(), Settings(data_dir=tmp_path, max_open_jobs_per_client=1))
    eventually(lambda: client.get("/health/ready").status_code == 200)

    def status(address: str) -> int:
        return client.post("/jobs", json=request_of(1),
                           headers={"X-Forwarded-For": address}).status_code

    assert [status(address) for address in ("192.0.2.1", "192.0.2.1", "192.0.2.2")] == [
        202, 429, 202]
    assert [status(address) for address in ("2001:db8::1", "2001:db8::2")] == [202, 429]


def test_share_is_a_quarter_but_holds_the_largest_sweep() -> None:
    assert Settings().max_open_jobs_per_client == 2500
    assert Settings(max_open_jobs=1000).max_open_jobs_per_client == 500
    assert Settings(max_open_jobs=100).max_open_jobs_per_client == 100
