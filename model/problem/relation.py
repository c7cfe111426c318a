"""Who goes with whom, who doesn't, and who is served before whom."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Literal, NamedTuple

from model.problem.quantities import MAX_QUANTITY, UNLIMITED, require

MOST_RELATIONS = 62
"""Most relations that keep customers together; likewise apart, incompatible goods counted."""

MOST_IN_ORDER = 20
"""Most customers who are served one before another by one relation."""

MOST_PLACES = 9
"""Most places of a customer."""

RelationKind = Literal["together", "apart", "before"]


class Lag(NamedTuple):
    """How long after service begins at one customer it begins at another, in ms."""

    node: int  # the one who is served before
    least: int
    most: int


@dataclass(frozen=True, slots=True)
class Relation:
    """Customers who go together, or no two of whom do; it binds those alone who are served.

    Those of `before` go together, too, in their order, unless it says so `across` vehicles.
    """

    kind: RelationKind
    nodes: tuple[int, ...]
    scope: Literal["vehicle", "trip"] = "vehicle"
    min_lag: int = 0  # ms from the start of service at any to that at all who are named behind
    max_lag: int | None = None  # ms to that of who is named next
    across: bool = False  # any vehicles serve them, of `before`

    def __post_init__(self) -> None:
        name = f"relation {self.kind}"
        require(len(set(self.nodes)) == len(self.nodes) >= 2, name, self.nodes)
        require(self.kind == "before" or (self.min_lag, self.max_lag) == (0, None), name,
                (self.min_lag, self.max_lag))
        require(0 <= self.min_lag <= (UNLIMITED if self.max_lag is None else self.max_lag),
                f"{name} min_lag", self.min_lag)
        require(max(self.min_lag, self.max_lag or 0) <= MAX_QUANTITY, f"{name} max_lag",
                self.max_lag)
        require(self.kind != "before" or len(self.nodes) <= MOST_IN_ORDER * MOST_PLACES, name,
                self.nodes)
        require(not self.across or (self.kind, self.scope) == ("before", "vehicle"), name,
                self.across)

    @property
    def keeps_together(self) -> bool:
        """Tell whether one vehicle serves all of those who are served."""
        return self.kind != "apart" and not self.across

    def lags(self, customer: Callable[[int], int]) -> Iterator[tuple[int, Lag]]:
        """Yield who is served behind whom, and how much later, whose `customer` any node is."""
        rank = {each: index for index, each in enumerate(dict.fromkeys(map(customer, self.nodes)))}
        for one, other in combinations(self.nodes if self.kind == "before" else (), 2):
            later = rank[customer(other)] - rank[customer(one)]
            if later > 0:
                most = UNLIMITED if self.max_lag is None or later > 1 else self.max_lag
                yield other, Lag(one, self.min_lag, most)

    def lags_across(self, customer: Callable[[int], int]) -> Iterator[tuple[int, Lag]]:
        """Yield for both of any two how much later than the other one is served, or less if before.
        """
        for node, lag in self.lags(customer) if self.across else ():
            yield node, lag
            yield lag.node, Lag(node, -lag.most, -lag.least)

    def among(self, number: Mapping[int, int]) -> "Relation | None":
        """Return it for those who have a new number; None if it says nothing of them."""
        nodes = tuple([number[node] for node in self.nodes if node in number])
        return replace(self, nodes=nodes) if len(nodes) > 1 else None
