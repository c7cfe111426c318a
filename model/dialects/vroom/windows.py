"""Jobs with many time windows: a few of them at a time.

The planner chooses among windows by customers that exclude each other (`choose_windows`), and does
so well only among few. With more, it first plans as if a job might start at any time from its first
window to its last. Driven by the true windows, these routes tell in which of them jobs start; then
windows near these are chosen among, and for jobs left out any others, again and again.
"""

from collections.abc import Mapping, Sequence
from operator import itemgetter

import numpy as np

from model.dialects.vroom.nodes import Slots
from model.dialects.vroom.request import Window

MOST_OF_A_JOB = 10
"""Most windows of a job that are chosen among at a time."""

MOST_BESIDE = 400
"""Most windows of all jobs at a time, beside one of each."""


def are_few(slots: Slots) -> bool:
    """Tell whether all windows can be chosen among at once."""
    numbers = [len(windows) for windows in slots.values()]
    return (max(numbers, default=0) <= MOST_OF_A_JOB
            and sum(numbers) - len(numbers) <= MOST_BESIDE)


def hulls(slots: Slots) -> Slots:
    """Return for each job one window, from the begin of its first one to the end of its last."""
    joined: dict[int, list[Window | None]] = {}
    for job, windows in slots.items():
        first, last = windows[0], windows[-1]
        joined[job] = [None if first is None or last is None else (first[0], last[1])]
    return joined


def choose_few(slots: Slots, starts: Mapping[int, Window | None],
               rng: np.random.Generator) -> Slots:
    """Return a few windows of each job, in order.

    Parameters
    ----------
    slots
        All windows, in order.
    starts
        Those in which jobs start so far; whoever is not there is left out so far.
    rng
        Draws windows for jobs left out, and who gets more than one if not all can.
    """
    chosen: dict[int, list[int]] = {}
    more: list[tuple[int, int, int]] = []
    for job in rng.permutation(list(slots)).tolist():
        first, *others = _by_preference(slots[job], starts.get(job), rng)
        chosen[job] = [first]
        # Those left out come first, then whoever has fewest.
        more += [(rank if job in starts else 0, job, index)
                 for rank, index in enumerate(others[:MOST_OF_A_JOB - 1], start=1)]
    for _, job, index in sorted(more, key=itemgetter(0))[:MOST_BESIDE]:
        chosen[job].append(index)
    return {job: [slots[job][index] for index in sorted(chosen[job])] for job in slots}


def _by_preference(windows: Sequence[Window | None], start: Window | None,
                   rng: np.random.Generator) -> list[int]:
    """Return windows, the nearest to that of the start first; if there is none, at random."""
    if start not in windows:
        drawn: list[int] = rng.permutation(len(windows)).tolist()
        return drawn
    place = windows.index(start)
    return sorted(range(len(windows)), key=lambda index: abs(index - place))
