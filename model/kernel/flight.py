"""What a flight may last. Compiled."""

from model.kernel.compiled import inlined
from model.kernel.instance import TYPE_ENDURANCE, TYPE_WAITING_COUNTS
from model.problem import UNREACHABLE, IntArray


@inlined
def within_endurance(columns: IntArray, takeoff: int, back: int, recovery_start: int) -> bool:
    """Tell whether a sortie, back at `back` and recovered from then on, is short enough."""
    if columns[TYPE_WAITING_COUNTS]:
        return recovery_start - takeoff <= columns[TYPE_ENDURANCE]
    return back - takeoff <= columns[TYPE_ENDURANCE]


@inlined
def unreachable(duration: int) -> bool:
    """Tell whether a flight duration marks a flight that can't be flown."""
    return duration >= UNREACHABLE
