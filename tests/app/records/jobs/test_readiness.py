"""When a service says that it is ready, beside jobs."""

import threading
from collections.abc import Callable
from pathlib import Path

import httpx
import pytest
from dbos import DBOS
from sqlalchemy import text

from app.database.migrations.running import newest, upgrade
from app.database.migrations.version import VERSION_TABLE
from app.serving.access.keys import KeyStore
from app.serving.settings import Settings
from tests.app.conftest import opened
from tests.app.postgres import Postgres
from tests.app.records.jobs.stepping import SteppingPlanner, request_of
from tests.conftest import eventually, free_port

pytestmark = pytest.mark.slow

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


def test_keys_are_read_as_soon_as_the_database_comes(
        serve: Serve, tmp_path: Path, fragile_postgres: Postgres) -> None:
    url = fragile_postgres.create("late")
    settings = Settings(data_dir=tmp_path, database_url=url, access="keys")
    fragile_postgres.stop()
    try:
        client = serve(SteppingPlanner(), settings)
        detail = eventually(lambda: client.get("/health/ready").json()["detail"].count(
            "the database can't be reached") and client.get("/health/ready").json()["detail"])
        assert detail.startswith("The API keys can't be read")
        assert client.get("/health/ready").status_code == 503
        refused = client.post("/plan", json=request_of(0), headers={"X-API-Key": "any"})
        assert (refused.status_code, refused.json()["type"]) == (
            503, "urn:tandem:error:keys-unreadable")
        assert "can't be reached" in refused.json()["detail"]
        assert client.get("/health/live").status_code == 200
    finally:
        fragile_postgres.start()
    eventually(lambda: client.get("/health/ready").status_code == 200)
    with opened(settings) as engine:
        key = {"X-API-Key": KeyStore(engine).create("ann", ["plan", "jobs"])}
    eventually(lambda: client.post("/plan", json=request_of(0), headers=key).status_code == 200)
    eventually(lambda: client.post("/jobs", json=request_of(0), headers=key).status_code == 202)


MISFITS = [("ALTER TABLE jobs DROP COLUMN webhook", "ALTER TABLE jobs ADD COLUMN webhook TEXT",
            "The database's table jobs lacks the column webhook"),
           (f"UPDATE {VERSION_TABLE} SET version_num = '9999'",
            f"UPDATE {VERSION_TABLE} SET version_num = '{newest()}'",
            "The database has the version 9999")]


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize(("spoil", "mend", "words"), MISFITS)
def test_tables_that_do_not_fit_at_the_start_are_told_in_words(
        serve: Serve, settings: Settings, spoil: str, mend: str, words: str) -> None:
    settings = settings.model_copy(update={"role": "api"})
    with opened(settings) as engine:
        upgrade(engine)
    change(settings, spoil)
    client = serve(SteppingPlanner(), settings)
    ready = eventually(lambda: (reply := client.get("/health/ready")).json()["detail"]
                       .startswith(words) and reply)
    assert (ready.status_code, ready.json()["status"]) == (503, "unavailable")
    refused = client.post("/jobs", json=request_of(0))
    assert refused.status_code == 503
    assert words in refused.json()["detail"]
    change(settings, mend)
    eventually(lambda: client.get("/health/ready").status_code == 200)
    assert client.post("/jobs", json=request_of(0)).status_code == 202


def test_column_that_is_lost_under_way_is_told_in_words(
        serve: Serve, settings: Settings) -> None:
    settings = settings.model_copy(update={"role": "api"})
    client = serve(SteppingPlanner(), settings)
    eventually(lambda: client.get("/health/ready").status_code == 200)
    spoil, mend, words = MISFITS[0]
    change(settings, spoil)
    refused = client.post("/jobs", json=request_of(0))
    assert refused.status_code == 503
    assert words in refused.json()["detail"]
    ready = client.get("/health/ready")
    assert (ready.status_code, ready.json()["status"]) == (503, "unavailable")
    assert words in ready.json()["detail"]
    change(settings, mend)
    assert client.get("/health/ready").status_code == 200
    assert client.post("/jobs", json=request_of(0)).status_code == 202


def change(settings: Settings, statement: str) -> None:
    """Change the database."""
    with opened(settings) as engine, engine.begin() as connection:
        connection.execute(text(statement))
