"""Are requests that ask for much answered in time? `python -m benchmarks.speed.punctuality`.

Requests that once took several times their time limit, and others of their kind, are sent over HTTP
to a service on one core. Told are the median and the longest time taken, what of it came before the
search (legs, flights around areas, validation), who is left out, and what the plan costs; or in
which words a request was refused. Fails if one is more than `--bound` times its limit.
"""

import json
import math
import os
import random
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer
from rich.console import Console
from rich.table import Table

from benchmarks.fuzz.api import Target, service
from benchmarks.fuzz.problems import client_of

Data = dict[str, Any]
Window = Callable[[random.Random], Data]

DAY = 86_400


def problem(number: int, types: int = 1, count: int | None = None, capacity: int = 40,
            shift: int = DAY, window: Window | None = None, **vehicle: Any) -> Data:
    """Return a problem on a square of 40 km, a customer every few minutes, wherever it is."""
    rng = random.Random(number)

    def place() -> list[float]:
        return [round(rng.uniform(-20, 20), 3), round(rng.uniform(-20, 20), 3)]

    customers = [{"id": str(index), "location": place(), "demand": [rng.randint(1, 10)],
                  "service_duration": 120, **({} if window is None else
                                              {"time_window": window(rng)})}
                 for index in range(number)]
    fleet = [{"id": f"t{kind}", "count": count or max(2, number // 4),
              "capacity": [capacity * (1 + kind % 5)], "shift": {"latest": shift},
              "costs": {"fixed": 20, "per_km": 1 + 0.2 * (kind % 5), "per_hour": 10},
              **vehicle} for kind in range(types)]
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
            "customers": customers, "fleet": fleet}


def drones(count: int = 1, **changes: Any) -> Data:
    """Return the drones of a type of vehicle."""
    return {"count": count, "capacity": [10], "speed_kmh": 60, "endurance": 1800,
            "launch_duration": 30, "recovery_duration": 30, **changes}


def speeds(steps: int, until: int) -> list[Data]:
    """Return a speed profile that changes again and again."""
    rng = random.Random(steps)
    return [{"from": round((step + 1) * until / steps), "speed_kmh": round(rng.uniform(20, 60), 1)}
            for step in range(steps)]


def soft(until: int, early: float = 0.0) -> Window:
    """Return a way to draw soft windows."""
    def draw(rng: random.Random) -> Data:
        earliest = rng.randrange(int(0.7 * until))
        return {"earliest": earliest, "latest": earliest + rng.randrange(1800, 7200),
                "late_cost_per_hour": 20.0, "early_cost_per_hour": early}

    return draw


def area(x: float, y: float, radius: float, corners: int, jagged: float = 1.0) -> list[list[float]]:
    """Return the corners of a circle, every second one drawn in."""
    return [[round(x + radius * share * math.cos(angle), 4),
             round(y + radius * share * math.sin(angle), 4)]
            for index in range(corners)
            for angle, share in ((math.tau * index / corners, jagged if index % 2 else 1.0),)]


def around(request: Data, *areas: list[list[float]], wind: float = 0.0) -> Data:
    """Return a problem with no-fly areas and wind."""
    return request | {"airspace": {"no_fly": list(areas),
                                   "wind": {"speed_kmh": wind, "direction_deg": 45}}}


def flown(number: int, types: int) -> Data:
    """Return a problem whose types of vehicles have drones of different speeds."""
    request = problem(number, types=types)
    for kind, vehicle in enumerate(request["fleet"]):
        vehicle["drones"] = drones(speed_kmh=60 + kind)
    return request


def requests() -> dict[str, Data]:
    """Return all requests, named."""
    circles = (area(-8, 0, 6, 500), area(8, 3, 6, 500))
    stars = (area(-8, 0, 6, 500, 0.6), area(8, 3, 6, 500, 0.6))
    triangle = area(5, 5, 4, 3)
    week = 10 * DAY
    return {
        "10, two areas of 500 corners": around(flown(10, 1), *circles),
        "the same, 5 types of drones": around(flown(10, 5), *circles),
        "the same, stars in wind": around(flown(10, 5), *stars, wind=20),
        "100, 20 areas of 50 corners": around(
            flown(100, 2), *(area(4 * (i % 5) - 8, 4 * (i // 5) - 8, 1.5, 50) for i in range(20))),
        "3,000 with drones, a triangle": around(problem(3000, drones=drones()), triangle),
        "2,000 with drones": problem(2000, drones=drones()),
        "3,000 with drones": problem(3000, drones=drones()),
        "1,000 on one trip, 1,000 speeds": problem(
            1000, count=1, capacity=100_000, shift=week, speed_profile=speeds(1000, week)),
        "the same, soft windows": problem(
            1000, count=1, capacity=100_000, shift=week, speed_profile=speeds(1000, week),
            window=soft(week)),
        "3,000, soft windows, 10 vehicles": problem(3000, count=10, capacity=10_000, shift=week,
                                                    window=soft(week)),
        "1,000, 24 speeds, waiting costs, drones": problem(
            1000, speed_profile=speeds(24, DAY), window=soft(DAY, 5.0), drones=drones()),
        "2,000 who all stay out, 100 types": problem(2000, types=100, count=1, shift=60),
        "1,000, hundreds of trips": problem(1000, count=2, capacity=10, shift=10 * week,
                                            max_trips=500),
        "300, 100 types": problem(300, types=100, count=50),
        "1,000, four drones, flights to eight": problem(
            1000, drones=drones(4, max_customers_per_sortie=8)),
    }


def pinned(target: Target, core: int) -> None:
    """Keep a service on one core, where the system can. In place."""
    if hasattr(os, "sched_setaffinity"):
        for task in Path(f"/proc/{target.process.pid}/task").iterdir():
            os.sched_setaffinity(int(task.name), {core})


def ask(client: httpx.Client, request: Data) -> tuple[float, httpx.Response]:
    """Return the seconds that a reply takes, and the reply."""
    body = json.dumps(request, separators=(",", ":")).encode()
    began = time.perf_counter()
    reply = client.post("/plan", content=body, headers={"Content-Type": "application/json"})
    return time.perf_counter() - began, reply


def told(reply: httpx.Response) -> tuple[str, ...]:
    """Return what a reply says: seconds before the search, customers left out and the cost."""
    content = reply.json()
    if reply.status_code != 200:
        error = content.get("errors", [{"code": content.get("title", "")}])[0]
        return f"{reply.status_code} {error['code']}", "", ""
    return (f"{content['solver']['elapsed']['validate']:.2f}", str(len(content["unassigned"])),
            f"{content['cost']['total']:.0f}")


def main(
    rounds: Annotated[int, typer.Option(help="How often each is sent.")] = 3,
    time_limit: Annotated[float, typer.Option(help="Of each request, in seconds.")] = 1.0,
    bound: Annotated[float, typer.Option(help="Largest ratio that is no fault.")] = 1.1,
    core: Annotated[int, typer.Option(help="Core of the service.")] = 0,
) -> None:
    """Ask for dear plans and tell how long they took."""
    table = Table("customers", "KB", "median, s", "longest, s", "before search, s", "left out",
                  "cost")
    late = 0
    with (tempfile.TemporaryDirectory() as name, service(Path(name)) as target,
          client_of(target) as client):
        pinned(target, core)
        for kind, request in requests().items():
            request["options"] = {"time_limit": time_limit}
            asked = [ask(client, request) for _ in range(rounds)]
            seconds = [elapsed for elapsed, _ in asked]
            late += statistics.median(seconds) > bound * time_limit
            table.add_row(kind, f"{len(json.dumps(request)) // 1000}",
                          f"{statistics.median(seconds):.3f}", f"{max(seconds):.3f}",
                          *told(asked[-1][1]))
    Console(width=120).print(table)
    raise typer.Exit(1 if late else 0)


if __name__ == "__main__":
    typer.run(main)
