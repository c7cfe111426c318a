"""Shipments of wild problems, between places anywhere or where customers are."""

import random
from collections.abc import Callable
from typing import Any

Data = dict[str, Any]

LONGEST = 10**9


def add_shipments(rng: random.Random, request: Data, place: Callable[[], list[float]],
                  windows: Callable[[], Data]) -> None:
    """Let parcels be fetched and brought, half of them such as a vehicle can carry. In place."""
    dimensions = len(request["fleet"][0]["capacity"])
    places = [each["location"] for each in (*request["depots"], *request["customers"])]
    request["shipments"] = []
    for number in range(rng.choice((1, 1, 2, 4, 8))):
        fits = rng.random() < 0.5
        choices = (0, 1, 1, 2) if fits else (0, 1, 2.5, 1e-3, 40, LONGEST)
        parts = rng.choice((1, 1, 1, 1, 2, 3, 8))
        ends = [{"location": place() if rng.random() < 0.8 else rng.choice(places),
                 **({} if fits else _asked(rng) | windows()),
                 **_chosen(rng, 0.5, served_by="either")}
                for _ in range(parts + 1)]
        amounts = [[rng.choice(choices) for _ in range(dimensions)] for _ in range(parts)]
        fetched = {"amount": amounts[0], "pickup": ends[0]} if parts == 1 else {"pickups": [
            {"id": f"{part}", "amount": amount} | end
            for part, (amount, end) in enumerate(zip(amounts, ends, strict=False))]}
        request["shipments"].append({
            "id": f"📦 {number}", **fetched, "delivery": ends[-1],
            **_chosen(rng, 0.3, max_time_between=rng.choice((0, 1, 900, 7200, LONGEST))),
            **_chosen(rng, 0.3, max_detour=rng.choice((1, 1.0004, 2.5, 1e6))),
            **_chosen(rng, 0.2, unassigned_cost=rng.choice((None, 0, 1e-9, 3, 1000)))})


def _asked(rng: random.Random) -> Data:
    """Return what an end asks for, but for its windows."""
    return {**_chosen(rng, 0.5, service_duration=rng.choice((0, 1e-4, 60, 900, 1e5, LONGEST))),
            **_chosen(rng, 0.2, setup_duration=rng.choice((0, 60, 1e5)))}


def _chosen(rng: random.Random, share: float, **fields: Any) -> Data:
    """Return fields, or none of them."""
    return fields if rng.random() < share else {}


def ends_of(request: Data) -> list[Data]:
    """Return all ends of each shipment, in order."""
    return [end for shipment in request.get("shipments", ())
            for end in (*(shipment.get("pickups") or [shipment["pickup"]]), shipment["delivery"])]
