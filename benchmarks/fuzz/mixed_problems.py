"""Requests of `POST /plan` that make sense, each of which mixes many rules.

Wild problems ask for what nobody could do; these for what a fleet might, so that most customers
are served and rules meet in plans. All is drawn from the generator passed.
"""

import random
from collections.abc import Callable
from typing import Any

from benchmarks.fuzz.mixed_places import (
    a_place, a_window, add_launch_sites, ask_permits, bar_launches, blow, close_sky, fly_from_hubs,
    go_together, keep_apart, let_revisit, lose_legs, offer_places, power_drones, put_in_order,
    ship, some, trucks_of,
)
from benchmarks.fuzz.wild_choices import places_of

Data = dict[str, Any]

MOST_RULES = 7

LIFTING = 0.1
"""Share of contradictions that are sent, to be refused."""


def mixed_request(rng: random.Random, number: int | None = None, *, tables: bool = True) -> Data:
    """Return a request, with so many customers; if so asked, without tables of legs."""
    size = rng.choice((1, 1, 2))
    depots = [{"id": f"D{number}", "location": a_place(rng)}
              for number in range(rng.choice((1, 2)))]
    request: Data = {
        "coordinate_system": "planar", "planar_unit": 1000, "depots": depots,
        "customers": [_customer(rng, f"c{each}", size)
                      for each in range(rng.randint(3, 10) if number is None else number)],
        "fleet": [_truck(rng, f"t{number}", size, depots)
                  for number in range(rng.choice((1, 1, 2)))],
        "unassigned_cost": rng.choice((None, None, 60, 1000)),
        "options": {"time_limit": 30, "search_iterations": rng.choice((0, 20, 60, 150)),
                    "threads": 1, "seed": rng.randrange(1000),
                    "policy": rng.choice(("attention", "attention", "pointer"))}}
    names = _without_contradictions(rng, {
        *rng.sample(sorted(OF_A_DAY), rng.randint(2, MOST_RULES)),
        *rng.sample(sorted(OTHERS), rng.randint(0, 4))})
    for name, change in (OTHERS | OF_A_DAY).items():
        if name in names:
            change(rng, request)
    if "missing_legs" in names and tables:
        lose_legs(rng, request, [*places_of(request), *(
            place for kind in request["fleet"] for place in _own_places(kind))])
    return request


def _without_contradictions(rng: random.Random, names: set[str]) -> set[str]:
    """Return names of rules without those that are refused beside others, nearly always."""
    for name, others in REFUSED_BESIDE.items():
        if name in names and names & others and rng.random() >= LIFTING:
            names = names - rng.choice((others, {name}))
    return names


def _own_places(kind: Data) -> list[Data]:
    """Return what a vehicle type has beside depots, to be told where it lies. In place."""
    return [kind["end"]] if isinstance(kind.get("end"), dict) else []


def _customer(rng: random.Random, name: str, size: int) -> Data:
    return {
        "id": name, "location": a_place(rng), "demand": [rng.randint(0, 2) for _ in range(size)],
        "service_duration": rng.choice((0, 60, 300, 333.333)),
        "served_by": rng.choice(("either", "either", "either", "truck", "drone")),
        **({"time_window": a_window(rng)} if rng.random() < 0.3 else {})}


def _truck(rng: random.Random, name: str, size: int, depots: list[Data]) -> Data:
    kind: Data = {
        "id": name, "count": rng.randint(1, 3), "capacity": [rng.choice((6, 12, 30))] * size,
        "depot": rng.choice(depots)["id"], "speed_kmh": 60,
        "costs": {"fixed": rng.choice((0, 5)), "per_km": 1, "per_hour": rng.choice((0, 20))}}
    if rng.random() < 0.6:
        kind["drones"] = {
            "count": rng.choice((1, 1, 2)), "capacity": [2] * size, "speed_kmh": 60,
            "endurance": rng.choice((1200, 2400)), "launch_duration": rng.choice((0, 30)),
            "recovery_duration": 30, "max_customers_per_sortie": rng.choice((1, 1, 2)),
            "costs": {"per_km": 0.1, "per_hour": 0}}
    return kind


def rest(rng: random.Random, request: Data) -> None:
    """Let drivers of some types have breaks. In place."""
    for kind in some(rng, trucks_of(request)):
        earliest, breaks = rng.choice((0, 600, 1800)), list[Data]()
        for number in range(rng.choice((1, 1, 2, 3))):
            width = rng.choice((0, 600, 1800, None)) if number == 0 else rng.choice((600, 1800))
            breaks.append({
                "id": f"b{number}", "duration": rng.choice((300, 900, 1800)),
                "start": {"earliest": earliest,
                          "latest": None if width is None else earliest + width},
                "at": rng.choice(("stop", "anywhere")), "paid": rng.random() < 0.5,
                "after_departure": rng.random() < 0.4,
                "max_load": rng.choice((None, None, [4] * len(kind["capacity"])))})
            earliest += 3600
        kind["breaks"] = breaks


def keep_driving_rules(rng: random.Random, request: Data) -> None:
    """Have drivers of some types rest by rules. In place."""
    for kind in some(rng, trucks_of(request), 0.7):
        kind["driving_rules"] = rng.choice((
            {"preset": rng.choice(("eu-561", "eu-561+2002-15", "us-hos"))},
            {"preset": "eu-561", "driven_before": 15_000},
            {"max_driving": rng.choice((600, 1500, 3000)),
             "break_duration": rng.choice((300, 900)),
             "split": rng.choice((None, [120, 300], [300, 600])),
             "max_driving_per_day": rng.choice((None, 5400, 9000)),
             "max_work_before_break": rng.choice((None, 2700, 3600)),
             "other_work_interrupts": rng.random() < 0.3,
             "driven_before": rng.choice((0, 300)), "while_drones_fly": rng.random() < 0.8}))


def prefer_vehicles(rng: random.Random, request: Data) -> None:
    """Let some cost more by some vehicles. In place."""
    names = [name for kind in request["fleet"] for name in (kind["id"], f"{kind['id']}-1")]
    for order in some(rng, [*request["customers"], *request.get("shipments", ())]):
        order["vehicle_costs"] = {name: rng.choice((0, 1, 5, 20)) for name in rng.sample(names, 2)}


def pay_for_the_end(rng: random.Random, request: Data) -> None:
    """Price the plan's end. In place."""
    request["fairness"] = {"makespan_cost_per_hour": rng.choice((5, 60))}


def use_several(rng: random.Random, request: Data) -> None:
    """Ask for a least number of vehicles. In place."""
    request["fairness"] = request.get("fairness", {}) | {"min_vehicles": rng.choice((1, 2, 3))}


def stack(rng: random.Random, request: Data) -> None:
    """Let only what was loaded last be unloaded. In place."""
    for kind in some(rng, trucks_of(request)):
        kind["lifo"] = True


def share_work(rng: random.Random, request: Data) -> None:
    """Price unequal work. In place."""
    request["fairness"] = request.get("fairness", {}) | {"balance": {
        "measure": rng.choice(("duration", "stops", "load", "distance")),
        "cost": rng.choice((1, 10))}}


def open_depots(rng: random.Random, request: Data) -> None:
    """Give all depots the same hours. In place."""
    hours = {"earliest": rng.choice((0, 600)), "latest": rng.choice((7200, 14_400))}
    for depot in request["depots"]:
        depot["time_window"] = hours


def limit_driving(rng: random.Random, request: Data) -> None:
    """Limit how long trucks may drive. In place."""
    for kind in trucks_of(request):
        if not kind.get("speed_profile"):
            kind["max_travel_duration"] = rng.choice((2400, 4800))


def limit_ways(rng: random.Random, request: Data) -> None:
    """Limit how far vehicles drive on all their trips. In place."""
    for kind in request["fleet"]:
        kind["max_distance"] = rng.choice((15_000, 40_000))


def price_lateness(rng: random.Random, request: Data) -> None:
    """Let being late cost, once and by the hour. In place."""
    for customer in some(rng, request["customers"]):
        customer.pop("time_windows", None)
        customer["time_window"] = a_window(rng) | {
            "late_cost_per_hour": rng.choice((0, 30)), "late_cost": rng.choice((1, 10))}


def open_twice(rng: random.Random, request: Data) -> None:
    """Give some customers several windows. In place."""
    for customer in some(rng, request["customers"]):
        customer.pop("time_window", None)
        opens = sorted(rng.sample(range(0, 10_800, 600), 4))
        customer["time_windows"] = [{"earliest": opens[0], "latest": opens[1]},
                                    {"earliest": opens[2], "latest": opens[3]}]


def pick_up(rng: random.Random, request: Data) -> None:
    """Have something picked up at customers. In place."""
    size = len(request["fleet"][0]["capacity"])
    for customer in some(rng, request["customers"]):
        customer["pickup"] = [rng.randint(0, 2) for _ in range(size)]
    for kind in request["fleet"]:
        kind["pickups"] = rng.choice(("any", "any", "last"))


def carry_goods(rng: random.Random, request: Data) -> None:
    """Let some goods not go with others. In place."""
    for order in some(rng, [*request["customers"], *request.get("shipments", ())]):
        order["goods"] = [rng.choice(("food", "paint"))]
    request["incompatible_goods"] = [
        {"goods": ["food", "paint"], "scope": rng.choice(("trip", "vehicle"))}]


def set_up(rng: random.Random, request: Data) -> None:
    """Let some ask for a setup, some where others are. In place."""
    for customer in some(rng, request["customers"]):
        customer["setup_duration"] = rng.choice((60, 180))
        if rng.random() < 0.4:
            customer["location"] = rng.choice(request["customers"])["location"]


def bring_fresh(rng: random.Random, request: Data) -> None:
    """Limit how long some parcels are aboard. In place."""
    for customer in some(rng, request["customers"]):
        customer["max_time_aboard"] = rng.choice((900, 1800, 3600))


def release_later(rng: random.Random, request: Data) -> None:
    """Let some parcels come to the depot later. In place."""
    for customer in some(rng, request["customers"]):
        customer["release_time"] = rng.choice((300, 1800))


def make_trips(rng: random.Random, request: Data) -> None:
    """Let vehicles make several trips, from several depots. In place."""
    for kind in trucks_of(request):
        kind |= {"max_trips": rng.choice((2, 3)), "reload_duration": rng.choice((0, 300)),
                 "reload_depots": [depot["id"] for depot in request["depots"]]}


def end_elsewhere(rng: random.Random, request: Data) -> None:
    """Let days end at the last stop, or at a place. In place."""
    for kind in trucks_of(request):
        kind["end"] = rng.choice(("open", {"location": a_place(rng)}))


def work_overtime(rng: random.Random, request: Data) -> None:
    """Limit work, but for overtime. In place."""
    for kind in trucks_of(request):
        kind |= {"max_working_duration": rng.choice((3600, 7200)),
                 "overtime": {"max_duration": 1800, "cost_per_hour": 30}}


def end_shifts(rng: random.Random, request: Data) -> None:
    """Let shifts begin and end. In place."""
    for kind in trucks_of(request):
        kind["shift"] = {"earliest": rng.choice((0, 600)), "latest": rng.choice((7200, 14_400))}


def limit_stops(rng: random.Random, request: Data) -> None:
    """Price and limit stops and sorties. In place."""
    for kind in trucks_of(request):
        kind["costs"] |= {"per_stop": rng.choice((0, 2)), "per_load_km": rng.choice((0, 0.1))}
        kind |= {"max_stops": rng.choice((3, 6)), "max_sorties": rng.choice((1, 3))}


def drive_slowly(rng: random.Random, request: Data) -> None:
    """Let speeds change with the time of day. In place."""
    for kind in some(rng, trucks_of(request)):
        kind["speed_profile"] = [{"from": 0, "factor": 1}, {"from": 1800, "factor": 0.5},
                                 {"from": rng.choice((3600, 5400)), "factor": 1}]


def ask_skills(rng: random.Random, request: Data) -> None:
    """Ask vehicles for skills. In place."""
    for order in some(rng, [*request["customers"], *request.get("shipments", ())], 0.3):
        order["skills"] = ["cold"]
    for kind in some(rng, request["fleet"], 0.7):
        kind["skills"] = ["cold"]


def choose_vehicles(rng: random.Random, request: Data) -> None:
    """Say of some who may not serve them. In place."""
    names = [name for kind in request["fleet"] for name in (kind["id"], f"{kind['id']}-1")]
    for order in some(rng, [*request["customers"], *request.get("shipments", ())], 0.3):
        order["vehicles"] = {"forbidden": [rng.choice(names)]}


Change = Callable[[random.Random, Data], None]

OF_A_DAY: dict[str, Change] = {
    "shipments": ship, "vehicle_costs": prefer_vehicles, "together": go_together,
    "apart": keep_apart, "before": put_in_order, "alternatives": offer_places, "breaks": rest,
    "driving_rules": keep_driving_rules, "makespan": pay_for_the_end, "balance": share_work,
    "depot_hours": open_depots, "max_travel_duration": limit_driving,
    "max_distance": limit_ways, "late_cost": price_lateness,
    "min_vehicles": use_several, "lifo": stack, "missing_legs": lambda rng, request: None}
"""The rules of a working day, each with what has a request state it. The last needs all places."""

OTHERS: dict[str, Change] = {
    "hubs": fly_from_hubs, "launch_sites": add_launch_sites, "revisits": let_revisit,
    "launch": bar_launches, "permits": ask_permits, "energy": power_drones, "wind": blow,
    "no_fly": close_sky, "time_windows": open_twice, "pickup": pick_up, "goods": carry_goods,
    "setup": set_up, "max_time_aboard": bring_fresh, "release_time": release_later,
    "trips": make_trips, "end": end_elsewhere, "overtime": work_overtime, "shift": end_shifts,
    "stops": limit_stops, "speed_profile": drive_slowly, "skills": ask_skills,
    "vehicles": choose_vehicles}
"""All other rules, so."""

REFUSED_BESIDE = {"overtime": {"depot_hours"}}
"""Rules with those beside which they can't be planned yet."""


def stated_in(request: Data) -> set[str]:
    """Return the names of the rules of a day that a request states."""
    kinds, orders = request["fleet"], [*request["customers"], *request.get("shipments", ())]
    stated = {relation["kind"] for relation in request.get("relations", ())}
    stated |= {name for name in ("breaks", "driving_rules", "max_travel_duration", "max_distance",
                                "lifo")
               if any(kind.get(name) for kind in kinds)}
    stated |= {name for name in ("alternatives", "vehicle_costs")
               if any(order.get(name) for order in orders)}
    stated |= {name for name, is_stated in (
        ("shipments", request.get("shipments")), ("missing_legs", request.get("matrices")),
        ("depot_hours", any("time_window" in depot for depot in request["depots"])),
        ("late_cost", any(order.get("time_window", {}).get("late_cost") for order in orders)),
        ("makespan", request.get("fairness", {}).get("makespan_cost_per_hour")),
        ("balance", request.get("fairness", {}).get("balance")),
        ("min_vehicles", request.get("fairness", {}).get("min_vehicles"))) if is_stated}
    return stated
