"""A planner whose plans take as long as a test wants, served here or in a process of its own."""

import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from subprocess import Popen
from typing import Any

import httpx
import uvicorn

from app.cli.serving import IDLE_SECONDS
from app.main import create_app
from app.serving.load.protocol import HttpProtocol
from app.serving.settings import Settings
from model.planner import ALONE, Listener, PlanOptions, PlanResult
from model.problem import Problem
from tests.app.conftest import FirstFitPlanner
from tests.conftest import PATIENCE, eventually, free_port

ROOT = Path(__file__).parents[4]


class WaitingPlanner(FirstFitPlanner):
    """Plans once it may go on, or is told to stop."""

    def __init__(self) -> None:
        self.go_on = threading.Event()
        self.started = self.looks = 0
        self.has_stopped = False

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, *rest: Any, **more: Any) -> PlanResult:
        self.started += 1
        while not self.go_on.wait(0.002):
            self.looks += 1
            if listener.should_stop():
                self.has_stopped = True
                break
        return super().plan(problem, options, received_at)


@contextmanager
def process_of_its_own(**settings: str) -> Iterator[tuple[Popen[bytes], httpx.Client]]:
    """Serve a `WaitingPlanner`, whose plans last until they are told to stop."""
    port = free_port()
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **settings}
    with (Popen([sys.executable, "-m", "tests.app.serving.load.waiting", str(port)], cwd=ROOT,
                env=environment) as process,
          httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=PATIENCE,
                       trust_env=False) as client):
        try:
            eventually(lambda: process.poll() is None and status_of(client, "/health/ready") == 200)
            yield process, client
        finally:
            process.kill()


def status_of(client: httpx.Client, path: str) -> int | None:
    """Return the status that a path is answered with, None if it isn't."""
    try:
        return client.get(path).status_code
    except httpx.TransportError:
        return None


def main() -> None:
    """Serve until told to stop."""
    settings = Settings()
    uvicorn.run(create_app(settings, WaitingPlanner()), port=int(sys.argv[1]), http=HttpProtocol,
                log_level="critical", timeout_keep_alive=IDLE_SECONDS,
                timeout_graceful_shutdown=settings.shutdown_seconds)


if __name__ == "__main__":
    main()
