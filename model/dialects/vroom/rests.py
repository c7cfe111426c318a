"""The breaks of vehicles as the planner takes them.

The planner has a break only if a route can't be over before it, nor begin behind it; VROOM always.
Who has it beside the route can take it there only within his shift, and one break after another:
each window is cut to what that leaves. By breaks cut so, the two are the same.

The planner has few breaks of one vehicle. Of more, neighbours are taken as one, with what lies
between them.
"""

from collections.abc import Sequence
from itertools import pairwise

from model.dialects.vroom.kinds import VehicleKind
from model.dialects.vroom.request import VroomBreak, Window
from model.dialects.vroom.windows import ENDLESS
from model.problem import MAX_BREAKS

CutBreak = tuple[int, Window]
"""Seconds, and when it may start."""

MostAboard = tuple[int, ...] | None
"""What may be aboard at most; None: anything."""


class Rests:
    """The breaks of all kinds of vehicles.

    The planner's break has one window: of several the longest, or the one that can be met first
    where those leave no time.
    """

    def __init__(self, kinds: Sequence[VehicleKind], is_timed: bool) -> None:
        """Cut windows; where nothing `is_timed` breaks bind nobody."""
        self._cut = [_cut(kind) if is_timed else () for kind in kinds]
        self._most = [[each.max_load for each in kind.stated.breaks] for kind in kinds]
        self._groups = [_groups(breaks) for breaks in self._cut]

    def begins(self) -> list[int]:
        """Return the seconds in which breaks may start first."""
        return [begin for breaks in self._cut for _, (begin, _) in breaks]

    def of(self, kind: int) -> Sequence[tuple[CutBreak, MostAboard]]:
        """Return the breaks of a kind, none if they can't be taken."""
        breaks, most = self._cut[kind], self._most[kind]
        return [(_as_one([breaks[number] for number in group]),
                 _least_of([most[number] for number in group]))
                for group in self._groups[kind]] if self.can_be_taken(kind) else []

    def latest_begin(self, kind: int) -> int | None:
        """Return when the last of a kind's breaks begins at the latest, where loads limit breaks.

        None if it may begin at any time. Whoever is about from the beginning of the planner's time
        until then has all breaks on the way.
        """
        breaks = self._cut[kind]
        last = breaks[-1][1][1] if breaks and any(self._most[kind]) else ENDLESS
        return last if last < ENDLESS // 2 else None

    def number_of(self, kind: int, number: int) -> int:
        """Return which of a kind's breaks, as the planner has them, stands for one stated."""
        return next(index for index, group in enumerate(self._groups[kind]) if number in group)

    def can_be_taken(self, kind: int) -> bool:
        """Tell whether there is time for all breaks of a kind."""
        return _fit(self._cut[kind])


def _fit(breaks: Sequence[CutBreak]) -> bool:
    return all(begin <= end for _, (begin, end) in breaks)


def _groups(breaks: Sequence[CutBreak]) -> list[list[int]]:
    """Return which breaks are taken as one, so few that the planner can have them."""
    groups = [[number] for number in range(len(breaks))]
    while len(groups) > MAX_BREAKS:
        joined = [_as_one([breaks[number] for number in (*one, *other)])
                  for one, other in pairwise(groups)]
        lost = [seconds - sum([breaks[number][0] for number in (*one, *other)])
                for (seconds, _), (one, other) in zip(joined, pairwise(groups), strict=True)]
        # Where nothing is lost by waiting, the widest window is left.
        first = min(range(len(joined)), key=lambda index: (
            lost[index], joined[index][1][0] - joined[index][1][1]))
        groups[first:first + 2] = [groups[first] + groups[first + 1]]
    return groups


def _as_one(breaks: Sequence[CutBreak]) -> CutBreak:
    """Return one break in which all of some, cut, are taken: as late as the first may be begun
    where there is time between.
    """
    (seconds, (begin, end)), *others = breaks
    for duration, (opens, closes) in others:
        before = max(seconds, opens - end)
        begin, end = max(begin, opens - before), min(end, closes - before)
        seconds = before + duration
    return seconds, (begin, end)


def _least_of(limits: Sequence[MostAboard]) -> MostAboard:
    """Return what is within all limits on what is aboard."""
    stated = [limit for limit in limits if limit is not None]
    return tuple(map(min, zip(*stated, strict=True))) if stated else None


def _cut(kind: VehicleKind) -> Sequence[CutBreak]:
    shift, breaks = kind.stated.time_window or (0, ENDLESS), kind.stated.breaks
    longest = _within(shift, breaks, [_longest(each.time_windows, shift) for each in breaks])
    if _fit(longest):
        return longest
    time, first = shift[0], list[Window]()
    for each in breaks:
        windows = each.time_windows or [(0, ENDLESS)]
        first.append(next((window for window in windows if time <= window[1]), windows[-1]))
        time = max(time, first[-1][0]) + each.service
    return _within(shift, breaks, first)


def _within(shift: Window, breaks: Sequence[VroomBreak],
            windows: Sequence[Window]) -> Sequence[CutBreak]:
    """Return breaks with one window each, cut to what shift and other breaks leave of it."""
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


def _longest(stated: Sequence[Window] | None, shift: Window) -> Window:
    """Return the longest of some windows within a shift."""
    return (0, ENDLESS) if stated is None else max(
        stated, key=lambda window: min(window[1], shift[1]) - max(window[0], shift[0]))
