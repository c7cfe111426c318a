"""Does what every remedy says, and plans again: `python -m benchmarks.fuzz.remedies`.

Wild problems and days with late windows for drones are planned. Each remedy of a customer left out
is applied to the request by its `changes`; where they are said to suffice, a plan of that customer
and that vehicle type alone must then serve the customer. Fails if one doesn't.
"""

import random
import re
import tempfile
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import httpx
import typer

from benchmarks.fuzz.api import service
from benchmarks.fuzz.problems import Fault, Study, client_of
from benchmarks.fuzz.wild_problems import wild_request
from examples.remedy import applied

Data = dict[str, Any]

MOST_OF_A_PLAN = 6
"""Remedies of one plan that are applied."""

SECONDS = 0.1
"""Time limit of plans that leave customers out."""

TURNS, PATIENCE = 100, 60.0
"""Turns of the plan that must serve one, and seconds that it may take at most."""


def late_drones(rng: random.Random) -> Data:
    """Return a day on which drones have to come late, and endurances are short."""
    def place() -> list[float]:
        return [rng.uniform(-4, 4), rng.uniform(-4, 4)]

    customers = []
    for number in range(rng.randint(1, 6)):
        earliest = rng.choice((0, 600, 7200, 20_000))
        width = rng.choice((60, 600, 3600))
        customers.append({
            "id": f"C{number}", "location": place(), "demand": [rng.randint(1, 6)],
            "served_by": rng.choice(("drone", "drone", "either")),
            "service_duration": rng.choice((0, 60, 600)),
            "time_window": {"earliest": earliest, "latest": earliest + width}})
    return {
        "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}], "customers": customers,
        "fleet": [{
            "id": "van", "count": rng.randint(1, 3), "capacity": [rng.choice((4, 20))],
            "speed_kmh": rng.choice((5, 40)), "max_trips": rng.choice((1, 3)),
            "shift": {"latest": rng.choice((None, 7200, 20_000))},
            "drones": {"count": rng.randint(1, 2), "capacity": [rng.randint(1, 5)],
                       "endurance": rng.choice((60, 300, 600, 1200)),
                       "endurance_includes_waiting": rng.random() < 0.7,
                       "launch_duration": rng.choice((0, 60)),
                       "recovery_duration": rng.choice((0, 60))}}],
        "options": {"time_limit": SECONDS, "policy": rng.choice(("attention", "pointer"))}}


def alone(request: Data, left_out: str, reason: Data, of: str = "customer") -> Data:
    """Return a problem of one customer, or shipment, and one vehicle type, left out at no price but
    a stated one.

    What the customer and the type say stays.
    """
    price = request.get("unassigned_cost") if reason["code"] == "COST" else None
    kind, = (kind for kind in request["fleet"] if kind["id"] == reason["vehicle_type"])
    return request | {
        **{f"{name}s": [_of_one_type(each, kind) for each in request.get(f"{name}s", ())
                        if name == of and each["id"] == left_out]
           for name in ("customer", "shipment")},
        "fleet": [kind],
        # Who is alone goes with nobody.
        "unassigned_cost": price, "replan": None, "relations": [],
        # Sites may name other types.
        "launch_sites": [{name: value for name, value in site.items() if name != "vehicles"}
                         for site in request.get("launch_sites", [])],
        # Turns, as a busy machine makes none in time; JavaScript holds no larger seeds exactly.
        "options": request.get("options", {}) | {
            "time_limit": PATIENCE, "search_iterations": TURNS, "seed": 0}}


def _of_one_type(customer: Data, kind: Data) -> Data:
    """Return a customer who names vehicles of one type alone; whoever may serve it still may."""
    durations = {name: duration
                 for name, duration in customer.get("service_duration_by_type", {}).items()
                 if name == kind["id"] or name.startswith(f"{kind['id']}/")}
    if "amount" in customer:
        customer = customer | {end: _of_one_type(customer[end], kind)
                               for end in ("pickup", "delivery")}
    costs = {name: cost for name, cost in customer.get("vehicle_costs", {}).items()
             if name == kind["id"] or name.startswith(f"{kind['id']}-")}
    stated = {"service_duration_by_type": durations, "vehicle_costs": costs}
    customer = customer | {name: value for name, value in stated.items() if name in customer}
    vehicles = customer.get("vehicles") or {}
    listed = [name for name in vehicles.values() if name is not None]
    if not listed:
        return customer
    own = [name for name in listed[0] if name == kind["id"]
           or re.fullmatch(re.escape(kind["id"]) + "-[1-9][0-9]*", name)]
    if own:
        return customer | {"vehicles": dict.fromkeys(vehicles, own)}
    if "allowed" in vehicles:
        return customer | {"vehicles": {"forbidden": [kind["id"]]}}
    return customer | {"vehicles": None}


@dataclass
class Remedies:
    """What came of all remedies."""

    study: Study
    applied: Counter[str] = field(default_factory=Counter)  # by code

    def try_plan(self, request: Data) -> list[str]:
        """Plan a problem and apply remedies; return those that don't hold, in words. In place."""
        plan = self.study.planned(request)
        false = []
        offered = [(left["id"], left.get("kind", "customer"), reason, remedy)
                   for left in (plan or {"unassigned": []})["unassigned"]
                   for reason in left["reasons"] for remedy in reason["remedies"]]
        for left_out, of, reason, remedy in offered[:MOST_OF_A_PLAN]:
            changed = alone(applied(request, remedy["changes"]), left_out, reason, of)
            # Who is alone has no relations; what isn't said to suffice has to be understood alone.
            fault = None if remedy["code"] == "RELATIONS" else self._fault(
                changed, remedy["suffices"])
            self.applied[reason["code"]] += 1
            if fault is not None:
                false.append(f"{of} {left_out}, {reason['vehicle_type']}, {remedy}: {fault}")
        return false

    def _fault(self, changed: Data, suffices: bool) -> str | None:
        """Return what is wrong with the request that a remedy makes. In place."""
        reply = self.study.ask("/plan", changed)
        if reply is None:
            return "the request that it makes is refused"
        reasons = [why for left in reply["unassigned"] for why in left["reasons"]]
        # Who fits at a price that nobody pays does fit.
        if suffices and any(why["code"] != "COST" for why in reasons):
            return f"still left out: {reasons}"
        return None


def main(
    remedies: Annotated[int, typer.Option(help="Remedies to apply, at least.")] = 1000,
    seed: Annotated[int, typer.Option(help="Seed of the first problem; later ones count on.")] = 0,
) -> None:
    """Apply remedies."""
    faults = 0
    with (tempfile.TemporaryDirectory() as name, service(Path(name)) as target,
          client_of(target) as client):
        found = Remedies(Study(client))
        number = seed
        while found.applied.total() < remedies:
            rng = random.Random(number)
            request = late_drones(rng) if number % 2 else wild_request(rng)
            try:
                false = found.try_plan(request)
            except (Fault, httpx.TransportError) as fault:
                false = [f"{type(fault).__name__}: {fault}"]
            for words in false:
                typer.echo(f"seed {number}: {words}")
            faults += len(false)
            number += 1
    typer.echo(f"{number - seed} problems, {found.applied.total()} remedies applied, {faults} "
               f"faults; {dict(sorted(found.applied.items()))}")
    raise typer.Exit(1 if faults else 0)


if __name__ == "__main__":
    typer.run(main)
