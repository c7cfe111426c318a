"""The way of the database's tables from version to version, on both databases."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Engine, inspect, text

from app.database.connections import Purpose, alone, make_engine
from app.database.migrations.running import (
    SchemaError, downgrade, find_misfit, newest, upgrade, version_of,
)
from app.database.migrations.steps import run as run_migrations
from app.database.migrations.version import VERSION_TABLE
from app.database.tables import TABLES
from app.serving.access.keys import KeyStore, find_key
from app.serving.settings import Settings

FIRST = "0001"
FOLDER = Path(__file__).parents[4] / "app" / "database" / "migrations"

JOB = {"id": "j1", "kind": "plan", "owner": "ann", "state": "queued", "fingerprint": "f",
       "created_at": 1, "progress": 0.0, "search_iterations": 0, "searched": 0.0,
       "cancel_requested": False, "revision": 1, "improved_revision": 0, "attempt": 0,
       "crashes": 0}


@pytest.fixture
def engine(settings: Settings) -> Iterator[Engine]:
    """Return an empty database."""
    engine = make_engine(settings.database)
    yield engine
    engine.dispose()


def run(engine: Engine, statement: str, values: dict[str, Any] | None = None) -> list[Any]:
    """Run a statement; return its rows, if it has any."""
    with engine.begin() as connection:
        result = connection.execute(text(statement), values or {})
        return list(result) if result.returns_rows else []


def add_job(engine: Engine) -> None:
    """Add a job by those columns alone that the first version has."""
    run(engine, f"INSERT INTO jobs ({', '.join(JOB)}) VALUES (:{', :'.join(JOB)})", JOB)


def differences(engine: Engine) -> list[Any]:
    """Return what Alembic would change to come to the tables of this version."""
    with engine.connect() as connection:
        context = MigrationContext.configure(connection, opts={
            "version_table": VERSION_TABLE, "compare_type": True})
        return compare_metadata(context, TABLES)


def forget_version(engine: Engine) -> None:
    """Leave the tables as those of before there were versions."""
    upgrade(engine)
    downgrade(engine, FIRST)
    run(engine, f"DROP TABLE {VERSION_TABLE}")


def test_migrations_lead_to_the_tables_of_this_version(engine: Engine) -> None:
    with alone(engine, Purpose.CHANGING_TABLES) as connection:
        run_migrations(connection, "upgrade", newest())
    assert version_of(engine) == newest()
    assert differences(engine) == []
    upgrade(engine)
    assert find_misfit(engine) is None


def test_empty_database_gets_the_tables_of_this_version_at_once(engine: Engine) -> None:
    upgrade(engine)
    assert version_of(engine) == newest()
    assert differences(engine) == []
    stated = inspect(engine)
    assert stated.get_pk_constraint(VERSION_TABLE)["name"] == f"{VERSION_TABLE}_pkc"


def test_way_back_and_up_again_keeps_keys_and_jobs(engine: Engine) -> None:
    key = KeyStore(engine).create("ann", ["plan"])
    add_job(engine)
    downgrade(engine, FIRST)
    assert version_of(engine) == FIRST
    upgrade(engine)
    assert differences(engine) == []
    assert find_key(KeyStore(engine).load(), key) is not None
    assert run(engine, "SELECT id, owner FROM jobs") == [("j1", "ann")]


def test_tables_of_before_there_were_versions_are_taken_over(engine: Engine) -> None:
    forget_version(engine)
    add_job(engine)
    upgrade(engine)
    assert version_of(engine) == newest()
    assert differences(engine) == []
    assert run(engine, "SELECT id, state FROM jobs") == [("j1", "queued")]


def test_open_sweeps_count_with_their_scenarios_after_the_upgrade(engine: Engine) -> None:
    forget_version(engine)
    add_job(engine)
    for scenario in ("a", "b", "c"):
        run(engine, f"INSERT INTO jobs ({', '.join(JOB)}, parent) "
            f"VALUES (:{', :'.join(JOB)}, 'j1')", JOB | {"id": scenario})
    upgrade(engine)
    assert run(engine, "SELECT plans FROM jobs ORDER BY id") == [(1,), (1,), (1,), (3,)]


def test_what_drivers_told_stays_on_the_way_there_and_back(engine: Engine) -> None:
    upgrade(engine)
    downgrade(engine, "0009")
    run(engine, "INSERT INTO dispatches (id, owner, client, created_at, plan_start, ends_at, "
        "expires_at, zone_offset, plan) VALUES ('d', 'o', 'c', 1, 1, 2, 3, 0, :plan)",
        {"plan": b"p"})
    run(engine, "INSERT INTO driver_links (id, dispatch, position, vehicle, digest, steps) "
        "VALUES ('l', 'd', 0, 'van-1', :none, :none)", {"none": b""})
    told = [("d", 0, "e2", 1, "1-stop-ab", "failed", 20, 21, "Nobody there"),
            ("d", 0, "e1", 0, "1-depart-cd", "done", 10, 11, None)]
    names = ["dispatch", "position", "id", "number", "step", "kind", "time", "received_at",
             "reason"]
    for row in told:
        run(engine, f"INSERT INTO driver_events ({', '.join(names)}) VALUES (:{', :'.join(names)})",
            dict(zip(names, row, strict=True)))
    upgrade(engine)
    assert run(engine, "SELECT number, kind, vehicle, outcome, reason FROM day_events "
               "ORDER BY number") == [
        (1, "vehicle.departed", "van-1", "done", None),
        (2, "vehicle.failed", "van-1", "failed", "Nobody there")]
    assert run(engine, "SELECT id, revision FROM days") == [("d", 2)]
    downgrade(engine, "0009")
    assert run(engine, "SELECT dispatch, position, id, step, kind, time, received_at, reason "
               "FROM driver_events ORDER BY number DESC") == [
        (*row[:3], *row[4:]) for row in told]
    assert run(engine, "SELECT id FROM dispatches") == [("d",)]


def test_half_of_the_tables_are_taken_over_too(engine: Engine) -> None:
    forget_version(engine)
    for table in ("jobs", "job_requests", "job_results"):
        run(engine, f"DROP TABLE {table}")
    upgrade(engine)
    assert differences(engine) == []


def test_processes_may_upgrade_at_once(settings: Settings) -> None:
    def start(_: int) -> None:
        engine = make_engine(settings.database)
        upgrade(engine)
        engine.dispose()

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(start, range(8)))


def test_later_version_is_told_in_words(engine: Engine) -> None:
    upgrade(engine)
    run(engine, f"UPDATE {VERSION_TABLE} SET version_num = '9999'")
    with pytest.raises(SchemaError, match=r"has the version 9999.*run the later one"):
        upgrade(engine)
    assert "9999" in (find_misfit(engine) or "")
    assert version_of(engine) == "9999"


@pytest.mark.parametrize(("change", "words"), [
    ("ALTER TABLE jobs DROP COLUMN webhook", "jobs lacks the column webhook"),
    ("ALTER TABLE api_keys DROP COLUMN name", "api_keys lacks the column name"),
    ("DROP TABLE job_results", "lacks the table job_results"),
    ("ALTER TABLE jobs RENAME COLUMN webhook TO hook", "jobs lacks the column webhook")])
def test_tables_that_do_not_fit_are_told_in_words(
        engine: Engine, change: str, words: str) -> None:
    upgrade(engine)
    run(engine, change)
    assert words in (find_misfit(engine) or "")
    with pytest.raises(SchemaError, match=words):
        upgrade(engine)


def test_column_that_would_have_to_be_filled_is_told(settings: Settings) -> None:
    engine = make_engine(settings.database)
    upgrade(engine)
    run(engine, "ALTER TABLE jobs ADD COLUMN note TEXT")
    assert find_misfit(engine) is None
    if engine.dialect.name == "postgresql":
        run(engine, "ALTER TABLE jobs ALTER COLUMN note SET NOT NULL")
        assert "needs the column note" in (find_misfit(engine) or "")
    engine.dispose()


def test_upgrade_that_fails_changes_nothing(engine: Engine) -> None:
    run(engine, "CREATE TABLE jobs (id VARCHAR(36), note TEXT)")
    with pytest.raises(SchemaError, match="can't be brought"):
        upgrade(engine)
    assert inspect(engine).get_table_names() == ["jobs"]


def test_there_is_no_way_back_to_what_never_was(engine: Engine) -> None:
    for version in ("0000", "9999", ""):
        with pytest.raises(SchemaError, match=FIRST):
            downgrade(engine, version)
    upgrade(engine)
    with pytest.raises(SchemaError, match="leads back"):
        downgrade(engine, "0000")


def test_each_migration_follows_the_one_before_and_one_is_the_newest() -> None:
    scripts = ScriptDirectory(str(FOLDER))
    versions = sorted(script.revision for script in scripts.walk_revisions())
    assert scripts.get_heads() == [versions[-1]] == [newest()]
    before = {script.revision: script.down_revision for script in scripts.walk_revisions()}
    assert before == dict(zip(versions, [None, *versions[:-1]], strict=True))


def test_migrations_are_installed_with_the_service() -> None:
    for file in FOLDER.rglob("*.py"):
        assert (file.parent / "__init__.py").exists()
