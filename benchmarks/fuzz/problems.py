"""Has wild problems planned and every plan checked: `python -m benchmarks.fuzz.problems`.

Each problem is sent to `POST /plan`. Whatever is planned goes to `POST /check`, which must find no
broken rule and the same cost. A shipment is asked for as a whole, and put where it fits. Then the
day goes on: the plan, whole or damaged, is checked against a changed request and planned on from;
what had happened by then must stay. Fails if a reply is anything but 200 or a documented 422.
"""

import copy
import json
import math
import random
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, TypeVar

import httpx
import typer

from benchmarks.fuzz.api import Target, service
from benchmarks.fuzz.wild_problems import wild_request
from benchmarks.fuzz.wild_shipments import ends_of

Data = dict[str, Any]

ROUNDING, CANCELLING = 1e-9, 1e-13
"""Shares of a cost by which sums of the same terms may differ, and differences of two plans."""

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
    moved: int = 0  # plans whose shipment has places
    longest: float = 0.0  # seconds

    def try_problem(self, seed: int) -> None:
        """Have one problem planned, checked and planned on. In place.

        Raises
        ------
        Fault
            If a reply should not be.
        """
        rng = random.Random(seed)
        self.go_on(rng, wild_request(rng))

    def go_on(self, rng: random.Random, request: Data) -> None:
        """Have a request planned, checked and, now and then, planned on. In place.

        Raises
        ------
        Fault
            If a reply should not be.
        """
        plan = self.planned(request)
        if plan is not None:
            self.move_shipment(request, plan)
        if plan is None or rng.random() > GOES_ON:
            return
        later = changed(rng, request, plan)
        is_whole = rng.random() >= DAMAGED
        if not is_whole:
            plan = damaged(rng, plan)
            self.ask("/check", {"problem": later, "plan": plan})
        terms = replan_terms(rng, plan)
        request = later | {"replan": terms}
        replanned = self.planned(request)
        self.replanned += replanned is not None
        if replanned is not None:
            self.move_shipment(request, replanned)
        if is_whole and replanned is not None and terms["freeze_before"] is not None:
            hold_to_the_past(request, plan, replanned)

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
        left_out = sum(_num_left_out(plan, left) for left in plan["unassigned"])
        if served + left_out != len(request["customers"]) + len(ends_of(request)):
            raise Fault(f"{served} served and {left_out} left out")
        if not all(left["reasons"] for left in plan["unassigned"]):
            raise Fault("a customer is left out without a reason")
        self.checked += 1
        self.left_out += bool(plan["unassigned"])
        return plan

    def move_shipment(self, request: Data, plan: Data) -> None:
        """Have a plan's first shipment explained, and put where it fits best. In place.

        Raises
        ------
        Fault
            If `POST /check` says something else of what fits, or of what it costs.
        """
        for shipment in request.get("shipments", ())[:1]:
            question = {"problem": request, "plan": plan, "shipment": shipment["id"],
                        "options": {"time_limit": 0.1}}
            told, fits = self.ask("/explain", question), self.ask("/fit", question)
            if told is None or fits is None or told["here"] != fits["here"]:
                raise Fault(f"the shipment of a sound plan isn't told of: {told}, {fits}")
            here = fits["here"]
            for place in fits["places"]:
                # Where there is no way, there is no route; companions may come from others.
                alone = (place["feasible"] or place["route"]) and "companions" not in place
                if here is None or here["vehicle"] != place["vehicle"] or not alone:
                    continue
                routes = [route for route in plan["routes"] if route["vehicle"] != place["vehicle"]]
                verdict = self.ask("/check", {"problem": request, "plan": plan | {
                    "routes": [*routes, place["route"]]}})
                if verdict is None or verdict["feasible"] < place["feasible"]:
                    raise Fault(f"what fits is refused by POST /check: {place} {verdict}")
                for term in {*plan["cost"]} - {"total", "unassigned"}:
                    less, more = here["saving"][term], place["cost"][term]
                    slip = max(1e-3 + ROUNDING * abs(less), CANCELLING * plan["cost"][term])
                    if abs(verdict["cost"][term] - plan["cost"][term] - more + less) > slip:
                        raise Fault(f"what fits costs {more} more by {term}, not {less}, but by "
                                    f"POST /check it is {verdict['cost'][term]}")
            self.moved += bool(fits["places"])

    def ask(self, path: str, body: Data) -> Data | None:
        """Return the reply to a request; None if it is refused as documented. In place."""
        began = time.perf_counter()
        reply = self.client.post(path, content=json.dumps(body),
                                 headers={"Content-Type": "application/json"})
        self.longest = max(self.longest, time.perf_counter() - began)
        self.statuses[f"{path} {reply.status_code}"] += 1
        if reply.status_code == 200:
            content: Data = json.loads(reply.text, parse_constant=_not_json)
            if content.get("solver", {}).get("plans_refused"):
                raise Fault(f"{path}: the judge refused a plan, for which another stands")
            return content
        if reply.status_code != 422 or not reply.json()["errors"]:
            raise Fault(f"{path} is answered with {reply.status_code}: {reply.text[:500]}")
        return None


Kind = TypeVar("Kind", bound=Study)


def _not_json(name: str) -> None:
    """Raise `Fault` for a number that JSON doesn't have."""
    raise Fault(f"a reply holds {name}, which is no JSON")


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


def _num_left_out(plan: Data, left: Data) -> int:
    """Return how many ends a plan leaves out; pickups that a broken vehicle has made are none."""
    if left.get("kind") != "shipment":
        return 1
    fetched = sum((halt.get("kind"), halt["id"]) == ("pickup", left["id"])
                  for route in plan["routes"] for trip in route["trips"]
                  for served in (trip["stops"], *(each["customers"] for each in trip["sorties"]))
                  for halt in served)
    return 1 + len(left.get("parts") or [None]) - fetched


def replan_terms(rng: random.Random, plan: Data) -> Data:
    """Return how to plan on from a plan: at some instant, without vehicles that broke down."""
    day = max((trip["stops"][-1]["departure"] for route in plan["routes"]
               for trip in route["trips"] if trip["stops"]), default=3600)
    return {
        "plan": {"routes": plan["routes"], "unassigned": plan["unassigned"]},
        "freeze_before": rng.choice((None, 0, min(1e9, rng.random() * day))),
        "pin_all": rng.random() < 0.2,
        "unavailable": [route["vehicle"] for route in plan["routes"] if rng.random() < 0.1],
        "parcels_back": rng.choice((None, None, 0, 5e8))}


def hold_to_the_past(request: Data, plan: Data, replanned: Data) -> None:
    """Compare what had happened by a plan with the plan that goes on from it.

    Raises
    ------
    Fault
        If that was changed, or parcels leave the depot that aren't there.
    """
    terms = request["replan"]
    now, broken = terms["freeze_before"], set(terms["unavailable"])
    moved = happened(plan, now, broken, is_calm(request)) - happened(replanned, now)
    if moved:
        raise Fault(f"what had happened before {now} is another past: {sorted(moved)[:3]}")
    back = terms["parcels_back"] or 0
    others = {route["vehicle"] for route in replanned["routes"]} - broken
    early = left_depot(plan, now, broken) & left_depot(replanned, back, others)
    if early:
        raise Fault(f"parcels leave the depot before {back}, when they are back: "
                    f"{sorted(early)[:3]}")


def is_calm(request: Data) -> bool:
    """Tell whether drones can fly from anywhere to anywhere."""
    airspace = request.get("airspace") or {}
    stated = airspace.get("wind") or {}
    hours = stated if isinstance(stated, list) else [stated]
    wind = any(hour.get("speed_kmh", 0) for hour in hours)
    return not (request.get("matrices") or airspace.get("no_fly") or wind)


def happened(plan: Data, now: float, broken: Collection[str] = (),
             lands_anywhere: bool = True) -> set[tuple[str, ...]]:
    """Return what a plan has done before an instant: stops left and flights begun, in words.

    Vehicles that are broken by then have done what they had begun to serve, and a trip on which
    that is nobody is no more.
    """
    done: set[tuple[str, ...]] = set()
    for route in plan["routes"]:
        for trip in route["trips"]:
            if not _has_left(trip, now):
                continue
            is_cut = route["vehicle"] in broken and trip["stops"][-1]["departure"] >= now
            flown = _flown(trip, now, is_cut, lands_anywhere)
            if is_cut and not flown and all(
                    stop["service_start"] >= now for stop in trip["stops"]
                    if stop["kind"] in {"customer", "pickup", "delivery"}):
                continue
            done |= {(route["vehicle"], stop["kind"], stop["id"], f"{stop['arrival']:.3f}",
                      f"{stop['departure']:.3f}")
                     for stop in trip["stops"] if stop["departure"] < now}
            done |= {(route["vehicle"], "flight", customer["id"], f"{sortie['launch_time']:.3f}",
                      f"{customer['arrival']:.3f}") for sortie, customer in flown}
    return done


def _flown(trip: Data, now: float, is_cut: bool, lands_anywhere: bool) -> list[tuple[Data, Data]]:
    """Return the flights of a trip that were begun before an instant, each with its customers.

    If the trip is cut short then, only whom they had begun to serve; where drones can't land
    anywhere, only by those who are aboard again, as the others may be lost.
    """
    flown = [(sortie, customer) for sortie in trip["sorties"] for customer in sortie["customers"]
             if sortie["launch_time"] < now]
    if is_cut:
        flown = [(sortie, customer) for sortie, customer in flown
                 if customer["service_start"] < now and (
                     lands_anywhere
                     or trip["stops"][sortie["recovery_stop"]]["departure"] < now)]
    return flown


def left_depot(plan: Data, now: float, vehicles: Collection[str]) -> set[str]:
    """Return whose parcels have left a depot before an instant with some vehicles."""
    return {visit["id"] for route in plan["routes"] if route["vehicle"] in vehicles
            for trip in route["trips"] if _has_left(trip, now) for visit in _visits(trip)}


def _has_left(trip: Data, now: float) -> bool:
    return bool(trip["stops"]) and trip["stops"][0]["departure"] < now


def _customer_stops(trip: Data) -> list[Data]:
    return [stop for stop in trip["stops"] if stop["kind"] == "customer"]


def _visits(trip: Data) -> list[Data]:
    """Return what a trip does for each of its customers; ends of shipments are none."""
    flown = [visit for sortie in trip["sorties"] for visit in sortie["customers"]]
    return [*_customer_stops(trip), *(visit for visit in flown if "kind" not in visit)]


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
    if names := [name for name, value in part.items()
                 if isinstance(value, int | float) and not isinstance(value, bool)]:
        name = rng.choice(names)
        part[name] = (rng.choice((0, 1, 2, 5)) if name.endswith("_stop")
                      else max(0, part[name] + rng.choice((-3600, -1, 0.0005, 60, 1e8))))


def tried(kind: type[Kind], seeds: Iterable[int], attempt: Callable[[Kind, int], None],
          on_fault: Callable[[int], None] = lambda _: None) -> tuple[Kind, int]:
    """Return what came of all seeds at a service of its own, and how many faults, which are told.

    Parameters
    ----------
    kind
        What is noted.
    attempt
        Tries one seed.
    on_fault
        Is told each seed with a fault.
    """
    faults = 0
    with (tempfile.TemporaryDirectory() as name, service(Path(name)) as target,
          client_of(target) as client):
        study = kind(client)
        for number in seeds:
            try:
                attempt(study, number)
            except (Fault, httpx.TransportError) as fault:
                faults += 1
                typer.echo(f"seed {number}: {type(fault).__name__}: {fault}")
                on_fault(number)
        faults += target.process.poll() is not None
    return study, faults


def main(
    problems: Annotated[int, typer.Option(help="Problems to send.")] = 5000,
    seed: Annotated[int, typer.Option(help="Seed of the first; later ones count on.")] = 0,
    folder: Annotated[Path | None, typer.Option(help="Where to write problems that fail.")] = None,
) -> None:
    """Fuzz plans, checks and replans."""
    def keep(number: int) -> None:
        if folder is not None:
            (folder / f"{number}.json").write_text(json.dumps(
                wild_request(random.Random(number)), indent=1))

    study, faults = tried(Study, range(seed, seed + problems), Study.try_problem, keep)
    typer.echo(f"{problems} problems, {faults} faults; {study.checked} plans checked, "
               f"{study.replanned} of them replanned, {study.left_out} of them with customers "
               f"left out; longest {study.longest:.2f} s; {dict(sorted(study.statuses.items()))}")
    raise typer.Exit(1 if faults else 0)


if __name__ == "__main__":
    typer.run(main)
