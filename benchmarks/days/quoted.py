"""Whether slots that are quoted and accepted are kept.

    python -m benchmarks.days.quoted --days 270

On each day orders ask for slots as they come in, and each takes one of those that can be kept, by
chance. Vans then drive as planned, so that nothing but a plan could break a promise. Told are how
many slots were offered, taken and broken, with seconds for a quote. Exits with 1 if one was broken.
"""

import argparse
import random
import statistics
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from benchmarks.days.disturbed import (
    BEGIN, END, HOUR, STEP, TURNS, WINDOW, Data, Dispatcher, Van, World, drawn,
)

SLOTS = 8


def _slots(draw: random.Random, now: float) -> list[Data]:
    """Return windows that an order may ask for."""
    return [{"earliest": (begins := round(draw.uniform(now, END - WINDOW / 2))),
             "latest": begins + draw.choice([1800, 3600, WINDOW])} for _ in range(SLOTS)]


def lived(dispatcher: Dispatcher, seed: int, orders: int, vans: int) -> Data:
    """Live a day whose orders take slots, and return what came of them."""
    draw = random.Random(seed)
    day = replace(drawn(seed, orders, vans), cancelled={}, broken=None, is_calm=True)
    wanted = sorted(((at or BEGIN, name) for name, at in day.placed.items()))
    known = {each["id"]: each for each in day.orders}
    name = dispatcher.begin(day.problem([], options={"search_iterations": TURNS},
                                        unassigned_cost=1000.0), BEGIN - 60)
    plan = dispatcher.planned(name)
    world = World(day, {f"van-{number}": Van(f"van-{number}") for number in range(1, vans + 1)})
    promised: dict[str, Data] = {}
    seconds, processor, told = list[float](), list[float](), list[Data]()
    offered, now = 0, BEGIN
    while now < END + HOUR:
        now += STEP
        told += world.drive(plan, now)
        if wanted and wanted[0][0] <= now:
            # All goes as planned: nothing has to be told before somebody asks.
            dispatcher.tell(name, sorted([*told, world.event("clock", now)],
                                         key=lambda each: each["at"]))
            told, plan = [], dispatcher.planned(name)
        while wanted and wanted[0][0] <= now:
            order = known[wanted.pop(0)[1]]
            slots = _slots(draw, now)
            began, cpu = time.perf_counter(), time.thread_time()
            quote = dispatcher.quote(name, {key: each for key, each in order.items()
                                            if key != "time_window"}, slots)
            seconds.append(time.perf_counter() - began)
            processor.append(time.thread_time() - cpu)
            kept = [index for index, each in enumerate(quote["slots"]) if each["feasible"]]
            offered += len(kept)
            if kept:
                chosen = draw.choice(kept)
                dispatcher.accept(name, quote["token"], chosen)
                promised[order["id"]] = slots[chosen]
                world.orders[order["id"]] = {**order, "time_window": slots[chosen]}
                plan = dispatcher.planned(name)
    broken = [order for order, slot in promised.items() if not (
        slot["earliest"] <= world.served.get(order, -1.0) <= slot["latest"] + 1)]
    return {"asked": len(seconds), "slots": SLOTS * len(seconds), "offered": offered,
            "taken": len(promised), "broken": broken, "seconds": seconds,
            "processor": processor}


def main() -> None:
    """Live days and print what came of their quotes."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--days", type=int, default=10)
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--orders", type=int, default=40)
    parser.add_argument("--vans", type=int, default=3)
    options = parser.parse_args()
    found: list[Data] = []
    with tempfile.TemporaryDirectory() as folder:
        dispatcher = Dispatcher(Path(folder))
        for seed in range(options.first, options.first + options.days):
            found.append(lived(dispatcher, seed, options.orders, options.vans))
            print(seed, _told(found), flush=True)
        dispatcher.close()
    if any(each["broken"] for each in found):
        sys.exit(1)


def _told(days: list[Data]) -> dict[str, Any]:
    return {**{what: sum(each[what] for each in days)
               for what in ("asked", "slots", "offered", "taken")},
            "broken": sum(len(each["broken"]) for each in days),
            **{f"ms of a quote, {what}": round(1000 * statistics.median(
                each for day in days for each in day[name]))
               for what, name in (("median", "seconds"), ("of the processor", "processor"))}}


if __name__ == "__main__":
    main()
