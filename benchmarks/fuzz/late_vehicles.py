"""Plans under way of which one vehicle is later than planned."""

import copy
import random
from itertools import pairwise
from typing import Any

Data = dict[str, Any]
Leg = tuple[str, int, str, str]
"""Vehicle, its trip, and ids of the places."""


def with_a_late_vehicle(rng: random.Random, plan: Data) -> tuple[Data, float] | None:
    """Return a plan of which a vehicle is late for its next stop, and when it is on its way there.

    Nothing is stated of what follows. None if no vehicle drives.
    """
    late = copy.deepcopy(plan)
    legs = [leg for route in late["routes"] for trip in route["trips"]
            for leg in pairwise(trip["stops"])
            if leg[1]["kind"] != "break" and leg[0]["departure"] < leg[1]["arrival"] - 1]
    if not legs:
        return None
    before, stop = rng.choice(legs)
    now = rng.uniform(before["departure"], stop["arrival"] - 1)
    delay = rng.choice((1, 60, 600, 3600))
    for name in ("arrival", "service_start", "departure"):
        stop[name] += delay
    return {"routes": late["routes"], "unassigned": late["unassigned"]}, round(now, 3)


def legs_of(plan: Data) -> dict[Leg, float]:
    """Return how long the shortest way between two places takes on each trip, without breaks."""
    legs: dict[Leg, float] = {}
    for route in plan["routes"]:
        for number, trip in enumerate(route["trips"]):
            for before, stop in pairwise(trip["stops"]):
                if "break" not in (before["kind"], stop["kind"]):
                    places = (route["vehicle"], number, before["id"], stop["id"])
                    lasts = stop["arrival"] - before["departure"]
                    legs[places] = min(lasts, legs.get(places, lasts))
    return legs
