"""Random problems to train and validate on: the mix of all variants, which `variants` lists."""

from collections.abc import Callable, Sequence

import numpy as np

from model.problem import Problem
from training.relations import chosen, related, shipments
from training.mixture import mixed
from training.particulars import particular
from training.pickups import pickups
from training.resting import resting
from training.variants import (
    InstanceConfig,
    appointed,
    cvrp,
    drone,
    hetero,
    multitrip,
    soft,
    table1,
    vrptw,
)
from training.variety import various

__all__ = ["ALL", "VARIANTS", "InstanceConfig", "generate", "sample_variant", "validation_set"]

VARIANTS: dict[str, Callable[[np.random.Generator, int, InstanceConfig], Problem]] = {
    "cvrp": cvrp,
    "vrptw": vrptw,
    "soft": soft,
    "hetero": hetero,
    "multitrip": multitrip,
    "drone": drone,
    "table1": table1,
    "mixed": mixed,
    "appointed": appointed,
    "pickups": pickups,
    "various": various,
    "particular": particular,
}
"""Variants by which all parts of the planner are tested."""

ALL = {
    **VARIANTS,
    "shipments": shipments,
    "chosen": chosen,
    "related": related,
    "resting": resting,
}
"""Variants by which policies are trained."""

VALIDATED = ("cvrp", "vrptw", "soft", "hetero", "multitrip", "drone", "table1", "mixed")
"""Variants of the validation set, which stays as it is when others come."""

COMPARED = (*VALIDATED, "appointed")
"""Variants on which versions of this planner are compared, which stay as they are, too."""

SHARES = {"cvrp": 0.04, "vrptw": 0.16, "soft": 0.04, "hetero": 0.04, "multitrip": 0.05,
          "drone": 0.08, "table1": 0.1, "mixed": 0.06, "appointed": 0.05, "pickups": 0.05,
          "various": 0.05, "particular": 0.05, "shipments": 0.1, "chosen": 0.04, "related": 0.05,
          "resting": 0.04}
"""How often training draws each variant."""

CUMULATIVE_SHARES = np.cumsum(list(SHARES.values()))

DEFAULT_CONFIG = InstanceConfig()

VALIDATION_SIZES = (20, 50, 20, 50, 100)
"""Customers of the validation set's instances, in turn."""


def generate(rng: np.random.Generator, num_customers: int, variant: str,
             config: InstanceConfig = DEFAULT_CONFIG) -> Problem:
    """Draw a problem.

    Raises
    ------
    ValueError
        If the variant is unknown or there is no customer.
    """
    if variant not in ALL:
        raise ValueError(f"variant: {variant!r} is not one of {', '.join(ALL)}")
    if num_customers < 1:
        raise ValueError(f"num_customers: {num_customers!r} is not allowed")
    return ALL[variant](rng, num_customers, config)


def sample_variant(rng: np.random.Generator) -> str:
    """Draw the name of a variant by `SHARES`."""
    names = tuple(SHARES)
    return names[min(int(np.searchsorted(CUMULATIVE_SHARES, rng.random(), "right")),
                     len(names) - 1)]


def validation_set(size: int = 200, seed: int = 20_250_926,
                   names: Sequence[str] = VALIDATED) -> list[tuple[str, Problem]]:
    """Return the named problems that every run is measured on.

    Variants, usually `VALIDATED`, take turns, then sizes (40 % of 20 customers, 40 % of 50, 20 % of
    100): by default each has 10, 10 and 5. Each problem has its own stream, so a smaller set is a
    prefix of a larger one.
    """
    problems = []
    for index in range(size):
        variant = names[index % len(names)]
        num_customers = VALIDATION_SIZES[index // len(names) % len(VALIDATION_SIZES)]
        rng = np.random.default_rng((seed, index))
        problems.append((f"{variant}-n{num_customers}-{index:03d}",
                         generate(rng, num_customers, variant)))
    return problems
