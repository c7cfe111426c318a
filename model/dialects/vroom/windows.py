"""When something may start, in VROOM's hundredths of a second."""

from collections.abc import Sequence

TIME_SCALE = 100
"""Hundredths of a second."""

ENDLESS = 2**62
"""Stands for no end of a time window."""

MISSED = 2**63
"""Start of what may not start any more: later than any end."""

Slots = Sequence[tuple[int, int]]
"""Windows, ascending."""


def scaled(window: tuple[int, int] | None) -> tuple[int, int]:
    """Return a window in hundredths of a second; None is one without end."""
    return (0, ENDLESS) if window is None else (window[0] * TIME_SCALE, window[1] * TIME_SCALE)


def slots_of(windows: Sequence[tuple[int, int]] | None) -> Slots:
    """Return windows in order, in hundredths of a second."""
    return [scaled(None)] if windows is None else [scaled(each) for each in sorted(windows)]


def start_in(arrival: int, slots: Slots) -> int:
    """Return the first start from an arrival on, `MISSED` after the last window."""
    return next((max(arrival, begin) for begin, end in slots if arrival <= end), MISSED)


def last_start(time: int, slots: Slots) -> int:
    """Return the last start up to a time, below any time if there is none."""
    return max((min(time, end) for begin, end in slots if begin <= time), default=-MISSED)
