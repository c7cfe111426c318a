"""When a leg is done by a speed that changes with the time of day. Compiled."""

from model.kernel.compiled import compiled, inlined
from model.problem import FULL_SPEED, IntArray


@inlined
def changes_until(times: IntArray, changes: int, time: int) -> int:
    """Return how many of the changes of a speed come no later than `time`."""
    low, high = 0, changes
    while low < high:
        middle = (low + high) // 2
        if times[middle] <= time:
            low = middle + 1
        else:
            high = middle
    return low


@compiled
def arrival_by_profile(times: IntArray, factors: IntArray, changes: int, duration: int,
                       leave: int) -> int:
    """Return when a leg of `duration` at full speed, begun at `leave`, is done."""
    piece = changes_until(times, changes, leave)
    work = duration * FULL_SPEED
    time = leave
    while piece < changes:
        done = (times[piece] - time) * factors[piece]
        if work <= done:
            break
        work -= done
        time = times[piece]
        piece += 1
    return time + (work + factors[piece] - 1) // factors[piece]
