"""A PostgreSQL server of Debian's packages for a measurement, on loopback, gone afterwards."""

import os
import shutil
import socket
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory


@dataclass(frozen=True)
class Server:
    """A server that may be away for a while."""

    url: str
    start: Callable[[], None]
    stop: Callable[[], None]


@contextmanager
def running_postgres() -> Iterator[str]:
    """Yield the URL of an empty database; raises as `postgres_server` does."""
    with postgres_server() as server:
        yield server.url


@contextmanager
def postgres_server() -> Iterator[Server]:
    """Yield a server with an empty database, which writes to disk as one not to be lost.

    Raises
    ------
    FileNotFoundError
        If PostgreSQL isn't installed.
    """
    folders = sorted(Path("/usr/lib/postgresql").glob("*/bin"),
                     key=lambda folder: int(folder.parent.name))
    if not folders:
        raise FileNotFoundError("PostgreSQL is not installed: apt-get install postgresql")
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with TemporaryDirectory(prefix="tandem-postgres-") as folder:
        if os.geteuid() == 0:
            shutil.chown(folder, "postgres")

        def run(program: str, *arguments: str) -> None:
            command = [str(folders[-1] / program), f"--pgdata={folder}/data", *arguments]
            if os.geteuid() == 0:
                # PostgreSQL refuses to run as root.
                command = ["runuser", "-u", "postgres", "--", *command]
            subprocess.run(command, check=True, cwd=folder, stdout=subprocess.DEVNULL)

        def start() -> None:
            run("pg_ctl", "--wait", f"--log={folder}/log.txt", "start",
                f"--options=-p {port} -c listen_addresses=127.0.0.1 -k {folder}")

        def stop() -> None:
            run("pg_ctl", "--wait", "--mode=fast", "stop")

        run("initdb", "--auth=trust", "--username=tandem", "--encoding=UTF8")
        start()
        try:
            yield Server(f"postgresql://tandem@127.0.0.1:{port}/postgres", start, stop)
        finally:
            stop()
