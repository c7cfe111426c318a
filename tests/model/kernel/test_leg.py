"""Compiled code computes the same legs as the judge, to the last bit."""

import numpy as np
import pytest

from model.kernel.compiled import compiled
from model.kernel.leg import (
    COMPUTED, GLOBE, LAW, POINT, AllLegs, ComputedLegs, leg, leg_from, leg_to, legs_from, legs_of,
    legs_to, nearness,
)
from model.problem import UNREACHABLE, Int32Array, IntArray, Points, StraightLegs, Travel
from model.problem.quantities import LONGEST_NARROW, NO_LEG

COUNT = 60


@compiled
def look_up(legs: AllLegs, back: AllLegs, found: IntArray) -> None:
    """Write all legs of the first travel, looked up in three ways, (way, origin, to, 2)."""
    every = legs_of(legs, 0)
    for here in range(found.shape[1]):
        onward, inward = legs_from(legs, 0, here), legs_to(back, 0, here)
        for there in range(found.shape[1]):
            one, other, third = leg(every, here, there), leg_to(onward, there), leg_from(
                inward, there)
            found[0, here, there] = one.duration, one.distance
            found[1, here, there] = other.duration, other.distance
            found[2, there, here] = third.duration, third.distance


@compiled
def look_up_nearness(legs: AllLegs, back: AllLegs, found: IntArray) -> None:
    """Write how near all places are, there or back, (node, node)."""
    for here in range(len(found)):
        onward, inward = legs_from(legs, 0, here), legs_to(back, 0, here)
        for there in range(len(found)):
            found[here, there] = nearness(inward, onward, there)


def computed(legs: StraightLegs) -> ComputedLegs:
    """Return legs as compiled code has them."""
    points = legs.points
    point, law = np.zeros(COUNT, POINT), np.zeros(1, LAW)
    for axis, at in zip("xyz", points.at.T, strict=False):
        point[axis] = at
    point["node"] = np.arange(COUNT)
    law[0] = (COMPUTED, GLOBE if points.on_globe else points.rounding, legs.more, legs.nowhere, 0,
              points.metres, legs.pace)
    return ComputedLegs(np.empty((1, 1, COUNT, 0, 2), np.int64), point, law)


def drawn(seed: int) -> StraightLegs:
    """Return legs between any places in a plane or on the globe, one of which is nowhere."""
    rng = np.random.default_rng(seed)
    if seed % 2:
        places = np.stack([rng.uniform(-180, 180, COUNT), rng.uniform(-90, 90, COUNT)], axis=1)
        places[:4] = (0, 90), (20, -90), places[9] + (180, 0), places[8]
        places[2, 1] *= -1
        points = Points.geographic(places)
    else:
        at = rng.normal(size=(COUNT, 2)) * 10.0 ** rng.uniform(-2, 7)
        at[:5] = at[5:10]
        points = Points(np.rint(at) if seed % 4 else at, 1.5, seed // 2 % 5)
    points.at[20] = np.nan
    return StraightLegs(points, 10.0 ** rng.uniform(0, 2), 500 * (seed % 3),
                        UNREACHABLE * (seed % 2))


def test_computed_legs_are_those_of_the_judge() -> None:
    found, near = np.empty((3, COUNT, COUNT, 2), np.int64), np.empty((COUNT, COUNT), np.int64)
    for seed in range(60):
        legs = drawn(seed)
        travel = Travel.along(legs)
        kernel = computed(legs)
        look_up(kernel, kernel, found)
        assert (found[..., 0] == travel.duration[:]).all(), seed
        assert (found[..., 1] == travel.distance[:]).all(), seed
        assert (travel.distance[:] == travel.distance[:].T).all(), seed
        look_up_nearness(kernel, kernel, near)
        assert (near == travel.distance[:]).all(), seed


@pytest.mark.parametrize("both_ways", [False, True])
def test_stated_legs_are_looked_up(both_ways: bool) -> None:
    legs = np.random.default_rng(0).integers(0, LONGEST_NARROW // 2, (1, COUNT, COUNT, 2))
    legs[0, :3, 5] = UNREACHABLE
    legs[0, 3, 5] = LONGEST_NARROW
    if both_ways:
        legs = np.maximum(legs, legs.transpose(0, 2, 1, 3))
    held = np.where(legs == UNREACHABLE, NO_LEG, legs).astype(np.int32)
    back = np.ascontiguousarray(held.transpose(0, 2, 1, 3))
    found = np.empty((3, COUNT, COUNT, 2), np.int64)
    look_up(held, back, found)
    assert (found[..., 0] == legs[..., 0]).all()
    assert (found[..., 1] == held[..., 1]).all()
    near = np.empty((COUNT, COUNT), np.int64)
    look_up_nearness(held, back, near)
    assert (near == np.minimum(held[0, ..., 1], held[0, ..., 1].T)).all()


@compiled
def sum_of_two(legs: Int32Array) -> int:
    """Return how long the leg from node 3 to 5 takes twice."""
    every, onward = legs_of(legs, 0), legs_from(legs, 0, 3)
    return leg(every, 3, 5).duration + leg_to(onward, 5).duration


def test_sums_of_stated_legs_do_not_overflow() -> None:
    assert sum_of_two(np.full((1, COUNT, COUNT, 2), LONGEST_NARROW, np.int32)) == 2 * LONGEST_NARROW
