"""How long quotes take, how many two cores give, and how near they come to a search.

    python -m benchmarks.days.slots --quotes 400 --searched 20

A plan of 200 orders is asked for 20 slots of an order more, again and again. Told are milliseconds,
by the clock and of the processor, quotes a second by processes beside each other, and by how much a
search of 2 s from the same plan undercuts the cost quoted, slot by slot, in % of the plan's.
"""

import argparse
import json
import random
import statistics
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import Any

from pydantic_core import from_json, to_json

from app.plans.quoting import answer_quote
from app.plans.quoted_plans import quoted_plans
from app.plans.service import PlanService
from app.requests.bounds import Bounds
from app.serving.load.received import ReceivedBody
from app.serving.settings import Settings
from model.planner import load_planner

Data = dict[str, Any]

SIDE, HOUR, SLOTS, SEARCH = 20_000, 3600, 20, 2.0


def order(rng: random.Random, name: str) -> Data:
    """Return an order somewhere in a square."""
    earliest = round(rng.uniform(8 * HOUR, 15 * HOUR))
    return {"id": name, "demand": [1], "service_duration": 120,
            "location": [rng.randrange(SIDE), rng.randrange(SIDE)],
            "time_window": {"earliest": earliest, "latest": earliest + 2 * HOUR}}


def problem(rng: random.Random, orders: int) -> Data:
    """Return a day's problem."""
    return {"depots": [{"id": "hub", "location": [SIDE / 2, SIDE / 2]}],
            "customers": [order(rng, f"o{number}") for number in range(orders)],
            "fleet": [{"id": "van", "count": max(2, orders // 14), "capacity": [30],
                       "speed_kmh": 36, "max_trips": 3,
                       "costs": {"fixed": 40, "per_km": 0.3, "per_hour": 18},
                       "shift": {"earliest": 8 * HOUR, "latest": 18 * HOUR}}],
            "options": {"times": "seconds"}}


def planned(stated: Data, seconds: float) -> Data:
    """Return a plan."""
    settings = Settings()
    service = PlanService(load_planner(settings.weights_dir, settings.policies), 1,
                          bounds=Bounds.of_plans(settings))
    asked = {**stated, "options": {**stated["options"], "time_limit": seconds}}
    return dict(from_json(service.plan(ReceivedBody(to_json(asked), time.perf_counter()))))


def asked_for(stated: Data, plan: Data, seed: int, search: bool = True) -> Data:
    """Return a request of a quote for an order by chance."""
    rng = random.Random(f"slots {seed}")
    more = {key: value for key, value in order(rng, "more").items() if key != "time_window"}
    starts = [round(rng.uniform(8 * HOUR, 16 * HOUR)) for _ in range(SLOTS)]
    slots = [{"earliest": start, "latest": start + rng.choice([HOUR // 2, HOUR, 2 * HOUR])}
             for start in starts]
    given = {"routes": plan["routes"], "unassigned": plan["unassigned"]}
    return {"problem": {**stated, "replan": {"plan": given, "freeze_before": 0}}, "plan": given,
            "order": more, "slots": slots, "search": search}


def quoted(bodies: Sequence[bytes]) -> list[tuple[float, float, bytes]]:
    """Return seconds by the clock and of the processor, and the reply, of each request."""
    bounds, plans, found = Bounds.of_plans(Settings()), quoted_plans(), []
    for body in bodies:
        began, cpu = time.perf_counter(), time.process_time()
        reply = answer_quote(ReceivedBody(body, began), bounds, plans=plans)
        found.append((time.perf_counter() - began, time.process_time() - cpu, reply))
    return found


def undercut(request: Data, reply: Data, without: float, at: int) -> float:
    """Return by how much a search undercuts a slot's quote, in % of the plan's cost.

    The same search finds a plan `without` the order at that cost.
    """
    stated = request["problem"]
    slot = {name: request["slots"][at][name] for name in ("earliest", "latest")}
    more = {**request["order"], "time_window": slot}
    found = planned({**stated, "customers": [*stated["customers"], more]}, SEARCH)
    more_dear = found["cost"]["total"] - without
    return float(100 * (reply["slots"][at]["cost"] - more_dear) / without)


def main() -> None:
    """Ask for quotes and print what came of them."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--orders", type=int, default=200)
    parser.add_argument("--quotes", type=int, default=400)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--searched", type=int, default=0, help="slots that are searched, too")
    parser.add_argument("--seconds", type=float, default=30.0, help="of search for the plan")
    parser.add_argument("--unsearched", action="store_true", help="others don't make room")
    options = parser.parse_args()
    stated = problem(random.Random(0), options.orders)
    plan = planned(stated, options.seconds)
    requests = [asked_for(stated, plan, seed, not options.unsearched)
                for seed in range(options.quotes)]
    bodies = [to_json(each) for each in requests]
    alone = quoted(bodies[:max(20, options.quotes // 10)])
    with ProcessPoolExecutor(options.processes) as pool:
        list(pool.map(quoted, [bodies[:2]] * options.processes))
        began = time.perf_counter()
        list(pool.map(quoted, [bodies[at::options.processes]
                               for at in range(options.processes)]))
        took = time.perf_counter() - began
    gaps = []
    without = planned(requests[0]["problem"], SEARCH)["cost"]["total"]
    for request, (_, _, content) in list(zip(requests, alone, strict=False))[:options.searched]:
        reply = json.loads(content)
        kept = [at for at, slot in enumerate(reply["slots"]) if slot["feasible"]]
        gaps += [undercut(request, reply, without, at) for at in kept[:1]]
    print(json.dumps({
        "ms, median": round(1000 * statistics.median(each[0] for each in alone), 1),
        "of the processor": round(1000 * statistics.median(each[1] for each in alone), 1),
        "quotes a second": round(options.quotes / took, 1), "processes": options.processes,
        **({"a search undercuts by, %": [round(each, 2) for each in sorted(gaps)]}
           if gaps else {})}, indent=1))


if __name__ == "__main__":
    main()
