"""How long a vehicle works past what is usual, and how much a trip may have. Compiled.

`kind` is the row of the vehicle type, whose limits of the end and of the working duration are those
with all the overtime allowed.
"""

from model.kernel.compiled import inlined
from model.kernel.plain import is_plain
from model.kernel.records import Record


@inlined
def overtime(kind: Record, end: int, working: int) -> int:
    """Return how long a vehicle works that ends at `end`, and works so long, past what is usual.

    Past the shift or its working duration, the longer.
    """
    if is_plain(kind):
        return 0
    return max(0, max(end - kind.usual_end, working - kind.usual_working))


@inlined
def usual_end(kind: Record) -> int:
    """Return when the shift ends without overtime."""
    return kind.usual_end


@inlined
def usual_working(kind: Record) -> int:
    """Return the longest working duration without overtime."""
    return kind.usual_working


@inlined
def most_stops(kind: Record) -> int:
    """Return how many customers the truck may serve itself on a trip, UNLIMITED if any number."""
    return kind.max_stops


@inlined
def allows_stops(kind: Record, count: int) -> bool:
    """Tell whether the truck may serve so many customers itself on a trip."""
    return is_plain(kind) or count <= kind.max_stops


@inlined
def allows_sorties(kind: Record, count: int) -> bool:
    """Tell whether so many sorties may be flown on a trip."""
    return is_plain(kind) or count <= kind.max_sorties
