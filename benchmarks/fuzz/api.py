"""Throws generated requests at the whole API: `python -m benchmarks.fuzz.api --cases 10000`.

Starts the service with keys and a database of its own, has schemathesis read its description and
send what fits and what doesn't, until there were so many cases. Fails if a reply has a status of
500 or more, or is not what the description says.
"""

import json
import os
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer

ROOT = Path(__file__).resolve().parents[2]

# That a request fits the schema doesn't make it valid: ids may repeat, windows end before they
# begin. Such requests are answered with 422. And DELETE stops a job, whose best plan stays.
UNCHECKED = "positive_data_acceptance,use_after_free"

START_SECONDS = 120.0


@dataclass(frozen=True)
class Target:
    """A running service."""

    url: str
    key: str
    process: subprocess.Popen[bytes]


@contextmanager
def service(folder: Path) -> Iterator[Target]:
    """Run the service until the block ends."""
    environment = environment_of(folder)
    tandem = [sys.executable, "-m", "app.cli"]
    scopes = [f"--scope={scope}" for scope in ("plan", "jobs", "admin")]
    key = subprocess.run([*tandem, "keys", "create", "fuzz", *scopes], env=environment, check=True,
                         text=True, stdout=subprocess.PIPE).stdout.strip()
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with subprocess.Popen([*tandem, "serve", "--port", str(port)], env=environment) as process:
        try:
            target = Target(f"http://127.0.0.1:{port}", key, process)
            _await_ready(target)
            yield target
        finally:
            process.terminate()


def environment_of(folder: Path) -> dict[str, str]:
    """Return the service's environment: of whoever starts it, all but settings.

    The engine that they named is no setting: a sanitized build is to be what is served.
    """
    others = {name: value for name, value in os.environ.items()
              if name == "TANDEM_ENGINE_LIBRARY" or not name.startswith("TANDEM_")}
    return others | {
        "PYTHONPATH": str(ROOT), "TANDEM_ACCESS": "keys", "TANDEM_DATA_DIR": str(folder),
        "TANDEM_LOG_LEVEL": "error", "TANDEM_WRONG_KEYS_PER_MINUTE": "0"}


def _await_ready(target: Target) -> None:
    deadline = time.monotonic() + START_SECONDS
    while target.process.poll() is None and time.monotonic() < deadline:
        try:
            if httpx.get(f"{target.url}/health/ready", trust_env=False).status_code == 200:
                return
        except httpx.TransportError:
            pass
        time.sleep(0.1)
    raise RuntimeError("the service did not start")


def fuzz(target: Target, folder: Path, examples: int, seed: int) -> dict[str, Any]:
    """Run schemathesis once and return its report.

    Parameters
    ----------
    target
        What to test.
    folder
        For its files.
    examples
        Most cases of each operation.
    seed
        Of all that is generated.
    """
    report = folder / "report.json"
    command = [
        str(Path(sys.executable).parent / "schemathesis"), "run", f"{target.url}/openapi.json",
        "--header", f"Authorization: Bearer {target.key}", "--max-examples", str(examples),
        "--seed", str(seed), "--exclude-checks", UNCHECKED, "--continue-on-failure", "--no-shrink",
        "--suppress-health-check", "all",
        "--report", "json", "--report-json-path", str(report),
    ]
    environment = {**os.environ, "PYTHONPATH": str(ROOT),
                   "SCHEMATHESIS_HOOKS": "benchmarks.fuzz.hooks"}
    # In its own folder: it would begin with the failures of the run before.
    with tempfile.TemporaryDirectory() as place:
        subprocess.run(command, env=environment, cwd=place, check=False)
    found: dict[str, Any] = json.loads(report.read_text("utf-8"))
    return found


def main(
    cases: Annotated[int, typer.Option(help="Requests to send, at least.")] = 10_000,
    examples: Annotated[int, typer.Option(help="Most requests to each operation in a run.")] = 200,
    seed: Annotated[int, typer.Option(help="Seed of the first run; later ones count on.")] = 0,
) -> None:
    """Fuzz the whole API."""
    sent = failures = 0
    with tempfile.TemporaryDirectory() as name, service(Path(name)) as target:
        while sent < cases and not failures:
            report = fuzz(target, Path(name), examples, seed)
            sent += report["test_cases"]["generated"]
            failures += len(report["failures"]) + len(report["errors"])
            seed += 1
        if target.process.poll() is not None:
            failures += 1
    typer.echo(f"{sent} cases, {failures} failures")
    raise typer.Exit(1 if failures else 0)


if __name__ == "__main__":
    typer.run(main)
