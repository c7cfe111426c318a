"""How wild requests are planned, and what their plans cost as a whole."""

import random
from typing import Any

MEASURES = "duration", "stops", "load", "distance"


def wild_fairness(rng: random.Random) -> dict[str, Any]:
    """Return what a plan costs as a whole, from nothing to all the money there is."""
    stated: dict[str, Any] = {"makespan_cost_per_hour": rng.choice((0, 30, 1e12))}
    if rng.random() < 0.7:
        stated["balance"] = {"measure": rng.choice(MEASURES), "cost": rng.choice((0, 5, 1e12))}
    if rng.random() < 0.3:
        stated["min_vehicles"] = 1
    return stated


def wild_options(rng: random.Random) -> dict[str, Any]:
    """Return how to plan."""
    return {
        "policy": rng.choice(("attention", "attention", "attention", "pointer")),
        "decoding": rng.choice(("greedy", "greedy", "sample")), "num_samples": rng.randint(1, 9),
        "temperature": rng.choice((0.01, 0.7, 1.0, 100)),
        "seed": rng.choice((0, 1, 2**63 - 1)), "threads": rng.choice((None, 1, 2)),
        "time_limit": rng.choice((0, 1e-9, 0.001, 0.03, 0.1)),
        "search_iterations": rng.choice((None, None, 0, 1, 100))}
