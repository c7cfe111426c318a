"""When everything happens on routes that are given, step by step, by VROOM's mode of that name.

No rule is hard but times that steps force. Of all times, those are best by which windows are missed
by the fewest seconds, then by which the route is shortest, then by which each step is earliest.

What is driven and done between steps is subtracted from their times, so that a route keeps what its
steps need where those never decrease. Then each is best at one of few: where a window begins or
ends of a step, or of another that is done without a wait between. A dynamic program tries these.
"""

from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

from model.dialects.vroom.breaks import GapsForBreaks
from model.dialects.vroom.errors import TooLargeError
from model.dialects.vroom.request import StartBounds
from model.dialects.vroom.windows import ENDLESS, TIME_SCALE, Slots

MOST_LOOKS = 3_000_000
"""Times of a step, each with times of the step before, that are looked at: some seconds."""

Cost = float
"""Integers, of which the first digits are seconds missed, or infinite."""


@dataclass(frozen=True)
class GivenWay:
    """A route whose breaks are in given gaps."""

    way: GapsForBreaks
    counts: Sequence[int]  # (gap,) breaks over behind it
    ends: tuple[Slots, Slots]  # when the vehicle may begin, and be back
    node_bounds: Sequence[StartBounds]  # of the start, of each job, of the end; in seconds
    rest_bounds: Sequence[StartBounds]  # of each break


@dataclass(frozen=True)
class Times:
    """When a route begins, each job and break starts, and it ends."""

    nodes: tuple[int, ...]
    rests: tuple[int, ...]


def best_times(given: GivenWay) -> Times | None:
    """Return the best times of a given route; None if what is forced can't be.

    Raises
    ------
    TooLargeError
        If there are too many times to look at.
    """
    return _Program(given).solve()


class _Program:
    """Tries the times of one route."""

    def __init__(self, given: GivenWay) -> None:
        self._given = given
        self._way = given.way
        self._gaps = [range(first, last) for first, last in zip(
            (0, *given.counts), given.counts, strict=False)]
        self._offsets = self._find_offsets()
        self._shifts = sorted(set(self._candidates()))
        self._node_slots = [given.ends[0], *self._way.slots, given.ends[1]]
        last = self._shifts[-1] + self._offsets[-1] + 1
        steps = len(self._offsets) + len(self._way.pauses)
        self._per_second = last * steps  # what the span's second outweighs
        self._per_missed = self._per_second * last

    def solve(self) -> Times | None:
        """Return the best times."""
        looks = sum(len(self._shifts) ** 2 if gap else len(self._shifts) for gap in self._gaps)
        if looks > MOST_LOOKS:
            raise TooLargeError("Too many time windows beside breaks to time the routes given.")
        values = [self._node_cost(0, shift) for shift in self._shifts]
        froms: list[Sequence[int]] = []
        for node in range(1, len(self._offsets)):
            before = self._behind(values, node - 1)
            froms.append([index for _, index in before])
            values = [value + self._node_cost(node, shift)
                      for (value, _), shift in zip(before, self._shifts, strict=True)]
        best, last = min(zip(values, range(len(values)), strict=True))
        if best == inf:
            return None
        chosen = [last]
        for indices in reversed(froms):
            chosen.append(indices[chosen[-1]])
        chosen.reverse()
        times = [self._shifts[index] + offset
                 for index, offset in zip(chosen, self._offsets, strict=True)]
        rests = [time for gap, (leave, arrive) in enumerate(pairwise(chosen))
                 if self._gaps[gap] for time in self._rests(gap, leave, arrive)]
        return Times(tuple(times), tuple(rests))

    def _find_offsets(self) -> list[int]:
        """Return how long after the start each node is at least."""
        offsets, actions = [0], (0, *self._way.actions)
        for action, travel, gap in zip(actions, self._way.times, self._gaps, strict=True):
            rests = sum([self._way.pauses[number].duration for number in gap])
            offsets.append(offsets[-1] + action + travel + rests)
        return offsets

    def _candidates(self) -> Iterator[int]:
        """Yield times at which nodes may be best, less their offsets."""
        yield 0
        slots = [self._given.ends[0], *self._way.slots, self._given.ends[1]]
        for node, (bounds, offset) in enumerate(zip(self._given.node_bounds, self._offsets,
                                                    strict=True)):
            yield from (max(0, time - offset) for time in (*_edges(slots[node]), *_known(bounds)))
        for gap, numbers in enumerate(self._gaps):
            leave = self._offsets[gap] + self._action(gap)
            for number in numbers:
                pause = self._way.pauses[number]
                edges = [*_edges(pause.slots), *_known(self._given.rest_bounds[number])]
                behind = sum([self._way.pauses[other].duration
                              for other in range(number, numbers.stop)])
                yield from (max(0, time - leave) for time in edges)
                yield from (max(0, time + behind - self._offsets[gap + 1]) for time in edges)
                leave += pause.duration

    def _action(self, node: int) -> int:
        return self._way.actions[node - 1] if node else 0

    def _node_cost(self, node: int, shift: int) -> Cost:
        """Return what it costs that a node starts so long after its offset."""
        time = shift + self._offsets[node]
        bounds = self._given.node_bounds[node]
        if node in (0, len(self._offsets) - 1):
            per = -self._per_second if node == 0 else self._per_second
        else:
            per = 1
        return self._cost(time, self._node_slots[node], bounds) + per * time

    def _cost(self, time: int, slots: Slots, bounds: StartBounds) -> Cost:
        if ((bounds.after is not None and time < bounds.after * TIME_SCALE)
                or (bounds.before is not None and time > bounds.before * TIME_SCALE)):
            return inf
        return self._per_missed * missed(time, slots)

    def _behind(self, values: Sequence[Cost], gap: int) -> list[tuple[Cost, int]]:
        """Return the least cost up to behind a gap, and where it comes from, by the node there."""
        best: list[tuple[Cost, int]] = []
        if not self._gaps[gap]:
            for index, value in enumerate(values):
                best.append(min(best[-1], (value, index)) if best else (value, index))
            return best
        best = [(inf, 0)] * len(values)
        for leave, value in enumerate(values):
            if value == inf:
                continue
            costs = self._rest_costs(gap, leave)
            for arrive in range(leave, len(values)):
                best[arrive] = min(best[arrive], (value + costs(arrive), leave))
        return best

    def _starts(self, gap: int, leave: int) -> tuple[int, list[int]]:
        """Return when the first break of a gap may start, and how much later breaks are best."""
        time = self._shifts[leave] + self._offsets[gap] + self._action(gap)
        waits, first = {0}, time
        for number in self._gaps[gap]:
            pause = self._way.pauses[number]
            waits.update(edge - first for edge in
                         (*_edges(pause.slots), *_known(self._given.rest_bounds[number])))
            first += pause.duration
        waits.update(self._room(gap, leave, arrive) for arrive in range(leave, len(self._shifts)))
        return time, sorted(wait for wait in waits if wait >= 0)

    def _room(self, gap: int, leave: int, arrive: int) -> int:
        """Return how long breaks may be put off between two nodes."""
        return self._shifts[arrive] - self._shifts[leave] + self._way.times[gap]

    def _rest_costs(self, gap: int, leave: int) -> Callable[[int], Cost]:
        """Return what tells the least cost of the breaks in a gap by the node behind it."""
        waits, rows = self._rest_rows(gap, leave)
        last = rows[-1]
        return lambda arrive: last[bisect_right(waits, self._room(gap, leave, arrive)) - 1][0]

    def _rest_rows(self, gap: int, leave: int) -> tuple[list[int],
                                                        list[list[tuple[Cost, int]]]]:
        """Return the least costs of breaks that are put off by at most so much, one by one, and by
        how much the last of them is.
        """
        time, waits = self._starts(gap, leave)
        rows: list[list[tuple[Cost, int]]] = []
        for number in self._gaps[gap]:
            pause, bounds = self._way.pauses[number], self._given.rest_bounds[number]
            row: list[tuple[Cost, int]] = []
            for index, wait in enumerate(waits):
                start = time + wait
                cost = self._cost(start, pause.slots, bounds) + start
                cost += rows[-1][index][0] if rows else 0
                row.append(min(row[-1], (cost, wait)) if row else (cost, wait))
            rows.append(row)
            time += pause.duration
        return waits, rows

    def _rests(self, gap: int, leave: int, arrive: int) -> list[int]:
        """Return when the breaks in a gap start between two nodes."""
        time, _ = self._starts(gap, leave)
        waits, rows = self._rest_rows(gap, leave)
        most, chosen = self._room(gap, leave, arrive), list[int]()
        for row in reversed(rows):
            most = row[bisect_right(waits, most) - 1][1]
            chosen.append(most)
        starts = []
        for wait, number in zip(reversed(chosen), self._gaps[gap], strict=True):
            starts.append(time + wait)
            time += self._way.pauses[number].duration
        return starts


def missed(time: int, slots: Slots) -> int:
    """Return by how much a start misses the nearest window."""
    return min(max(begin - time, time - end, 0) for begin, end in slots)


def _known(bounds: StartBounds) -> list[int]:
    return [time * TIME_SCALE for time in (bounds.after, bounds.before) if time is not None]


def _edges(slots: Slots) -> list[int]:
    return [time for slot in slots for time in slot if time < ENDLESS]


