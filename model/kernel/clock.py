"""When a leg is done, and when it has to begin, by speeds that change by time of day. Compiled.

`kind` is the row of the vehicle type, `times` and `factors` its profile, of which as many changes
count as the row says.
"""

from model.kernel.compiled import compiled, inlined
from model.kernel.instance import NO_PROFILE
from model.kernel.plain import is_plain
from model.kernel.records import Record, Records
from model.problem import FULL_SPEED, IntArray


@inlined
def is_steady(kind: Record) -> bool:
    """Tell whether the speed is the same all day, so that legs last as long as tables say."""
    return kind.speed_changes == NO_PROFILE


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


@inlined
def setup_beside(kind: Record, setups: Records, origin: int, to: int) -> int:
    """Return how long a truck sets up after a leg that the leg's duration doesn't hold."""
    if (is_plain(kind) or len(setups) == 0 or is_steady(kind)
            or setups[origin].site == setups[to].site):
        return 0
    return setups[to].setup_duration


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


@inlined
def leave_by_profile(times: IntArray, factors: IntArray, changes: int, duration: int,
                     arrival: int) -> int:
    """Return the latest departure whose leg of `duration` at full speed ends by `arrival`."""
    piece = changes_until(times, changes, arrival - 1)
    work = duration * FULL_SPEED
    time = arrival
    while piece > 0:
        done = (time - times[piece - 1]) * factors[piece]
        if work <= done:
            break
        work -= done
        time = times[piece - 1]
        piece -= 1
    return time - (work + factors[piece] - 1) // factors[piece]


@inlined
def leg_end(kind: Record, times: IntArray, factors: IntArray, duration: int,
            leave: int) -> int:
    """Return when a leg of `duration` at full speed, begun at `leave`, is done."""
    if is_steady(kind):
        return leave + duration
    return arrival_by_profile(times, factors, kind.speed_changes, duration, leave)


@inlined
def leg_start(kind: Record, times: IntArray, factors: IntArray, duration: int,
              arrival: int) -> int:
    """Return the latest departure whose leg of `duration` at full speed ends by `arrival`."""
    if is_steady(kind):
        return arrival - duration
    return leave_by_profile(times, factors, kind.speed_changes, duration, arrival)
