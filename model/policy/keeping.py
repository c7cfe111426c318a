"""Parts of a plan that a further sample keeps, so that it plans anew only what is near a customer.

As ruin and recreate does, with the policy to recreate. Vehicles don't meet in the decision process,
so the actions of any of them are legal in any order. Where orders bind some to others, all is new.
"""

import numpy as np

from model.engine.instance import Instance
from model.problem import BoolArray, IntArray
from model.simulation.actions import DRIVE, LAUNCH, NUM_KINDS, OPEN

LEAST_ANEW, MOST_ANEW = 0.15, 0.9
"""Bounds of the share of its customers that are planned anew, whose logarithm is uniform."""

MOST_ANEW_GREEDILY = 0.6
"""The upper bound where nothing is drawn: most of what is larger was planned likewise before."""


def part_to_keep(instance: Instance, actions: IntArray, most_anew: float,
                 rng: np.random.Generator) -> IntArray:
    """Return the actions of a plan that a further sample begins with.

    Parameters
    ----------
    instance
        The problem, packed alone.
    actions
        Codes of all actions of the plan, from the first on.
    most_anew
        Upper bound of the share of its customers that are left out; `LEAST_ANEW` is the lower.
    rng
        Chooses a customer and a share. The vehicles that serve those nearest are left out until
        they serve the share; what would be too much of the last, it does first.

    Returns
    -------
    Codes of the actions kept, those of whole vehicles first.
    """
    vehicle, services = _vehicles(actions), np.flatnonzero(serves(actions))
    if len(services) == 0 or instance.across.shape[1]:
        return actions[:0]
    nearest_first = _nearby(instance, actions[services] // NUM_KINDS, vehicle[services], rng)
    anew = np.cumsum(np.bincount(vehicle[services])[nearest_first])
    wanted = LEAST_ANEW * (most_anew / LEAST_ANEW) ** rng.random() * len(services)
    last = int(np.searchsorted(anew, wanted))
    whole = np.isin(vehicle, nearest_first[last + 1 :])
    of_last = actions[vehicle == nearest_first[last]]
    share = (anew[last] - wanted) / (anew[last] - (anew[last - 1] if last > 0 else 0))
    return np.concatenate([actions[whole], of_last[: int(len(of_last) * share)]])


def vehicles_nearby(instance: Instance, actions: IntArray, rng: np.random.Generator) -> IntArray:
    """Return the vehicles of a plan, those first that serve who is nearest to a customer drawn.

    Parameters
    ----------
    instance
        The problem, packed alone.
    actions
        Codes of all actions of the plan, from the first on.
    rng
        Draws the customer.
    """
    services = np.flatnonzero(serves(actions))
    if len(services) == 0:
        return services
    return _nearby(instance, actions[services] // NUM_KINDS, _vehicles(actions)[services], rng)


def _nearby(instance: Instance, node: IntArray, vehicle: IntArray,
            rng: np.random.Generator) -> IntArray:
    """As `vehicles_nearby`; `node` and `vehicle` are who is served, and by whom."""
    drive = instance.duration[0, 0, rng.choice(node), node]
    _, first = np.unique(vehicle[np.argsort(drive, kind="stable")], return_index=True)
    return np.argsort(first, kind="stable")


def _vehicles(actions: IntArray) -> IntArray:
    """Return (action,) the number of the vehicle that acts, counted from 0 on."""
    return np.cumsum(actions % NUM_KINDS == OPEN) - 1


def serves(actions: IntArray) -> BoolArray:
    """Tell which actions serve a customer."""
    kind = actions % NUM_KINDS
    return (kind == DRIVE) | (kind == LAUNCH)
