"""When a service says that it is ready, beside jobs."""

import threading
from collections.abc import Callable
from pathlib import Path

import httpx
import pytest
from dbos import DBOS

from app.settings import Settings
from tests.app.jobs.stepping import SteppingPlanner, eventually, request_of
from tests.conftest import free_port

Serve = Callable[..., httpx.Client]


def test_service_is_ready_only_when_jobs_are_taken(
        serve: Serve, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    go_on, migrate = threading.Event(), DBOS.migrate

    def migrate_slowly(url: str) -> None:
        assert go_on.wait(60)
        migrate(url)

    monkeypatch.setattr(DBOS, "migrate", migrate_slowly)
    client = serve(SteppingPlanner(), Settings(data_dir=tmp_path, role="api"))
    eventually(lambda: client.post("/plan", json=request_of(0)).status_code == 200)
    starting = client.get("/health/ready")
    assert (starting.status_code, starting.json()["detail"]) == (
        503, "the database is being prepared")
    go_on.set()
    eventually(lambda: client.get("/health/ready").status_code == 200)
    assert client.post("/jobs", json=request_of(0)).status_code == 202


def test_service_without_its_database_is_ready_for_plans(serve: Serve, tmp_path: Path) -> None:
    nowhere = f"postgresql://nobody@127.0.0.1:{free_port()}/none"
    client = serve(SteppingPlanner(), Settings(data_dir=tmp_path, database_url=nowhere))
    eventually(lambda: client.get("/health/ready").status_code == 200)
    assert client.post("/plan", json=request_of(0)).status_code == 200
    refused = client.post("/jobs", json=request_of(0))
    assert (refused.status_code, "retry-after" in refused.headers) == (503, True)
