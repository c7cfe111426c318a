"""Parcels that one vehicle fetches at one place and brings to another."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from model.problem.quantities import require, require_quantity

MOST_DETOUR = 10**9
"""The largest multiple of a direct leg, in thousandths."""


@dataclass(frozen=True, slots=True)
class Shipment:
    """A parcel that is fetched from one customer and brought to another on the same trip."""

    id: str
    pickup: int  # node
    delivery: int  # node, reached later
    amount: tuple[int, ...]  # (dimension,) parts, aboard between
    max_time_between: int | None = None  # from the end of service there to its start here
    max_detour: int | None = None  # the same, in thousandths of the direct leg's duration

    def __post_init__(self) -> None:
        for amount in self.amount:
            require_quantity(f"shipment {self.id} amount", amount)
        require_quantity(f"shipment {self.id} max_time_between", self.max_time_between or 0)
        require(self.max_detour is None or 1000 <= self.max_detour <= MOST_DETOUR,
                f"shipment {self.id} max_detour", self.max_detour)

    def renumbered(self, number: Mapping[int, int]) -> "Shipment":
        """Return the same shipment where nodes have other numbers."""
        return replace(self, pickup=number[self.pickup], delivery=number[self.delivery])

    @property
    def is_limited(self) -> bool:
        """Tell whether the parcel may be under way for so long and no longer."""
        return self.max_time_between is not None or self.max_detour is not None

    def longest_between(self, direct: int) -> int | None:
        """Return how long it may be under way, where the direct leg takes so long; None: ever."""
        limits = [limit for limit in (
            self.max_time_between,
            None if self.max_detour is None else direct * self.max_detour // 1000,
        ) if limit is not None]
        return min(limits, default=None)
