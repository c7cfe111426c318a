"""The breaks of vehicles as the planner takes them.

The planner has a break only if a route can't be over before it, nor begin behind it; VROOM always.
Who has it beside the route can take it there only within his shift, and one break after another:
each window is cut to what that leaves. By breaks cut so, the two are the same.
"""

from collections.abc import Sequence

from model.dialects.vroom.kinds import Kind
from model.dialects.vroom.request import Window
from model.dialects.vroom.windows import ENDLESS

CutBreak = tuple[int, Window]
"""Seconds, and when it may start."""


class Rests:
    """The breaks of all kinds of vehicles.

    The planner's break has one window. Of several the longest is taken, or, relaxed, all and what
    is between.
    """

    def __init__(self, kinds: Sequence[Kind], is_timed: bool) -> None:
        """Cut windows; where nothing `is_timed` breaks bind nobody."""
        self._strict = [_cut(kind, relaxed=False) if is_timed else () for kind in kinds]
        self._loose = [_cut(kind, relaxed=True) if is_timed else () for kind in kinds]
        self.differ = self._strict != self._loose
        """Whether relaxed breaks are others."""
        self.are_exact = not is_timed or not any(
            each.max_load is not None for kind in kinds for each in kind.stated.breaks)
        """Whether whoever takes these breaks takes VROOM's."""

    def begins(self) -> list[int]:
        """Return the seconds in which breaks may start first."""
        return [begin for breaks in (*self._strict, *self._loose) for _, (begin, _) in breaks]

    def of(self, kind: int, relaxed: bool) -> Sequence[CutBreak]:
        """Return the breaks of a kind, none if they can't be taken."""
        breaks = (self._loose if relaxed else self._strict)[kind]
        return breaks if _fit(breaks) else ()

    def can_be_taken(self, kind: int) -> bool:
        """Tell whether there is time for all breaks of a kind."""
        return _fit(self._loose[kind])


def _fit(breaks: Sequence[CutBreak]) -> bool:
    return all(begin <= end for _, (begin, end) in breaks)


def _cut(kind: Kind, relaxed: bool) -> Sequence[CutBreak]:
    shift = kind.stated.time_window or (0, ENDLESS)
    breaks = kind.stated.breaks
    windows = [_window(each.time_windows, shift, relaxed) for each in breaks]
    begins, time = [], shift[0]
    for each, (begin, _) in zip(breaks, windows, strict=True):
        begins.append(max(time, begin))
        time = begins[-1] + each.service
    ends, time = [], shift[1]
    for each, (_, end) in zip(breaks[::-1], windows[::-1], strict=True):
        ends.append(min(time - each.service, end))
        time = ends[-1]
    return [(each.service, window) for each, window
            in zip(breaks, zip(begins, ends[::-1], strict=True), strict=True)]


def _window(stated: Sequence[Window] | None, shift: Window, relaxed: bool) -> Window:
    """Return the one window that stands for those stated."""
    if stated is None:
        return 0, ENDLESS
    if relaxed:
        return stated[0][0], stated[-1][1]
    return max(stated, key=lambda window: min(window[1], shift[1]) - max(window[0], shift[0]))
