"""When a vehicle that may be under way leaves where it begins, and since when it works. Compiled.

`columns` are those of the vehicle type.
"""

from model.kernel.compiled import inlined
from model.kernel.instance import TYPE_BEGUN, TYPE_BUSY, TYPE_EARLIEST
from model.problem import IntArray


@inlined
def leaves_first(columns: IntArray, time: int) -> int:
    """Return when a truck leaves its start at which its trip begins at `time`."""
    return max(time, columns[TYPE_BUSY])


@inlined
def has_begun(columns: IntArray) -> bool:
    """Tell whether work counts from before the vehicle leaves, however late it does."""
    return columns[TYPE_BEGUN] == 1


@inlined
def counted_from(columns: IntArray, departure: int) -> int:
    """Return from when work counts that begins with a departure, unless it has begun before."""
    return columns[TYPE_EARLIEST] if has_begun(columns) else departure
