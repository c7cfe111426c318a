"""A few of many time windows: about those that are used, and any for jobs left out."""

import numpy as np

from model.dialects.vroom.windows import MOST_BESIDE, MOST_OF_A_JOB, are_few, choose_few, hulls


def test_few_windows_are_chosen_about_those_that_are_used() -> None:
    slots = {job: [(100 * begin, 100 * begin + 50) for begin in range(100)] for job in range(60)}
    assert not are_few(slots)
    starts = dict.fromkeys(range(50), (1000, 1050))
    few = choose_few(slots, starts, np.random.default_rng(0))
    assert are_few(few)
    assert sum(map(len, few.values())) == 60 + MOST_BESIDE
    assert all(starts[job] in few[job] for job in starts)
    assert all(len(few[job]) == MOST_OF_A_JOB for job in range(50, 60))
    assert all(list(windows) == [window for window in slots[job] if window in windows]
               for job, windows in few.items())
    assert all(window in slots[job][6:15] for job in starts for window in few[job])
    assert hulls(slots)[0] == [(0, 9950)]
    assert hulls({3: [None]}) == {3: [None]}
