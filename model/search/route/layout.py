"""The problem as the search reads it."""

from typing import NamedTuple

from model.engine.instance import ProblemTables
from model.engine.structs import Struct
from model.problem import BoolArray

MOST_VISITS = 8
"""Customers on a sortie that the search puts there at most."""

NOWHERE = -1
"""Slot of a customer who is left out."""


class Strategy(Struct):
    """How a problem is searched: which moves there are, and where insertion looks."""


class PlanPrices(NamedTuple):
    """What a plan costs as a whole."""

    makespan: float  # per ms of its last end
    balance: float  # per part of the measure
    measure: int  # index into MEASURES
    min_vehicles: int
    too_few: float  # of each vehicle fewer
    used: float = 0.0  # how many vehicles, in any case
    sum: float = 0.0  # of their shares
    squares: float = 0.0  # of their shares
    latest: int = 0  # ms, their last end


MEASURES = "duration", "stops", "load", "distance"


class ProblemData(Struct):
    """The problem, unchanged by the search, and its tables."""

    @property
    def problem(self) -> ProblemTables:
        """Return the tables alone."""
        return ProblemTables(**{name: getattr(self, name) for name in ProblemTables._fields})


def are_kept(data: ProblemData) -> BoolArray:
    """Mark the nodes (none where nobody is) of customers who go together with others."""
    goods = data.goods
    kept: BoolArray = (goods["kept_on_trip"] | goods["kept_on_vehicle"]) != 0
    return kept
