"""How processes end: real ones, by real signals."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.cli.serving import run_server
from app.serving.settings import Settings
from tests.app.serving.load.waiting import ROOT, process_of_its_own, status_of
from tests.conftest import PATIENCE, eventually, free_port, soon

pytestmark = pytest.mark.slow

Request = dict[str, Any]

DRAIN = 300.0
"""Seconds for which a process that ends sends requests elsewhere; more than anybody waits here."""


def test_running_plans_are_returned_and_new_requests_sent_elsewhere(smallest: Request) -> None:
    with (process_of_its_own(TANDEM_DRAIN_SECONDS=f"{DRAIN:g}") as (process, client),
          ThreadPoolExecutor(1) as pool):
        running = pool.submit(client.post, "/plan", json=smallest)
        soon(lambda: "tandem_planner_running 1.0" in client.get("/metrics").text)
        process.send_signal(signal.SIGTERM)
        reply = running.result(PATIENCE)
        assert reply.status_code == 200
        assert reply.json()["summary"]["served"] == 2
        refused = client.post("/plan", json=smallest)
        assert refused.status_code == 503
        assert refused.json()["type"] == "urn:tandem:error:stopping"
        assert refused.headers["connection"] == "close"
        assert int(refused.headers["retry-after"]) > 0
        ready = client.get("/health/ready")
        assert ready.status_code == 503
        assert ready.json()["status"] == "stopping"
        assert ready.headers["connection"] == "close"
        assert client.get("/health/live").status_code == 200
        # Who asks again waits for nothing more.
        process.send_signal(signal.SIGTERM)
        process.wait(PATIENCE)


@pytest.mark.thorough
def test_interrupted_process_ends_at_once() -> None:
    with process_of_its_own(TANDEM_DRAIN_SECONDS=f"{DRAIN:g}") as (process, _):
        process.send_signal(signal.SIGINT)
        process.wait(PATIENCE)


@pytest.mark.thorough
def test_process_ends_by_itself_after_its_time() -> None:
    with process_of_its_own(TANDEM_DRAIN_SECONDS="1.5") as (process, _):
        began = time.perf_counter()
        process.send_signal(signal.SIGTERM)
        assert process.wait(PATIENCE) in (0, -signal.SIGTERM)
        assert time.perf_counter() - began > 1.5


def children(process: subprocess.Popen[bytes]) -> set[int]:
    """Return the processes that run the application, which a process has started."""
    found = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    return {int(pid) for pid in found if "spawn_main" in command_of(int(pid))}


def command_of(pid: int) -> str:
    """Return the command line of a process; empty if it has ended."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return ""


@contextmanager
def serving(data_dir: Path) -> Iterator[subprocess.Popen[bytes]]:
    """Run two processes on one port, until the block ends."""
    port = free_port()
    with (subprocess.Popen(
            [sys.executable, "-m", "app.cli", "serve", "--port", str(port), "--workers", "2"],
            cwd=ROOT, stderr=subprocess.DEVNULL, env={
                **os.environ, "PYTHONPATH": str(ROOT), "TANDEM_DATA_DIR": str(data_dir),
                "TMPDIR": str(data_dir)}) as process,
          httpx.Client(base_url=f"http://127.0.0.1:{port}", trust_env=False) as client):
        try:
            eventually(lambda: status_of(client, "/health/live") == 200)
            yield process
        finally:
            process.kill()


@pytest.mark.thorough
@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="reads Linux's list of processes")
def test_processes_that_share_a_port_are_replaced_and_end_with_the_one_that_started_them(
        tmp_path: Path) -> None:
    with serving(tmp_path) as process:
        first = children(process)
        assert len(first) == 2
        os.kill(min(first), signal.SIGKILL)
        eventually(lambda: len(children(process) - first) == 1)
        workers = children(process)
        process.kill()
        process.wait(PATIENCE)
        eventually(lambda: not any(command_of(pid) for pid in workers))


def test_processes_share_the_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[tuple[str | None, str | None]] = []

    def run(app: object, **options: Any) -> None:
        assert (app, options["workers"], options["factory"]) == (
            "app.cli.serving:worker_app", 3, True)
        folder = os.environ["PROMETHEUS_MULTIPROC_DIR"]
        assert Path(folder).is_dir()
        seen.append((os.environ.get("TANDEM_MAX_CONCURRENT_PLANS"), folder))

    monkeypatch.setattr("os.environ", dict(os.environ))
    monkeypatch.setattr("uvicorn.run", run)
    monkeypatch.setattr("loky.cpu_count", lambda: 8)
    run_server(Settings(), "127.0.0.1", 0, 3)
    assert seen[0][0] == "2"
    assert not Path(seen[0][1] or "").exists()
    del os.environ["TANDEM_MAX_CONCURRENT_PLANS"], os.environ["PROMETHEUS_MULTIPROC_DIR"]
    run_server(Settings(max_concurrent_plans=5), "127.0.0.1", 0, 3)
    assert seen[1][0] is None
