"""How long a plan takes, over HTTP and by phase: `python -m benchmarks.speed.latency`.

Starts the service on a free port of this machine, sends `examples/table1.json` one request after
another, then repeats the phases in this process with a clock on each.
"""

import json
import os
import socket
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import httpx
import numpy as np
import typer
from pydantic_core import to_json
from rich.console import Console
from rich.table import Table

from app.plans.replies import plan_reply
from app.plans.service import plan_options
from app.requests.conversion.problem import to_problem
from app.requests.reading import read_request
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from model.judge.check import check
from model.engine.instance import pack
from model.planner import Elapsed, PlanResult
from model.policy.decode import DecodeConfig, decode, load_policy, prepare
from model.policy.extract import extract

EXAMPLE = Path(__file__).parents[2] / "examples" / "table1.json"


@dataclass
class Clock:
    """Seconds of each phase, run after run."""

    phases: dict[str, list[float]] = field(default_factory=dict)

    @contextmanager
    def phase(self, name: str) -> Iterator[None]:
        """Time what happens inside."""
        began = time.perf_counter()
        yield
        self.phases.setdefault(name, []).append(time.perf_counter() - began)


@contextmanager
def service() -> Iterator[str]:
    """Run the service until the block ends; yields its address."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    address = f"http://127.0.0.1:{port}"
    process = subprocess.Popen([sys.executable, "-m", "app.cli", "serve", "--port", str(port)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        began = time.perf_counter()
        while not _is_ready(address):
            if process.poll() is not None or time.perf_counter() - began > 120:
                raise RuntimeError("the service did not start")
            time.sleep(0.05)
        print(f"ready {time.perf_counter() - began:.1f} s after its start")
        yield address
    finally:
        process.terminate()
        process.wait()


def _is_ready(address: str) -> bool:
    try:
        return httpx.get(f"{address}/health/ready").status_code == 200
    except httpx.TransportError:
        return False


def over_http(address: str, request: dict[str, Any], runs: int) -> list[float]:
    """Return the seconds of each request, after one that doesn't count."""
    body = json.dumps(request).encode()
    seconds = []
    with httpx.Client(base_url=address, timeout=60,
                      headers={"content-type": "application/json"}) as client:
        for _ in range(runs + 1):
            began = time.perf_counter()
            reply = client.post("/plan", content=body)
            seconds.append(time.perf_counter() - began)
            reply.raise_for_status()
            if reply.json()["summary"]["served"] != len(request["customers"]):
                print(f"served {reply.json()['summary']['served']}", file=sys.stderr)
    return seconds[1:]


def by_phase(request: dict[str, Any], runs: int) -> Clock:
    """Plan in this process with a clock on each phase."""
    body = json.dumps(request).encode()
    settings = Settings()
    policy = load_policy(settings.weights_dir / request["options"]["policy"])
    clock = Clock()
    for run in range(runs + 1):
        now = Clock() if run == 0 else clock
        with now.phase("validate"):
            parsed = read_request(body, [policy.name])
            problem = to_problem(parsed)
            options = plan_options(parsed.options)
        with now.phase("describe"):
            instance = pack([problem])
            scene = prepare(problem, instance)
        with now.phase("decode"):
            decoded = decode(policy, scene, DecodeConfig(options.decoding, options.num_samples))
        with now.phase("extract"):
            solution = extract(problem, instance, decoded.actions)
        with now.phase("check"):
            evaluation = check(problem, solution)
        with now.phase("serialise"):
            result = PlanResult(
                solution, evaluation, start="policy", decoded_cost=decoded.cost,
                final_cost=decoded.cost, search_iterations=0, threads=1, deterministic=True,
                elapsed=Elapsed(0.0, 0.0, 0.0))
            to_json(plan_reply(problem, options, result))
    return clock


def main(runs: Annotated[int, typer.Option(help="requests of each kind")] = 50,
         policy: str = DEFAULT_POLICY) -> None:
    """Print medians in milliseconds."""
    base = json.loads(EXAMPLE.read_text())
    table = Table(title=f"examples/table1.json, {os.cpu_count()} cores, median of {runs}, ms")
    kinds: dict[str, dict[str, Any]] = {
        "greedy": {"decoding": "greedy"}, "128 samples": {"decoding": "sample", "num_samples": 128}}
    columns: dict[str, dict[str, float]] = {}
    with service() as address:
        for name, options in kinds.items():
            request = {**base, "options": {**options, "policy": policy, "time_limit": 0}}
            seconds = over_http(address, request, runs)
            columns[name] = {"HTTP, median": statistics.median(seconds),
                             "HTTP, 95 %": float(np.quantile(seconds, 0.95))}
    for name, options in kinds.items():
        request = {**base, "options": {**options, "policy": policy, "time_limit": 0}}
        for phase, times in by_phase(request, runs).phases.items():
            columns[name][phase] = statistics.median(times)
    table.add_column("")
    for name in kinds:
        table.add_column(name, justify="right")
    for row in next(iter(columns.values())):
        table.add_row(row, *(f"{1000 * columns[name][row]:.2f}" for name in kinds))
    Console().print(table)


if __name__ == "__main__":
    typer.run(main)
