"""Many customers and a plan for them without any search, by which what surrounds it is measured.

Customers lie on a square, vehicles sweep it in strips, to and fro, so many customers each. And
customers with windows for vehicles of several kinds, which are for the search to plan.
"""

import random
from collections.abc import Iterator, Sequence
from math import hypot, sqrt
from typing import Any

Data = dict[str, Any]
Place = tuple[float, float]

PER_ROUTE = 20
SPACE_M = 500.0
"""Customers per route, and about how far they are from each other."""

SPEED_M_S, SERVICE_S = 12.5, 60.0


def many_customers(number: int) -> Data:
    """Return a request of so many customers, as JSON has it."""
    rng = random.Random(number)
    side = SPACE_M * sqrt(number)
    return {
        "depots": [{"id": "hub", "location": [side / 2, side / 2]}],
        "customers": [
            {"id": f"c{index}", "demand": [rng.randint(1, 9)], "service_duration": SERVICE_S,
             "location": [round(rng.uniform(0, side), 1), round(rng.uniform(0, side), 1)],
             "time_window": {"earliest": index % 60 * 60, "latest": 10**6}}
            for index in range(number)],
        "fleet": [{"id": "truck", "count": -(-number // PER_ROUTE), "capacity": [10 * PER_ROUTE],
                   "speed_kmh": SPEED_M_S * 3.6, "costs": {"fixed": 100, "per_km": 1}}],
    }


WORKING_DAY_S, WINDOW_S = 14 * 3600, 4 * 3600

BREAK_S, SETUP_S, MOST_STOPS = 3600, 60, 40

DRONE: Data = {"count": 1, "capacity": [4], "speed_kmh": 60, "endurance": 1800,
               "launch_duration": 30, "recovery_duration": 30, "costs": {"per_km": 0.1}}


def mixed_customers(number: int, has_drones: bool, has_rarer: bool = False) -> Data:
    """Return a request with windows, vehicles of two sizes, two trips each and perhaps drones.

    Half of the vehicles carry twice what the others do and cost more; each may serve 12 customers
    on average. With drones, each has one, and most of the lighter parcels may fly. With rarer
    rules, half of the customers have two windows where the day has room for them, a third send a
    parcel instead, all take a setup, and trips have a limit of stops.
    """
    rng = random.Random(number)
    side = SPACE_M * sqrt(number)
    more: Data = {"drones": DRONE} if has_drones else {}
    if has_rarer:
        more |= {"max_stops": MOST_STOPS}
    customers = [_mixed_customer(rng, index, side, has_drones) for index in range(number)]
    return {
        "depots": [{"id": "hub", "location": [side / 2, side / 2]}],
        "customers": [*map(_with_rarer, customers)] if has_rarer else customers,
        "fleet": [
            {"id": name, "count": -(-number // 25), "capacity": [capacity], "speed_kmh": 60,
             "costs": {"fixed": fixed, "per_km": per_km, "per_hour": 20}, "max_trips": 2,
             "shift": {"earliest": 0, "latest": WORKING_DAY_S}, **more}
            for name, capacity, fixed, per_km in (("large", 200, 100, 1), ("small", 100, 60, 0.7))],
    }


def _mixed_customer(rng: random.Random, index: int, side: float, has_drones: bool) -> Data:
    opens = rng.randrange(5) * WINDOW_S // 2
    demand = rng.randint(1, 9)
    # Drawn also without drones, so that the customers are the same.
    may_fly = rng.random() < 0.8 and has_drones and demand <= DRONE["capacity"][0]
    return {"id": f"c{index}", "demand": [demand], "service_duration": SERVICE_S,
            "location": [round(rng.uniform(0, side), 1), round(rng.uniform(0, side), 1)],
            "time_window": {"earliest": opens, "latest": opens + WINDOW_S},
            "served_by": "either" if may_fly else "truck"}


def _with_rarer(customer: Data) -> Data:
    rng = random.Random(customer["id"])
    customer = {**customer, "setup_duration": SETUP_S}
    opens = customer["time_window"]["latest"] + BREAK_S
    if rng.random() < 0.5 and opens + BREAK_S < WORKING_DAY_S:
        second = {"earliest": opens, "latest": opens + BREAK_S}
        customer["time_windows"] = [customer.pop("time_window"), second]
    if rng.random() < 1 / 3:
        customer |= {"demand": [0], "pickup": customer["demand"]}
    return customer


def swept(request: Data) -> list[list[int]]:
    """Return the customers of each vehicle by their place in the request."""
    customers = request["customers"]
    strip = SPACE_M * 3

    def place(index: int) -> tuple[int, float]:
        x, y = customers[index]["location"]
        return int(x // strip), y if x // strip % 2 else -y

    order = sorted(range(len(customers)), key=place)
    return [order[start:start + PER_ROUTE] for start in range(0, len(order), PER_ROUTE)]


def swept_reply(request: Data) -> Data:
    """Return a plan as `POST /plan` would reply it, all waiting left out."""
    routes = [_route(request, number, some) for number, some in enumerate(swept(request), 1)]
    number = len(request["customers"])
    distance = sum(route["trips"][0]["distance"] for route in routes)
    return {
        "status": "complete",
        "cost": {"total": distance, "fixed": 0.0, "distance": distance, "stops": 0.0, "time": 0.0,
                 "overtime": 0.0, "lateness": 0.0, "earliness": 0.0, "makespan": 0.0,
                 "balance": 0.0, "too_few_vehicles": 0.0, "unassigned": 0.0},
        "routes": routes, "unassigned": [], "warnings": [], "legs": [],
        "summary": {"customers": number, "served": number, "must_unserved": 0,
                    "vehicles": len(routes), "vehicles_lacking": 0,
                    "trips": len(routes), "sorties": 0,
                    "distance": distance, "drone_distance": 0.0, "energy_wh": None,
                    "load_rate": {"min": 0.1, "mean": 0.5, "max": 1.0},
                    "makespan": max(route["working_duration"] for route in routes),
                    "co2_kg": None},
        "solver": {"policy": "attention", "decoding": "greedy", "seed": 0, "start": "policy",
                   "decoded_cost": distance, "final_cost": distance, "search_iterations": 0,
                   "threads": 1, "deterministic": True,
                   "elapsed": {"validate": 0, "decode": 0, "search": 0, "check": 0, "total": 0}},
    }


def _route(request: Data, number: int, some: Sequence[int]) -> Data:
    stops = list(_stops(request, some))
    places = [request["depots"][0]["location"],
              *(request["customers"][index]["location"] for index in some),
              request["depots"][0]["location"]]
    end = stops[-1]["departure"]
    return {
        "vehicle": f"truck-{number}", "type": "truck", "working_duration": end,
        "working_rate": None, "overtime": 0.0, "cost": 0.0,
        "trips": [{"load": [1.0], "load_rate": 0.5, "duration": end, "energy_wh": None,
                   "distance": sum(map(_metres, places, places[1:])), "stops": stops,
                   "sorties": []}],
    }


def _stops(request: Data, some: Sequence[int]) -> Iterator[Data]:
    """Yield a trip's stops, one after another as soon as possible."""
    depot, time = request["depots"][0], 0.0
    before = depot["location"]
    halts = [request["customers"][index] for index in some]
    for place in (depot, *halts, depot):
        time += _metres(before, place["location"]) / SPEED_M_S
        departure = time + place.get("service_duration", 0.0)
        yield {"kind": "depot" if place is depot else "customer", "id": place["id"],
               "arrival": time, "service_start": time, "departure": departure, "waiting": 0.0,
               "lateness": 0.0, "load": [0.0]}
        before, time = place["location"], departure


def _metres(start: Place, end: Place) -> float:
    return hypot(end[0] - start[0], end[1] - start[1])
