"""`tandem serve`: runs the service as one process, or several on one port."""

import os
import socket
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Any

import typer
import uvicorn
from fastapi import FastAPI

from app.cli.file_errors import EXIT_BAD_INPUT
from app.cli.opening import roads_of
from app.database.files import FolderError, check_folder
from app.serving.access.setup import ExposedError, check_exposure
from app.serving.children.starting import have_server
from app.serving.load.memory import collect_seldom, keep_memory, loading
from app.serving.load.protocol import HttpProtocol
from app.serving.observe.logs import log_config
from app.serving.observe.metrics import MULTIPROCESS_DIR
from app.serving.settings import Settings

IDLE_SECONDS = 75
"""How long a connection is kept for a further request: longer than clients and proxies keep theirs.

Whoever has kept one just as long as the service (5 s for uvicorn and for httpx, a minute for most
proxies) at times asks on one that is being closed, and can't tell whether that was heard.
"""

HEALTHCHECK_SECONDS = 30
"""How long a process may not answer its parent, which then starts another in its place."""


class PortTakenError(OSError):
    """Something else listens on the service's port."""


def check_port(host: str, port: int) -> None:
    """Make sure that nobody listens there yet, before anything is loaded and jobs are worked on.

    Raises
    ------
    PortTakenError
        If somebody does.
    """
    try:
        socket.create_connection((host, port), timeout=1.0).close()
    except OSError:
        return
    raise PortTakenError(f"Something listens on port {port} of {host} already: end it, or name "
                         "another port by --port, or PORT=8001 of make.")


def serve(
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="Port to listen on.", min=0, max=65535)] = 8000,
    workers: Annotated[int, typer.Option(help="Processes that share the port.", min=1,
                                         max=256)] = 1,
) -> None:
    """Answer planning requests over HTTP."""
    settings = Settings()
    try:
        check_exposure(settings, host)
        check_port(host, port)
        if settings.database_url is None or settings.role != "api":
            check_folder(settings.data_dir)
    except (ExposedError, PortTakenError, FolderError) as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(EXIT_BAD_INPUT) from error
    with roads_of(settings):
        # What is wrong with them is told here, in words and once.
        pass
    run_server(settings, host, port, workers)


def run_server(settings: Settings, host: str, port: int, workers: int) -> None:
    """Answer requests until a signal ends the process."""
    options: dict[str, Any] = {
        "host": host,
        "port": port,
        "http": HttpProtocol,
        "access_log": False,
        "server_header": False,
        "timeout_keep_alive": IDLE_SECONDS,
        "timeout_graceful_shutdown": settings.shutdown_seconds,
        "log_config": log_config(settings.log_format, settings.log_level,
                                 traced=settings.otlp_endpoint is not None),
    }
    if workers == 1:
        keep_memory()
        uvicorn.run(_application(settings), **options)
        return
    with _shared_by_workers(settings, workers):
        uvicorn.run("app.cli.serving:worker_app", factory=True, workers=workers,
                    timeout_worker_healthcheck=HEALTHCHECK_SECONDS, **options)


def worker_app() -> FastAPI:
    """Return the application of one of several processes, which reads the environment."""
    keep_memory()
    collect_seldom()
    return _application(Settings())


def _application(settings: Settings) -> FastAPI:
    """Return the application, imported while the server of those who plan imports what they need.
    """
    have_server()
    with loading():
        from app.main import create_app

    return create_app(settings)


@contextmanager
def _shared_by_workers(settings: Settings, workers: int) -> Iterator[None]:
    """Have workers, which read the environment, share cores and metrics. In place."""
    if "max_concurrent_plans" not in settings.model_fields_set:
        slots = max(1, settings.max_concurrent_plans // workers)
        os.environ["TANDEM_MAX_CONCURRENT_PLANS"] = str(slots)
    with tempfile.TemporaryDirectory(prefix="tandem-metrics-") as folder:
        os.environ.setdefault(MULTIPROCESS_DIR, folder)
        yield
