"""Ways around obstacles: who sees whom, whatever the speed, and what flights come of it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from model.engine.library import call
from model.engine.pausing import Pause, matrix_blocks, row_blocks
from model.problem import BoolArray, FloatArray, IntArray
from model.travel.obstacles import TOUCH_M, Corners, Obstacles
from model.travel.wind import Wind

SLACK_M = 2 * TOUCH_M
"""How far a corner's neighbour may be on the wrong side of a flight that bends there."""

LEFT, RIGHT = 1, 2
"""Bits that tell on which sides of a way an area may lie."""

LOOKS_AT_ONCE = 200_000
"""Lines of sight between two pauses: some milliseconds' work."""

CORNERS_AT_ONCE = 12_000
"""Corners between two pauses whose ways to others are looked for."""

ROOM_FOR_SIGHTS = 100_000
"""Pairs of corners that are found at once, beside those of one with all others."""

FLIGHTS_AT_ONCE = 6_000_000
"""Flights from or to corners put together between two pauses."""


class FlightLegs(NamedTuple):
    """Flights from each origin (row) to each target (column), infinite where there is none."""

    distance: FloatArray  # (origin, target) metres
    duration: FloatArray  # (origin, target) seconds


class Sights(NamedTuple):
    """Straight flights from each row's place to the places that it sees, or back.

    The entries of row `i` are those from `begin[i]` up to `begin[i + 1]`.
    """

    begin: IntArray  # (row + 1,)
    place: IntArray  # (entry,)
    distance: FloatArray  # (entry,) metres
    duration: FloatArray  # (entry,) seconds, infinite where the wind is too strong


class Pairs(NamedTuple):
    """The (row, column) pairs that see each other, row after row."""

    begin: IntArray  # (row + 1,) where the entries of each row begin
    column: IntArray  # (entry,)
    x: FloatArray  # (entry,) metres east from row to column
    y: FloatArray  # (entry,) metres north

    def flown(self, wind: Wind, back: bool = False) -> Sights:
        """Return the flights from rows to columns, or back."""
        lengths = np.hypot(self.x, self.y)
        x, y = (-self.x, -self.y) if back else (self.x, self.y)
        return Sights(self.begin, self.column, lengths, wind.durations(x, y, lengths))

    def seen_from(self, row: int, wind: Wind, back: bool = False) -> tuple[IntArray, FloatArray]:
        """Return the columns that a row sees, and the seconds of flights there, or back."""
        entries = slice(self.begin[row], self.begin[row + 1])
        x, y = self.x[entries], self.y[entries]
        durations = wind.durations(-x, -y, np.hypot(x, y)) if back else wind.durations(
            x, y, np.hypot(x, y))
        return self.column[entries], durations


class Turns(NamedTuple):
    """On which sides of ways to corners their areas may lie, as bits: 1 left, 2 right.

    The flights between corners, row by row, are those with the row's area on the left alone, those
    with it on either side, and those with it on the right alone.
    """

    reached: IntArray  # (entry,) of flights from nodes to corners
    arrived: IntArray  # (entry,) of flights between corners, at their end
    only_left_end: IntArray  # (corner,)
    only_right_begin: IntArray  # (corner,)


@dataclass(frozen=True)
class Ways:
    """Flights that are not straight."""

    blocked: BoolArray  # (node, node) straight flights that meet an obstacle
    outward: Pairs  # nodes and the corners that they see
    between: Pairs  # corners and the corners that they see
    turns: Turns
    order: IntArray  # (node,) all nodes, the outermost first, so that searches become shorter

    def replace_blocked(self, legs: FlightLegs, wind: Wind, pause: Pause) -> None:
        """Fly around where there is no straight flight. In place.

        A straight flight is the quickest in steady wind too, so quickest ways bend only at corners.
        """
        outward, inward = self.outward.flown(wind), self.outward.flown(wind, back=True)
        between = self.between.flown(wind)
        size = 1 + FLIGHTS_AT_ONCE // (1 + len(outward.place) + 4 * len(between.place))
        for rows in row_blocks(len(self.blocked), size, pause):
            call("tandem_fly_around", outward, between, inward, self.turns, self.blocked,
                 self.order, wind.is_calm, rows.start, rows.stop, legs.distance, legs.duration)

    def bends(self, start: int, end: int, wind: Wind) -> IntArray:
        """Return the corners, in their order, where the quickest flight between two nodes bends.

        None where there is no flight around obstacles.
        """
        return self.quickest(start, end, wind)[1]

    def quickest(self, start: int, end: int, wind: Wind) -> tuple[float, IntArray]:
        """Return the seconds of the quickest flight between two nodes, and where it bends.

        Infinite where there is none around obstacles.

        References
        ----------
        Dijkstra (1959), a note on two problems in connexion with graphs, Numer. Math. 1:269-271.
        """
        num_corners = len(self.between.begin) - 1
        time, before = np.full(num_corners, np.inf), np.full(num_corners, -1)
        left = np.full(num_corners, np.inf)  # from a corner to the end
        corners, durations = self.outward.seen_from(start, wind)
        time[corners] = durations
        corners, durations = self.outward.seen_from(end, wind, back=True)
        left[corners] = durations
        ahead = time.copy()  # infinite once a corner is done with
        while num_corners and ahead.min() < (time + left).min():
            corner = int(ahead.argmin())
            ahead[corner] = np.inf
            corners, durations = self.between.seen_from(corner, wind)
            sooner = time[corner] + durations < time[corners]
            corners = corners[sooner]
            time[corners] = ahead[corners] = time[corner] + durations[sooner]
            before[corners] = corner
        return float((time + left).min(initial=np.inf)), _traced(time + left, before)


def _traced(total: FloatArray, before: IntArray) -> IntArray:
    """Return the way to the corner from which the end is reached the soonest."""
    corners: list[int] = []
    if len(total) and np.isfinite(total.min()):
        corner = int(total.argmin())
        while corner >= 0:
            corners.append(corner)
            corner = int(before[corner])
    return np.array(corners[::-1], np.int64)


def find_ways(points: FloatArray, obstacles: Obstacles, pause: Pause) -> Ways:
    """Find out which points and corners of obstacles see one another."""
    inside = obstacles.hold(points)
    blocked = inside[:, None] | inside
    unreachable = np.count_nonzero(blocked)
    _look_around(points, obstacles, blocked, pause)
    corners = obstacles.corners
    if np.count_nonzero(blocked) == unreachable:
        corners = Corners(*(places[:0] for places in corners))
    hidden = _dead_ends(points, corners, pause)
    hidden[inside] = True
    _look(points, corners.place, obstacles, hidden, pause)
    row, column = np.nonzero(~hidden)
    outward = _pairs(points, corners.place, row, column)
    between, turns = _turning(corners, outward, *_sights(corners, obstacles, pause))
    middle = points.mean(axis=0) if len(points) else 0.0
    order = np.argsort(-np.hypot(*(points - middle).T), kind="stable")
    return Ways(blocked, outward, between, turns, order)


def _look_around(points: FloatArray, obstacles: Obstacles, hidden: BoolArray,
                 pause: Pause) -> None:
    """Mark the pairs of points that don't see each other. In place."""
    _look(points, points, obstacles, hidden, pause, mutual=True)
    for rows in matrix_blocks(len(points), pause):
        hidden[rows] |= hidden[:, rows].T


def _look(starts: FloatArray, ends: FloatArray, obstacles: Obstacles, hidden: BoolArray,
          pause: Pause, mutual: bool = False) -> None:
    """Mark the ends that each start doesn't see; mutually, those behind it alone. In place."""
    if len(obstacles.edges) == 0:
        return
    looks = int(np.count_nonzero(~hidden)) // (1 + len(starts))
    for rows in row_blocks(len(starts), 1 + LOOKS_AT_ONCE // (1 + looks), pause):
        call("tandem_mark_hidden", starts, ends, obstacles.edges, hidden, rows.start, rows.stop,
             mutual)


def _dead_ends(starts: FloatArray, corners: Corners, pause: Pause) -> BoolArray:
    """Mark the (start, corner) pairs that no quickest way goes along."""
    dead = np.zeros((len(starts), len(corners.place)), np.bool_)
    for rows in row_blocks(len(starts), 1 + LOOKS_AT_ONCE // (1 + len(corners.place)), pause):
        call("tandem_mark_dead_ends", starts, *corners, SLACK_M, dead, rows.start, rows.stop)
    return dead


def _sights(corners: Corners, obstacles: Obstacles, pause: Pause) -> tuple[IntArray, IntArray]:
    """Return the rows and columns of corners that see one another, each pair both ways."""
    count = len(corners.place)
    room = np.empty((count + ROOM_FOR_SIGHTS, 2), np.int32)
    found = [np.empty((0, 2), np.int32)]
    for is_east in (False, True):
        first = 0
        while first < count:
            pause()
            written, first = call("tandem_write_sights", *corners, obstacles.edges, SLACK_M,
                                  is_east, first, min(first + CORNERS_AT_ONCE, count), room)
            found.append(room[:written].copy())
    one, other = np.concatenate(found).astype(np.int64).T
    return np.concatenate([one, other]), np.concatenate([other, one])


def _turning(corners: Corners, outward: Pairs, row: IntArray, column: IntArray
             ) -> tuple[Pairs, Turns]:
    """Return the flights between corners, and the sides on which their areas may lie."""
    edges = [np.ascontiguousarray((neighbour - corners.place).T)
             for neighbour in (corners.before, corners.after)]
    place = np.ascontiguousarray(corners.place.T)
    leaving = _sides(edges, row, *(axis[column] - axis[row] for axis in place))
    # Those on the left alone first, those on either side, those on the right alone.
    order = np.argsort(3 * row + np.array((0, 0, 2, 1))[leaving], kind="stable")
    row, column, leaving = row[order], column[order], leaving[order]
    between = _pairs(corners.place, corners.place, row, column)
    count = len(corners.place)
    return between, Turns(
        _sides(edges, outward.column, outward.x, outward.y),
        _sides(edges, column, between.x, between.y),
        between.begin[:-1] + np.bincount(row[leaving == LEFT], minlength=count),
        between.begin[1:] - np.bincount(row[leaving == RIGHT], minlength=count))


def _sides(edges: Sequence[FloatArray], corner: IntArray, x: FloatArray, y: FloatArray
           ) -> IntArray:
    """Return on which sides of ways to or from a corner each its area may lie.

    The two `edges` of each corner lead to its neighbours on the boundary.
    """
    slack = SLACK_M * np.hypot(x, y)
    one, other = (x * edge[1, corner] - y * edge[0, corner] for edge in edges)
    is_right = np.minimum(one, other) < -slack
    is_left = np.maximum(one, other) > slack
    # Neither excludes both: that is so by rounding alone.
    sides = (LEFT + RIGHT - RIGHT * (is_left & ~is_right) - LEFT * (is_right & ~is_left))
    return sides.astype(np.int32)


def _pairs(starts: FloatArray, ends: FloatArray, row: IntArray, column: IntArray) -> Pairs:
    begin = np.zeros(len(starts) + 1, np.int64)
    np.cumsum(np.bincount(row, minlength=len(starts)), out=begin[1:])
    row, column = np.ascontiguousarray(row), np.ascontiguousarray(column)
    return Pairs(begin, column, ends[column, 0] - starts[row, 0], ends[column, 1] - starts[row, 1])
