"""Who goes with whom, and who doesn't."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

from model.problem.quantities import require

MOST_RELATIONS = 62
"""Most relations that keep customers together; likewise apart, incompatible goods counted."""

RelationKind = Literal["together", "apart"]


@dataclass(frozen=True, slots=True)
class Relation:
    """Customers who go together, or no two of whom do; it binds those alone who are served."""

    kind: RelationKind
    nodes: tuple[int, ...]
    scope: Literal["vehicle", "trip"] = "vehicle"

    def __post_init__(self) -> None:
        require(len(set(self.nodes)) == len(self.nodes) >= 2, f"relation {self.kind}", self.nodes)

    @property
    def keeps_together(self) -> bool:
        """Tell whether one vehicle serves all of those who are served."""
        return self.kind != "apart"

    def among(self, number: Mapping[int, int]) -> "Relation | None":
        """Return it for those who have a new number; None if it says nothing of them."""
        nodes = tuple([number[node] for node in self.nodes if node in number])
        return replace(self, nodes=nodes) if len(nodes) > 1 else None
