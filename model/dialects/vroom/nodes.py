"""The planner's nodes: starts and ends of vehicles, and jobs."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from model.dialects.vroom.places import NOWHERE, Sites
from model.problem import MAX_QUANTITY, BoolArray, IntArray

PARTS = 1000
"""The planner's unit is a thousandth: of a second, of a metre, of a unit of cost."""

LONGEST = MAX_QUANTITY // PARTS
"""Seconds, metres and costs of a leg above this count as this; it is longer than any plan."""


class Terminus(NamedTuple):
    """Where a route starts or ends."""

    site: int  # perhaps NOWHERE
    opens: int | None = None  # second after which any route is over


@dataclass(frozen=True, eq=False)
class Nodes:
    """Starts and ends of vehicles, the planner's depots; then jobs."""

    depots: tuple[Terminus, ...]
    jobs: tuple[int, ...]  # index into the request's jobs
    sites: IntArray  # (node,) site or NOWHERE

    @classmethod
    def of(cls, places: Sites, ends: Sequence[tuple[Terminus, Terminus]],
           jobs: Sequence[int]) -> "Nodes":
        """Return the nodes for jobs, and for the starts and ends of kinds of vehicles."""
        depots = tuple(dict.fromkeys(end for both in ends for end in both))
        sites = np.concatenate([np.array([end.site for end in depots], np.int64),
                                places.jobs[list(jobs)]])
        return cls(depots, tuple(jobs), sites)

    def of_job(self) -> dict[int, int]:
        """Return the node of each job."""
        return {job: node for node, job in enumerate(self.jobs, start=len(self.depots))}

    def spread(self, matrix: IntArray) -> IntArray:
        """Return a matrix of sites with a row and a column for each node, 0 from and to nowhere."""
        spread = at_most_longest(matrix)[np.ix_(self.sites, self.sites)]
        spread[self.sites == NOWHERE] = 0
        spread[:, self.sites == NOWHERE] = 0
        return spread

    def changes_place(self) -> BoolArray:
        """Return (node, job) whether a job is at another place than the node before it."""
        differs: BoolArray = self.sites[:, None] != self.sites[len(self.depots):]
        return differs


def at_most_longest(matrix: IntArray) -> IntArray:
    """Return a matrix with entries that the planner can add up."""
    bounded: IntArray = np.minimum(matrix, LONGEST)
    return bounded
