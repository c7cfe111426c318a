"""Has wild problems planned and every plan checked: `python -m benchmarks.fuzz_problems`.

Each problem is sent to `POST /plan`. Whatever is planned goes to `POST /check`, which must find no
broken rule and the same cost. Then the day goes on: the plan, whole or damaged, is checked against
a changed request and planned on from; what had happened by then must stay. Fails if a reply is
anything but 200 or a documented 422.
"""

import copy
import json
import math
import random
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer

from benchmarks.fuzz_api import Target, service
from benchmarks.wild_problems import wild_request

Data = dict[str, Any]

ROUNDING = 1e-9
"""Share of a cost by which two sums of the same terms may differ."""

GOES_ON, DAMAGED = 0.5, 0.5
"""Shares of plans that are planned on from, and of these that are damaged before."""

PATIENCE = 120.0
"""Seconds in which any reply has to come; time limits are a tenth of a second at most."""


class Fault(Exception):
    """A reply that should not be."""


@dataclass
class Study:
    """What came of all requests."""

    client: httpx.Client
    statuses: Counter[str] = field(default_factory=Counter)
    checked: int = 0
    replanned: int = 0
    left_out: int = 0  # plans with customers left out
    longest: float = 0.0  # seconds

    def try_problem(self, seed: int) -> None:
        """Have one problem planned, checked and planned on. In place.

        Raises
        ------
        Fault
            If a reply should not be.
        """
        rng = random.Random(seed)
        request = wild_request(rng)
        plan = self.planned(request)
        if plan is None or rng.random() > GOES_ON:
            return
        later = changed(rng, request, plan)
        is_whole = rng.random() >= DAMAGED
        if not is_whole:
            plan = damaged(rng, plan)
            self.ask("/check", {"problem": later, "plan": plan})
        day = max((trip["stops"][-1]["departure"] for route in plan["routes"]
                   for trip in route["trips"] if trip["stops"]), default=3600)
        given = {"routes": plan["routes"], "unassigned": plan["unassigned"]}
        now = rng.choice((None, 0, min(1e9, rng.random() * day)))
        replanned = self.planned(later | {"replan": {
            "plan": given, "freeze_before": now, "pin_all": rng.random() < 0.2,
            "unavailable": [route["vehicle"] for route in plan["routes"] if rng.random() < 0.1],
            "parcels_back": rng.choice((None, None, 0, 5e8))}})
        self.replanned += replanned is not None
        if is_whole and replanned is not None and now is not None:
            moved = happened(plan, now) - happened(replanned, now)
            if moved:
                raise Fault(f"what had happened before {now} is another past: {sorted(moved)[:3]}")

    def planned(self, request: Data) -> Data | None:
        """Return the plan of a request, found sound; None if it is refused. In place."""
        plan = self.ask("/plan", request)
        if plan is None:
            return None
        verdict = self.ask("/check", {"problem": request, "plan": plan})
        if verdict is None or not verdict["feasible"]:
            raise Fault(f"the plan is refused by POST /check: {verdict}")
        for term, cost in plan["cost"].items():
            if not math.isclose(cost, verdict["cost"][term], rel_tol=ROUNDING, abs_tol=1e-6):
                raise Fault(f"cost by {term}: {cost}, by POST /check {verdict['cost'][term]}")
        served = plan["summary"]["served"]
        if served + len(plan["unassigned"]) != len(request["customers"]):
            raise Fault(f"{served} served and {len(plan['unassigned'])} left out")
        if not all(left["reasons"] for left in plan["unassigned"]):
            raise Fault("a customer is left out without a reason")
        self.checked += 1
        self.left_out += bool(plan["unassigned"])
        return plan

    def ask(self, path: str, body: Data) -> Data | None:
        """Return the reply to a request; None if it is refused as documented. In place."""
        began = time.perf_counter()
        reply = self.client.post(path, content=json.dumps(body),
                                 headers={"Content-Type": "application/json"})
        self.longest = max(self.longest, time.perf_counter() - began)
        self.statuses[f"{path} {reply.status_code}"] += 1
        if reply.status_code == 200:
            content: Data = reply.json()
            return content
        if reply.status_code != 422 or not reply.json()["errors"]:
            raise Fault(f"{path} is answered with {reply.status_code}: {reply.text[:500]}")
        return None


def client_of(target: Target) -> httpx.Client:
    """Return a client of a running service."""
    return httpx.Client(base_url=target.url, trust_env=False, timeout=PATIENCE,
                        headers={"Authorization": f"Bearer {target.key}"})


def changed(rng: random.Random, request: Data, plan: Data) -> Data:
    """Return a request as the day goes on: orders new, cancelled and changed, other wishes."""
    later = copy.deepcopy(request)
    customers = later["customers"]
    if rng.random() < 0.3 and not later.get("matrices"):
        new = copy.deepcopy(rng.choice(customers)) if customers else None
        if new is not None:
            customers.append(new | {"id": "nouveau été"})
    if rng.random() < 0.3 and customers and not later.get("matrices"):
        customers.pop(rng.randrange(len(customers)))
    if rng.random() < 0.3 and customers:
        rng.choice(customers)["time_window"] = {"earliest": 0, "latest": rng.choice((0, 60, 1e6))}
    if rng.random() < 0.1:
        rng.choice(later["fleet"])["count"] = 1
    return later


def happened(plan: Data, now: float) -> set[tuple[str, ...]]:
    """Return what a plan has done before an instant: stops left and flights begun, in words."""
    done: set[tuple[str, ...]] = set()
    for route in plan["routes"]:
        for trip in route["trips"]:
            if not trip["stops"] or trip["stops"][0]["departure"] >= now:
                continue
            done |= {(route["vehicle"], "stop", stop["id"], f"{stop['arrival']:.3f}",
                      f"{stop['departure']:.3f}")
                     for stop in trip["stops"] if stop["departure"] < now}
            done |= {(route["vehicle"], "flight", customer["id"], f"{sortie['launch_time']:.3f}",
                      f"{customer['arrival']:.3f}")
                     for sortie in trip["sorties"] for customer in sortie["customers"]
                     if sortie["launch_time"] < now}
    return done


def damaged(rng: random.Random, plan: Data) -> Data:
    """Return a plan with parts dropped, doubled, moved or mistimed."""
    plan = copy.deepcopy(plan)
    for _ in range(rng.randint(1, 3)):
        parts = list(_lists(plan["routes"]))
        if not parts:
            return plan
        part = rng.choice(parts)
        place = rng.randrange(len(part))
        action = rng.randrange(4)
        if action == 0:
            del part[place]
        elif action == 1:
            part.append(copy.deepcopy(part[place]))
        elif action == 2:
            rng.shuffle(part)
        elif isinstance(part[place], dict):
            _mistime(rng, part[place])
    return plan


def _lists(value: Any) -> Iterator[list[Any]]:
    """Yield all lists of objects in a value that aren't empty."""
    if isinstance(value, list):
        if value and isinstance(value[0], dict):
            yield value
        for item in value:
            yield from _lists(item)
    elif isinstance(value, dict):
        for item in value.values():
            yield from _lists(item)


def _mistime(rng: random.Random, part: Data) -> None:
    """Change a time or an index. In place."""
    names = [name for name, value in part.items()
             if isinstance(value, int | float) and not isinstance(value, bool)]
    if names:
        name = rng.choice(names)
        part[name] = (rng.choice((0, 1, 2, 5)) if name.endswith("_stop")
                      else max(0, part[name] + rng.choice((-3600, -1, 0.0005, 60, 1e8))))


def main(
    problems: Annotated[int, typer.Option(help="Problems to send.")] = 5000,
    seed: Annotated[int, typer.Option(help="Seed of the first; later ones count on.")] = 0,
    folder: Annotated[Path | None, typer.Option(help="Where to write problems that fail.")] = None,
) -> None:
    """Fuzz plans, checks and replans."""
    faults = 0
    with (tempfile.TemporaryDirectory() as name, service(Path(name)) as target,
          client_of(target) as client):
        study = Study(client)
        for number in range(seed, seed + problems):
            try:
                study.try_problem(number)
            except (Fault, httpx.TransportError) as fault:
                faults += 1
                typer.echo(f"seed {number}: {type(fault).__name__}: {fault}")
                if folder is not None:
                    (folder / f"{number}.json").write_text(json.dumps(
                        wild_request(random.Random(number)), indent=1))
        faults += target.process.poll() is not None
    typer.echo(f"{problems} problems, {faults} faults; {study.checked} plans checked, "
               f"{study.replanned} of them replanned, "
               f"{study.left_out} of them with customers left out; longest reply "
               f"{study.longest:.2f} s; {dict(sorted(study.statuses.items()))}")
    raise typer.Exit(1 if faults else 0)


if __name__ == "__main__":
    typer.run(main)
