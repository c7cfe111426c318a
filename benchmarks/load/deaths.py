"""Has the engine end its process again and again under load, and looks what becomes of others.

    python -m benchmarks.load.deaths --deaths 20

A library stands before the engine that aborts at problems of 13 customers. Such plans and jobs are
sent while others ask for plans, and 20 jobs of others are open. Wrong is any reply to others but
200, any job of theirs that doesn't end with a plan, a reply to who did it but 503 with
`Retry-After`, and a service that ended. Exits with 1 if any of this happened.
"""

import json
import statistics
import sys
import tempfile
import threading
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer

from benchmarks.load.crashes import EXAMPLE, Service
from benchmarks.load.dying import DEADLY, dying_engine

LONGEST = 600.0
"""Seconds that all of it may take."""

PAUSE = 0.05

WRONG = ("other plans not 200", "other jobs failed or lost", "own plans not 503",
         "ends of the service")


def deadly(seed: int) -> dict[str, Any]:
    """Return a request at which the engine aborts."""
    customers = [{"id": f"c{number}", "location": [number, seed % 7], "demand": [1]}
                 for number in range(DEADLY)]
    return {"depots": [{"id": "hub", "location": [0, 0]}], "customers": customers,
            "planar_unit": 1000, "fleet": [{"id": "truck", "count": 2, "capacity": [DEADLY]}],
            "options": {"time_limit": 30.0, "seed": seed}}


@dataclass
class Study:
    """What was sent, and what came of it."""

    service: Service
    harmless: dict[str, Any]
    seconds: float  # of a job that harms nobody
    replies: Counter[str] = field(default_factory=Counter)  # to plans that harm nobody
    own: Counter[str] = field(default_factory=Counter)  # to those that do
    took: list[float] = field(default_factory=list)
    jobs: list[str] = field(default_factory=list)  # that harm nobody
    own_jobs: list[str] = field(default_factory=list)
    over: threading.Event = field(default_factory=threading.Event)

    def ask(self, seed: int) -> None:
        """Ask for plans that harm nobody until it is over. In place."""
        body = self.harmless | {"options": {"time_limit": 0.2, "seed": seed}}
        while not self.over.is_set():
            began = time.perf_counter()
            self.replies[self._status(body)] += 1
            self.took.append(time.perf_counter() - began)

    def kill(self) -> None:
        """Ask for plans and jobs that do harm until it is over. In place."""
        seed = 0
        while not self.over.is_set():
            seed += 1
            self.own[self._status(deadly(seed))] += 1
            if seed % 4 == 1:
                self.own_jobs.append(self.submit(deadly(seed)))
            time.sleep(PAUSE)

    def submit(self, request: dict[str, Any]) -> str:
        """Submit a job and return its id."""
        reply = self.service.client.post("/jobs", json=request)
        reply.raise_for_status()
        return str(reply.json()["id"])

    def deaths(self) -> int:
        """Return how many processes died."""
        lines = self.service.client.get("/metrics").text.splitlines()
        return sum(int(float(line.rpartition(" ")[2])) for line in lines
                   if line.startswith("tandem_process_deaths_total{"))

    def states(self, jobs: list[str]) -> Counter[str]:
        """Return how many jobs are in which state, those failed with their error."""
        found = Counter[str]()
        for job_id in jobs:
            job = self.service.client.get(f"/jobs/{job_id}").json()
            found[job["error"] or job["state"]] += 1
        return found

    def _status(self, body: dict[str, Any]) -> str:
        try:
            reply = self.service.client.post("/plan", json=body)
        except httpx.TransportError as error:
            return type(error).__name__
        return f"{reply.status_code}{' with Retry-After' * ('retry-after' in reply.headers)}"


def run(deaths: int, jobs: int, askers: int, seconds: float) -> dict[str, Any]:
    """Run the study and return what came of it."""
    with tempfile.TemporaryDirectory() as folder:
        settings = {"TANDEM_ROLE": "all", "TANDEM_ENGINE_LIBRARY": str(dying_engine(Path(folder))),
                    "TANDEM_MAX_QUEUED_PLANS": "100", "TANDEM_MAX_QUEUE_SECONDS": "60"}
        service = Service(Path(folder), None, settings)
        service.start()
        try:
            study = Study(service, json.loads(EXAMPLE.read_text("utf-8")), seconds)
            return _under_load(study, deaths, jobs, askers)
        finally:
            service.close()


def _under_load(study: Study, deaths: int, jobs: int, askers: int) -> dict[str, Any]:
    options = {"time_limit": study.seconds}
    study.jobs = [study.submit(study.harmless | {"options": options}) for _ in range(jobs)]
    threads = [threading.Thread(target=study.ask, args=(number,)) for number in range(askers)]
    threads.append(threading.Thread(target=study.kill))
    for thread in threads:
        thread.start()
    until = time.monotonic() + LONGEST
    while study.deaths() < deaths and time.monotonic() < until:
        time.sleep(PAUSE)
    study.over.set()
    for thread in threads:
        thread.join()
    while time.monotonic() < until:
        left = study.states(study.jobs + study.own_jobs)
        if not left["queued"] + left["running"]:
            break
        time.sleep(PAUSE)
    done, own = study.states(study.jobs), study.states(study.own_jobs)
    return {
        "deaths": study.deaths(),
        "other plans": study.replies.total(),
        "other plans not 200": study.replies.total() - study.replies["200"],
        "milliseconds of other plans, median": round(1000 * statistics.median(study.took)),
        "milliseconds of other plans, longest": round(1000 * max(study.took)),
        "other jobs": len(study.jobs),
        "other jobs failed or lost": len(study.jobs) - done["done"],
        "own plans": study.own.total(),
        "own plans not 503": study.own.total() - study.own["503 with Retry-After"],
        "own jobs": dict(own),
        "ends of the service": int(not study.service.is_running),
    }


def main(
    deaths: Annotated[int, typer.Option(help="Of processes, at least.")] = 20,
    jobs: Annotated[int, typer.Option(help="Of others.")] = 20,
    askers: Annotated[int, typer.Option(help="Others who ask for plans.")] = 3,
    seconds: Annotated[float, typer.Option(help="Time limit of others' jobs.")] = 2.0,
) -> None:
    """Run the study and print what came of it."""
    outcome = run(deaths, jobs, askers, seconds)
    typer.echo("\n".join(f"{name}: {value}" for name, value in outcome.items()))
    if any(outcome[name] for name in WRONG):
        sys.exit(1)


if __name__ == "__main__":
    typer.run(main)
