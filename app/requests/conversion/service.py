"""How long vehicle types serve customers who state a duration of their own for them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from app.requests.conversion.names import drones_of
from app.requests.conversion.units import thousandths
from app.schemas.customer import CustomerInput, place_name
from model.problem import VehicleType


def with_service_durations(kinds: Sequence[VehicleType],
                           customers: Sequence[CustomerInput]) -> tuple[VehicleType, ...]:
    """Return vehicle types that know of the durations which customers state for them."""
    stated: dict[str, dict[str, int]] = {}
    for customer in customers:
        for name, seconds in customer.service_duration_by_type.items():
            stated.setdefault(name, {})[customer.id] = thousandths(seconds)
    by_whomever = {name: thousandths(seconds) for name, seconds in by_any(customers).items()}
    if not stated and not by_whomever:
        return tuple(kinds)
    return tuple([_with_durations(kind, stated, by_whomever) for kind in kinds])


def by_any(customers: Sequence[CustomerInput]) -> dict[str, float]:
    """Return how many seconds whoever comes, by truck or drone, is at places that state it."""
    return {place_name(customer.id, place.id): place.service_duration for customer in customers
            for place in customer.alternatives if place.service_duration is not None}


def _with_durations(kind: VehicleType, stated: Mapping[str, Mapping[str, int]],
                    by_whomever: Mapping[str, int]) -> VehicleType:
    kind = replace(kind, service_durations=stated.get(kind.id, {}))
    if kind.drones is None:
        return kind
    first, *others = [
        replace(drones, service_durations={
            **stated.get(drones_of(kind.id, drones.id), {}),
            **(by_whomever if drones.service_duration is not None else {})})
        for drones in kind.drone_types]
    return replace(kind, drones=first, more_drones=tuple(others))
