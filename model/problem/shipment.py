"""Parcels that one vehicle fetches at one place, or several, and brings to another."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from model.problem.customer import Customer
from model.problem.quantities import MAX_QUANTITY, Milliseconds, Parts, require, require_units

MOST_DETOUR = 10**9
"""The largest multiple of a direct leg, in thousandths."""

MOST_PICKUPS = 8
"""At most so many places where one shipment is fetched."""


Amount = tuple[Parts, ...]  # (dimension,)


@dataclass(frozen=True, slots=True)
class Part:
    """What of a shipment is fetched at one place."""

    pickup: int  # node
    amount: Amount


@dataclass(frozen=True, slots=True)
class Shipment:
    """A parcel that is fetched from one customer, or in parts from several, and brought to another
    on the same trip.
    """

    id: str
    pickup: int  # node
    delivery: int  # node, reached later
    amount: Amount  # aboard between
    max_time_between: Milliseconds | None = None  # from the end of service there to its start here
    max_detour: int | None = None  # the same, in thousandths of the direct leg's duration
    more: tuple[Part, ...] = ()  # what else is fetched, elsewhere

    def __post_init__(self) -> None:
        require(len(self.more) < MOST_PICKUPS, f"shipment {self.id} pickups", len(self.parts))
        for each in (self, *self.more):
            require_units(each, f"shipment {self.id}")
        most = max(self.total, default=0)
        require(most <= MAX_QUANTITY, f"shipment {self.id} amount", most)
        require(self.max_detour is None or 1000 <= self.max_detour <= MOST_DETOUR,
                f"shipment {self.id} max_detour", self.max_detour)

    def require_ends(self, ends: Sequence[Customer]) -> None:
        """Refuse ends, in the order of `nodes`, that ask for something else, or not for one parcel.

        Where it is delivered something may come from the depot as well.
        """
        for end in ends:
            brings = any(end.demand) and end is not ends[-1]
            require(not brings and not any(end.pickup), f"customer {end.id} demand", end.demand)
            for part in self.parts:
                require(len(part.amount) == len(end.demand), f"shipment {self.id} amount",
                        part.amount)
        goods = {end.goods for end in ends}
        require(len(goods) == 1, f"shipment {self.id} goods", goods)

    def renumbered(self, number: Mapping[int, int]) -> "Shipment":
        """Return the same shipment where nodes have other numbers."""
        return replace(self, pickup=number[self.pickup], delivery=number[self.delivery],
                       more=tuple([replace(part, pickup=number[part.pickup])
                                   for part in self.more]))

    @property
    def parts(self) -> tuple[Part, ...]:
        """What is fetched at each place."""
        return (Part(self.pickup, self.amount), *self.more)

    @property
    def pickups(self) -> tuple[int, ...]:
        """The nodes where it is fetched."""
        return (self.pickup, *[part.pickup for part in self.more])

    @property
    def nodes(self) -> tuple[int, ...]:
        """The nodes of all its ends, that of the delivery last."""
        return (*self.pickups, self.delivery)

    @property
    def total(self) -> Amount:
        """What is delivered."""
        if not self.more:
            return self.amount
        return tuple([sum(amounts) for amounts in zip(
            *[part.amount for part in self.parts], strict=False)])

    def change_at(self, node: int) -> Amount:
        """Return by how much a stop at one of its ends changes what is aboard."""
        if node == self.delivery:
            return tuple([-amount for amount in self.total])
        return next(part.amount for part in self.parts if part.pickup == node)

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
