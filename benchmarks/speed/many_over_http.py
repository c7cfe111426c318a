"""Many customers with windows, two kinds of vehicles, two trips and drones, over HTTP.

`python -m benchmarks.speed.many_over_http --customers 100000 --seconds 60` starts the service,
sends it seeded problems and tells of each when the reply was there, what its plan is like, and at
the end how much memory the service took at most. With `--rarer` they state several windows,
pickups, setups and most stops, too.
"""

import json
import re
import time
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer

from examples.many import mixed_customers
from benchmarks.speed.latency import service

CLOSING_S = 600.0


def answer(address: str, customers: int, seconds: float, has_drones: bool,
           has_rarer: bool) -> dict[str, Any]:
    """Send a problem; return the figures of the reply and of its plan."""
    request = (mixed_customers(customers, has_drones, has_rarer)
               | {"options": {"time_limit": seconds}})
    body = json.dumps(request).encode()
    began = time.perf_counter()
    reply = httpx.post(f"{address}/plan", content=body, timeout=seconds + CLOSING_S,
                       headers={"Content-Type": "application/json"})
    took = time.perf_counter() - began
    reply.raise_for_status()
    plan = reply.json()
    summary, solver = plan["summary"], plan["solver"]
    return {"customers": customers, "drones": has_drones, "time_limit": seconds,
            "reply after": round(took, 1), "left out": customers - summary["served"],
            "first plan": round(solver["decoded_cost"]), "cost": round(solver["final_cost"]),
            "vehicles": summary["vehicles"], "trips": summary["trips"],
            "sorties": summary["sorties"], "turns": solver["search_iterations"]}


def peak_megabytes() -> float:
    """Return the largest peak of this process's children."""
    children = Path("/proc/self/task").glob("*/children")
    peaks = [0.0]
    for child in " ".join(path.read_text() for path in children).split():
        found = re.search(r"VmHWM:\s+(\d+)", Path(f"/proc/{child}/status").read_text())
        peaks.append(int(found[1]) / 1000 if found else 0.0)
    return max(peaks)


def main(customers: Annotated[list[int], typer.Option(help="several")],
         seconds: Annotated[float, typer.Option(help="time_limit")] = 60.0,
         rarer: Annotated[bool, typer.Option("--rarer", help="by rarer rules, too")] = False
         ) -> None:
    """Print a line of JSON a reply."""
    with service() as address:
        for number in customers:
            for has_drones in (False, True):
                print(json.dumps(answer(address, number, seconds, has_drones, rarer)), flush=True)
        print(f"{peak_megabytes():.0f} MB at most")


if __name__ == "__main__":
    typer.run(main)
