"""Where everything is, and the legs between."""

from collections.abc import Mapping
from dataclasses import dataclass

from model.problem import FloatArray, IntArray

NOWHERE = -1
"""Stands for the start or end that a vehicle doesn't have."""


@dataclass(frozen=True, eq=False)
class ProfileLegs:
    """Legs of one profile, (site, site), as stated or to whole seconds and metres."""

    durations: IntArray  # s
    distances: IntArray  # m, zeros if unknown
    costs: IntArray | None  # in place of those by hour and kilometre
    distances_known: bool


@dataclass(frozen=True, eq=False)
class Sites:
    """Sites are the distinct places of a request, numbered from 0."""

    jobs: IntArray  # (job,) site
    starts: IntArray  # (vehicle,) site or NOWHERE
    ends: IntArray
    map: FloatArray | None  # (site, 2) m, where all sites are known
    legs: Mapping[str, ProfileLegs]  # by profile
