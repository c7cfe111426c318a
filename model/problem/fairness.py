"""What a plan costs as a whole: its end, how unequal its vehicles' work is, and too few of them."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

from model.problem.quantities import (
    Count, Milliseconds, Money, MoneyPerHour, require_rate, require_units,
)

Measure = Literal["duration", "stops", "load", "distance"]


@dataclass(frozen=True)
class Balance:
    """What unequal work costs: by the squares of what each vehicle used differs from the mean."""

    measure: Measure
    cost: float  # of each such square / mean, in hours, stops, units or km

    def __post_init__(self) -> None:
        require_rate("balance cost", self.cost)


class Before(NamedTuple):
    """What a vehicle has done that has worked already."""

    kinds: frozenset[int]  # indices of types that are this vehicle and no other
    share: int  # in ms, stops, parts or mm


@dataclass(frozen=True)
class Fairness:
    """Prices of a plan as a whole."""

    makespan_cost_per_hour: MoneyPerHour = 0.0  # of the latest end of all, since plan start
    balance: Balance | None = None
    min_vehicles: Count = 0  # how many are to be used
    too_few_cost: Money = 0.0  # of each vehicle fewer, more than using one costs
    before: tuple[Before, ...] = ()  # vehicles that are used in any case
    last_end: Milliseconds = 0  # when those of them are done that do nothing more

    def __post_init__(self) -> None:
        require_units(self, "fairness")

    @property
    def is_stated(self) -> bool:
        """Tell whether anything of the plan as a whole costs."""
        balance = self.balance
        return (self.makespan_cost_per_hour > 0 or self.min_vehicles > 0
                or (balance is not None and balance.cost > 0))


UNPRICED = Fairness()
"""Nothing of the plan as a whole costs."""
