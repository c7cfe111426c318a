"""How much more work larger problems take, counted and not timed."""

import sys
from collections.abc import Callable
from types import FrameType
from typing import Any


def calls_of(work: Callable[[], object]) -> int:
    """Return how many functions of Python and of C some work calls, which no other work changes.

    A loop over all customers for each customer shows in it, unless it is in C alone.
    """
    number = 0

    def count(frame: FrameType, event: str, argument: Any) -> None:
        nonlocal number
        number += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        work()
    finally:
        sys.setprofile(before)
    return number


def growth_of(work: Callable[[int], Callable[[], object]], size: int, factor: int = 4) -> float:
    """Return how many times as many calls a problem takes that is `factor` times as large.

    `work` makes what is counted for a size.
    """
    for each in (size, size * factor):
        work(each)()  # what happens once, also for large ones alone
    return calls_of(work(size * factor)) / calls_of(work(size))
