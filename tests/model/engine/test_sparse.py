"""Large arrays take memory where something is written."""

from pathlib import Path

import numpy as np

from model.engine.sparse import HUGE, sparse_rows

ROW = np.dtype((np.record, np.dtype([("number", np.int64), ("others", np.int64, 511)])))
"""As long as a page."""

LARGER_THAN_MEMORY = 2**43
"""Bytes: eight terabytes."""


def resident() -> int:
    """Return bytes of memory that this process holds."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


def test_rows_are_zeros_that_can_be_written() -> None:
    for number in (3, 3 * HUGE // ROW.itemsize):
        rows = sparse_rows((number, 2), ROW)
        assert rows.shape == (number, 2)
        assert rows.dtype == ROW
        assert not rows["number"][::97].any()
        rows[number - 1, 1].number = 7
        assert rows[number - 1, 1].number == 7


def test_memory_is_taken_where_something_is_written() -> None:
    number = 32 * HUGE // ROW.itemsize
    before = resident()
    rows = sparse_rows((number,), ROW)
    rows["number"][::512] = 1  # in each of the huge pages there would be
    assert np.count_nonzero(rows["number"][::512]) == number / 512
    assert resident() - before < rows.nbytes / 8


def test_rows_may_be_longer_than_the_memory_there_is() -> None:
    rows = sparse_rows((LARGER_THAN_MEMORY,), np.uint8)
    rows[-1] = 7
    assert (rows[0], rows[-1]) == (0, 7)
