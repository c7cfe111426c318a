"""`CustomerInput` -> `Customer`."""

from collections.abc import Sequence
from itertools import pairwise

from app.requests.conversion.amounts import counted
from app.requests.conversion.units import by_name, thousandths
from app.schemas.customer import CustomerInput
from model.problem import UNLIMITED, Customer


def to_customer(stated: CustomerInput, decimals: Sequence[int],
                site: int | None = None) -> Customer:
    """Convert a valid customer; `decimals` by dimension, `site` as `sites_of` numbers it."""
    windows = stated.windows
    first, last = windows[0], windows[-1]
    return Customer(
        **by_name(stated, Customer),
        id=stated.id,
        demand=counted(stated.demand, decimals),
        pickup=() if stated.pickup is None else counted(stated.pickup, decimals),
        earliest=thousandths(first.earliest),
        latest=UNLIMITED if last.latest is None else thousandths(last.latest),
        late_cost_per_hour=last.late_cost_per_hour,
        late_cost=last.late_cost,
        early_cost_per_hour=first.early_cost_per_hour,
        served_by=stated.served_by,
        skills=frozenset(stated.skills),
        gaps=() if first is last else tuple(
            [(thousandths(window.latest or 0.0), thousandths(following.earliest))
             for window, following in pairwise(windows)]),
        goods=frozenset(stated.goods),
        site=site,
    )
