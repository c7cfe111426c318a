"""Looks for the requests that outlast their time limit the most.

`python -m benchmarks.speed.dearest`.

A small population of requests of at most 200 KB evolves towards a larger ratio of the time taken,
over HTTP, to the time limit; a refusal counts with the time that it took, and what is asked of a
plan with that limit, too. The service runs on one core where the machine can be told so. What beats
the record is asked for twice more, and the least ratio counts, so that a busy moment of the machine
is no find. Fails beyond `--bound`, and if a reply has a status of 500 or more.
"""

import csv
import json
import os
import random
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Literal

import httpx
import typer
from tqdm import tqdm

from app.serving.load.courtesy import NICENESS
from benchmarks.fuzz.api import service
from benchmarks.speed.dear_requests import (
    PLAN, Genes, changed_genes, gene, mixed_genes, random_genes, request_of,
)
from benchmarks.speed.punctuality import pinned

Data = dict[str, Any]

POPULATION = 24
"""Requests that others are made of, for each endpoint."""

FRESH, MIXED = 0.15, 0.3
"""Shares of new requests that are drawn anew, and mixed of two."""

TURNS = ("/plan", "/fit", "/plan", "/explain", "/plan", "/check", "/vroom")
"""Endpoints asked in turn: most often the one that has most rules."""

ABOUT_PLANS = "/check", "/fit", "/explain"
"""Endpoints that are asked about a plan, which is made first."""

RECORD_SHARE = 0.97
"""Share of the record from which on a ratio is measured again."""

POLLING = 0.1

PATIENCE = 600.0
"""Seconds in which any reply has to come."""


@dataclass(frozen=True)
class Find:
    """How long a request took."""

    path: str
    genes: Genes
    ratio: float
    status: int
    bytes: int


@dataclass
class Search:
    """A search for the dearest requests to one endpoint.

    `measure` returns the ratio, the status and the length of the request that genes describe.
    """

    path: str
    rng: random.Random
    measure: Callable[[str, Genes], tuple[float, int, int]]
    best: list[Find] = field(default_factory=list)  # the dearest first

    def step(self) -> Find:
        """Try one more request. In place; return what came of it."""
        genes = self._next()
        find = self._measured(genes)
        if not self.best or find.ratio > RECORD_SHARE * self.best[0].ratio:
            find = min((find, self._measured(genes), self._measured(genes)),
                       key=lambda again: again.ratio)
        self.best = sorted([*self.best, find], key=lambda each: -each.ratio)[:POPULATION]
        return find

    def _next(self) -> Genes:
        if len(self.best) < POPULATION or self.rng.random() < FRESH:
            return random_genes(self.rng, self.path)
        # The dearer of two, twice.
        first, second = (min(self.rng.sample(range(len(self.best)), 2)) for _ in range(2))
        genes = self.best[first].genes
        if self.rng.random() < MIXED:
            genes = mixed_genes(self.rng, genes, self.best[second].genes)
        return changed_genes(self.rng, self.path, genes)

    def _measured(self, genes: Genes) -> Find:
        return Find(self.path, genes, *self.measure(self.path, genes))


BESIDE_SECONDS, BESIDE_PATIENCE = 60.0, 10.0
"""Time limit of a job that runs beside, and how long one may take to begin."""

BESIDE: Genes = {"customers": 5, "types": 4, "drones": 4, "drone_types": 3}
"""What the job has that runs beside, besides the first of all."""


class Companion:
    """Has a job of many types run beside what is asked for."""

    def __init__(self, client: httpx.Client) -> None:
        self._client = client
        self._request = request_of("/plan", {**dict.fromkeys(PLAN, 0), **BESIDE}, BESIDE_SECONDS)
        self._job: str | None = None

    def keep_running(self) -> None:
        """Submit a job if none is under way, and wait until it runs. In place."""
        end = time.monotonic() + BESIDE_PATIENCE
        while time.monotonic() < end:
            state = "done" if self._job is None else self._client.get(
                f"/jobs/{self._job}").json()["state"]
            if state == "running":
                return
            if state != "queued":
                self._job = self._client.post("/jobs", json=self._request).json()["id"]
            time.sleep(POLLING)


def _about(path: str, genes: Genes, request: Data, plan: Data) -> Data:
    """Return a question about a plan, of some customer unless all of it is checked."""
    asked: Data = {"problem": request, "plan": {"routes": plan["routes"],
                                                "unassigned": plan["unassigned"]}}
    if path == "/check":
        return asked
    customers = request["customers"]
    asked["options"] = {"time_limit": request["options"]["time_limit"]}
    return asked | {"customer": customers[genes["seed"] % len(customers)]["id"]}


def processor_time(process: int) -> float:
    """Return the seconds of the processor that a process and its children took so far.

    Threads that stand back are left out while they run: they are those of a job beside.
    """
    ticks, waiting = 0, [process]
    while waiting:
        each = waiting.pop()
        try:
            ticks += sum(map(int, _counts(Path(f"/proc/{each}"))[11:15]))
            for task in Path(f"/proc/{each}/task").iterdir():
                counts = _counts(task)
                if int(counts[16]) >= NICENESS:
                    ticks -= sum(map(int, counts[11:13]))
                waiting += map(int, (task / "children").read_text().split())
        except FileNotFoundError:
            continue
    return ticks / os.sysconf("SC_CLK_TCK")


def _counts(folder: Path) -> list[str]:
    """Return what Linux tells of a process or thread from the third field of `stat` on."""
    return (folder / "stat").read_text().rsplit(")", 1)[1].split()


@dataclass(frozen=True)
class Asker:
    """Asks a service for plans."""

    client: httpx.Client
    time_limit: float  # seconds
    companion: "Companion | None" = None
    now: Callable[[], float] = time.perf_counter

    def measure(self, path: str, genes: Genes) -> tuple[float, int, int]:
        """Return the ratio of time taken to time limit, the status and the bytes sent."""
        request = self.request(path, genes)
        body = json.dumps(request, separators=(",", ":")).encode()
        if self.companion is not None:
            self.companion.keep_running()
        began = self.now()
        reply = self.client.post(path, content=body)
        elapsed = self.now() - began
        return elapsed / self.time_limit, reply.status_code, len(body)

    def request(self, path: str, genes: Genes) -> Data:
        """Return a request; one that is about a plan is planned for that first."""
        request = request_of(path, genes, self.time_limit)
        how = "no" if path == "/vroom" else gene(path, genes, "replan")
        if how == "no" and path not in ABOUT_PLANS:
            return request
        reply = self.client.post("/plan", json=request)
        if reply.status_code != 200:
            return request
        plan = reply.json()
        if path in ABOUT_PLANS:
            return _about(path, genes, request, plan)
        ends = [trip["stops"][-1]["departure"] for route in plan["routes"]
                for trip in route["trips"]]
        now = 0.4 * max(ends, default=0.0) if how == "under way" else None
        given = {"routes": plan["routes"], "unassigned": plan["unassigned"]}
        return request | {"replan": {"plan": given, "freeze_before": now}}


def main(
    minutes: Annotated[float, typer.Option(help="How long to look.")] = 60.0,
    time_limit: Annotated[float, typer.Option(help="Of each request, in seconds.")] = 1.0,
    bound: Annotated[float, typer.Option(help="Largest ratio that is no fault.")] = 1.3,
    seed: Annotated[int, typer.Option(help="Of the search.")] = 0,
    core: Annotated[int, typer.Option(help="Core of the service.")] = 0,
    only: Annotated[Literal["/plan", "/vroom", "/check", "/fit", "/explain"] | None,
                    typer.Option(help="One endpoint; else most requests go to /plan.")] = None,
    beside: Annotated[bool, typer.Option(help="Have a job run beside.")] = False,
    by_processor: Annotated[bool, typer.Option(
        help="Count the processor time of what is asked, not the clock's (Linux).")] = False,
    folder: Annotated[Path, typer.Option(help="For the finds.")] = Path("runs/dearest"),
) -> None:
    """Look for requests that take much longer than their time limit."""
    folder.mkdir(parents=True, exist_ok=True)
    with (tempfile.TemporaryDirectory() as name, service(Path(name)) as target,
          (folder / "finds.csv").open("w", newline="") as file):
        pinned(target, core)
        client = httpx.Client(
            base_url=target.url, trust_env=False, timeout=PATIENCE,
            headers={"Authorization": f"Bearer {target.key}", "Content-Type": "application/json"})
        now = partial(processor_time, target.process.pid) if by_processor else time.perf_counter
        asker = Asker(client, time_limit, Companion(client) if beside else None, now)
        turns = TURNS if only is None else (only,)
        searches = {path: Search(path, random.Random(seed), asker.measure) for path in turns}
        table = csv.writer(file)
        table.writerow(["endpoint", "ratio", "status", "bytes", "genes"])
        worst, faults, rounds = 0.0, 0, 0
        end = time.monotonic() + 60 * minutes
        with tqdm(total=round(60 * minutes), unit="s", disable=None) as bar:
            while time.monotonic() < end:
                find = searches[turns[rounds % len(turns)]].step()
                rounds += 1
                faults += find.status >= 500
                table.writerow([find.path, f"{find.ratio:.3f}", find.status, find.bytes,
                                json.dumps({each: gene(find.path, find.genes, each)
                                            for each in find.genes})])
                file.flush()
                if find.ratio > worst or find.status >= 500:
                    request = asker.request(find.path, find.genes)
                    (folder / f"{rounds:05}-{find.ratio:.2f}-{find.status}.json").write_text(
                        json.dumps({"path": find.path, "request": request}))
                worst = max(worst, find.ratio)
                bar.n = round(60 * minutes - (end - time.monotonic()))
                bar.set_postfix(tried=rounds, worst=f"{worst:.2f}")
        faults += target.process.poll() is not None
    typer.echo(f"{rounds} requests, worst ratio {worst:.2f}, {faults} faults")
    raise typer.Exit(1 if faults or worst > bound else 0)


if __name__ == "__main__":
    typer.run(main)
