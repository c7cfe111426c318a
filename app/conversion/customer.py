"""`CustomerInput` -> `Customer`."""

from collections.abc import Sequence

from app.conversion.amounts import counted
from app.conversion.units import thousandths
from app.schemas.customer import CustomerInput
from model.problem import UNLIMITED, Customer


def to_customer(stated: CustomerInput, decimals: Sequence[int]) -> Customer:
    """Convert a valid customer; `decimals` by dimension."""
    window = stated.time_window
    return Customer(
        id=stated.id,
        demand=counted(stated.demand, decimals),
        service_duration=thousandths(stated.service_duration),
        earliest=thousandths(window.earliest),
        latest=UNLIMITED if window.latest is None else thousandths(window.latest),
        late_cost_per_hour=window.late_cost_per_hour,
        early_cost_per_hour=window.early_cost_per_hour,
        served_by=stated.served_by,
        skills=frozenset(stated.skills),
        release_time=thousandths(stated.release_time),
        unassigned_cost=stated.unassigned_cost,
    )
