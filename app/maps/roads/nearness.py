"""Which legs between many places are asked for: those to near ones, and a few far ones.

Places are parted into groups of neighbours, by halving them across the longer side of the area
again and again. Legs are asked for within a group and to and from the groups around it; besides, to
and from hubs, and between one place of each group: by these the other legs can be estimated.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.maps.roads.engine import Block
from model.problem import BoolArray, FloatArray, IntArray

FULL_UP_TO = 2000
"""Places whose legs are all asked for."""

GROUP = 80
"""Most places of a group: few enough for one question to most servers."""

NEAREST = 300
"""Places to which legs are asked for from each at least, its own group's included."""


@dataclass(frozen=True)
class Nearness:
    """Places in groups of neighbours."""

    groups: tuple[IntArray, ...]
    group_of: IntArray  # (place,)
    near: BoolArray  # (group, group) whether legs between them are asked for
    middles: IntArray  # (group,) the place amid each
    hubs: IntArray

    def wanted(self) -> list[Block]:
        """Return the legs to ask for."""
        everyone = np.arange(len(self.group_of))
        blocks = [Block(group, np.concatenate([self.groups[other]
                                               for other in np.flatnonzero(self.near[number])]))
                  for number, group in enumerate(self.groups)]
        return [*blocks, Block(self.hubs, everyone), Block(everyone, self.hubs),
                Block(self.middles, self.middles)]

    def asked(self) -> BoolArray:
        """Tell of each leg whether it is asked for."""
        asked: BoolArray = self.near[np.ix_(self.group_of, self.group_of)]
        asked[self.hubs, :] = asked[:, self.hubs] = True
        asked[np.ix_(self.middles, self.middles)] = True
        return asked


def nearness(lon_lat: FloatArray, hubs: Sequence[int]) -> Nearness:
    """Part places into groups; hubs are those to and from which all legs are wanted."""
    latitude = np.radians(lon_lat[:, 1].mean())
    flat = lon_lat * (np.cos(latitude), 1.0)
    groups = _halved(flat, np.arange(len(flat)))
    group_of = np.empty(len(flat), np.int64)
    for number, group in enumerate(groups):
        group_of[group] = number
    centres = np.array([flat[group].mean(axis=0) for group in groups])
    apart = np.hypot(*(centres[:, None] - centres).transpose(2, 0, 1))
    near = np.zeros(apart.shape, bool)
    sizes = np.array([len(group) for group in groups])
    for number, order in enumerate(np.argsort(apart, axis=1, kind="stable")):
        enough = int(np.searchsorted(np.cumsum(sizes[order]), NEAREST)) + 1
        near[number, order[:enough]] = True
    middles = [group[np.hypot(*(flat[group] - centre).T).argmin()]
               for group, centre in zip(groups, centres, strict=True)]
    return Nearness(tuple(groups), group_of, near | near.T, np.array(middles),
                    np.array(hubs, np.int64))


def estimated(straight_m: FloatArray, known: FloatArray, parts: Nearness) -> FloatArray:
    """Return all legs between places, those that aren't known estimated.

    A leg from one group to another is to its great circle as that from the one's middle to the
    other's is: so a river between them, or a motorway, counts, each way by itself.

    Parameters
    ----------
    straight_m
        (place, place) metres on great circles.
    known
        (place, place) durations or distances; nan: unknown.
    """
    between = np.ix_(parts.middles, parts.middles)
    apart = np.where(straight_m[between] > 0.0, straight_m[between], np.nan)
    ratios = known[between] / apart
    found = ratios[np.isfinite(ratios)]
    ratios = np.where(np.isfinite(ratios), ratios, np.median(found) if len(found) else np.nan)
    legs = known.copy()
    for number, group in enumerate(parts.groups):
        rows = known[group]
        guesses = straight_m[group] * ratios[number, parts.group_of]
        legs[group] = np.where(np.isnan(rows), guesses, rows)
    return legs


def _halved(flat: FloatArray, places: IntArray) -> list[IntArray]:
    if len(places) <= GROUP:
        return [places]
    here = flat[places]
    order = np.argsort(here[:, np.ptp(here, axis=0).argmax()], kind="stable")
    half = len(places) // 2
    return _halved(flat, places[order[:half]]) + _halved(flat, places[order[half:]])
