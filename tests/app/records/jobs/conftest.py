"""Databases for jobs, and a service that works on them."""

import os
import shutil
import socket
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import httpx
import pytest
import uvicorn
from sqlalchemy import create_engine, text

from app.cli.serving import IDLE_SECONDS
from app.main import create_app
from app.records.jobs import order, planning, studies, webhook
from app.serving.settings import Settings
from tests.app.records.jobs.stepping import SteppingPlanner
from tests.conftest import PATIENCE, end, eventually, free_port


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


@pytest.fixture(scope="session")
def postgres() -> Iterator[Postgres]:
    """Return a running PostgreSQL server."""
    # Not in pytest's folder, which is closed to other users.
    with TemporaryDirectory(prefix="tandem-postgres-") as folder:
        if os.geteuid() == 0:
            shutil.chown(folder, "postgres")
        server = Postgres(find_programs(), Path(folder))
        server.start()
        yield server
        server.stop()


@pytest.fixture(params=["sqlite", "postgresql"])
def settings(request: pytest.FixtureRequest, tmp_path: Path) -> Settings:
    """Return settings with an empty database."""
    url = None
    if request.param == "postgresql":
        name = f"t{abs(hash(request.node.nodeid))}"
        url = request.getfixturevalue("postgres").create(name)
    return Settings(data_dir=tmp_path, database_url=url, role="all", job_slots=2)


@contextmanager
def serving(settings: Settings, planner: SteppingPlanner | None = None) -> Iterator[httpx.Client]:
    """Serve on loopback and work on jobs in this process."""
    server = uvicorn.Server(uvicorn.Config(create_app(settings, planner or SteppingPlanner()),
                                           log_config=None, timeout_keep_alive=IDLE_SECONDS))
    with socket.create_server(("127.0.0.1", 0)) as listener:
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
        thread.start()
        address = f"http://127.0.0.1:{listener.getsockname()[1]}"
        try:
            with httpx.Client(base_url=address, timeout=PATIENCE, trust_env=False,
                              verify=False) as client:
                eventually(lambda: client.get("/health/ready").status_code == 200)
                yield client
        finally:
            server.should_exit = True
            end(thread)


@pytest.fixture(scope="module")
def jobs(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """Return a client of a service that works on jobs, with SQLite and webhooks.

    It writes down finds and calls webhooks again sooner than others do.
    """
    settings = Settings(data_dir=tmp_path_factory.mktemp("jobs"), role="all", job_slots=2,
                        max_scenarios=8, drain_seconds=0,
                        webhook_secret="whsec_MDEyMzQ1Njc4OTAxMjM0NTY3ODkwMTIzNDU2Nzg5MDE=")
    with pytest.MonkeyPatch.context() as patch, serving(settings) as client:
        for module in (order, planning, studies):
            patch.setattr(module, "SLICE", 0.25)
        patch.setattr(webhook, "FIRST_WAIT", 0.25)
        yield client
