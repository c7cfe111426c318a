"""Who goes with whom, who doesn't, and who is served before whom."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Literal, NamedTuple

from model.problem.quantities import UNLIMITED, Milliseconds, require, require_units

MOST_RELATIONS = 62
"""Most relations that keep customers together; likewise apart, incompatible goods counted."""

MOST_IN_ORDER = 20
"""Most customers who are served one before another by one relation."""

MOST_PLACES = 9
"""Most places of a customer."""

RelationKind = Literal["together", "apart", "before"]


SINCE_PLAN_START = 0
"""Instead of a customer served before: no customer, since depots come first."""


class Lag(NamedTuple):
    """How long after service begins at one customer it begins at another, in ms."""

    node: int  # the one who is served before, or `SINCE_PLAN_START`
    least: int
    most: int


def by_node(lags: Iterable[tuple[int, Lag]]) -> dict[int, tuple[Lag, ...]]:
    """Return all lags of each node."""
    found: dict[int, tuple[Lag, ...]] = {}
    for node, lag in lags:
        found[node] = (*found.get(node, ()), lag)
    return found


@dataclass(frozen=True, slots=True)
class Relation:
    """Customers who go together, or no two of whom do; it binds those alone who are served.

    Those of `before` go together, too, in their order, unless it says so `across` vehicles.
    """

    kind: RelationKind
    nodes: tuple[int, ...]
    scope: Literal["vehicle", "trip"] = "vehicle"
    min_lag: Milliseconds = 0  # from the start of service at any to that at all named behind
    max_lag: Milliseconds | None = None  # to that of who is named next
    across: bool = False  # any vehicles serve them, of `before`
    ranks: tuple[int, ...] = ()  # of nodes in the order, where some are missing; (): none is

    def __post_init__(self) -> None:
        name = f"relation {self.kind}"
        require(len(set(self.nodes)) == len(self.nodes) >= 2, name, self.nodes)
        require(self.kind == "before" or (self.min_lag, self.max_lag) == (0, None), name,
                (self.min_lag, self.max_lag))
        require_units(self, name)
        require(self.min_lag <= (UNLIMITED if self.max_lag is None else self.max_lag),
                f"{name} min_lag", self.min_lag)
        require(self.kind != "before" or len(self.nodes) <= MOST_IN_ORDER * MOST_PLACES, name,
                self.nodes)
        require(not self.across or (self.kind, self.scope) == ("before", "vehicle"), name,
                self.across)
        require(len(self.ranks) in (0, len(self.nodes)), f"{name} ranks", self.ranks)

    @property
    def keeps_together(self) -> bool:
        """Tell whether one vehicle serves all of those who are served."""
        return self.kind != "apart" and not self.across

    def lags(self, customer: Callable[[int], int]) -> Iterator[tuple[int, Lag]]:
        """Yield who is served behind whom, and how much later, whose `customer` any node is."""
        ranks = self.ranks or self._ranks(customer)
        ranked = list(zip(self.nodes, ranks, strict=True)) if self.kind == "before" else []
        for (one, place), (other, behind) in combinations(ranked, 2):
            later = behind - place
            if later > 0:
                most = UNLIMITED if self.max_lag is None or later > 1 else self.max_lag
                yield other, Lag(one, self.min_lag, most)

    def lags_across(self, customer: Callable[[int], int]) -> Iterator[tuple[int, Lag]]:
        """Yield for both of any two how much later than the other one is served, or less if before.
        """
        for node, lag in self.lags(customer) if self.across else ():
            yield node, lag
            yield lag.node, Lag(node, -lag.most, -lag.least)

    def _ranks(self, customer: Callable[[int], int]) -> tuple[int, ...]:
        """Return the place in the order of each node, whose `customer` any node is."""
        rank = {each: index for index, each in enumerate(dict.fromkeys(map(customer, self.nodes)))}
        return tuple([rank[customer(node)] for node in self.nodes])

    def among(self, number: Mapping[int, int],
              customer: Callable[[int], int]) -> "Relation | None":
        """Return it for those who have a new number; None if it says nothing of them."""
        left = [(number[node], rank) for node, rank
                in zip(self.nodes, self.ranks or self._ranks(customer), strict=True)
                if node in number]
        if len(left) < 2:
            return None
        nodes, ranks = zip(*left, strict=True)
        if self.kind != "before" or len(left) == len(self.nodes):
            ranks = self.ranks
        return replace(self, nodes=nodes, ranks=ranks)
