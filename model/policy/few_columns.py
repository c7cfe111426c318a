"""Set partitioning where there are few columns, by trying: a program takes longer to be built."""

from collections.abc import Sequence

import numpy as np

from model.problem import BoolArray, FloatArray, IntArray

FEW = 40
"""Columns that meet several rows, up to which it is tried."""

MOST_TRIED = 300
"""Columns that are tried before a program is thought to be quicker."""

ROUNDING = 1e-9
"""Share of a cost that is lost by adding up otherwise."""


class TooManyColumnsError(Exception):
    """There is more to try than pays."""


def cheapest_by_trying(columns: Sequence[IntArray], cost: FloatArray, room: IntArray,
                       known: float) -> BoolArray | None:
    """Return which columns to choose; arguments are those of `cheapest_partition`.

    The lowest row that is to be met yet is met by each column that can, those first that cost
    least above the shares of their rows. A row's share is that of the column by which it is
    cheapest, so that all choices cost the shares of all rows, and what their columns cost above.

    Raises
    ------
    TooManyError
        If more than `MOST_TRIED` columns would have to be tried.
    """
    trial = _Trial(columns, cost, room, known)
    trial.go_on(trial.all_rows, room[room >= 0].tolist(), 0.0, ())
    if trial.best is None:
        return None
    chosen = np.zeros(len(columns), np.bool_)
    chosen[list(trial.best)] = True
    return chosen


class _Trial:
    """What is known of each column, and the cheapest choice so far."""

    def __init__(self, columns: Sequence[IntArray], cost: FloatArray, room: IntArray,
                 known: float) -> None:
        meets = np.zeros((len(columns), len(room)), np.bool_)
        meets[np.repeat(np.arange(len(columns)), list(map(len, columns))),
              np.concatenate(columns)] = True
        once, limited = meets[:, room < 0], meets[:, room >= 0]
        by_row = cost / np.maximum(once.sum(axis=1), 1)
        share = np.where(once, by_row[:, None], np.inf).min(axis=0, initial=np.inf)
        above = cost - np.where(once, share, 0.0).sum(axis=1)
        order = np.argsort(above, kind="stable")
        self._meets, self._order = once[order], order
        self._meeting: dict[int, list[int]] = {}  # by row, in that order
        self._above = above.tolist()
        self._rows, self._limited = np.packbits(once, axis=1, bitorder="little"), limited
        self._most = known * (1 + ROUNDING) - float(share.sum())
        self._left = MOST_TRIED
        self.all_rows = (1 << once.shape[1]) - 1
        self.best: tuple[int, ...] | None = None

    def go_on(self, rows: int, room: list[int], above: float, chosen: tuple[int, ...]) -> None:
        """Try all choices for the rows that are to be met yet, beside what is chosen. In place."""
        if rows == 0:
            self._most, self.best = above, chosen
            return
        lowest = (rows & -rows).bit_length() - 1
        if lowest not in self._meeting:
            self._meeting[lowest] = self._order[self._meets[:, lowest]].tolist()
        for index in self._meeting[lowest]:
            cost = above + self._above[index]
            if cost >= self._most:
                return
            self._left -= 1
            if self._left < 0:
                raise TooManyColumnsError
            own = int.from_bytes(self._rows[index].tobytes(), "little")
            left = [free - used for free, used
                    in zip(room, self._limited[index].tolist(), strict=True)]
            if not own & ~rows and min(left, default=0) >= 0:
                self.go_on(rows & ~own, left, cost, (*chosen, index))
