"""Who sees whom past obstacles: compiled, so that millions of lines of sight take seconds.

Obstacles are segments, the edges of areas that no line of sight may meet. Seen from one point, each
edge covers a range of angles; it is filed under the few nodes of a binary tree over all angles
that make up its range, so that a line of sight is compared only with the edges on its way.
"""

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.problem import BoolArray, FloatArray, IntArray

LEVELS = 10
"""The tree of angles has two to this many leaves."""

LEAVES = 1 << LEVELS

FEW_EDGES = 12
"""With no more edges than this, every line of sight is compared with all."""

NARROWEST = 1e-9
"""Smallest range of angles that the tree divides: below, rounding would decide."""

MARGIN = 0.01
"""Share of a leaf by which an edge's range of angles is widened."""

OUTSIDE = -1


@compiled
def mark_hidden(
    starts: FloatArray, ends: FloatArray, edges: FloatArray, hidden: BoolArray, first: int,
    last: int, mutual: bool,
) -> None:
    """Mark the ends that each of some starts doesn't see. In place.

    Parameters
    ----------
    starts, ends
        (start, 2) and (end, 2) points outside all areas.
    edges
        (edge, 4) x and y of both ends of the areas' edges.
    hidden
        (start, end); pairs that are marked already are not looked at.
    first, last
        The rows to work out.
    mutual
        Whether `ends` are `starts`: then only the ends behind each start are looked at.
    """
    count = len(edges)
    seen = np.empty((count, 4))
    heads = np.empty(2 * LEAVES, np.int64)
    following = np.empty(count * 4 * LEVELS, np.int64)
    items = np.empty(count * 4 * LEVELS, np.int64)
    ranges = np.empty((count, 2))
    for row in range(first, last):
        begin = row + 1 if mutual else 0
        _move(edges, starts[row, 0], starts[row, 1], seen)
        if count <= FEW_EDGES:
            for column in range(begin, len(ends)):
                if not hidden[row, column]:
                    x, y = ends[column, 0] - starts[row, 0], ends[column, 1] - starts[row, 1]
                    hidden[row, column] = _meets_any(seen, x, y)
            continue
        centre_x, centre_y = _middle(seen)
        lowest, scale = _ranges(seen, centre_x, centre_y, ranges)
        _file(ranges, lowest, scale, heads, following, items)
        for column in range(begin, len(ends)):
            if not hidden[row, column]:
                x, y = ends[column, 0] - starts[row, 0], ends[column, 1] - starts[row, 1]
                leaf = _leaf(_angle(x, y, centre_x, centre_y), lowest, scale)
                hidden[row, column] = (
                    leaf != OUTSIDE and _meets_filed(seen, x, y, leaf, heads, following, items))


@compiled
def mark_dead_ends(
    starts: FloatArray, corners: FloatArray, before: FloatArray, after: FloatArray,
    slack: float, hidden: BoolArray, first: int, last: int,
) -> None:
    """Mark the corners that no shortest way from each of some starts bends at. In place.

    Such a way leaves the area on one side: if the line through a start and a corner has the
    corner's two edges on different sides, the way may be cut short there.

    Parameters
    ----------
    before, after
        (corner, 2) the corners' neighbours on their area's boundary.
    slack
        How far from the line a neighbour may be to count as on either side.
    """
    for row in range(first, last):
        for corner in range(len(corners)):
            x, y = corners[corner, 0] - starts[row, 0], corners[corner, 1] - starts[row, 1]
            near = slack * np.sqrt(x * x + y * y)
            one = (x * (before[corner, 1] - corners[corner, 1])
                   - y * (before[corner, 0] - corners[corner, 0]))
            other = (x * (after[corner, 1] - corners[corner, 1])
                     - y * (after[corner, 0] - corners[corner, 0]))
            if (one > near and other < -near) or (one < -near and other > near):
                hidden[row, corner] = True


@inlined
def _move(edges: FloatArray, x: float, y: float, seen: FloatArray) -> None:
    """Write the edges as seen from a point. In place."""
    for edge in range(len(edges)):
        seen[edge, 0] = edges[edge, 0] - x
        seen[edge, 1] = edges[edge, 1] - y
        seen[edge, 2] = edges[edge, 2] - x
        seen[edge, 3] = edges[edge, 3] - y


@inlined
def _meets(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> bool:
    """Tell whether the segment from the origin to x, y meets that from a to b."""
    if (max(ax, bx) < min(0.0, x) or min(ax, bx) > max(0.0, x)
            or max(ay, by) < min(0.0, y) or min(ay, by) > max(0.0, y)):
        return False
    side_a = x * ay - y * ax
    side_b = x * by - y * bx
    if (side_a > 0 and side_b > 0) or (side_a < 0 and side_b < 0):
        return False
    along_x, along_y = bx - ax, by - ay
    side_origin = along_y * ax - along_x * ay
    side_end = along_x * (y - ay) - along_y * (x - ax)
    return not ((side_origin > 0 and side_end > 0) or (side_origin < 0 and side_end < 0))


@inlined
def _meets_any(seen: FloatArray, x: float, y: float) -> bool:
    for edge in range(len(seen)):
        if _meets(x, y, seen[edge, 0], seen[edge, 1], seen[edge, 2], seen[edge, 3]):
            return True
    return False


@inlined
def _middle(seen: FloatArray) -> tuple[float, float]:
    """Return a direction towards the edges, so that they seldom lie behind where angles end."""
    x = y = 0.0
    for edge in range(len(seen)):
        x += seen[edge, 0]
        y += seen[edge, 1]
    length = np.sqrt(x * x + y * y)
    return (x / length, y / length) if length > 0 else (1.0, 0.0)


@inlined
def _angle(x: float, y: float, centre_x: float, centre_y: float) -> float:
    """Return what grows with the angle from the centre: 0 there, 1 at a right one, -2 to 2."""
    along = x * centre_x + y * centre_y
    across = y * centre_x - x * centre_y
    reach = abs(along) + abs(across)
    if reach == 0:
        return 0.0
    share = across / reach
    if along >= 0:
        return share
    return 2.0 - share if across >= 0 else -2.0 - share


@inlined
def _ranges(seen: FloatArray, centre_x: float, centre_y: float,
            ranges: FloatArray) -> tuple[float, float]:
    """Write each edge's range of angles, from high to low where it lies across the end of angles.

    In place.

    Returns
    -------
    The lowest angle of all, and leaves per angle.
    """
    lowest, highest = 2.0, -2.0
    for edge in range(len(seen)):
        one = _angle(seen[edge, 0], seen[edge, 1], centre_x, centre_y)
        other = _angle(seen[edge, 2], seen[edge, 3], centre_x, centre_y)
        low, high = min(one, other), max(one, other)
        if high - low > 2.0 - 1e-6:
            # It passes behind, or so near that it can't be told on which side.
            lowest, highest = -2.0, 2.0
            if high - low < 2.0 + 1e-6:
                low, high = -2.0, 2.0
            else:
                low, high = high, low
        ranges[edge, 0] = low
        ranges[edge, 1] = high
        lowest, highest = min(lowest, low), max(highest, high)
    return lowest, LEAVES / max(highest - lowest, NARROWEST)


@inlined
def _leaf(angle: float, lowest: float, scale: float) -> int:
    """Return the leaf of an angle, or `OUTSIDE` if no edge is there."""
    place = (angle - lowest) * scale
    if place < -MARGIN or place > LEAVES + MARGIN:
        return OUTSIDE
    return min(max(int(place), 0), LEAVES - 1)


@inlined
def _file(ranges: FloatArray, lowest: float, scale: float, heads: IntArray, following: IntArray,
          items: IntArray) -> None:
    """File all edges under the nodes of the tree that make up their ranges. In place."""
    heads[:] = -1
    filed = 0
    for edge in range(len(ranges)):
        low, high = ranges[edge, 0], ranges[edge, 1]
        for part in range(2 if low > high else 1):
            begin, end = (low - lowest) * scale - MARGIN, (high - lowest) * scale + MARGIN
            if low > high:
                begin, end = (begin, LEAVES) if part == 0 else (0, end)
            left = min(max(int(begin), 0), LEAVES - 1) + LEAVES
            right = min(max(int(end), 0), LEAVES - 1) + LEAVES + 1
            while left < right:
                if left & 1:
                    items[filed], following[filed], heads[left] = edge, heads[left], filed
                    filed += 1
                    left += 1
                if right & 1:
                    right -= 1
                    items[filed], following[filed], heads[right] = edge, heads[right], filed
                    filed += 1
                left >>= 1
                right >>= 1


@inlined
def _meets_filed(seen: FloatArray, x: float, y: float, leaf: int, heads: IntArray,
                 following: IntArray, items: IntArray) -> bool:
    """Tell whether a line of sight meets an edge filed under its leaf, or above it."""
    node = leaf + LEAVES
    while node > 0:
        entry = heads[node]
        while entry >= 0:
            edge = items[entry]
            if _meets(x, y, seen[edge, 0], seen[edge, 1], seen[edge, 2], seen[edge, 3]):
                return True
            entry = following[entry]
        node >>= 1
    return False
