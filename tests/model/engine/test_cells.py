"""The nearest points found in cells of a tree are those of all pairs."""

import time

import numpy as np
import pytest

from model.engine.nearest import CELL, write_nearest_points
from model.engine.pausing import EndedError, go_on
from model.problem import FloatArray, Int32Array

NUMBER, RANKS = 10 * CELL, 40


def nearest(points: FloatArray, ranks: int = RANKS) -> Int32Array:
    """Return the numbers of the points nearest to each."""
    found = np.full((len(points), ranks), -1, np.int32)
    write_nearest_points(points, found, go_on)
    return found


@pytest.mark.parametrize("axes", [2, 3])
@pytest.mark.parametrize("across", [1_000_000, 8])
def test_the_nearest_come_first(axes: int, across: int) -> None:
    """By whole numbers, so that many are equally near where all are close together."""
    points = np.random.default_rng(axes).integers(0, across, (NUMBER, axes)).astype(np.float64)
    away = ((points[:, None] - points)**2).sum(axis=2)
    np.fill_diagonal(away, np.inf)
    found = nearest(points)
    assert (np.take_along_axis(away, found.astype(np.int64), axis=1)
            == np.sort(away, axis=1)[:, :RANKS]).all()
    assert all(len(set(row)) == RANKS for row in found.tolist())


def test_few_points_are_all_ranked() -> None:
    points = np.array([[0.0, 0.0], [3.0, 0.0], [1.0, 0.0]])
    assert nearest(points, 2).tolist() == [[2, 1], [2, 0], [0, 1]]


def test_points_at_one_place_take_no_longer() -> None:
    def seconds(points: FloatArray) -> float:
        began = time.thread_time()
        found = nearest(points)
        spent = time.thread_time() - began
        assert (found != np.arange(len(points))[:, None]).all()
        return spent

    apart = np.random.default_rng(3).random((40 * NUMBER, 2))
    seconds(apart[:NUMBER])  # loads the engine
    assert seconds(np.zeros_like(apart)) < 5 * seconds(apart)


def test_ranking_may_be_ended() -> None:
    def end() -> None:
        raise EndedError

    found = np.full((NUMBER, RANKS), -1, np.int32)
    with pytest.raises(EndedError):
        write_nearest_points(np.zeros((NUMBER, 2)), found, end)
    assert (found == -1).all()
