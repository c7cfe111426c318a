"""Lives a day against the service: orders come in, vans tell what they do, the service is killed.

    python -m benchmarks.days.lived --orders 1000 --speed 100 --kills 50

Orders are drawn in a square, half of them before the day begins, with windows of two hours. Vans do
what the plan says, later or sooner by chance, and tell it. Told are: how long plans took from
events, how many windows were kept, and whether any event was lost, counted twice, or any plan
broke a rule. Exits with 1 if one was.
"""

import argparse
import json
import random
import statistics
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx

from benchmarks.load.crashes import Service

Data = dict[str, Any]

BEGIN, END, LAST_ORDER = 8 * 3600.0, 18 * 3600.0, 15 * 3600.0
SIDE = 20_000.0
"""Metres of the square."""

WINDOW = 7200.0
STOP = 120.0
"""Seconds of service."""

STEP = 0.1
"""Seconds between two looks at the world."""

LATE, LATE_SHARE, SPREAD = 900.0, 0.03, 60.0
"""Seconds by which some stops take longer, how many of them, and how all spread."""


@dataclass
class World:
    """What truly happens."""

    rng: random.Random
    orders: dict[str, Data]
    coming: list[tuple[float, Data]]
    done: dict[str, float] = field(default_factory=dict)
    departed: set[tuple[str, int]] = field(default_factory=set)
    noise: dict[tuple[str, str], float] = field(default_factory=dict)
    told: int = 0

    def events(self, now: float, plan: Data | None) -> Iterator[Data]:
        """Yield what has happened by now and wasn't told yet. In place."""
        while self.coming and self.coming[0][0] <= now:
            at, order = self.coming.pop(0)
            self.orders[order["id"]] = order
            yield self._event("order.placed", at, customer=order)
        for route in [] if plan is None else plan["routes"]:
            yield from self._driven(route, now)

    def _driven(self, route: Data, now: float) -> Iterator[Data]:
        vehicle = route["vehicle"]
        for index, trip in enumerate(route["trips"]):
            first, *stops, last = trip["stops"]
            if (vehicle, index) not in self.departed:
                if first["departure"] > now:
                    return
                self.departed.add((vehicle, index))
                yield self._event("vehicle.departed", first["departure"], vehicle=vehicle)
            for stop in stops:
                if stop["id"] in self.done:
                    continue
                at = stop["departure"] + self._noise(vehicle, stop["id"])
                if at > now:
                    return
                self.done[stop["id"]] = max(stop["service_start"], at - STOP)
                yield self._event("vehicle.served", at, vehicle=vehicle, order=stop["id"])
            if last["arrival"] > now:
                return
            if (vehicle, -1 - index) not in self.departed:
                self.departed.add((vehicle, -1 - index))
                yield self._event("vehicle.arrived", last["arrival"], vehicle=vehicle)

    def _noise(self, vehicle: str, order: str) -> float:
        late = LATE if self.rng.random() < LATE_SHARE else 0.0
        return self.noise.setdefault((vehicle, order), self.rng.gauss(0, SPREAD) + late)

    def _event(self, kind: str, at: float, **about: Any) -> Data:
        self.told += 1
        return {"event_id": f"e{self.told}", "kind": kind, "at": round(at, 3), **about}

    @property
    def kept(self) -> int:
        """How many were served within their windows."""
        return sum(at <= self.orders[order]["time_window"]["latest"] + 1
                   for order, at in self.done.items())


class Follower(threading.Thread):
    """Follows a day's stream, over all ends of its service."""

    def __init__(self, service: Service, day: str) -> None:
        super().__init__(daemon=True)
        self._service = service
        self._day = day
        self.seen: list[int] = []
        self.ids: list[str] = []
        self.planned: list[tuple[float, int]] = []  # when a plan was told, and what it counts with
        self.is_over = threading.Event()

    def run(self) -> None:
        """Follow until the day is over. In place."""
        while not self.is_over.is_set():
            last = str(self.seen[-1] if self.seen else 0)
            try:
                with self._service.client.stream("GET", f"/days/{self._day}/events", timeout=20,
                                                 headers={"Last-Event-ID": last}) as reply:
                    for line in reply.iter_lines():
                        if line.startswith("data:"):
                            self._hear(json.loads(line[5:]))
                        if self.is_over.is_set():
                            return
            except httpx.HTTPError:
                time.sleep(STEP)

    def _hear(self, event: Data) -> None:
        self.seen.append(event["number"])
        if event["event_id"] is not None:
            self.ids.append(event["event_id"])
        if event["kind"] == "plan.changed":
            self.planned.append((time.monotonic(), event["about"]["planned"]))


def drawn(rng: random.Random, orders: int, vans: int) -> tuple[Data, World]:
    """Return a problem of the morning, and the world."""
    def order(number: int, placed: float) -> Data:
        earliest = round(max(BEGIN, placed + 1800) + rng.uniform(0, END - WINDOW - 1800 - max(
            BEGIN, placed + 1800)), 0)
        return {"id": f"o{number}", "demand": [rng.randint(1, 9)], "service_duration": STOP,
                "location": [round(rng.uniform(0, SIDE)), round(rng.uniform(0, SIDE))],
                "time_window": {"earliest": earliest, "latest": earliest + WINDOW}}

    known = [order(number, 0.0) for number in range(orders // 2)]
    times = sorted(rng.uniform(BEGIN, LAST_ORDER) for _ in range(orders - len(known)))
    coming = [(at, order(number, at)) for number, at in enumerate(times, len(known))]
    problem = {
        "depots": [{"id": "hub", "location": [SIDE / 2, SIDE / 2]}], "customers": known,
        "fleet": [{"id": "van", "count": vans, "capacity": [200], "speed_kmh": 40, "max_trips": 4,
                   "costs": {"fixed": 50, "per_hour": 20},
                   "shift": {"earliest": BEGIN, "latest": END}}]}
    return problem, World(rng, {each["id"]: each for each in known}, coming)


def lived(service: Service, options: argparse.Namespace) -> Data:
    """Live a day and return what came of it."""
    rng = random.Random(options.seed)
    problem, world = drawn(rng, options.orders, options.vans)
    day = service.client.post("/days", json={"problem": problem, "clock": BEGIN - 60}).json()["id"]
    follower = Follower(service, day)
    follower.start()
    sent: list[tuple[float, int]] = []  # when events were told, and the number of the last
    kills = sorted(rng.uniform(0.02, 0.98) for _ in range(options.kills))
    now, began = BEGIN - 60, time.monotonic()
    plan, plans = None, 0
    accepted: dict[str, int] = {}
    while now < END + 1800:
        now = BEGIN - 60 + (time.monotonic() - began) * options.speed
        if kills and now > BEGIN + kills[0] * (END - BEGIN):
            kills.pop(0)
            service.kill()
            service.start()
        if len(follower.planned) > plans:
            plans = len(follower.planned)
            plan = _asked(service, "GET", f"/days/{day}/plan").json()["plan"]
        events = list(world.events(now, plan))
        if events:
            reply = _asked(service, "POST", f"/days/{day}/events", json=events)
            reply.raise_for_status()
            sent.append((time.monotonic(), reply.json()["revision"]))
            accepted |= {each["event_id"]: each["number"] for each in reply.json()["accepted"]}
        time.sleep(STEP)
    return _outcome(service, day, world, follower, sent, accepted)


def _asked(service: Service, method: str, path: str, **more: Any) -> httpx.Response:
    """Ask until the service answers: it may be away."""
    while True:
        try:
            reply = service.client.request(method, path, **more)
        except httpx.HTTPError:
            time.sleep(STEP)
            continue
        if reply.status_code != 503:
            return reply
        time.sleep(STEP)


def _outcome(service: Service, day: str, world: World, follower: Follower,
             sent: list[tuple[float, int]], accepted: dict[str, int]) -> Data:
    deadline = time.monotonic() + 30
    while not (state := _asked(service, "GET", f"/days/{day}").json())["is_planned"]:
        if time.monotonic() > deadline:
            break
        time.sleep(STEP)
    follower.is_over.set()
    waits = []
    for told_at, number in sent:
        then = next((at for at, counts in follower.planned if counts >= number), None)
        if then is not None:
            waits.append(max(0.0, then - told_at))
    before = _asked(service, "GET", f"/days/{day}/plan").content
    service.kill()
    service.start()
    waits.sort()
    counts = follower.ids
    return {
        "orders": len(world.orders), "events": world.told, "plans": state["plan_number"],
        "served": len(world.done), "windows kept": world.kept,
        "seconds to a plan": {name: round(waits[min(len(waits) - 1, int(share * len(waits)))], 2)
                              for name, share in (("median", .5), ("p90", .9), ("p99", .99))}
        if waits else None, "mean": round(statistics.fmean(waits), 2) if waits else None,
        "lost": world.told - len(accepted), "twice": len(counts) - len(set(counts)),
        "failure": state["failure"],
        "plan stays": _asked(service, "GET", f"/days/{day}/plan").content == before}


def main() -> None:
    """Live a day and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--orders", type=int, default=200)
    parser.add_argument("--vans", type=int, default=0, help="0: one for forty orders")
    parser.add_argument("--speed", type=float, default=100.0)
    parser.add_argument("--kills", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    options.vans = options.vans or max(2, options.orders // 25)
    with tempfile.TemporaryDirectory() as folder:
        service = Service(Path(folder), None)
        service.start()
        try:
            outcome = lived(service, options)
        finally:
            service.close()
    print(json.dumps(outcome, indent=1))
    if outcome["lost"] or outcome["twice"] or outcome["failure"] or not outcome["plan stays"]:
        sys.exit(1)


if __name__ == "__main__":
    main()
