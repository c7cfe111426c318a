"""How soon the service plans, and in how much memory: `python -m benchmarks.speed.starting`.

Starts it on a free port of this machine, time after time, each with a data folder of its own, and
asks for a plan of `examples/table1.json` as soon as anybody answers. Processor time is told beside
the clock's: it is the same on a busy machine.
"""

import json
import os
import resource
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Annotated, NamedTuple

import httpx
import typer

from benchmarks.speed.latency import EXAMPLE

SEARCHED = {"policy": "pointer", "time_limit": 10, "search_iterations": 1000}
"""Options of each plan: some 30 ms of search, however busy the machine."""

WAIT, LOOK = 120.0, 0.01
"""Seconds to wait for the service at most, and between two attempts to reach it."""

PLANS = 10

MODULES = ("app.main", "app.cli.commands")
TICKS = os.sysconf("SC_CLK_TCK")


class Start(NamedTuple):
    """One start of the service: seconds, and resident MB."""

    listening: float
    planned: float
    ready: float
    processor: float  # of all threads, until the first plan
    after_start: float
    after_plans: float


def start() -> Start:
    """Start the service, have it plan, and end it."""
    with socket.socket() as probe, tempfile.TemporaryDirectory() as folder:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
        probe.close()
        began = time.perf_counter()
        process = subprocess.Popen(
            [sys.executable, "-m", "app.cli", "serve", "--port", str(port)],
            env=os.environ | {"TANDEM_DATA_DIR": folder},
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            return _watched(process.pid, port, began)
        finally:
            process.terminate()
            process.wait()


def _watched(process: int, port: int, began: float) -> Start:
    body = json.dumps(json.loads(EXAMPLE.read_text()) | {"options": SEARCHED})
    headers = {"content-type": "application/json"}
    _wait_for(port)
    listening, after_start = time.perf_counter() - began, resident(process)
    with httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=WAIT, headers=headers) as client:
        client.post("/plan", content=body).raise_for_status()
        planned, processor = time.perf_counter() - began, processor_seconds(process)
        while client.get("/health/ready").status_code != httpx.codes.OK:
            time.sleep(LOOK)
        ready = time.perf_counter() - began
        for _ in range(PLANS - 1):
            client.post("/plan", content=body).raise_for_status()
    return Start(listening, planned, ready, processor, after_start, resident(process))


def _wait_for(port: int) -> None:
    """Return as soon as somebody listens."""
    until = time.monotonic() + WAIT
    while time.monotonic() < until:
        try:
            socket.create_connection(("127.0.0.1", port)).close()
        except ConnectionRefusedError:
            time.sleep(LOOK)
        else:
            return
    raise TimeoutError("the service did not start")


def processor_seconds(process: int) -> float:
    """Return the processor time that a process took so far."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICKS


def resident(process: int) -> float:
    """Return the memory that a process has, in MB."""
    pages = int(Path(f"/proc/{process}/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def import_seconds(module: str) -> float:
    """Return the processor time that Python takes to start and import a module."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-c", f"import {module}"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main(runs: Annotated[int, typer.Option(help="starts of each kind", min=1)] = 5) -> None:
    """Print medians."""
    for module in MODULES:
        seconds = statistics.median(import_seconds(module) for _ in range(runs))
        print(f"import {module}: {seconds:.2f} s of processor time")
    starts = [start() for _ in range(runs)]
    middle = Start(*(statistics.median(values) for values in zip(*starts, strict=True)))
    print(f"listens after {middle.listening:.2f} s, first plan after {middle.planned:.2f} s "
          f"({middle.processor:.2f} s of processor time), ready after {middle.ready:.2f} s")
    print(f"resident: {middle.after_start:.0f} MB after the start, {middle.after_plans:.0f} MB "
          f"after {PLANS} plans")
    print(f"load of the machine: {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores")


if __name__ == "__main__":
    typer.run(main)
