"""Running plans, which belong to the engine, and what Python sees of them."""

from typing import TYPE_CHECKING, Any

import numpy as np

from model.engine.handle import Handle
from model.engine.instance import Instance
from model.engine.lent import lent_fields
from model.engine.library import call, dtype_of
from model.engine.records import Record, Records
from model.problem import FloatArray, IntArray

NO_VEHICLE = -1
"""Type of the vehicle under way where there is none."""


class State:
    """Running plans, a row per rollout, then scratch rows: what `tandem_state_seen` has, by name.
    """

    def __init__(self, instance: Instance, rollouts: IntArray, num_scratch: int) -> None:
        """Begin rollouts, as `reset` says."""
        self._own = Handle("state", instance, rollouts, num_scratch)
        vars(self).update(lent_fields("tandem_look_at_state", self._own))

    if TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any:
            """Return what is seen."""

    @property
    def pointer(self) -> Any:
        """Return what functions of the engine take."""
        return self._own.pointer

    def under_way(self, r: int) -> Record:
        """Return the open vehicle of a rollout, of type `NO_VEHICLE` if none is on a trip."""
        return call("tandem_look_at_vehicle", self, r)


def empty_costs(rows: int) -> Records:
    """Return rows that hold no cost yet of any term."""
    return np.zeros(rows, dtype_of("tandem_cost"))


def empty_outlooks(*shape: int) -> Records:
    """Return rows for what actions on customers lead to."""
    return np.zeros(shape, dtype_of("tandem_outlook"))


def by_term(cost: Records) -> FloatArray:
    """Return costs as a table of numbers, (row, term), of all `COST_TERMS` but `changes`."""
    return cost.view(np.float64).reshape(len(cost), -1)
