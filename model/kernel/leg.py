"""Legs: how long and how far from one place to another. Compiled.

All are read here: from tables, or computed from where nodes are. What is computed is the same to
the last bit as in `problem/distances`: the same operations in the same order, none of them fused.
"""

import math
from typing import NamedTuple

import numpy as np

from model.kernel.compiled import chosen_by_type, inlined, pasted, spliced
from model.kernel.records import Record, Records, record
from model.problem import UNREACHABLE, Int32Array, IntArray
from model.problem.distances import (
    COARSE_MS, DIMACS, EXACT, FLOAT_NOISE_MS, LONG_ARC, LONG_SERIES, MM_PER_M, ROUND,
    SHORT_ARC, SHORT_SERIES, TRUNC,
)
from model.problem.quantities import NO_LEG

LEG_DURATION, LEG_DISTANCE = range(2)
"""Last axis of a table of legs."""

GLOBE = -1
"""Stands for a way to round distances where nodes lie on a sphere."""

LAW = record("table", "rounding", "more", "nowhere", "sets_up", metres=float, pace=float)
"""How legs of a travel are told: the number of their table, or `COMPUTED`; else as `StraightLegs`
has it, and whether setups are added."""
COMPUTED = -1

POINT = record("node", "site", "setup_duration", x=float, y=float, z=float)
"""A node, where it is as in `Points`, and the setup there."""


class Leg(NamedTuple):
    """A way, driven at full speed or flown."""

    duration: int
    distance: int


class ComputedLegs(NamedTuple):
    """Those of all travels, of which some are computed."""

    table: IntArray  # (direction, table, node, node, 2); one direction if they are the same back
    point: Records  # (node,) POINT
    law: Records  # (travel,) LAW


class ComputedTravel(NamedTuple):
    """Those of one travel."""

    computed: bool
    table: IntArray  # (origin, to, 2)
    point: Records
    law: Record


class ComputedRow(NamedTuple):
    """Those of one travel from one node, or to it."""

    computed: bool
    table: IntArray  # (node, 2)
    point: Records
    law: Record
    here: Record


class Stated(NamedTuple):
    """Those of one travel, or of one of its rows, where none are computed."""

    table: Int32Array  # (origin, to, 2), or (node, 2)


AllLegs = Int32Array | ComputedLegs
"""Those of all travels. Where none are computed and all fit 32 bits, (travel, origin, to, 2) with
`NO_LEG` for `UNREACHABLE`: most of the time of a search goes into getting them from memory."""
TravelLegs = Stated | ComputedTravel
LegRow = Stated | ComputedRow


def are_the_same_back(legs: AllLegs, back: AllLegs) -> bool:
    """Tell whether all legs are those back as well."""
    return len(legs.table) == 1 if isinstance(legs, ComputedLegs) else legs is back


def _stated_legs_of(legs: Int32Array, m: int) -> TravelLegs:
    return Stated(legs[m])


def _computed_legs_of(legs: ComputedLegs, m: int) -> TravelLegs:
    law = legs.law[m]
    return ComputedTravel(law.table < 0, legs.table[0, max(law.table, 0)], legs.point, law)


legs_of = chosen_by_type(ComputedLegs, _computed_legs_of, _stated_legs_of, paste=True)
"""Return the legs of travel `m`: `legs_of(legs, m)`."""


def _stated_row(legs: Int32Array, m: int, node: int) -> LegRow:
    return Stated(legs[m, node])


def _computed_legs_from(legs: ComputedLegs, m: int, node: int) -> LegRow:
    law = legs.law[m]
    return ComputedRow(law.table < 0, legs.table[0, max(law.table, 0), node], legs.point, law,
                       legs.point[node])


legs_from = chosen_by_type(ComputedLegs, _computed_legs_from, _stated_row, paste=True)
"""Return the legs of travel `m` from a node, for a loop over where they lead."""


def _computed_legs_to(legs: ComputedLegs, m: int, node: int) -> LegRow:
    law = legs.law[m]
    return ComputedRow(law.table < 0, legs.table[len(legs.table) - 1, max(law.table, 0), node],
                       legs.point, law, legs.point[node])


legs_to = chosen_by_type(ComputedLegs, _computed_legs_to, _stated_row, paste=True)
"""Return the legs of travel `m` to a node; stated ones are given as (travel, to, origin, 2)."""


@spliced
def wide(duration: int, distance: int) -> Leg:
    """Return a leg in 64 bits, in which sums fit. Whether there is one, its duration tells alone.
    """
    return Leg(UNREACHABLE if duration == NO_LEG else int(np.int64(duration)),
               int(np.int64(distance)))


def _stated_leg(legs: Stated, origin: int, to: int) -> Leg:
    return wide(legs.table[origin, to, LEG_DURATION], legs.table[origin, to, LEG_DISTANCE])


def _computed_leg(legs: ComputedTravel, origin: int, to: int) -> Leg:
    if legs.computed:
        return straight_leg(legs.point[origin], legs.point[to], legs.law)
    return Leg(legs.table[origin, to, LEG_DURATION], legs.table[origin, to, LEG_DISTANCE])


leg = chosen_by_type(ComputedTravel, _computed_leg, _stated_leg)
"""Return a leg of one travel: `leg(legs, origin, to)`."""


def _stated_leg_at(row: Stated, node: int) -> Leg:
    return wide(row.table[node, LEG_DURATION], row.table[node, LEG_DISTANCE])


def _computed_leg_to(onward: ComputedRow, node: int) -> Leg:
    if onward.computed:
        return straight_leg(onward.here, onward.point[node], onward.law)
    return Leg(onward.table[node, LEG_DURATION], onward.table[node, LEG_DISTANCE])


leg_to = chosen_by_type(ComputedRow, _computed_leg_to, _stated_leg_at)
"""Return the leg to a node from that for which `legs_from` took the row: `leg_to(onward, node)`."""


def _computed_leg_from(inward: ComputedRow, node: int) -> Leg:
    if inward.computed:
        return straight_leg(inward.point[node], inward.here, inward.law)
    return Leg(inward.table[node, LEG_DURATION], inward.table[node, LEG_DISTANCE])


leg_from = chosen_by_type(ComputedRow, _computed_leg_from, _stated_leg_at)
"""Return the leg from a node to that for which `legs_to` took the row: `leg_from(inward, node)`."""


def _stated_distance_at(row: Stated, node: int) -> int:
    return int(np.int64(row.table[node, LEG_DISTANCE]))


def _computed_distance_to(onward: ComputedRow, node: int) -> int:
    if onward.computed:
        return straight_distance(onward.here, onward.point[node], onward.law)
    return int(onward.table[node, LEG_DISTANCE])


distance_to = chosen_by_type(ComputedRow, _computed_distance_to, _stated_distance_at)
"""Return the distance of `leg_to` alone."""


def _computed_distance_from(inward: ComputedRow, node: int) -> int:
    if inward.computed:
        return straight_distance(inward.point[node], inward.here, inward.law)
    return int(inward.table[node, LEG_DISTANCE])


distance_from = chosen_by_type(ComputedRow, _computed_distance_from, _stated_distance_at)
"""Return the distance of `leg_from` alone."""


def _stated_nearness(inward: Stated, onward: Stated, node: int) -> int:
    return int(np.int64(min(inward.table[node, LEG_DISTANCE], onward.table[node, LEG_DISTANCE])))


def _computed_nearness(inward: ComputedRow, onward: ComputedRow, node: int) -> int:
    if inward.computed:
        # As far back, to the last bit.
        return straight_leg(onward.here, onward.point[node], onward.law).distance
    return min(inward.table[node, LEG_DISTANCE], onward.table[node, LEG_DISTANCE])


nearness = chosen_by_type(ComputedRow, _computed_nearness, _stated_nearness)
"""Return the shorter distance to or from a node: `nearness(inward, onward, node)`, rows of one
travel that `legs_to` and `legs_from` took for the same node."""


@inlined
def straight_leg(origin: Record, to: Record, law: Record) -> Leg:
    """Return a leg as `StraightLegs` has it, with the setup at its end.

    It takes rows, since to hand over an array to a call takes as long as the leg.
    """
    if origin.node == to.node:
        return Leg(0, 0)
    setup = 0
    if law.sets_up and origin.site != to.site:
        setup = to.setup_duration
    metres = metres_between(origin, to, law)
    if metres != metres:
        return Leg(law.nowhere + setup, law.nowhere)
    duration, noise = metres * law.pace, FLOAT_NOISE_MS
    if duration >= COARSE_MS:
        noise = max(noise, 2 * np.spacing(duration))
    return Leg(math.ceil(duration - noise) + law.more + setup, int(np.rint(metres * MM_PER_M)))


@inlined
def straight_distance(origin: Record, to: Record, law: Record) -> int:
    """Return the distance of a leg alone, which takes half of the time. As `straight_leg`."""
    if origin.node == to.node:
        return 0
    metres = metres_between(origin, to, law)
    if metres != metres:
        return law.nowhere
    return int(np.rint(metres * MM_PER_M))


@spliced
def metres_between(origin: Record, to: Record, law: Record) -> float:
    """Return metres between two nodes, not a number if one is nowhere."""
    if law.rounding == GLOBE:
        return angle_between(origin, to) * law.metres
    return units_between(origin, to, law.rounding) * law.metres


@spliced
def units_between(origin: Record, to: Record, rounding: int) -> float:
    """Return the distance between two nodes in the plane, rounded as `rounded_as` does."""
    east, north = origin.x - to.x, origin.y - to.y
    straight = math.sqrt(east * east + north * north)
    if rounding == EXACT:
        return straight
    if rounding == ROUND:
        return np.floor(straight + 0.5)
    if rounding == TRUNC:
        return np.trunc(straight)
    if rounding == DIMACS:
        return np.trunc(straight * 10.0) / 10.0
    return np.floor(straight * 1000.0 + 0.5) / 1000.0


@spliced
def angle_between(origin: Record, to: Record) -> float:
    """Return the angle between two unit vectors as `angles_between` does."""
    x, y, z = origin.x - to.x, origin.y - to.y, origin.z - to.z
    quarter = (x * x + y * y + z * z) * 0.25
    if quarter <= SHORT_ARC:
        return 2.0 * math.sqrt(quarter) * short_series(quarter)
    if quarter <= LONG_ARC:
        return 2.0 * math.sqrt(quarter) * long_series(quarter)
    x, y, z = origin.x + to.x, origin.y + to.y, origin.z + to.z
    quarter = (x * x + y * y + z * z) * 0.25
    if quarter <= SHORT_ARC:
        return math.pi - 2.0 * math.sqrt(quarter) * short_series(quarter)
    return math.pi - 2.0 * math.sqrt(quarter) * long_series(min(quarter, LONG_ARC))


@spliced
def short_series(square: float) -> float:
    """Return arcsin(s) / s by the square of s, up to `SHORT_ARC`."""
    value = 0.0
    for coefficient in SHORT_SERIES:
        value = value * square + coefficient
    return value


@inlined
def long_series(square: float) -> float:
    """Return arcsin(s) / s by the square of s, up to `LONG_ARC`."""
    value = 0.0
    for coefficient in LONG_SERIES:
        value = value * square + coefficient
    return value


@pasted
def matrix_of(matrices: IntArray, b: int, m: int) -> IntArray:
    """Return the durations, or distances, of travel `m` in problem `b`, (origin, to)."""
    return matrices[b, m]


@pasted
def matrices_of(matrices: IntArray, b: int) -> IntArray:
    """Return the durations of all travels in problem `b`, (travel, origin, to)."""
    return matrices[b]


@pasted
def matrix_among(matrices: IntArray, m: int) -> IntArray:
    """Return the durations of travel `m`, (origin, to), from those of one problem."""
    return matrices[m]


@inlined
def lookup(matrix: IntArray, origin: int, to: int) -> int:
    """Return the duration of a leg, or the distance, from a matrix of either."""
    return matrix[origin, to]
