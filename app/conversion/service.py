"""How long vehicle types serve customers who state a duration of their own for them."""

from collections.abc import Sequence
from dataclasses import replace

from app.conversion.names import drones_of
from app.conversion.units import thousandths
from app.schemas.customer import CustomerInput
from model.problem import VehicleType


def with_service_durations(kinds: Sequence[VehicleType],
                           customers: Sequence[CustomerInput]) -> tuple[VehicleType, ...]:
    """Return vehicle types that know of the durations which customers state for them."""
    stated: dict[str, dict[str, int]] = {}
    for customer in customers:
        for name, seconds in customer.service_duration_by_type.items():
            stated.setdefault(name, {})[customer.id] = thousandths(seconds)
    if not stated:
        return tuple(kinds)
    return tuple(
        replace(kind, service_durations=stated.get(kind.id, {}),
                drones=None if kind.drones is None else replace(
                    kind.drones, service_durations=stated.get(drones_of(kind.id), {})))
        for kind in kinds)
