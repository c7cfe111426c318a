"""Lets days change while they go on, and judges each new plan: `python -m benchmarks.fuzz.replans`.

Each day is planned, or changed by hand where that breaks no rule, then something happens, and the
plan is gone on from; the reply is gone on from in turn. Of other days any one thing is taken away
or changed, which is planned or refused, or nothing has happened: see `--kind`. Of each reply this
is judged from the JSON alone: `POST /check` finds no broken rule and the same cost; what has begun
is unchanged; whatever is aboard a vehicle that drives stays with it or is left out with a reason;
parcels of broken vehicles are told of, and leave no depot before they are back; and it costs no
more than the plan given, where that may still be driven as it is. Nothing that happens is refused.
"""

import json
import math
import random
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, Literal

import typer

from benchmarks.fuzz.changing_days import Change, by_hand, morning, what_happens
from benchmarks.fuzz.late_vehicles import legs_of, with_a_late_vehicle
from benchmarks.fuzz.mixed_problems import mixed_request
from benchmarks.fuzz.problems import Fault, Study, hold_to_the_past, replan_terms, tried
from benchmarks.fuzz.things_gone import with_a_thing_gone
from benchmarks.fuzz.wild_problems import wild_request

Data = dict[str, Any]

CHANGED_BY_HAND, GOES_ON = 0.6, 0.6
"""Shares of plans that are changed by hand, and of those that go on once more."""

THINGS = 5
"""How often something is taken away from a day."""


@dataclass
class Days(Study):
    """What came of all days."""

    compared: int = 0  # with the plan given, driven as it is
    left_aboard: int = 0  # parcels that stayed aboard and are left out

    def try_day(self, seed: int) -> None:
        """Have a day planned, changed, and planned on. In place.

        Raises
        ------
        Fault
            If a reply should not be.
        """
        rng = random.Random(seed)
        request = morning(rng)
        plan = self.planned(request)
        if plan is None:
            raise Fault("the morning is refused")
        if rng.random() < CHANGED_BY_HAND:
            plan = self._retimed(request, by_hand(rng, plan)) or plan
        since, broken, lost = 0.0, frozenset[str](), frozenset[str]()
        while since == 0.0 or rng.random() < GOES_ON:
            change = what_happens(rng, request, plan, since)
            change = replace(change, broken=change.broken | broken, lost=change.lost | lost)
            plan = self.goes_on(change, plan)
            request, broken, lost = change.request, change.broken, change.lost
            since = max(change.now, 0.001)

    def try_gone(self, seed: int) -> None:
        """Have a day planned, then planned on with one thing of it gone, some times. In place.

        Raises
        ------
        Fault
            If a reply should not be.
        """
        rng = random.Random(seed)
        day = self._any_day(rng)
        if day is None:
            return
        request, plan = day
        for _ in range(THINGS):
            terms = replan_terms(rng, plan)
            if terms["pin_all"]:
                terms["keep_order"] = rng.random() < 0.5
            later = with_a_thing_gone(rng, request) | {"replan": terms}
            later["options"] = later.get("options", {}) | {"change_costs": {
                name: rng.choice((0.0, 0.1, 10.0))
                for name in ("vehicle", "position", "promise_per_minute")}}
            if _may_wait(later):
                later["forecast"] = _drawn_forecast(rng, later["customers"])
            replanned = self.planned(later)
            self.replanned += replanned is not None

    def try_unchanged(self, seed: int) -> None:
        """Have a day planned on on which nothing has changed: at no more cost. In place.

        Raises
        ------
        Fault
            If a reply should not be.
        """
        rng = random.Random(seed)
        day = self._any_day(rng)
        if day is None:
            return
        request, plan = day
        terms = replan_terms(rng, plan) | {"unavailable": [], "parcels_back": None}
        replanned = self.planned(request | {"replan": terms})
        if replanned is None:
            raise Fault("nothing has changed, and it is refused")
        self.replanned += 1
        before, after = plan["cost"]["total"], replanned["cost"]["total"]
        if after > before and not math.isclose(after, before, rel_tol=1e-9, abs_tol=1e-6):
            raise Fault(f"costs {after}, and {before} as the plan given, though nothing changed")

    def try_late(self, seed: int) -> None:
        """Have a day planned on on which a vehicle is late for the stop it drives to. In place.

        Raises
        ------
        Fault
            If it is elsewhere sooner than it can be.
        """
        rng = random.Random(seed)
        request = rng.choice((mixed_request, morning))(rng)
        plan = self.planned(request)
        found = None if plan is None else with_a_late_vehicle(rng, plan)
        if found is None:
            return
        late, now = found
        replanned = self.planned(request | {"replan": {"plan": late, "freeze_before": now}})
        if replanned is None:
            raise Fault("a late vehicle is refused")
        self.replanned += 1
        if plan is None or any("speed_profile" in kind for kind in request["fleet"]):
            return
        before, after = legs_of(plan), legs_of(replanned)
        for places in before.keys() & after.keys():
            if after[places] < before[places] - 0.002:
                raise Fault(f"{places} take {after[places]} s, and {before[places]} as planned")

    def _any_day(self, rng: random.Random) -> tuple[Data, Data] | None:
        """Return a request of any kind and its plan; None if it is refused. In place."""
        request = rng.choice((mixed_request, wild_request, morning))(rng)
        plan = self.planned(request)
        return None if plan is None else (request, plan)

    def goes_on(self, change: Change, plan: Data) -> Data:
        """Return the plan that goes on from another, found sound. In place."""
        request = change.replan(plan)
        replanned = self.planned(request)
        if replanned is None:
            refusal = self.client.post("/plan", json=request).json()["errors"]
            raise Fault(f"what happens is refused: {refusal}")
        self.replanned += 1
        hold_to_the_past(request, plan, replanned)
        self.hold_aboard(change, plan, replanned)
        self._hold_cost(request, change, plan, replanned)
        return replanned

    def _retimed(self, request: Data, plan: Data) -> Data | None:
        """Return a plan without times with them; None if it breaks rules. In place."""
        verdict = self.ask("/check", {"problem": request, "plan": plan})
        if verdict is None or not verdict["feasible"]:
            return None
        return {"routes": verdict.get("routes", plan["routes"]), "unassigned": plan["unassigned"]}

    def hold_aboard(self, change: Change, plan: Data, replanned: Data) -> None:
        """Raise `Fault` where what is aboard moves, or a broken vehicle's is not told of."""
        named = {customer["id"] for customer in change.request["customers"]}
        servants = {name: route["vehicle"] for route in replanned["routes"]
                    for trip in route["trips"] for name in _served(trip)}
        reasons = {left["id"]: left["reasons"] for left in replanned["unassigned"]}
        for vehicle, names in aboard(plan, change.now).items():
            for name in sorted(names & named):
                servant = servants.get(name)
                if vehicle in change.broken:
                    told = [parcel for parcel in replanned["replan"].get("parcels", [])
                            if parcel["id"] == name and parcel["vehicle"] == vehicle]
                    if servant != vehicle and not told:
                        raise Fault(f"{name} is aboard {vehicle}, which is broken, and is not "
                                    "told of")
                elif servant is None:
                    self.left_aboard += 1
                    if not any(reason["code"] == "ABOARD" for reason in reasons[name]):
                        raise Fault(f"{name} is aboard {vehicle}, but: {reasons[name]}")
                elif servant != vehicle:
                    raise Fault(f"{name} is aboard {vehicle}, and {servant} is to serve it")

    def _hold_cost(self, request: Data, change: Change, plan: Data, replanned: Data) -> None:
        """Raise `Fault` if the plan given could be driven on at less cost. In place."""
        for given in _driven_on(change, plan):
            verdict = self.ask("/check", {"problem": request, "plan": given})
            if verdict is None or not verdict["feasible"]:
                continue
            self.compared += 1
            before, after = verdict["cost"]["total"], replanned["cost"]["total"]
            if after > before and not math.isclose(after, before, rel_tol=1e-9, abs_tol=1e-6):
                raise Fault(f"costs {after}, and {before} as the plan given goes on")


def _driven_on(change: Change, plan: Data) -> list[Data]:
    """Return how a plan given could go on: as it is, and timed anew."""
    named = {customer["id"] for customer in change.request["customers"]}
    planned = {name for route in plan["routes"] for trip in route["trips"]
               for name in _served(trip)}
    left = [{"id": name} for name in sorted(named - planned)]
    if planned <= named:
        return [{"routes": plan["routes"], "unassigned": left}]
    return []


def aboard(plan: Data, now: float) -> dict[str, set[str]]:
    """Return whose parcels each vehicle has aboard that is under way, and has not yet served."""
    found = {}
    for route in plan["routes"]:
        for trip in route["trips"]:
            if trip["stops"][0]["departure"] <= now < trip["stops"][-1]["departure"]:
                halts = [*trip["stops"], *(visit for sortie in trip["sorties"]
                                           for visit in sortie["customers"])]
                found[route["vehicle"]] = {halt["id"] for halt in halts
                                           if halt["service_start"] > now
                                           and halt.get("kind", "customer") == "customer"}
    return found


def _served(trip: Data) -> Collection[str]:
    return [*(stop["id"] for stop in trip["stops"] if stop["kind"] == "customer"),
            *(visit["id"] for sortie in trip["sorties"] for visit in sortie["customers"])]


DayKind = Literal["changing", "gone", "late", "unchanged"]

KINDS: Mapping[DayKind, Callable[[Days, int], None]] = {
    "changing": Days.try_day, "gone": Days.try_gone, "late": Days.try_late,
    "unchanged": Days.try_unchanged}

def _may_wait(request: Data) -> bool:
    """Tell whether it may be decided who waits; customers may be no customers any more."""
    customers = request.get("customers")
    return (isinstance(customers, list) and all(
        isinstance(each, dict) and not each.get("alternatives") for each in customers)
        and not any(request.get(name) for name in ("shipments", "relations", "fairness")))


def _drawn_forecast(rng: random.Random, customers: Sequence[Data]) -> Data:
    """Return a forecast of orders like some of today's, or none of any."""
    days = [[each | {"placed_at": rng.randrange(20_000)}
             for each in rng.sample(customers, rng.randrange(len(customers) + 1))]
            for _ in range(rng.randrange(3))]
    return {"every": rng.choice((600, 3600, 20_000)), "look_ahead": rng.randrange(1, 4),
            "past_days": days}


def main(
    days: Annotated[int, typer.Option(help="Days to try.")] = 2000,
    seed: Annotated[int, typer.Option(help="Seed of the first; later ones count on.")] = 0,
    kind: Annotated[DayKind, typer.Option(help="What becomes of each.")] = "changing",
) -> None:
    """Fuzz days that go on."""
    study, faults = tried(Days, range(seed, seed + days), KINDS[kind])
    typer.echo(f"{days} days, {faults} faults; {study.replanned} plans gone on from, "
               f"{study.compared} compared with the plan given, {study.left_aboard} parcels left "
               f"aboard; {json.dumps(dict(sorted(study.statuses.items())))}")
    raise typer.Exit(1 if faults else 0)


if __name__ == "__main__":
    typer.run(main)
