"""Rules of mixed problems that say where: places, legs, airspace, flights and orders of customers.

Each changes a request in place; what it draws makes sense, so that most customers can be served.
"""

import math
import random
from typing import Any

from benchmarks.fuzz.wild_shipments import ends_of

Data = dict[str, Any]

REACH = 8
"""Kilometres from the middle to the edge, which takes as many minutes."""


def a_place(rng: random.Random) -> list[float]:
    """Return a place, in kilometres."""
    return [round(rng.uniform(-REACH, REACH), 1), round(rng.uniform(-REACH, REACH), 1)]


def some(rng: random.Random, entries: list[Data], share: float = 0.5) -> list[Data]:
    """Return a share of entries, one at least where there are any."""
    chosen = [entry for entry in entries if rng.random() < share]
    return chosen or rng.sample(entries, min(1, len(entries)))


def a_window(rng: random.Random, least: int = 900) -> Data:
    """Return a window of hours that lasts so many seconds at least."""
    earliest = rng.choice((0, 0, 600, 1800, 3600))
    return {"earliest": earliest, "latest": earliest + rng.choice((least, 3600, 7200, 14_400))}


def trucks_of(request: Data) -> list[Data]:
    """Return the types that drive."""
    return [kind for kind in request["fleet"] if not kind.get("flies")]


def drones_of(request: Data) -> list[Data]:
    """Return the drones of all trucks that have some."""
    return [kind["drones"] for kind in request["fleet"] if kind.get("drones")]


def ship(rng: random.Random, request: Data) -> None:
    """Have parcels fetched and brought. In place."""
    size = len(request["fleet"][0]["capacity"])
    places = [customer["location"] for customer in request["customers"]]

    def end() -> Data:
        return {"location": a_place(rng) if rng.random() < 0.8 else rng.choice(places),
                **({"service_duration": rng.choice((60, 300))} if rng.random() < 0.5 else {}),
                **({"time_window": a_window(rng)} if rng.random() < 0.2 else {})}

    def amount() -> list[int]:
        return [rng.randint(0, 2) for _ in range(size)]

    def fetched() -> Data:
        if rng.random() < 0.7:
            return {"amount": amount(), "pickup": end()}
        return {"pickups": [{"id": f"p{part}", "amount": amount(), **end()}
                            for part in range(rng.randint(1, 3))]}

    request["shipments"] = [
        {"id": f"s{number}", **fetched(), "delivery": end(),
         **({"max_time_between": rng.choice((900, 1800, 3600))} if rng.random() < 0.4 else {}),
         **({"max_detour": rng.choice((1, 1.5, 3))} if rng.random() < 0.3 else {}),
         **({"unassigned_cost": rng.choice((20, 500))} if rng.random() < 0.2 else {})}
        for number in range(rng.randint(1, 4))]
    # What else is drawn stays as it was.
    flown = random.Random(str(request["shipments"]))
    for each in ends_of(request):
        each |= {"served_by": "either"} if flown.random() < 0.5 else {}


def go_together(rng: random.Random, request: Data) -> None:
    """Keep some customers together. In place."""
    _relate(rng, request, {"kind": "together", "scope": rng.choice(("vehicle", "trip"))})


def keep_apart(rng: random.Random, request: Data) -> None:
    """Keep some customers apart. In place."""
    if not request.get("relations"):
        _relate(rng, request, {"kind": "apart", "scope": rng.choice(("vehicle", "trip"))})


def put_in_order(rng: random.Random, request: Data) -> None:
    """Have some customers served before others. In place."""
    least = rng.choice((0, 0, 300, 1200))
    most = least + rng.choice((600, 1800, 7200)) if rng.random() < 0.6 else None
    if not request.get("relations"):
        _relate(rng, request, {"kind": "before", "min_lag": least, "max_lag": most,
                               "same_vehicle": rng.random() < 0.6})


def _relate(rng: random.Random, request: Data, relation: Data) -> None:
    # Nobody waits for others whom drones alone serve.
    names = [customer["id"] for customer in request["customers"]
             if relation.get("same_vehicle", True) or customer.get("served_by") != "drone"]
    names += [f"{each['id']}/{'pickup' if 'pickup' in each and rng.random() < 0.5 else 'delivery'}"
              for each in request.get("shipments", ()) if rng.random() < 0.5]
    if len(names) < 3:
        return
    request.setdefault("relations", []).append(
        relation | {"customers": rng.sample(names, rng.randint(2, 3))})


def offer_places(rng: random.Random, request: Data) -> None:
    """Let some customers be served elsewhere, unless they are in an order. In place."""
    ordered = {name for relation in request.get("relations", ()) if relation["kind"] == "before"
               for name in relation["customers"]}
    free = [customer for customer in request["customers"] if customer["id"] not in ordered]
    for customer in some(rng, free, 0.4):
        customer["alternatives"] = [
            {"id": f"p{number}", "location": a_place(rng), "cost": rng.choice((0, 1, 5)),
             **({"service_duration": 30} if rng.random() < 0.5 else {}),
             **({"time_window": a_window(rng)} if rng.random() < 0.4 else {})}
            for number in range(rng.randint(1, 3))]


def add_launch_sites(rng: random.Random, request: Data) -> None:
    """Let trucks stop for their drones alone. In place."""
    request["launch_sites"] = [
        {"id": f"site {number}", "location": a_place(rng), "cost": rng.choice((0, 0, 1)),
         **({"time_window": a_window(rng)} if rng.random() < 0.3 else {})}
        for number in range(rng.randint(1, 3))]


def let_revisit(rng: random.Random, request: Data) -> None:
    """Let trucks come back for their drones. In place."""
    for kind in some(rng, trucks_of(request)):
        kind["revisits"] = True


def bar_launches(rng: random.Random, request: Data) -> None:
    """Let nothing take off at some customers. In place."""
    for customer in some(rng, request["customers"]):
        customer["launch"] = False


def ask_permits(rng: random.Random, request: Data) -> None:
    """Limit what is in the air, where it flies, and what trucks do meanwhile. In place."""
    for kind in [kind for kind in trucks_of(request) if kind.get("drones")]:
        kind |= rng.choice(({"max_airborne": 1}, {"truck_waits": True}, {}))
        kind["drones"] |= rng.choice(({"max_range": rng.choice((2000, 5000))}, {},
                                      {"preset": "us-part-107"}))


def fly_from_hubs(rng: random.Random, request: Data) -> None:
    """Add vehicles that fly by themselves. In place."""
    size = len(request["fleet"][0]["capacity"])
    request["fleet"].append({
        "id": "hub", "flies": True, "count": rng.randint(1, 4), "capacity": [3] * size,
        "max_trips": rng.choice((1, 3, 8)), "speed_kmh": rng.choice((50, 80)),
        "endurance": rng.choice((1800, 3600)), "reload_duration": rng.choice((0, 120)),
        "costs": {"fixed": 1, "per_km": 0.2, "per_hour": 0},
        **({"turnaround": {"swap_duration": 60}} if rng.random() < 0.3 else {}),
        **({"energy": _battery(rng)} if rng.random() < 0.3 else {})})
    if rng.random() < 0.3:
        request["fleet"][-1] |= {"energy": _battery(rng), "turnaround": {"charge_w": 200}}
        request["depots"][0]["chargers"] = rng.choice((0, 1, 1, 2))
    elif rng.random() < 0.4:
        request["depots"][0]["batteries"] = rng.choice((0, 1, 3))
    if rng.random() < 0.5:
        request["fleet"][-1]["reload_depots"] = [depot["id"] for depot in request["depots"]]
    if rng.random() < 0.3:
        request["fleet"][-1]["max_range"] = rng.choice((1000, 2500, 5000))


def _battery(rng: random.Random) -> Data:
    return {"battery_wh": rng.choice((40, 120)), "kg_per_unit": rng.choice((0.5, 1)),
            "power": {"cruise_w": 150, "cruise_w_per_kg": 40, "hover_w": 100}}


def power_drones(rng: random.Random, request: Data) -> None:
    """Let batteries limit drones. In place."""
    for drones in drones_of(request):
        drones["energy"] = _battery(rng)
        if rng.random() < 0.4:
            drones["turnaround"] = rng.choice(({"swap_duration": 60}, {"charge_w": 200}))


def blow(rng: random.Random, request: Data) -> None:
    """Let wind blow by the hour, more than some drones bear. In place."""
    request["airspace"] = request.get("airspace", {}) | {"wind": [
        {"from": hour * 1800, "speed_kmh": rng.choice((0, 10, 25)),
         "direction_deg": rng.choice((0, 90, 225)), "gust_kmh": rng.choice((20, 35, 60))}
        for hour in range(rng.randint(1, 5))]}
    for flyer in (*drones_of(request), *request["fleet"]):
        if flyer.get("flies") or "endurance" in flyer:
            flyer["max_wind_kmh"] = rng.choice((30, 50))


def close_sky(rng: random.Random, request: Data) -> None:
    """Close some of the sky. In place."""
    areas = []
    for _ in range(rng.randint(1, 3)):
        (x, y), size, corners = a_place(rng), rng.choice((0.5, 1.5)), rng.choice((3, 5))
        areas.append([[x + size * math.cos(math.tau * corner / corners),
                       y + size * math.sin(math.tau * corner / corners)]
                      for corner in range(corners)])
    request["airspace"] = request.get("airspace", {}) | {"no_fly": areas}


def lose_legs(rng: random.Random, request: Data, places: list[Data]) -> None:
    """State trucks' legs between all places, of which some aren't there. In place."""
    for index, place in enumerate(places):
        place["location_index"] = index

    def leg(origin: Data, to: Data) -> float | None:
        metres = 1000 * math.dist(origin["location"], to["location"])
        is_there = origin is to or rng.random() > 0.08
        return round(metres * rng.uniform(1, 1.3)) if is_there else None

    metres = [[leg(origin, to) for to in places] for origin in places]
    request["matrices"] = {"truck": {"distances": metres, "durations": [
        [None if each is None else each * 0.06 for each in row] for row in metres]}}
