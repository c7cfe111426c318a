"""When a vehicle that may be under way leaves where it begins, and since when it works. Compiled.

`kind` is the row of the vehicle type.
"""

from model.kernel.compiled import inlined
from model.kernel.records import Record


@inlined
def leaves_first(kind: Record, time: int) -> int:
    """Return when a truck leaves its start at which its trip begins at `time`."""
    return max(time, kind.busy_until)


@inlined
def has_begun(kind: Record) -> bool:
    """Tell whether work counts from before the vehicle leaves, however late it does."""
    return kind.begun == 1


@inlined
def counted_from(kind: Record, departure: int) -> int:
    """Return from when work counts that begins with a departure, unless it has begun before."""
    return kind.shift_earliest if has_begun(kind) else departure
