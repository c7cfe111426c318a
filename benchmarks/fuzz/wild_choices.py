"""By whom customers of wild problems may be served, and at what price."""

import random
from typing import Any

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


def choose_vehicles(rng: random.Random, request: Data) -> None:
    """Let some customers say who may serve them, now and then somebody unknown. In place."""
    names = _names_of_vehicles(rng, request)
    for customer in request["customers"]:
        if rng.random() < 0.5:
            which = rng.choice(("allowed", "forbidden"))
            customer["vehicles"] = {which: rng.sample(names, rng.randint(1, min(3, len(names))))}
