"""Has wild requests of VROOM's planned and judged: `python -m benchmarks.fuzz.vroom`.

Fails if a reply is anything but a solution or a documented refusal, if a job is lost or served
twice, or if a route breaks a rule that can be told from the reply alone.
"""

import json
import random
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer

from benchmarks.fuzz.api import service
from benchmarks.fuzz.problems import Fault, client_of
from benchmarks.fuzz.wild_vroom import wild_vroom

Data = dict[str, Any]

Name = tuple[str, int]
"""Kind and id of a task."""

REFUSED = (400, 413)

NO_TASKS = ("start", "break", "end")


@dataclass
class Study:
    """What came of all requests."""

    client: httpx.Client
    statuses: Counter[int] = field(default_factory=Counter)
    left_out: int = 0  # solutions with jobs left out
    longest: float = 0.0  # seconds

    def try_request(self, request: Data) -> None:
        """Have one request planned and judge the solution. In place.

        Raises
        ------
        Fault
            If the reply should not be.
        """
        began = time.perf_counter()
        reply = self.client.post("/vroom", content=json.dumps(request),
                                 headers={"Content-Type": "application/json"})
        self.longest = max(self.longest, time.perf_counter() - began)
        self.statuses[reply.status_code] += 1
        if reply.status_code in REFUSED:
            if not reply.json().get("error"):
                raise Fault(f"refused without words: {reply.text[:500]}")
            return
        if reply.status_code != 200:
            raise Fault(f"answered with {reply.status_code}: {reply.text[:500]}")
        solution = json.loads(reply.content, parse_constant=_no_number)
        judge(request, solution)
        self.left_out += bool(solution["unassigned"])


def _no_number(name: str) -> float:
    raise Fault(f"the reply says {name}")


def judge(request: Data, solution: Data) -> None:
    """Judge a solution by what it says itself and what the request says of jobs and vehicles.

    Raises
    ------
    Fault
        If a job is lost or served twice, or a rule is broken.
    """
    jobs = tasks_of(request)
    vehicles = {vehicle["id"]: vehicle for vehicle in request["vehicles"]}
    served = [(step["type"], step["id"]) for route in solution["routes"]
              for step in route["steps"] if step["type"] not in NO_TASKS]
    left_out = [(job["type"], job["id"]) for job in solution["unassigned"]]
    if sorted(served + left_out) != sorted(jobs):
        raise Fault(f"served {served} and left out {left_out} of {sorted(jobs)}")
    for route in solution["routes"]:
        _judge_route(vehicles[route["vehicle"]], jobs, route["steps"])


def tasks_of(request: Data) -> dict[Name, Data]:
    """Return jobs and the ends of shipments by kind and id; ends name the other one's."""
    tasks: dict[Name, Data] = {("job", job["id"]): job for job in request["jobs"]}
    for shipment in request.get("shipments", ()):
        for kind, other in (("pickup", "delivery"), ("delivery", "pickup")):
            tasks[kind, shipment[kind]["id"]] = {
                "skills": shipment.get("skills", ()), **shipment[kind],
                "mate": (other, shipment[other]["id"])}
    return tasks


def _judge_route(vehicle: Data, jobs: dict[Name, Data], steps: list[Data]) -> None:
    """Raise `Fault` for a window, a load, a skill, a number of tasks, a shipment or a break that
    isn't kept.
    """
    visited = [step for step in steps if step["type"] not in NO_TASKS]
    names = [(step["type"], step["id"]) for step in visited]
    begin, end = vehicle.get("time_window", (0, float("inf")))
    if not begin <= steps[0]["arrival"] <= steps[-1]["arrival"] <= end:
        raise Fault(f"vehicle {vehicle['id']} works outside its window")
    if len(visited) > vehicle.get("max_tasks", len(visited)):
        raise Fault(f"vehicle {vehicle['id']} has too many tasks")
    for place, step in enumerate(visited):
        job, start = jobs[names[place]], step["arrival"] + step["waiting_time"]
        mate = job.get("mate")
        if mate and (mate not in names or (names.index(mate) > place) != (mate[0] == "delivery")):
            raise Fault(f"{names[place]} is not before, or behind, its other end")
        if not _is_open(job, start):
            raise Fault(f"job {job['id']} is begun at {start}, outside its windows")
        if not set(job.get("skills", ())) <= set(vehicle.get("skills", ())):
            raise Fault(f"vehicle {vehicle['id']} lacks a skill for job {job['id']}")
    _judge_breaks(vehicle, [step for step in steps if step["type"] == "break"])
    for step in steps:
        if any(load > most for load, most in
               zip(step.get("load", ()), vehicle.get("capacity", ()), strict=False)):
            raise Fault(f"vehicle {vehicle['id']} is too full: {step['load']}")


def _judge_breaks(vehicle: Data, steps: list[Data]) -> None:
    """Raise `Fault` for a break that is missing, too full, or outside its windows."""
    breaks = {each["id"]: each for each in vehicle.get("breaks", ())}
    if sorted(step["id"] for step in steps) != sorted(breaks):
        raise Fault(f"vehicle {vehicle['id']} takes the breaks {steps}")
    for step in steps:
        each = breaks[step["id"]]
        if not _is_open(each, step["arrival"] + step["waiting_time"]):
            raise Fault(f"break {each['id']} is begun outside its windows")
        if any(load > most for load, most in
               zip(step.get("load", ()), each.get("max_load", ()), strict=False)):
            raise Fault(f"vehicle {vehicle['id']} is too full for break {each['id']}")


def _is_open(stated: Data, start: int) -> bool:
    return any(first <= start <= last
               for first, last in stated.get("time_windows", [(0, float("inf"))]))


def main(
    requests: Annotated[int, typer.Option(help="Requests to send.")] = 7000,
    seed: Annotated[int, typer.Option(help="Seed of the first; later ones count on.")] = 0,
) -> None:
    """Fuzz VROOM's endpoint."""
    faults = 0
    with (tempfile.TemporaryDirectory() as name, service(Path(name)) as target,
          client_of(target) as client):
        study = Study(client)
        for number in range(seed, seed + requests):
            try:
                study.try_request(wild_vroom(random.Random(number)))
            except (Fault, httpx.TransportError) as fault:
                faults += 1
                typer.echo(f"seed {number}: {type(fault).__name__}: {fault}")
        faults += target.process.poll() is not None
    typer.echo(f"{requests} requests, {faults} faults; {study.left_out} solutions with jobs left "
               f"out; longest reply {study.longest:.2f} s; {dict(sorted(study.statuses.items()))}")
    raise typer.Exit(1 if faults else 0)


if __name__ == "__main__":
    typer.run(main)
