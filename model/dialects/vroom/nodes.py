"""The planner's nodes: starts and ends of vehicles, and jobs in their time windows."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from model.dialects.vroom.kinds import Kind
from model.dialects.vroom.places import NOWHERE, Places
from model.dialects.vroom.request import Window
from model.problem import MAX_QUANTITY, BoolArray, IntArray

PARTS = 1000
"""The planner's unit is a thousandth: of a second, of a metre, of a unit of cost."""

LONGEST = MAX_QUANTITY // PARTS
"""Seconds, metres and costs of a leg above this count as this; it is longer than any plan."""

Slots = Mapping[int, Sequence[Window | None]]
"""Time windows by the index of the job, in order; None: any time."""


@dataclass(frozen=True, eq=False)
class Nodes:
    """Starts and ends of vehicles, the planner's depots; then jobs, each in all its windows."""

    depots: tuple[int, ...]  # sites, perhaps NOWHERE
    jobs: tuple[int, ...]  # index into the request's jobs
    windows: tuple[Window | None, ...]  # of each of these
    sites: IntArray  # (node,) site or NOWHERE

    @classmethod
    def of(cls, places: Places, kinds: Sequence[Kind], slots: Slots) -> "Nodes":
        """Return the nodes for vehicles and jobs."""
        depots = tuple(dict.fromkeys(site for kind in kinds for site in (kind.start, kind.end)))
        chosen = [(job, window) for job, windows in slots.items() for window in windows]
        jobs = tuple(job for job, _ in chosen)
        sites = np.concatenate([np.array(depots, np.int64), places.jobs[list(jobs)]])
        return cls(depots, jobs, tuple(window for _, window in chosen), sites)

    def of_job(self) -> dict[int, list[int]]:
        """Return the nodes of each job, one for each of its windows."""
        nodes: dict[int, list[int]] = {}
        for node, job in enumerate(self.jobs, start=len(self.depots)):
            nodes.setdefault(job, []).append(node)
        return nodes

    def first_of_each_job(self) -> IntArray:
        """Return indices into `jobs` that name each job once."""
        return np.unique(np.array(self.jobs, np.int64), return_index=True)[1]

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
