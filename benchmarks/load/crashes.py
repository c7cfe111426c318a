"""Kills the service at random moments and looks what becomes of its jobs.

    python -m benchmarks.load.crashes --kills 30
    python -m benchmarks.load.crashes --kills 30 --database-url postgresql://user@host/tandem

Without a URL first with SQLite, then with a PostgreSQL server that is started for it. Jobs of
several seconds are kept coming. After each `kill -9` the service starts again. A job is lost if it
never ends, has two results if a result that was read once changes later, was made twice if its
idempotency key leads to another or the service lists one that nobody sent, and its cost must never
rise, not even from one process to the next. Exits with 1 if any of this happened.
"""

import argparse
import json
import os
import random
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

import httpx

from benchmarks.postgres import running_postgres

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "app" / "schemas" / "examples" / "table1.json"

LONGEST_START = 600.0
"""Seconds that the service may take to be ready."""

POLLING = 0.1

WRONG = ("lost", "failed", "made twice", "with two results", "whose cost rose")
"""Of an outcome, what should never be."""

Outcome = dict[str, int | float]


@dataclass
class Followed:
    """What was seen of a job."""

    request: dict[str, Any]
    key: str  # of idempotency
    costs: list[float] = field(default_factory=list)
    result: str | None = None
    rises: int = 0
    other_results: int = 0
    kills: int = 0  # of the process that worked on it

    def see(self, job: dict[str, Any]) -> None:
        """Compare what the service says now with what it said before. In place."""
        cost = job["cost"]
        if cost is not None:
            self.rises += bool(self.costs) and cost > self.costs[-1]
            self.costs.append(cost)
        if job["state"] in ("done", "failed", "cancelled"):
            told = json.dumps(job, sort_keys=True)
            self.other_results += self.result is not None and told != self.result
            self.result = self.result or told


class Service:
    """The real service in a process of its own."""

    def __init__(self, folder: Path, database_url: str | None,
                 settings: Mapping[str, str] = MappingProxyType({})) -> None:
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        self._port = port
        self._environment = {**os.environ, "TANDEM_DATA_DIR": str(folder),
                             "TANDEM_LOG_LEVEL": "warning", **settings}
        if database_url is not None:
            self._environment["TANDEM_DATABASE_URL"] = database_url
        self._log = (folder / "log.txt").open("a")
        self._process: subprocess.Popen[bytes] | None = None
        self.client = httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=60,
                                   trust_env=False)

    def start(self) -> None:
        """Start the service and wait until it can plan. In place."""
        command = [sys.executable, "-m", "app.cli", "serve", "--port", str(self._port)]
        self._process = subprocess.Popen(command, cwd=ROOT, env=self._environment,
                                         stdout=self._log, stderr=self._log)
        deadline = time.monotonic() + LONGEST_START
        while not self._is_ready():
            if self._process.poll() is not None or time.monotonic() > deadline:
                raise RuntimeError(f"the service did not start: see {self._log.name}")
            time.sleep(POLLING)

    def kill(self) -> None:
        """Kill the service as the kernel would. In place."""
        if self._process is not None:
            self._process.send_signal(signal.SIGKILL)
            self._process.wait()

    def close(self) -> None:
        """Kill the service, and let go of what was open to it. In place."""
        self.kill()
        self.client.close()
        self._log.close()

    @property
    def is_running(self) -> bool:
        """Tell whether the process that was started last is there."""
        return self._process is not None and self._process.poll() is None

    def _is_ready(self) -> bool:
        try:
            return self.client.get("/health/ready").status_code == 200
        except httpx.TransportError:
            return False


class Study:
    """Jobs that are followed over kills of their process."""

    def __init__(self, service: Service, seconds: tuple[float, float], at_once: int,
                 rng: random.Random) -> None:
        self._service = service
        self._seconds = seconds
        self._at_once = at_once
        self._rng = rng
        self._request: dict[str, Any] = json.loads(EXAMPLE.read_text("utf-8"))
        self.jobs: dict[str, Followed] = {}
        self.made_twice: set[str] = set()
        self.resumptions: list[float] = []

    @property
    def open_jobs(self) -> list[str]:
        """Jobs that have not ended yet."""
        return [job_id for job_id, job in self.jobs.items() if job.result is None]

    def submit(self) -> None:
        """Have as many jobs at once as wanted. In place."""
        while len(self.open_jobs) < self._at_once:
            seconds = self._rng.uniform(*self._seconds)
            request = self._request | {"options": {"time_limit": seconds, "seed": len(self.jobs)}}
            job = Followed(request, f"job-{len(self.jobs)}")
            reply = self._send(job)
            if reply.status_code == 503:
                return  # the database is being prepared
            reply.raise_for_status()
            self.jobs[reply.json()["id"]] = job

    def look(self) -> set[str]:
        """See what has become of all jobs; return those that run. In place."""
        running = set()
        for job_id in self.open_jobs:
            reply = self._service.client.get(f"/jobs/{job_id}")
            if reply.status_code == 503:
                continue  # the database is away
            job = reply.json()
            self.jobs[job_id].see(job)
            if job["state"] == "running":
                running.add(job_id)
        return running

    def look_again(self) -> None:
        """See whether what has ended is still the same, and nothing was made twice. In place."""
        for job_id, job in self.jobs.items():
            if job.result is not None:
                job.see(self._service.client.get(f"/jobs/{job_id}").json())
            if self._send(job).json()["id"] != job_id:
                self.made_twice.add(job_id)
        self.made_twice |= self._listed() - self.jobs.keys()

    def _listed(self) -> set[str]:
        """Return all jobs that the service lists."""
        listed: set[str] = set()
        cursor: str | None = None
        while True:
            more = {} if cursor is None else {"cursor": cursor}
            page = self._service.client.get("/jobs", params={"limit": "500", **more}).json()
            listed |= {job["id"] for job in page["jobs"]}
            cursor = page["next"]
            if cursor is None:
                return listed

    def _send(self, job: Followed) -> httpx.Response:
        return self._service.client.post("/jobs", json=job.request,
                                         headers={"Idempotency-Key": job.key})

    def run_until(self, deadline: float) -> set[str]:
        """Follow jobs until then, on `time.monotonic`; return those that run by then. In place."""
        running: set[str] = set()
        while time.monotonic() < deadline:
            self.submit()
            running = self.look()
            time.sleep(POLLING)
        return running

    def crash(self, running: set[str]) -> None:
        """Kill the service, start it again, and wait for progress of what ran. In place."""
        for job_id in running:
            self.jobs[job_id].kills += 1
        self._service.kill()
        self._service.start()
        began = time.monotonic()
        before = {job_id: self._iterations(job_id) for job_id in running}
        while running and all(self._iterations(job_id) == before[job_id] for job_id in running):
            time.sleep(POLLING)
        if running:
            self.resumptions.append(time.monotonic() - began)

    def finish(self) -> None:
        """Wait for all jobs. In place."""
        deadline = time.monotonic() + LONGEST_START
        while self.open_jobs and time.monotonic() < deadline:
            self.look()
            time.sleep(POLLING)

    def _iterations(self, job_id: str) -> int:
        return int(self._service.client.get(f"/jobs/{job_id}").json()["search_iterations"])


def main() -> None:
    """Run the study and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=30)
    parser.add_argument("--database-url", help="left out: SQLite, then PostgreSQL")
    parser.add_argument("--jobs-at-once", type=int, default=3)
    parser.add_argument("--seconds", type=float, nargs=2, default=(3.0, 12.0),
                        help="shortest and longest time limit of a job")
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    outcomes = []
    if arguments.database_url is None:
        outcomes.append(run(arguments, None))
        with running_postgres() as url:
            outcomes.append(run(arguments, url))
    else:
        outcomes.append(run(arguments, arguments.database_url))
    if any(outcome[name] for outcome in outcomes for name in WRONG):
        sys.exit(1)


def run(arguments: argparse.Namespace, database_url: str | None) -> Outcome:
    """Run the study with one database, and print and return what came of it."""
    rng = random.Random(arguments.seed)
    with tempfile.TemporaryDirectory() as folder:
        service = Service(Path(folder), database_url)
        study = Study(service, tuple(arguments.seconds), arguments.jobs_at_once, rng)
        service.start()
        try:
            for _ in range(arguments.kills):
                study.crash(study.run_until(time.monotonic() + rng.uniform(0.5, 6.0)))
            study.finish()
            study.look_again()
        finally:
            service.close()
    outcome = outcome_of(study)
    print(table(outcome, arguments.kills, "SQLite" if database_url is None else "PostgreSQL"),
          flush=True)
    return outcome


def outcome_of(study: Study) -> Outcome:
    """Return what became of the jobs."""
    jobs = study.jobs.values()
    states = [json.loads(job.result)["state"] for job in jobs if job.result is not None]
    return {
        "jobs": len(jobs),
        "of these killed while they ran": sum(job.kills > 0 for job in jobs),
        "most kills of one job": max((job.kills for job in jobs), default=0),
        "done": states.count("done"),
        "lost": len(study.open_jobs),
        "failed": states.count("failed"),
        "made twice": len(study.made_twice),
        "with two results": sum(job.other_results > 0 for job in jobs),
        "whose cost rose": sum(job.rises > 0 for job in jobs),
        "seconds from ready to progress, median": statistics.median(study.resumptions or [0.0]),
        "seconds from ready to progress, longest": max(study.resumptions, default=0.0),
    }


def table(outcome: Outcome, kills: int, database: str) -> str:
    """Return the outcome in Markdown."""
    rows = {"database": database, "kills": kills, **outcome}
    lines = [f"| {name} | {value:.2f} |" if isinstance(value, float) else f"| {name} | {value} |"
             for name, value in rows.items()]
    return "\n".join(["| what | figure |", "| --- | --- |", *lines])


if __name__ == "__main__":
    main()
