"""The engine computes the same legs as the judge, to the last bit."""

import numpy as np
import pytest

from model.engine.header import dtype_of
from model.engine.leg import COMPUTED, GLOBE, AllLegs, ComputedLegs
from model.problem import UNREACHABLE, IntArray, Points, StraightLegs, Travel
from model.problem.quantities import LONGEST_NARROW, NO_LEG
from tests.engine.rules.asking import legs_of, write
from tests.seeds import seeds

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

COUNT = 60


def look_up(legs: AllLegs, back: AllLegs) -> tuple[IntArray, IntArray, IntArray]:
    """Return all legs of the first travel as they are looked up.

    In three ways, (way, origin, to, 2); distances alone in two, (way, origin, to); and how near all
    places are, there or back, (node, node).
    """
    found = np.empty((7, COUNT, COUNT), np.int64)
    distances = np.empty((2, COUNT, COUNT), np.int64)
    given = legs_of(legs), legs_of(back)
    write("all_legs", *given, 0, COUNT, found)
    write("all_distances", *given, 0, COUNT, distances)
    return found[:6].reshape(3, COUNT, COUNT, 2), distances, found[6]


def computed(legs: StraightLegs) -> ComputedLegs:
    """Return legs as the engine has them."""
    points = legs.points
    point, law = np.zeros(COUNT, dtype_of("tandem_point")), np.zeros(1, dtype_of("tandem_leg_law"))
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
    for seed in seeds(60):
        legs = drawn(seed)
        travel = Travel.along(legs)
        kernel = computed(legs)
        found, distances, near = look_up(kernel, kernel)
        assert (found[..., 0] == travel.duration[:]).all(), seed
        assert (found[..., 1] == travel.distance[:]).all(), seed
        assert (distances == travel.distance[:]).all(), seed
        assert (travel.distance[:] == travel.distance[:].T).all(), seed
        assert (near == travel.distance[:]).all(), seed


@pytest.mark.parametrize("both_ways", [False, True])
def test_stated_legs_are_looked_up(both_ways: bool) -> None:
    legs = np.random.default_rng(0).integers(0, LONGEST_NARROW // 2, (1, COUNT, COUNT, 2))
    legs[0, :3, 5] = UNREACHABLE
    legs[0, 3, 5] = LONGEST_NARROW
    if both_ways:
        legs = np.maximum(legs, legs.transpose(0, 2, 1, 3))
    held = np.where(legs == UNREACHABLE, NO_LEG, legs).astype(np.int32)
    found, distances, near = look_up(held, np.ascontiguousarray(held.transpose(0, 2, 1, 3)))
    assert (found[..., 0] == legs[..., 0]).all()
    assert (found[..., 1] == held[..., 1]).all()
    assert (distances == held[..., 1]).all()
    assert (near == np.minimum(held[0, ..., 1], held[0, ..., 1].T)).all()
