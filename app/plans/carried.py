"""What requests say of customers for drivers, put beside their stops in a reply."""

from collections.abc import Iterator, Mapping
from typing import Any

from app.schemas.customer import place_name
from app.schemas.request import PlanRequest
from app.schemas.shipment import ENDS, end_name

Info = Mapping[str, Mapping[str, str]]
"""What is said of customers, by their ids."""


def info_of(request: PlanRequest) -> Info:
    """Return what a request says of its customers, of those of whom it says anything."""
    return {customer.id: customer.info for customer in request.customers if customer.info}


def carry(info: Info, reply: dict[str, Any]) -> None:
    """Put what is said of customers at their stops and flights. In place."""
    if not info:
        return
    for visit in _visits(reply):
        kind, name = named(visit)
        if kind == "customer" and name in info:
            visit["info"] = dict(info[name])


def named(visit: Mapping[str, Any]) -> tuple[str, str]:
    """Return the kind of a visit of a reply, and its name; a customer's is that among them all."""
    kind, name = visit.get("kind", "customer"), visit["id"]
    if kind in ENDS:
        return "customer", end_name(name, kind, visit.get("part"))
    other = visit.get("alternative")
    return kind, name if other is None else place_name(name, other)


def names_left_out(left: Mapping[str, Any]) -> list[str]:
    """Return the names among all customers of who a reply leaves out: of all ends of a shipment."""
    if left.get("kind") != "shipment":
        return [left["id"]]
    pickups = [end_name(left["id"], "pickup", part) for part in left.get("parts", (None,))]
    return [*pickups, end_name(left["id"], "delivery")]


def _visits(reply: dict[str, Any]) -> Iterator[dict[str, Any]]:
    for route in reply["routes"]:
        for trip in route["trips"]:
            yield from trip["stops"]
            for sortie in trip["sorties"]:
                yield from sortie["customers"]
