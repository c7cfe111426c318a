"""A PostgreSQL server for each process that runs tests, and settings with empty databases."""

import os
import secrets
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from sqlalchemy import create_engine, text

from app.serving.settings import Settings
from tests.conftest import PATIENCE, free_port


class Postgres:
    """A PostgreSQL server of Debian's packages, on loopback, with its data in a folder."""

    def __init__(self, programs: Path, folder: Path) -> None:
        self._programs = programs
        self._data = folder / "data"
        self._log = folder / "log.txt"
        self._folder = folder
        self.port = free_port()
        self._run("initdb", "--auth=trust", "--username=tandem", "--encoding=UTF8", "--no-sync")

    def start(self) -> None:
        """Start the server and wait until it answers."""
        options = f"-p {self.port} -c listen_addresses=127.0.0.1 -c fsync=off -k {self._folder}"
        self._run("pg_ctl", "--wait", f"--timeout={PATIENCE:g}", f"--log={self._log}",
                  f"--options={options}", "start")

    def stop(self) -> None:
        """Stop the server; clients lose their connections."""
        self._run("pg_ctl", "--wait", f"--timeout={PATIENCE:g}", "--mode=fast", "stop")

    def url(self, database: str) -> str:
        """Return the URL of a database."""
        return f"postgresql+psycopg://tandem@127.0.0.1:{self.port}/{database}"

    def create(self, database: str) -> str:
        """Make an empty database and return its URL."""
        engine = create_engine(self.url("postgres"), isolation_level="AUTOCOMMIT")
        with engine.connect() as connection:
            connection.execute(text(f"CREATE DATABASE {database}"))
        engine.dispose()
        return self.url(database)

    def _run(self, program: str, *arguments: str) -> None:
        command = [str(self._programs / program), f"--pgdata={self._data}", *arguments]
        if os.geteuid() == 0:
            # PostgreSQL refuses to run as root.
            command = ["runuser", "-u", "postgres", "--", *command]
        subprocess.run(command, check=True, cwd=self._folder, stdout=subprocess.DEVNULL)


def find_programs() -> Path:
    """Return the folder of PostgreSQL's programs: the variable POSTGRESQL, or Debian's newest."""
    chosen = os.environ.get("POSTGRESQL")
    if chosen is not None:
        return Path(chosen)
    folders = sorted(Path("/usr/lib/postgresql").glob("*/bin"),
                     key=lambda folder: int(folder.parent.name))
    if not folders:
        raise RuntimeError("PostgreSQL is not installed: .ci/prepare says how")
    return folders[-1]


@contextmanager
def running() -> Iterator[Postgres]:
    """Yield a running PostgreSQL server."""
    # Not in pytest's folder, which is closed to other users.
    with TemporaryDirectory(prefix="tandem-postgres-") as folder:
        if os.geteuid() == 0:
            shutil.chown(folder, "postgres")
        server = Postgres(find_programs(), Path(folder))
        server.start()
        yield server
        server.stop()


@pytest.fixture(scope="session")
def postgres() -> Iterator[Postgres]:
    """Return a server that goes on for other tests."""
    with running() as server:
        yield server


@pytest.fixture
def fragile_postgres() -> Iterator[Postgres]:
    """Return a server that a test may stop."""
    with running() as server:
        yield server


def settings_of(request: pytest.FixtureRequest, folder: Path) -> Settings:
    """Return settings with an empty database of the kind that a fixture's parameter names."""
    url = None
    if request.param == "postgresql":
        url = request.getfixturevalue("postgres").create(f"t{secrets.token_hex(8)}")
    return Settings(data_dir=folder, database_url=url, role="all", job_slots=2)


@pytest.fixture(params=["sqlite", "postgresql"])
def settings(request: pytest.FixtureRequest, tmp_path: Path) -> Settings:
    """Return settings with an empty database."""
    return settings_of(request, tmp_path)
