"""Whether memory stays flat over a day of small plans: `python -m benchmarks.load.endurance`.

Sends random small problems to a service over loopback, from another process, and prints the
resident memory of the service after each tenth.
"""

import asyncio
import json
import time
from typing import Any

import numpy as np
import typer

from app.schemas.limits import DEFAULT_POLICY
from benchmarks.load.load import Client, Service, Tally, encoded, running

MOST_CUSTOMERS = 8
DIFFERENT = 500
"""Requests that take turns."""


def small_request(rng: np.random.Generator, policy: str) -> dict[str, Any]:
    """Return a request with few customers, windows and drones now and then."""
    size = int(rng.integers(1, MOST_CUSTOMERS + 1))
    customers = []
    for number in range(size):
        customer = {"id": str(number), "location": rng.uniform(-10, 10, 2).round(3).tolist(),
                    "demand": [int(rng.integers(1, 4))]}
        if rng.random() < 0.3:
            earliest = int(rng.integers(0, 7200))
            customer["time_window"] = {"earliest": earliest, "latest": earliest + 3600}
        customers.append(customer)
    truck: dict[str, Any] = {"id": "truck", "count": 2, "capacity": [12]}
    if rng.random() < 0.5:
        truck["drones"] = {"count": int(rng.integers(1, 3)), "capacity": [2]}
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
            "customers": customers, "fleet": [truck],
            "options": {"policy": policy, "time_limit": 0}}


def send(service: Service, requests: list[bytes], count: int, clients: int) -> Tally:
    """Send so many requests, each client the next one as soon as it is answered."""
    tally = Tally()
    numbers = iter(range(count))

    async def ask() -> None:
        client = Client(service.port)
        for number in numbers:
            await client.time(requests[number % len(requests)], tally)
        client.close()

    async def ask_all() -> None:
        await asyncio.gather(*(ask() for _ in range(clients)))

    asyncio.run(ask_all())
    return tally


def main(plans: int = 200_000, workers: int = 1,
         policy: str = DEFAULT_POLICY) -> None:
    """Print memory by plans made."""
    rng = np.random.default_rng(0)
    with running(workers) as service:
        requests = [encoded(json.dumps(small_request(rng, policy)).encode(), service.key)
                    for _ in range(DIFFERENT)]
        send(service, requests, 4 * DIFFERENT, 2 * workers)
        print(f"warm: {service.memory():.0f} MB", flush=True)
        began, replies = time.perf_counter(), 0
        for tenth in range(1, 11):
            tally = send(service, requests, plans // 10, 2 * workers)
            replies += tally.count(200)
            print(f"{plans * tenth // 10} requests, {replies} plans: {service.memory():.0f} MB, "
                  f"{plans * tenth / 10 / (time.perf_counter() - began):.0f}/s, "
                  f"99 % within {tally.quantile(200, 0.99):.1f} ms", flush=True)


if __name__ == "__main__":
    typer.run(main)
