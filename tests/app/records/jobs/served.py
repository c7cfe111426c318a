"""Services in processes of their own, to be killed.

Each is forked from a process that has loaded all it needs: loading takes seconds of each otherwise.
"""

import os
import sys
from collections.abc import Callable, Mapping
from multiprocessing import get_context
from multiprocessing.process import BaseProcess
from pathlib import Path

import httpx
import uvicorn

from app.cli.serving import IDLE_SECONDS
from app.cli.commands import main
from app.main import create_app
from app.serving.settings import Settings
from tests.app.records.jobs.stepping import SteppingPlanner
from tests.conftest import PATIENCE, eventually, free_port

FORKING = get_context("forkserver")
FORKING.set_forkserver_preload([__name__, "app.cli.serving"])


def stepping(port: int) -> None:
    """Serve the planner whose plans get better while time passes."""
    uvicorn.run(create_app(Settings(), SteppingPlanner()), port=port,
                timeout_keep_alive=IDLE_SECONDS)


def halfway(port: int) -> None:
    """Serve that planner, which ends no search by itself."""
    uvicorn.run(create_app(Settings(), SteppingPlanner(comes_to=0.5)), port=port,
                timeout_keep_alive=IDLE_SECONDS)


def truly(port: int) -> None:
    """Serve as the command does."""
    sys.argv[1:] = ["serve", "--port", str(port)]
    main()


class Served:
    """The service in a process of its own."""

    def __init__(self, log: Path, serve: Callable[[int], None] = stepping,
                 **settings: object) -> None:
        self.port = free_port()
        self._log = log
        self.serve = serve
        stated = {f"TANDEM_{name.upper()}": str(value) for name, value in settings.items()}
        self._environment = {**os.environ, "TANDEM_ROLE": "all", **stated}
        self.client = httpx.Client(base_url=f"http://127.0.0.1:{self.port}", timeout=PATIENCE,
                                   trust_env=False, verify=False)
        self.process: BaseProcess | None = None

    def start(self) -> None:
        """Start the process and wait until it is ready."""
        self.process = FORKING.Process(
            target=_run, args=(self.serve, self.port, self._log, self._environment))
        self.process.start()
        eventually(self._is_ready)

    def kill(self) -> None:
        """Kill the process as the kernel would."""
        if self.process is not None:
            self.process.kill()
            self.process.join()

    def terminate(self) -> None:
        """Have the process end in good order."""
        if self.process is not None:
            self.process.terminate()
            self.process.join(PATIENCE)
            assert self.process.exitcode is not None

    def _is_ready(self) -> bool:
        assert self.process is not None
        assert self.process.is_alive(), self._log.read_text()
        try:
            return self.client.get("/health/ready").status_code == 200
        except httpx.TransportError:
            return False


def _run(serve: Callable[[int], None], port: int, log: Path,
         environment: Mapping[str, str]) -> None:
    os.environ.clear()
    os.environ.update(environment)
    with log.open("a") as output:
        os.dup2(output.fileno(), sys.stdout.fileno())
        os.dup2(output.fileno(), sys.stderr.fileno())
    serve(port)
