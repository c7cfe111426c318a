"""Legs held in 32 bits are looked up as if they were held in 64."""

import copy
import pickle
from typing import Any

import numpy as np
import pytest

from model.problem import UNREACHABLE, IntArray, Travel
from model.problem.narrow import NarrowMatrix, narrowed
from model.problem.quantities import LONGEST_NARROW, NO_LEG

SIZE = 7
NODES = np.array([4, 0, 2])


def legs(longest: int = LONGEST_NARROW, closed: float = 0.0) -> IntArray:
    """Return legs of which one is the longest, some of the others closed."""
    rng = np.random.default_rng(1)
    matrix = rng.integers(0, longest, (SIZE, SIZE))
    matrix[rng.random((SIZE, SIZE)) < closed] = UNREACHABLE
    matrix[2, 3] = longest
    return matrix


def is_narrow(matrix: object) -> bool:
    return isinstance(matrix, NarrowMatrix)


@pytest.mark.parametrize("closed", [0.0, 0.4])
@pytest.mark.parametrize("key", [
    3, slice(2, 5), (2, slice(None)), (slice(None), 3), (slice(1, None), slice(4)), (2, 3),
    NODES, (NODES[:, None], NODES), (slice(1, 3), NODES)])
def test_lookups_are_those_of_an_array(key: Any, closed: float) -> None:
    matrix = legs(closed=closed)
    held = narrowed(matrix)
    assert is_narrow(held)
    found = held[key]
    assert found.dtype == np.int64
    assert np.array_equal(found, matrix[key])
    assert len(held) == SIZE
    assert held.shape == matrix.shape
    for origin, to in np.ndindex(matrix.shape):
        leg = held.item(origin, to)
        assert type(leg) is int
        assert leg == matrix[origin, to]


@pytest.mark.parametrize("closed", [0.0, 0.4])
def test_sums_of_the_longest_do_not_overflow(closed: float) -> None:
    held = narrowed(legs(closed=closed))
    assert held[2, 3] + held[2, 3] == 2 * LONGEST_NARROW
    assert (held[2] + held[2])[3] == 2 * LONGEST_NARROW
    assert held.item(2, 3) + held.item(2, 3) == 2 * LONGEST_NARROW


@pytest.mark.parametrize("closed", [0.0, 0.4])
def test_what_does_not_fit_stays_as_it_is(closed: float) -> None:
    matrix = legs(NO_LEG, closed)
    assert narrowed(matrix) is matrix
    travel = Travel(matrix, legs(closed=closed))
    assert travel.duration is matrix
    assert is_narrow(travel.distance)
    assert travel.narrow() is None
    assert travel.longest()[0] == NO_LEG


def test_lookups_are_copies() -> None:
    travel = Travel(legs(), legs())
    travel.duration[:][2, 3] = 0
    assert travel.duration.item(2, 3) == LONGEST_NARROW


def test_equal_matrices_are_held_once() -> None:
    matrix = legs()
    travel = Travel(matrix, matrix)
    assert travel.duration is travel.distance


@pytest.mark.parametrize("closed", [0.0, 0.4])
def test_travel_knows_which_legs_there_are(closed: float) -> None:
    duration, distance = legs(LONGEST_NARROW, closed), legs(5, closed)
    travel = Travel(duration, distance)
    assert travel.narrow() is not None
    assert travel.reaches_all() == (closed == 0.0)
    assert travel.longest() == (LONGEST_NARROW, 5)
    among = travel.among(NODES)
    assert is_narrow(among.duration)
    assert np.array_equal(among.duration[:], duration[NODES[:, None], NODES])


@pytest.mark.parametrize("longest", [LONGEST_NARROW, NO_LEG])
def test_other_legs_are_written_whatever_holds_them(longest: int) -> None:
    matrix = legs()
    travel = Travel(matrix.copy(), matrix.copy())
    origin, to, new = np.array([0, 1]), np.array([5, 6]), np.array([7, longest])
    travel.write(origin, to, new, 3)
    expected = matrix.copy()
    expected[origin, to] = new
    assert np.array_equal(travel.duration[:], expected)
    assert is_narrow(travel.duration) == (longest == LONGEST_NARROW)
    assert is_narrow(travel.distance)
    assert travel.distance[origin, to].tolist() == [3, 3]
    assert travel.distance.item(2, 3) == matrix[2, 3]


@pytest.mark.parametrize("wrong", [-1, 10**12 + 1, 2**50 - 1, 2**50 + 1, -2**63])
@pytest.mark.parametrize("closed", [0.0, 0.4])
def test_wrong_legs_are_refused(wrong: int, closed: float) -> None:
    matrix = legs(closed=closed)
    matrix[0, 1] = wrong
    for pair in ((matrix, legs()), (legs(), matrix)):
        with pytest.raises(ValueError, match="travel"):
            Travel(*pair)


@pytest.mark.parametrize("closed", [0.0, 0.4])
def test_copies_of_all_kinds_are_the_same(closed: float) -> None:
    travel = Travel(legs(closed=closed), legs())
    for other in (copy.deepcopy(travel), pickle.loads(pickle.dumps(travel))):
        assert np.array_equal(other.duration[:], travel.duration[:])
        assert other.duration.item(2, 3) == LONGEST_NARROW
