"""By whom, where and with whom customers of wild problems are served, and at what price."""

import random
from typing import Any

from benchmarks.fuzz.wild_shipments import ends_of

Data = dict[str, Any]

RICHEST = 1e12
"""Largest cost of anything."""


def _names_of_vehicles(rng: random.Random, request: Data) -> list[str]:
    """Return types, some of their vehicles, and now and then one that isn't there."""
    names = [kind["id"] for kind in request["fleet"]]
    names += [f"{kind['id']}-{rng.randint(1, min(kind['count'], 5))}"
              for kind in request["fleet"] for _ in range(2)]
    if rng.random() < 0.02:
        names.append(f"{names[0]}-0")
    return names


def prefer_vehicles(rng: random.Random, request: Data) -> None:
    """Let some customers cost more by some vehicles. In place."""
    names = _names_of_vehicles(rng, request)
    for customer in request["customers"]:
        if rng.random() < 0.5:
            customer["vehicle_costs"] = {
                name: rng.choice((0, 1e-9, 3, 50, RICHEST))
                for name in rng.sample(names, rng.randint(1, min(3, len(names))))}


def set_hours_apart(request: Data) -> None:
    """Let hubs open at hours of their own that have few places to charge at. In place.

    Drawn apart, of some requests: all else is as it is without.
    """
    rng = random.Random(f"hours apart {request['customers']}")
    flyers = [kind for kind in request["fleet"] if kind.get("flies")]
    if not flyers or rng.random() < 0.3:
        return
    for depot in request["depots"]:
        opens = rng.choice((0, 0, 1800, 7200))
        depot |= {"chargers": rng.choice((0, 1, 1, 2)), "time_window": {
            "earliest": opens, "latest": rng.choice((None, opens + rng.choice((1800, 14400))))}}
    for kind in flyers:
        kind |= {"count": rng.choice((1, 2, 3)), "max_trips": rng.choice((2, 5)),
                 "reload_duration": rng.choice((0, 0, 120)), "turnaround": {"charge_w": 300},
                 "energy": {"battery_wh": rng.choice((60, 400)), "kg_per_unit": 0.1,
                            "power": {"cruise_w": 250}}}
        if rng.random() < 0.5:
            kind["reload_depots"] = [depot["id"] for depot in request["depots"]
                                     if depot["id"] != kind.get("depot")]


def offer_places(rng: random.Random, request: Data) -> None:
    """Let some customers be served elsewhere instead. In place."""
    stated = [customer["location"] for customer in request["customers"]]
    for customer in request["customers"]:
        if rng.random() < 0.4:
            customer["alternatives"] = [
                {"id": rng.choice("abcdefgh") if rng.random() < 0.02 else str(number),
                 "location": rng.choice(stated), "cost": rng.choice((0, 0, 3, 50, RICHEST)),
                 **({"service_duration": rng.choice((0, 60, 900))} if rng.random() < 0.4 else {}),
                 **({name: other[name] for name in ("time_window", "time_windows")
                     if name in other} if rng.random() < 0.5 else {})}
                for number in range(rng.randint(1, 3))
                for other in [rng.choice(request["customers"])]]


def places_of(request: Data) -> list[Data]:
    """Return all places of a request."""
    return [*request["depots"], *request["customers"], *request.get("launch_sites", ()),
            *ends_of(request), *(place for customer in request["customers"]
                                 for place in customer.get("alternatives", ()))]


def choose_vehicles(rng: random.Random, request: Data) -> None:
    """Let some customers say who may serve them, now and then somebody unknown. In place."""
    names = _names_of_vehicles(rng, request)
    for customer in request["customers"]:
        if rng.random() < 0.5:
            which = rng.choice(("allowed", "forbidden"))
            customer["vehicles"] = {which: rng.sample(names, rng.randint(1, min(3, len(names))))}


def relate(rng: random.Random, request: Data) -> None:
    """Let some customers go together, or apart; now and then one who isn't there. In place."""
    names = [customer["id"] for customer in request["customers"]]
    if len(names) < 2:
        return
    request["relations"] = [
        {"kind": rng.choice(("together", "together", "apart")),
         "customers": rng.sample(names, rng.randint(2, min(4, len(names)))),
         "scope": rng.choice(("vehicle", "trip"))}
        for _ in range(rng.randint(1, 3))]
    for relation in request["relations"]:
        if relation["kind"] == "together" and rng.random() < 0.5:
            least = rng.choice((0, rng.uniform(0, 3600)))
            relation |= {"kind": "before", "min_lag": least,
                         "max_lag": rng.choice((None, least + rng.uniform(0, 7200))),
                         "same_vehicle": relation["scope"] == "trip" or rng.random() < 0.5}
    if rng.random() < 0.02:
        request["relations"][0]["customers"][0] = "nobody"


def limit_ways(rng: random.Random, request: Data) -> Data:
    """Return a request, some with limits of what vehicles drive on all their trips. In place."""
    if rng.random() < 0.1:
        for kind in request["fleet"]:
            kind["max_distance"] = rng.choice((0, 1, 2e4, 1e5, 1e9))
    return request
