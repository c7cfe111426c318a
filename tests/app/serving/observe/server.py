"""Serves a small planner as `tandem serve` does, in a process of its own."""

import logging
import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from subprocess import PIPE, Popen
from typing import Any

import httpx
import uvicorn

from app.cli.serving import IDLE_SECONDS
from app.main import create_app
from app.serving.observe.logs import log_config
from app.serving.settings import Settings
from model.planner import PlanOptions, PlanResult
from model.problem import Problem
from tests.app.conftest import FirstFitPlanner
from tests.conftest import PATIENCE, eventually, free_port

ROOT = Path(__file__).parents[4]

logger = logging.getLogger(__name__)

CRASHING_SEED = 666


class CrashingPlanner(FirstFitPlanner):
    """Crashes when asked for a certain seed."""

    def plan(self, problem: Problem, options: PlanOptions, *rest: Any, **more: Any) -> PlanResult:
        if options.seed == CRASHING_SEED:
            logger.warning("about to crash")
            raise RuntimeError("crashed as asked")
        return super().plan(problem, options, *rest, **more)


class Server:
    """A running process and the lines that it has logged."""

    def __init__(self, client: httpx.Client, process: Popen[str]) -> None:
        self.client = client
        self.process = process
        self.lines: list[str] = []
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stderr is not None
        self.lines.extend(self.process.stderr)

    def stop(self) -> list[str]:
        """End the process in good order; return all that it logged."""
        self.process.terminate()
        self.process.wait(PATIENCE)
        self.finish()
        return self.lines

    def finish(self) -> None:
        """Wait for the last lines of a process that ends."""
        self._reader.join()


@contextmanager
def running(**settings: str) -> Iterator[Server]:
    """Run a process with settings, such as `TANDEM_LOG_FORMAT="json"`."""
    port = free_port()
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **settings}
    with (Popen([sys.executable, "-m", "tests.app.serving.observe.server", str(port)], cwd=ROOT,
                env=environment, stderr=PIPE, text=True) as process,
          httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=PATIENCE,
                       trust_env=False) as client):
        server = Server(client, process)
        try:
            eventually(lambda: is_ready(client, process))
            yield server
        finally:
            process.kill()
            server.finish()


def is_ready(client: httpx.Client, process: Popen[str]) -> bool:
    """Tell whether a server plans."""
    assert process.poll() is None, "the server ended"
    try:
        return client.get("/health/ready").status_code == 200
    except httpx.TransportError:
        return False


def main() -> None:
    """Serve until told to stop."""
    settings = Settings()
    logs = log_config(settings.log_format, settings.log_level,
                      traced=settings.otlp_endpoint is not None)
    uvicorn.run(create_app(settings, CrashingPlanner()), port=int(sys.argv[1]), access_log=False,
                log_config=logs, timeout_keep_alive=IDLE_SECONDS)


if __name__ == "__main__":
    main()
