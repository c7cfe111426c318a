"""A published instance as its file states it, and the ways to round its distances."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from app.requests.conversion.rounding import rounded
from app.schemas.errors import RequestError
from app.schemas.fields import Rounding
from model.problem import FloatArray
from model.travel.matrices import planar_distances

EdgeWeight = Literal["EUC_2D", "FLOOR_2D", "CEIL_2D", "EXACT_2D", "EXPLICIT"]


class InstanceFileError(RequestError, name="not-an-instance"):
    """A file that holds no instance, or one with rules that Tandem doesn't know."""

    title = "The file can't be converted"


@dataclass(frozen=True)
class FileVehicles:
    """Equal vehicles of an instance file, in its units."""

    count: int
    capacity: float  # per trip
    fixed_cost: float = 0.0  # per vehicle used
    unit_cost: float = 1.0  # per unit of distance
    depot: int = 0  # node
    max_trips: int | None = 1  # None: any number
    max_distance: float | None = None
    max_duration: float | None = None


@dataclass(frozen=True, eq=False)
class InstanceFile:
    """An instance in the units of its file; nodes are in the file's order, from 0."""

    name: str
    depots: tuple[int, ...]  # nodes
    coordinates: FloatArray | None  # (node, 2); None only with EXPLICIT
    edge_weight: EdgeWeight
    explicit_weights: FloatArray | None  # (node, node); None but with EXPLICIT
    demand: FloatArray  # (node,)
    earliest: FloatArray  # (node,) a depot's window is when its vehicles may be out
    latest: FloatArray  # (node,) inf where there is no limit
    service: FloatArray  # (node,)
    release: FloatArray  # (node,)
    vehicles: tuple[FileVehicles, ...]

    @property
    def num_nodes(self) -> int:
        """Depots and customers."""
        return len(self.demand)

    @cached_property
    def has_windows(self) -> bool:
        """Whether any node has a time window."""
        return bool((self.earliest > 0).any() or np.isfinite(self.latest).any())

    @cached_property
    def has_releases(self) -> bool:
        """Whether any node is released after the start."""
        return bool(self.release.any())

    def customers(self) -> list[int]:
        """Return the nodes that are no depots, in order."""
        return [node for node in range(self.num_nodes) if node not in self.depots]


def distances(file: InstanceFile, rounding: Rounding) -> FloatArray:
    """Return the (node, node) distances, which are travel durations too, in the file's unit."""
    return rounded(_weights(file), rounding)


def _weights(file: InstanceFile) -> FloatArray:
    """Return the distances as the file defines them."""
    if file.explicit_weights is not None:
        return file.explicit_weights
    if file.coordinates is None:
        raise InstanceFileError(f"EDGE_WEIGHT_TYPE {file.edge_weight} needs NODE_COORD_SECTION.")
    straight = planar_distances(file.coordinates)
    if file.edge_weight == "FLOOR_2D":
        return np.floor(straight)
    if file.edge_weight == "CEIL_2D":
        return np.ceil(straight)
    if file.edge_weight == "EXACT_2D":
        return rounded(straight * 1000, "round")
    return straight
