"""Neighbours are ranked alike with and without many that are equally near."""

import time
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from model.engine.nearest import least_columns

Weights = NDArray[np.float32]

FEW, MANY = 512, 2048
RANKS = 100


def apart(rng: np.random.Generator) -> Weights:
    """Return rows without equal entries."""
    row = np.arange(MANY, dtype=np.float32)
    return rng.permuted(np.tile(row, (20, 1)), axis=1)


def equal_but_few(rng: np.random.Generator) -> Weights:
    """Return rows equal but for a few entries that are larger."""
    return (1 + (rng.random((20, MANY)) < 0.01)).astype(np.float32)


def half_equal(rng: np.random.Generator) -> Weights:
    """Return rows of which half the entries are the least."""
    return np.where(rng.random((20, MANY)) < 0.5, np.float32(0), 1 + apart(rng))


def equal_behind(rng: np.random.Generator) -> Weights:
    """Return rows in which all are equal that come behind the nearest ten."""
    return np.minimum(apart(rng), np.float32(10))


def themselves(rng: np.random.Generator) -> Weights:
    """Return the distances of customers at one place, of whom none is his own neighbour."""
    weight = np.ones((20, MANY), np.float32)
    weight[np.arange(20), rng.permutation(MANY)[:20]] = np.inf
    return weight


KINDS = (apart, equal_but_few, half_equal, equal_behind, themselves)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("columns", [FEW, MANY])
def test_the_least_come_first_and_of_equal_ones_the_first(
        kind: Callable[[np.random.Generator], Weights], columns: int) -> None:
    weight = kind(np.random.default_rng(0))[:, :columns]
    found = least_columns(weight, RANKS)
    assert (found == np.argsort(weight, axis=1, kind="stable")[:, :RANKS]).all()


def test_rows_are_ranked_for_themselves() -> None:
    rng = np.random.default_rng(1)
    weight = np.concatenate([apart(rng), themselves(rng), apart(rng)])
    assert (least_columns(weight, RANKS)[:20] == least_columns(weight[:20], RANKS)).all()
    assert (least_columns(weight, RANKS)[-20:] == np.argsort(weight[-20:], axis=1)[:, :RANKS]).all()


def seconds_of(weight: Weights) -> float:
    """Return the least processor time of some attempts."""
    spent = []
    for _ in range(5):
        began = time.thread_time()
        least_columns(weight, RANKS)
        spent.append(time.thread_time() - began)
    return min(spent)


@pytest.mark.parametrize("kind", KINDS)
def test_many_equal_entries_take_hardly_longer(
        kind: Callable[[np.random.Generator], Weights]) -> None:
    rng = np.random.default_rng(2)
    assert seconds_of(kind(rng)) < 5 * seconds_of(apart(rng))
