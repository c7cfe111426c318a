"""Does work go on for clients who have left? `python -m benchmarks.load.leavers`.

Clients send sweeps whose scenarios each go on from a plan around no-fly areas, so that all of them
have to be worked out before the sweep is accepted, and close their connections after a moment. From
then on `GET /jobs` and `GET /health/ready` are asked again and again, and the processor time of the
service is read. Fails if a reply takes longer than `--bound`, or work goes on a while later.
"""

import json
import os
import statistics
import tempfile
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer

from benchmarks.fuzz.api import Target, service
from benchmarks.fuzz.problems import client_of
from benchmarks.speed.punctuality import area, drones, problem

Data = dict[str, Any]

ASKED = ("/jobs", "/health/ready")

STILL_WORKS = 0.5
"""Seconds of processor time for each second from which on a service is at work."""

WAKING = 0.05
"""Seconds between two questions."""


def sweep(customers: int, corners: int, winds: int) -> Data:
    """Return a sweep over winds, in each of which all flights around the areas differ."""
    base = problem(customers, drones=drones(2), capacity=400)
    base["airspace"] = {"no_fly": [area(x, 5.0, 3.0, corners, 0.5) for x in (-8.0, 8.0)]}
    base["options"] = {"time_limit": 1.0}
    return {"base": base, "grid": {
        "airspace.wind.speed_kmh": [round(0.5 * number, 1) for number in range(winds)]}}


def going_on(client: httpx.Client, study: Data) -> Data:
    """Return a sweep whose base goes on from a plan, when a part of the day is over."""
    base = study["base"]
    plan = client.post("/plan", json=base).raise_for_status().json()
    ends = [trip["stops"][-1]["departure"] for route in plan["routes"] for trip in route["trips"]]
    given = {"routes": plan["routes"], "unassigned": plan["unassigned"]}
    replan = {"plan": given, "freeze_before": 0.3 * max(ends)}
    return study | {"base": base | {"replan": replan}}


def leave(target: Target, body: bytes, after: float) -> None:
    """Send a sweep and close the connection after some seconds."""
    with client_of(target) as client:
        try:
            reply = client.post("/sweep", content=body, timeout=httpx.Timeout(60, read=after),
                                headers={"Content-Type": "application/json"})
            typer.echo(f"answered before its client left: {reply.status_code}", err=True)
        except httpx.ReadTimeout:
            pass


def spent(process: int) -> float:
    """Return the processor time of a process and all that it began, as Linux counts it."""
    user, system = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[11:13]
    begun = Path(f"/proc/{process}/task/{process}/children").read_text().split()
    own = (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")
    return own + sum(spent(int(child)) for child in begun)


def latencies(target: Target, path: str, seconds: float) -> list[float]:
    """Ask for something again and again; return how long each reply took."""
    taken = []
    with client_of(target) as client:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            began = time.perf_counter()
            client.get(path).raise_for_status()
            taken.append(time.perf_counter() - began)
            time.sleep(WAKING)
    return taken


def watched(target: Target, seconds: float) -> dict[str, list[float]]:
    """Return how long replies took, by what was asked for."""
    found: dict[str, list[float]] = {}

    def ask(path: str) -> None:
        found[path] = latencies(target, path, seconds)

    _together([threading.Thread(target=ask, args=(path,)) for path in ASKED])
    return found


def _together(threads: Sequence[threading.Thread]) -> None:
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def main(
    clients: Annotated[int, typer.Option(help="Who send a sweep each.")] = 8,
    customers: Annotated[int, typer.Option(help="Of each sweep.")] = 40,
    corners: Annotated[int, typer.Option(help="Of each of two no-fly areas.")] = 60,
    winds: Annotated[int, typer.Option(help="Scenarios of each sweep.")] = 60,
    after: Annotated[float, typer.Option(help="Seconds until they leave.")] = 0.5,
    seconds: Annotated[float, typer.Option(help="How long to look then.")] = 5.0,
    bound: Annotated[float, typer.Option(help="Seconds that a reply may take.")] = 1.0,
) -> None:
    """Send sweeps whose clients leave, and tell what becomes of the service."""
    with tempfile.TemporaryDirectory() as folder, service(Path(folder)) as target:
        with client_of(target) as client:
            body = json.dumps(going_on(client, sweep(customers, corners, winds))).encode()
        typer.echo(f"{clients} sweeps of {len(body):,} bytes")
        _together([threading.Thread(target=leave, args=(target, body, after))
                   for _ in range(clients)])
        found = watched(target, seconds)
        before = spent(target.process.pid)
        time.sleep(1.0)
        works = spent(target.process.pid) - before
    for path, taken in found.items():
        typer.echo(f"GET {path}: median {1000 * statistics.median(taken):.0f} ms, longest "
                   f"{1000 * max(taken):.0f} ms, of {len(taken)}")
    typer.echo(f"after {seconds:g} s: {works:.2f} s of processor time in a second")
    slowest = max(max(taken) for taken in found.values())
    raise typer.Exit(1 if slowest > bound or works > STILL_WORKS else 0)


if __name__ == "__main__":
    typer.run(main)
