"""What customers ask to be aboard, as rows for the engine."""

from collections.abc import Sequence

import numpy as np

from model.engine.breaks import limits_loads
from model.problem import Customer, IntArray, Problem

DIMENSIONS_PER_TIER = 3
"""How many dimensions of load are looked at together."""


def padded(amount: Sequence[int], length: int) -> tuple[int, ...]:
    """Return so many dimensions of an amount, zero in those that the problem doesn't have."""
    return (*amount[:length], *(0,) * (length - len(amount)))


def num_tiers(problems: Sequence[Problem], size: int) -> int:
    """Return how many tiers of so many dimensions loads have to be looked at in at each stop."""
    tiers = max(-(-problem.num_dimensions // size) for problem in problems)
    changes = any(problem.shipments or any(any(customer.pickup) for customer in problem.customers)
                  for problem in problems)
    counts = any(kind.cost_per_load_km or limits_loads(kind)
                 for problem in problems for kind in problem.vehicle_types)
    return tiers if tiers > 1 or changes or counts else 0


def write_amounts(rows: IntArray, customers: Sequence[Customer], size: int) -> None:
    """Write what is delivered and picked up, (customer, tier, amount), in tiers of so many
    dimensions. In place.
    """
    tiers = rows.shape[1]
    if not tiers:
        return
    shape = len(customers), tiers, size
    for first, amounts in ((0, [customer.demand for customer in customers]),
                           (size, [customer.pickup for customer in customers])):
        table = np.array([padded(amount, tiers * size) for amount in amounts], np.int64)
        rows[:, :, first:first + size] = table.reshape(shape)
        rows[:, :, 2 * size + first // size] = table.sum(axis=1)[:, None]
