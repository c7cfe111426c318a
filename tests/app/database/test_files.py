"""SQLite's file under a running service: deleted, put back, replaced, or not to be written."""

import resource
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import pytest
from sqlalchemy import text
from sqlalchemy.exc import OperationalError
from typer.testing import CliRunner

from app.cli.commands import cli
from app.database.connections import FILE_NAME
from app.database.durable import connect
from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner, ready
from tests.app.records.jobs.stepping import request_of
from tests.conftest import eventually

Serve = Callable[..., httpx.Client]


def put_away(folder: Path, ends: tuple[str, ...] = ("", "-wal", "-shm")) -> Callable[[], None]:
    """Take the database's files away; return what puts them back."""
    moved = [(file, file.with_name(f"{file.name}.away"))
             for end in ends if (file := folder / f"{FILE_NAME}{end}").exists()]
    for file, away in moved:
        file.rename(away)

    def put_back() -> None:
        for file, away in moved:
            away.rename(file)

    return put_back


def asked(client: httpx.Client) -> dict[str, int]:
    """Return how what has to be kept is answered, and what the service says of itself."""
    kept = {"name": "a", "request": {"depots": [], "customers": [], "fleet": []}}
    return {"job": client.post("/jobs", json=request_of(0)).status_code,
            "plan": client.put("/plans/mine", json=kept, headers={"If-Match": "*"}).status_code,
            "ready": client.get("/health/ready").status_code}


def test_nothing_is_accepted_once_the_file_is_gone(serve: Serve, tmp_path: Path) -> None:
    client = ready(serve(FirstFitPlanner(), Settings(data_dir=tmp_path, role="api")))
    new = {"name": "a", "request": {"depots": [], "customers": [], "fleet": []}}
    assert client.put("/plans/mine", json=new).status_code == 201
    assert asked(client) == {"job": 202, "plan": 200, "ready": 200}
    put_back = put_away(tmp_path)
    refused = client.post("/jobs", json=request_of(0))
    assert (refused.status_code, "file is gone" in refused.json()["detail"]) == (503, True)
    assert asked(client) == {"job": 503, "plan": 503, "ready": 503}
    assert "file is gone" in client.get("/health/ready").json()["detail"]
    assert client.post("/plan", json=request_of(0)).status_code == 200
    put_back()
    assert asked(client) == {"job": 202, "plan": 200, "ready": 200}
    assert len(client.get("/jobs").json()["jobs"]) == 2


@contextmanager
def short_files(most: int) -> Iterator[None]:
    """Let no file of this process grow beyond so many bytes, as on a disk without room."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_a_disk_without_room_is_told(serve: Serve, tmp_path: Path) -> None:
    client = ready(serve(FirstFitPlanner(), Settings(data_dir=tmp_path, role="api")))
    with short_files(2**16):
        told = client.get("/health/ready")
    assert (told.status_code, told.json()["status"]) == (503, "unavailable")
    assert "Nothing can be written to the database's folder" in told.json()["detail"]
    assert client.get("/health/ready").status_code == 200


def test_an_empty_file_in_its_place_is_told(serve: Serve, tmp_path: Path) -> None:
    client = ready(serve(FirstFitPlanner(), Settings(data_dir=tmp_path, role="api")))
    assert client.post("/jobs", json=request_of(0)).status_code == 202
    put_away(tmp_path)
    (tmp_path / FILE_NAME).touch()
    assert client.get("/health/ready").status_code == 503
    assert asked(client)["job"] == 503


@pytest.mark.parametrize("ends", [("",), ("-wal",), ("", "-wal", "-shm")])
def test_a_transaction_under_way_commits_to_no_file_that_is_gone(
        tmp_path: Path, ends: tuple[str, ...]) -> None:
    engine = connect(Settings(data_dir=tmp_path).database)
    with engine.begin() as connection:
        connection.execute(text("CREATE TABLE a (x INTEGER)"))
    with engine.connect() as connection:
        connection.execute(text("INSERT INTO a VALUES (1)"))
        put_away(tmp_path, ends)
        with pytest.raises(OperationalError, match="gone"):
            connection.commit()
    engine.dispose()


def test_a_file_that_is_put_back_is_written_again(tmp_path: Path) -> None:
    engine = connect(Settings(data_dir=tmp_path).database)

    def write() -> Any:
        with engine.begin() as connection:
            connection.execute(text("CREATE TABLE IF NOT EXISTS a (x INTEGER)"))
            connection.execute(text("INSERT INTO a VALUES (1)"))
            return connection.execute(text("SELECT count(*) FROM a")).scalar()

    assert write() == 1
    put_back = put_away(tmp_path)
    with pytest.raises(OperationalError):
        write()
    assert not (tmp_path / FILE_NAME).exists()
    put_back()
    assert eventually(write) == 2
    engine.dispose()


@pytest.mark.parametrize("folder", ["a file", "/proc/tandem"])
def test_service_that_can_keep_nothing_says_so_at_its_start(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch, folder: str) -> None:
    (tmp_path / "a file").touch()
    monkeypatch.setenv("TANDEM_DATA_DIR", str(tmp_path / folder))
    done = CliRunner().invoke(cli, ["serve", "--port", "0"])
    assert done.exit_code == 2
    assert f"Nothing can be written to the folder {tmp_path / folder} (" in done.output
    assert "TANDEM_DATA_DIR" in done.output
