"""What it is worth to plan a day anew as it is disturbed.

    python -m benchmarks.days.disturbed --seeds 20 --picture docs/develop/disturbed.svg

Days of a city are drawn: half of the orders come in on the way, ways and services last longer or
shorter than planned, some orders are cancelled, and on half of the days a van breaks down. Each is
lived several times with the same draws: planned anew at each event, the same with a price of
changes, or new orders only behind the others, by the hour, or never: then what comes in isn't
served. Hindsight plans once, of all that comes and of how long it truly lasts. Told are what was
driven, promises kept (orders served in their windows, of those not cancelled), and by how many
plans a driver saw another order of stops ahead.
"""

import argparse
import random
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import hypot
from pathlib import Path
from typing import Any

from pydantic_core import from_json, to_json

from app.database.durable import connect
from app.database.migrations.running import upgrade
from app.maps.roads.roads import NO_ROADS
from app.plans.quoted_plans import quoted_plans
from app.plans.quoting import answer_quote
from app.plans.service import PlanService
from app.records.days.runner import DayRunner
from app.records.days.service import DayService
from app.records.days.store import DayStore
from app.records.dispatches.store import DispatchStore
from app.requests.bounds import Bounds
from app.serving.load.received import ReceivedBody
from app.serving.settings import Settings
from benchmarks.days.disturbed_report import draw, table
from model.planner import load_planner

Data = dict[str, Any]

HOUR = 3600.0
BEGIN, END, LAST_ORDER = 8 * HOUR, 18 * HOUR, 15 * HOUR
SIDE, SPEED = 20_000.0, 10.0
"""Metres of the city, and metres a second."""

HUB = [SIDE / 2, SIDE / 2]
WINDOW, NOTICE, SERVICE = 2 * HOUR, HOUR, 240.0
FIXED, PER_KM, PER_HOUR = 40.0, 0.3, 18.0
TRAVEL_SPREAD, SERVICE_SPREAD = 0.25, 0.4
"""Standard deviations of the logarithms of how long ways and services last, by what is planned."""

CANCELLED, BROKEN = 0.05, 0.5
"""Share of orders that are cancelled, and of days on which a van breaks down."""

STEP = 300.0
"""Seconds of a day between two looks at what has happened."""

TURNS, WITHIN = 600, 60.0
"""Turns that are searched for a plan, and seconds that no plan takes: what else a machine does
counts for nothing."""

FEW_CHANGES: Data = {"change_costs": {"vehicle": 4, "position": 1, "promise_per_minute": 0.02}}
BEHIND: Data = {"change_limits": {"new_orders": "behind"}}

WAYS: dict[str, tuple[Data, float]] = {
    "at each event": ({}, 0.0), "at each event, changes priced": (FEW_CHANGES, 0.0),
    "at each event, new ones behind": (BEHIND, 0.0), "by the hour": ({}, HOUR),
    "never": ({}, float("inf"))}
"""How days are lived: with which options, and how long is waited until it is planned anew."""


NO_SLOTS = b'{"slots": [{"feasible": false}, {"feasible": false}]}'
"""What is answered to who asks for remedies."""


@dataclass(frozen=True)
class Drawn:
    """A day as it comes."""

    seed: int
    orders: tuple[Data, ...]
    placed: dict[str, float]
    cancelled: dict[str, float]
    broken: tuple[str, float] | None
    vans: int
    is_calm: bool = False  # all lasts as long as planned

    def lasts(self, kind: str, one: str, other: str = "") -> float:
        """Return how long a way or service lasts, by what is planned."""
        if self.is_calm:
            return 1.0
        spread = TRAVEL_SPREAD if kind == "way" else SERVICE_SPREAD
        drawn = random.Random(f"{self.seed} {kind} {one} {other}").gauss(0.0, spread)
        return float(2.718281828459045 ** (drawn - spread**2 / 2))

    def problem(self, orders: list[Data], **more: Any) -> Data:
        """Return the problem of some orders."""
        return {"depots": [{"id": "hub", "location": HUB}], "customers": orders,
                "fleet": [{"id": "van", "count": self.vans, "capacity": [30],
                           "speed_kmh": SPEED * 3.6, "max_trips": 4,
                           "costs": {"fixed": FIXED, "per_km": PER_KM, "per_hour": PER_HOUR},
                           "shift": {"earliest": BEGIN, "latest": END}}], **more}


def drawn(seed: int, orders: int, vans: int) -> Drawn:
    """Return a day."""
    rng = random.Random(seed)
    listed, placed, cancelled = [], {}, {}
    for number in range(orders):
        name = f"o{number}"
        placed[name] = 0.0 if number < orders // 2 else rng.uniform(BEGIN, LAST_ORDER)
        first = max(BEGIN, placed[name] + NOTICE)
        earliest = round(rng.uniform(first, END - WINDOW - HOUR / 2) if first < END - WINDOW
                         - HOUR / 2 else first)
        listed.append({"id": name, "demand": [1], "service_duration": SERVICE,
                       "location": [round(rng.uniform(0, SIDE)), round(rng.uniform(0, SIDE))],
                       "time_window": {"earliest": earliest, "latest": earliest + WINDOW}})
        if rng.random() < CANCELLED:
            cancelled[name] = rng.uniform(max(BEGIN, placed[name]), earliest)
    broken = (f"van-{rng.randint(1, vans)}", rng.uniform(10 * HOUR, 14 * HOUR))
    return Drawn(seed, tuple(listed), placed, cancelled,
                 broken if rng.random() < BROKEN else None, vans)


@dataclass
class Van:
    """Where a van is, and what it has done."""

    name: str
    place: list[float] = field(default_factory=lambda: HUB)
    at: str = "hub"
    trip: int = 0
    bound: Data | None = None  # the stop that it drives to
    ready: float = BEGIN  # when it is there and done, or free
    since: float | None = None
    until: float = 0.0
    metres: float = 0.0
    is_broken: bool = False

    @property
    def cost(self) -> float:
        """What it has cost."""
        if self.since is None:
            return 0.0
        hours = (self.until - self.since) / HOUR
        return FIXED + PER_KM * self.metres / 1000 + PER_HOUR * hours


@dataclass
class World:
    """What truly happens on a day, by the plans that drivers get."""

    day: Drawn
    vans: dict[str, Van]
    served: dict[str, float] = field(default_factory=dict)
    told: int = 0
    orders: dict[str, Data] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.orders |= {each["id"]: each for each in self.day.orders}

    def drive(self, plan: Data, now: float) -> Iterator[Data]:
        """Yield what vans have done by now. In place."""
        routes = {route["vehicle"]: route["trips"] for route in plan["routes"]}
        for van in self.vans.values():
            broken = self.day.broken
            if broken is not None and broken[0] == van.name and broken[1] <= now:
                if not van.is_broken:
                    van.is_broken, van.until = True, min(van.ready, broken[1])
                    if van.bound is not None and van.ready > broken[1]:
                        self.served.pop(van.bound["id"], None)
                    yield self.event("vehicle.broken", broken[1], vehicle=van.name)
                continue
            while (found := self._next(van, routes.get(van.name, []), now)) is not None:
                yield found

    def _next(self, van: Van, trips: list[Data], now: float) -> Data | None:
        """Return the next that a van has done by now. In place."""
        if van.bound is None:
            if van.trip >= len(trips):
                return None
            first = trips[van.trip]["stops"][0]
            leaves = max(first["departure"], van.ready)
            if leaves > now:
                return None
            van.since = leaves if van.since is None else van.since
            self._bind(van, trips, leaves)
            return self.event("vehicle.departed", leaves, vehicle=van.name)
        if van.ready > now:
            return None
        stop, at, van.until = van.bound, van.ready, van.ready
        if stop["kind"] == "customer":
            self._bind(van, trips, at)
            return self.event("vehicle.served", at, vehicle=van.name, order=stop["id"])
        van.bound, van.trip = None, van.trip + 1
        return self.event("vehicle.arrived", at, vehicle=van.name)

    def _bind(self, van: Van, trips: list[Data], leaves: float) -> None:
        """Have a van drive on to the next stop of its trip. In place."""
        stops = trips[van.trip]["stops"] if van.trip < len(trips) else []
        left = [stop for stop in stops[1:] if stop["kind"] != "customer"
                or stop["id"] not in self.served]
        van.bound = left[0] if left else {"kind": "depot", "id": "hub"}
        order = self.orders.get(van.bound["id"])
        place = HUB if order is None else order["location"]
        far = hypot(place[0] - van.place[0], place[1] - van.place[1])
        arrival = leaves + far / SPEED * self.day.lasts("way", van.at, van.bound["id"])
        van.metres, van.place, van.at, van.ready = (
            van.metres + far, place, van.bound["id"], arrival)
        if order is not None:
            start = max(arrival, order["time_window"]["earliest"])
            self.served[order["id"]] = start
            van.ready = start + SERVICE * self.day.lasts("service", order["id"])

    def event(self, kind: str, at: float, **about: Any) -> Data:
        """Return an event by a name of its own. In place."""
        self.told += 1
        return {"event_id": f"e{self.told}", "kind": kind, "at": round(at, 3), **about}

    def outcome(self, changes: int) -> Data:
        """Return what came of the day."""
        wanted = [each for each in self.day.orders if each["id"] not in self.day.cancelled]
        kept = sum(each["id"] in self.served and self.served[each["id"]]
                   <= each["time_window"]["latest"] for each in wanted)
        served = sum(each["id"] in self.served for each in wanted)
        used = sum(van.since is not None for van in self.vans.values())
        return {"cost": sum(van.cost for van in self.vans.values()), "served": served,
                "kept": kept, "wanted": len(wanted), "changes": changes / max(1, used)}


class Dispatcher:
    """Plans days in this process, as the service does."""

    def __init__(self, folder: Path) -> None:
        settings = Settings(data_dir=folder)
        engine = connect(settings.database)
        upgrade(engine)
        bounds = self._bounds = Bounds.of_plans(settings)
        self._plans = PlanService(load_planner(settings.weights_dir, settings.policies,
                                               lambda: None), bounds=bounds)
        self._quoted = quoted_plans()
        self._store = DayStore(engine)
        self._runner = DayRunner(engine, lambda body, stop: self.plan(body), settings, NO_ROADS,
                                 lambda: True, lambda body: NO_SLOTS, lambda *_: None)
        self._days = DayService(self._store, DispatchStore(engine), settings, bounds,
                                settings.policies, self._runner.memory)
        self._runner.start()

    def plan(self, body: bytes) -> bytes:
        """Answer `POST /plan`."""
        return bytes(self._plans.plan(ReceivedBody(body, time.perf_counter())))

    def begin(self, problem: Data, now: float) -> str:
        """Begin a day."""
        row = self._days.begin(to_json({"problem": problem, "clock": now, "plan_within": WITHIN}),
                               "", "study")
        return row.id

    def tell(self, day: str, events: list[Data]) -> None:
        """Tell what has happened. In place."""
        self._days.tell(day, "", to_json(events))
        self._runner.hurry()

    def planned(self, day: str) -> Data:
        """Return a day's plan once it counts with all that was told."""
        while (row := self._store.find("", day)) is None or row.planned < row.asked:
            time.sleep(0.005)
        if row.failure is not None:
            raise RuntimeError(row.failure)
        return dict(from_json(self._store.plan(day) or b""))

    def quote(self, day: str, order: Data, slots: list[Data]) -> Data:
        """Price slots for an order."""
        asked = to_json({"order": order, "slots": slots})
        now = self._days.asked_of(day, "", asked)
        reply = answer_quote(ReceivedBody(now.body, time.perf_counter()), self._bounds,
                             plans=self._quoted, first=now.waiting)
        return self._days.quoted(day, "", asked, reply)

    def accept(self, day: str, token: str, slot: int) -> None:
        """Have an order count in a slot. In place."""
        self._days.accept(day, "", token, to_json({"slot": slot}),
                          self._days.find(day, "").revision)
        self._runner.hurry()

    def close(self) -> None:
        """End. In place."""
        self._runner.stop()


def lived(dispatcher: Dispatcher, day: Drawn, options: Data, every: float) -> Data:
    """Live a day on which it is planned anew so often, and return what came of it."""
    known = [each for each in day.orders if day.placed[each["id"]] == 0.0]
    problem = day.problem(known, options={**options, "search_iterations": TURNS},
                          unassigned_cost=1000.0)
    name = dispatcher.begin(problem, BEGIN - 60)
    plan = dispatcher.planned(name)
    world = World(day, {f"van-{number}": Van(f"van-{number}")
                        for number in range(1, day.vans + 1)})
    coming = sorted([(at, "order.placed", order) for order, at in day.placed.items() if at]
                    + [(at, "order.cancelled", order) for order, at in day.cancelled.items()])
    waiting, changes, now, planned_at = list[Data](), 0, BEGIN, BEGIN
    while now < END + HOUR:
        now += STEP
        waiting += world.drive(plan, now)
        while coming and coming[0][0] <= now:
            at, kind, order = coming.pop(0)
            waiting.append(world.event(kind, at, **(
                {"customer": world.orders[order]} if kind == "order.placed" else {"order": order})))
        if waiting and now - planned_at >= every:
            waiting.append(world.event("clock", now))
            dispatcher.tell(name, sorted(waiting, key=lambda each: each["at"]))
            waiting, planned_at, before, plan = [], now, plan, dispatcher.planned(name)
            changes += _changed(before, plan, world)
    return world.outcome(changes)


def _changed(before: Data, plan: Data, world: World) -> int:
    """Return how many drivers see another order of stops ahead than that before."""
    was, now = _ahead(before, world), _ahead(plan, world)
    return sum(was.get(name, []) != now.get(name, []) for name in {*was, *now})


def _ahead(plan: Data, world: World) -> dict[str, list[str]]:
    return {route["vehicle"]: [stop["id"] for trip in route["trips"] for stop in trip["stops"]
                               if stop["kind"] == "customer" and stop["id"] not in world.served]
            for route in plan["routes"] if not world.vans[route["vehicle"]].is_broken}


def hindsight(dispatcher: Dispatcher, day: Drawn, turns: int) -> Data:
    """Return what comes of a day whose plan knows all that comes, and how long it lasts."""
    wanted = [each for each in day.orders if each["id"] not in day.cancelled]
    places = [("hub", HUB), *((each["id"], each["location"]) for each in wanted)]
    far = [[hypot(a[0] - b[0], a[1] - b[1]) for _, b in places] for _, a in places]
    lasting = [[metres / SPEED * (1.0 if one == other else day.lasts("way", one, other))
                for (other, _), metres in zip(places, row, strict=True)]
               for (one, _), row in zip(places, far, strict=True)]
    customers = [{**each, "location_index": index, "release_time": day.placed[each["id"]],
                  "service_duration": SERVICE * day.lasts("service", each["id"])}
                 for index, each in enumerate(wanted, 1)]
    problem = day.problem(customers, matrices={"truck": {"durations": lasting, "distances": far}},
                          unassigned_cost=1000.0, options={
                              "time_limit": WITHIN, "search_iterations": turns})
    problem["depots"][0]["location_index"] = 0
    if day.broken is not None:
        kind = problem["fleet"][0]
        problem["fleet"] = [{**kind, "count": day.vans - 1}, {
            **kind, "id": "broken", "count": 1, "shift": {"earliest": BEGIN,
                                                          "latest": day.broken[1]}}]
    reply = from_json(dispatcher.plan(to_json(problem)))
    served = reply["summary"]["served"]
    return {"cost": reply["cost"]["total"] - 1000.0 * len(reply["unassigned"]), "served": served,
            "kept": served, "wanted": len(wanted), "changes": 0.0}


def main() -> None:
    """Live days, print a table, and draw it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--orders", type=int, default=40)
    parser.add_argument("--vans", type=int, default=5)
    parser.add_argument("--hindsight", type=int, default=20_000, help="turns of its search")
    parser.add_argument("--picture", type=Path, help="file for an SVG of all days")
    options = parser.parse_args()
    found: dict[str, list[Data]] = {}
    with tempfile.TemporaryDirectory() as folder:
        dispatcher = Dispatcher(Path(folder))
        for seed in range(options.first, options.first + options.seeds):
            day = drawn(seed, options.orders, options.vans)
            for name, (stated, every) in WAYS.items():
                found.setdefault(name, []).append(lived(dispatcher, day, stated, every))
            found.setdefault("hindsight", []).append(hindsight(dispatcher, day, options.hindsight))
            print(seed, {name: (round(each[-1]["cost"], 1), each[-1]["kept"], each[-1]["wanted"],
                                round(each[-1]["changes"], 1)) for name, each in found.items()},
                  flush=True)
            if options.picture is not None:
                draw(found, options.picture)
        dispatcher.close()
    print(table(found))


if __name__ == "__main__":
    main()
