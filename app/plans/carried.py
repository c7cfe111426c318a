"""What requests say of customers for drivers, put beside their stops in a reply."""

from collections.abc import Iterator, Mapping
from typing import Any

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
    for halt in _halts(reply):
        kind = halt.get("kind", "customer")
        name = end_name(halt["id"], kind) if kind in ENDS else halt["id"]
        if kind in ("customer", *ENDS) and name in info:
            halt["info"] = dict(info[name])


def _halts(reply: dict[str, Any]) -> Iterator[dict[str, Any]]:
    for route in reply["routes"]:
        for trip in route["trips"]:
            yield from trip["stops"]
            for sortie in trip["sorties"]:
                yield from sortie["customers"]
