"""Lives a day against the service: orders come in, vans tell what they do, the service is killed.

    python -m benchmarks.days.lived --orders 1000 --positions 400 --kills 50 --away 2

Orders are drawn in a square, half of them before the day begins, with windows of two hours. Vans do
what the plan says, later or sooner by chance, and tell it, and now and then where they are. The
service is killed (`kill -9`) and its database goes away at random moments. Told are: how long plans
took from events, of all and of those between which nothing was away, how many windows were kept,
and whether any event was lost, counted twice, any plan broke a rule, or the day rebuilt by another
process is another. Exits with 1 if one was.
"""

import argparse
import json
import random
import sys
import tempfile
import threading
import time
import zlib
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import httpx

from app.plans.checking import answer_check
from app.records.days.runner import LEASE
from app.requests.bounds import UNBOUNDED
from benchmarks.load.crashes import Service
from benchmarks.postgres import Server, postgres_server

Data = dict[str, Any]

BEGIN, END, LAST_ORDER = 8 * 3600.0, 18 * 3600.0, 15 * 3600.0
SIDE = 20_000.0
"""Metres of the square."""

HUB = [SIDE / 2, SIDE / 2]

WINDOW = 7200.0
STOP = 120.0
"""Seconds of service."""

STEP = 0.1
"""Seconds between two looks at the world."""

JUDGES = 2
"""Processes that judge plans at the end."""

AWAY = 3.0
"""Seconds for which the database is away."""

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
    every: float = 0.0  # seconds between two positions of a van; 0: none are told
    sighted: dict[str, float] = field(default_factory=dict)

    def events(self, now: float, plan: Data | None) -> Iterator[Data]:
        """Yield what has happened by now and wasn't told yet. In place."""
        while self.coming and self.coming[0][0] <= now:
            at, order = self.coming.pop(0)
            self.orders[order["id"]] = order
            yield self._event("order.placed", at, customer=order)
        for route in [] if plan is None else plan["routes"]:
            yield from self._driven(route, now)
            yield from self._seen(route, now)

    def _seen(self, route: Data, now: float) -> Iterator[Data]:
        """Yield where a van is, between the stops that lie before and behind."""
        vehicle = route["vehicle"]
        if not self.every or now - self.sighted.setdefault(vehicle, now) < self.every:
            return
        stops = [stop for trip in route["trips"] for stop in trip["stops"]]
        for first, second in pairwise(stops):
            if first["departure"] <= now < second["arrival"]:
                self.sighted[vehicle] = now
                share = (now - first["departure"]) / (second["arrival"] - first["departure"])
                yield self._event("vehicle.position", now, vehicle=vehicle, location=[
                    round(one + share * (other - one), 1) for one, other in zip(
                        self._place(first), self._place(second), strict=True)])

    def _place(self, stop: Data) -> list[float]:
        return self.orders[stop["id"]]["location"] if stop["kind"] == "customer" else HUB

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
        self.times: dict[int, float] = {}  # of the day, by number of a plan
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
            self.times[event["about"]["plan_number"]] = event["at"]


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
        "depots": [{"id": "hub", "location": HUB}], "customers": known,
        "fleet": [{"id": "van", "count": vans, "capacity": [200], "speed_kmh": 40, "max_trips": 4,
                   "costs": {"fixed": 50, "per_hour": 20},
                   "shift": {"earliest": BEGIN, "latest": END}}]}
    return problem, World(rng, {each["id"]: each for each in known}, coming)


@dataclass
class Seen:
    """What was seen of a day from outside."""

    sent: list[tuple[float, int]] = field(default_factory=list)  # when, and the last's number
    accepted: dict[str, int] = field(default_factory=dict)
    plans: list[bytes] = field(default_factory=list)  # compressed: there are hundreds
    away: list[tuple[float, float]] = field(default_factory=list)  # from when to when


def lived(service: Service, server: Server | None, options: argparse.Namespace) -> Data:
    """Live a day and return what came of it."""
    rng = random.Random(options.seed)
    problem, world = drawn(rng, options.orders, options.vans)
    world.every = options.positions
    day = service.client.post("/days", json={"problem": problem, "clock": BEGIN - 60}).json()["id"]
    follower = Follower(service, day)
    follower.start()
    seen = Seen()
    troubles = sorted((rng.uniform(0.02, 0.98), kind) for kind, count in (
        ("kill", options.kills), ("away", options.away)) for _ in range(count))
    now, began = BEGIN - 60, time.monotonic()
    plans, plan = 0, None
    while now < END + 1800:
        now = BEGIN - 60 + (time.monotonic() - began) * options.speed
        if troubles and now > BEGIN + troubles[0][0] * (END - BEGIN):
            # The world stands still meanwhile: else a start would take minutes of it.
            began += _trouble(troubles.pop(0)[1], service, server, seen)
        if len(follower.planned) > plans:
            plans = len(follower.planned)
            content = _asked(service, "GET", f"/days/{day}/plan").content
            seen.plans.append(zlib.compress(content, 1))
            plan = json.loads(content)["plan"]
        events = list(world.events(now, plan))
        if events:
            reply = _asked(service, "POST", f"/days/{day}/events", json=events)
            reply.raise_for_status()
            seen.sent.append((time.monotonic(), reply.json()["revision"]))
            seen.accepted |= {each["event_id"]: each["number"]
                              for each in reply.json()["accepted"]}
        time.sleep(STEP)
    return _outcome(service, day, problem, world, follower, seen)


def _trouble(kind: str, service: Service, server: Server | None, seen: Seen) -> float:
    """Kill the service, or have its database be away, and return for how long. In place."""
    since = time.monotonic()
    if kind == "kill":
        service.kill()
        service.start()
    elif server is not None:
        server.stop()
        time.sleep(AWAY)
        server.start()
    seen.away.append((since, time.monotonic()))
    return time.monotonic() - since


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


def _outcome(service: Service, day: str, problem: Data, world: World, follower: Follower,
             seen: Seen) -> Data:
    deadline = time.monotonic() + 60
    while not (state := _asked(service, "GET", f"/days/{day}").json())["is_planned"]:
        if time.monotonic() > deadline:
            break
        time.sleep(STEP)
    time.sleep(1)
    follower.is_over.set()
    waits, calm = _waits(follower, seen)
    before = _as_it_stands(service, day)
    service.kill()
    service.start()
    counts = follower.ids
    rules = partial(_broken, problem, world.orders, follower.times)
    with ProcessPoolExecutor(JUDGES) as judges:
        broken = [each for each in judges.map(rules, seen.plans) if each is not None]
    return {
        "orders": len(world.orders), "events": world.told, "plans": state["plan_number"],
        "served": len(world.done), "windows kept": world.kept,
        "left out": len([each for each in state["orders"] if each["state"] == "left_out"]),
        "seconds to a plan": _spread(waits), "of these with nothing away": _spread(calm),
        "seconds away": round(sum(until - since for since, until in seen.away), 1),
        "lost": world.told - len(seen.accepted), "twice": len(counts) - len(set(counts)),
        "failure": state["failure"],
        "plans judged": len(broken),
        "of these bad": len([each for each in broken if each]),
        "by": sorted({code for each in broken for code in each}),
        "rebuilt the same": _as_it_stands(service, day) == before}


def _waits(follower: Follower, seen: Seen) -> tuple[list[float], list[float]]:
    """Return seconds from events to their plans, of all and of those whose service was there."""
    waits, calm = [], []
    for told_at, number in seen.sent:
        then = next((at for at, counts in follower.planned if counts >= number), None)
        waits.append(float("inf") if then is None else max(0.0, then - told_at))
        # A day stays its process's for some seconds after that died.
        if then is not None and not any(since < then and told_at < until + LEASE
                                        for since, until in seen.away):
            calm.append(waits[-1])
    return waits, calm


def _spread(waits: list[float]) -> Data:
    ranked = sorted(waits) or [0.0]
    return {"events at once": len(waits), **{
        name: round(ranked[min(len(ranked) - 1, int(share * len(ranked)))], 2)
        for name, share in (("median", .5), ("p90", .9), ("p99", .99), ("most", 1.0))}}


def _as_it_stands(service: Service, day: str) -> list[bytes]:
    """Return all that the service tells of a day whose clock stands still."""
    return [_asked(service, "GET", f"/days/{day}{path}").content
            for path in ("", "/plan", "/problem")]


def _broken(problem: Data, known: Data, times: dict[int, float],
            packed: bytes) -> list[str] | None:
    """Return the rules that a plan breaks by what is yet to come, what has happened being given.

    None: nobody told when it was made.
    """
    made = json.loads(zlib.decompress(packed))
    plan, now = made["plan"], times.get(made["number"])
    if now is None:
        return None
    names = [stop["id"] for route in plan["routes"] for trip in route["trips"]
             for stop in trip["stops"] if stop["kind"] == "customer"]
    orders = [known[name] for name in (*names, *(
        each["id"] for each in plan["unassigned"]))]
    given = {"routes": plan["routes"], "unassigned": plan["unassigned"]}
    verdict = json.loads(answer_check(json.dumps({
        "problem": {**problem, "customers": orders,
                    "replan": {"plan": given, "freeze_before": max(0.0, now)}},
        "plan": plan}).encode(), UNBOUNDED))
    return [each["code"] for each in verdict["violations"]]


def main() -> None:
    """Live a day and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--orders", type=int, default=200)
    parser.add_argument("--vans", type=int, default=0, help="0: one for 25 orders")
    parser.add_argument("--speed", type=float, default=100.0)
    parser.add_argument("--positions", type=float, default=0.0,
                        help="seconds between two of a van; 0: none")
    parser.add_argument("--kills", type=int, default=0)
    parser.add_argument("--away", type=int, default=0,
                        help="how often the database is; not 0: it is PostgreSQL")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    options.vans = options.vans or max(2, options.orders // 25)
    with tempfile.TemporaryDirectory() as folder, ExitStack() as open_ones:
        server = open_ones.enter_context(postgres_server()) if options.away else None
        # Without workers for jobs it is back sooner.
        service = Service(Path(folder), None if server is None else server.url,
                          {"TANDEM_ROLE": "api"})
        service.start()
        try:
            outcome = lived(service, server, options)
        finally:
            service.close()
    print(json.dumps(outcome, indent=1))
    if (outcome["lost"] or outcome["twice"] or outcome["failure"] or outcome["of these bad"]
            or not outcome["rebuilt the same"]):
        sys.exit(1)


if __name__ == "__main__":
    main()
