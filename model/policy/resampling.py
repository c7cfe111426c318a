"""Parts of a plan that a further sample keeps, so that it plans anew only what is near a customer.

As ruin and recreate does, with the policy to recreate. Vehicles don't meet in the decision process,
so the actions of any of them are legal in any order.
"""

import numpy as np

from model.kernel.instance import Instance
from model.problem import IntArray
from model.simulation.simulator import DRIVE, LAUNCH, NUM_KINDS, OPEN

LEAST_ANEW, MOST_ANEW = 0.15, 0.7
"""Bounds of the share of its customers that are planned anew, whose logarithm is uniform."""


def part_to_keep(instance: Instance, actions: IntArray, rng: np.random.Generator) -> IntArray:
    """Return the actions of a plan that a further sample begins with.

    Parameters
    ----------
    instance
        The problem, packed alone.
    actions
        Codes of all actions of the plan, from the first on.
    rng
        Chooses a customer and a share. The vehicles that serve those nearest are left out until
        they serve the share; what would be too much of the last, it does first.

    Returns
    -------
    Codes of the actions kept, those of whole vehicles first.
    """
    kind, node = actions % NUM_KINDS, actions // NUM_KINDS
    vehicle = np.cumsum(kind == OPEN) - 1
    services = np.flatnonzero((kind == DRIVE) | (kind == LAUNCH))
    if len(services) == 0:
        return actions[:0]
    drive = instance.duration[0, 0, node[rng.choice(services)], node[services]]
    _, first = np.unique(vehicle[services[np.argsort(drive, kind="stable")]], return_index=True)
    nearest_first = np.argsort(first, kind="stable")
    anew = np.cumsum(np.bincount(vehicle[services])[nearest_first])
    wanted = LEAST_ANEW * (MOST_ANEW / LEAST_ANEW) ** rng.random() * len(services)
    last = int(np.searchsorted(anew, wanted))
    whole = np.isin(vehicle, nearest_first[last + 1 :])
    of_last = actions[vehicle == nearest_first[last]]
    share = (anew[last] - wanted) / (anew[last] - (anew[last - 1] if last > 0 else 0))
    return np.concatenate([actions[whole], of_last[: int(len(of_last) * share)]])
