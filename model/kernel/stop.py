"""What a window and a service mean at a customer: all instants of a stop. Compiled.

`place` is a row of node columns, or the `Hours` taken from one for a loop. Callers state when
somebody arrives, and never compare with a column themselves, so that what a window is can change
here alone.

Within a block of stops, times hang on the arrival `time` at its beginning: a pair (d, c) stands
for `max(time + d, c)`, and holds for arrivals in an interval (see `docs/search.md`).
"""

from typing import NamedTuple

from model.kernel.compiled import inlined
from model.kernel.instance import (
    NODE_EARLIEST, NODE_LATEST, NODE_LIMIT, NODE_RELEASE, NODE_SERVICE, NONE,
)
from model.problem import IntArray


class Hours(NamedTuple):
    """What a customer's row says of time, in the order of its columns, as numbers at hand."""

    earliest: int
    limit: int
    service: int
    release: int
    latest: int


Place = IntArray | Hours
"""Either can be asked for columns."""


@inlined
def hours(place: IntArray) -> Hours:
    """Take from a row what a loop asks for again and again."""
    return Hours(place[NODE_EARLIEST], place[NODE_LIMIT], place[NODE_SERVICE], place[NODE_RELEASE],
                 place[NODE_LATEST])


@inlined
def opening(place: Place, arrival: int) -> int:
    """Return the beginning of the window in which whoever comes at `arrival` is served."""
    return place[NODE_EARLIEST]


@inlined
def closing(place: Place) -> int:
    """Return the last arrival that is not late."""
    return place[NODE_LATEST]


@inlined
def width(place: Place) -> int:
    """Return how long it takes from the first arrival that needn't wait to the last in time."""
    return closing(place) - opening(place, NONE)


@inlined
def service_duration(place: Place) -> int:
    """Return how long a truck serves a customer."""
    return place[NODE_SERVICE]


@inlined
def start_of_service(place: Place, arrival: int) -> int:
    """Return when service begins; early arrival waits."""
    return max(arrival, opening(place, arrival))


@inlined
def end_of_service(place: Place, arrival: int) -> int:
    """Return when a truck has served."""
    return start_of_service(place, arrival) + service_duration(place)


@inlined
def too_late(place: Place, arrival: int) -> bool:
    """Tell whether a hard window forbids an arrival."""
    return arrival > place[NODE_LIMIT]


@inlined
def lateness(place: Place, arrival: int) -> int:
    """Return by how much an arrival is late."""
    return max(0, arrival - closing(place))


@inlined
def waiting(place: Place, arrival: int) -> int:
    """Return how long whoever arrives waits for the window."""
    return start_of_service(place, arrival) - arrival


@inlined
def as_late(place: Place, arrival: int) -> int:
    """Return the last arrival that is no later, by its window, than `arrival`."""
    return max(arrival, closing(place))


@inlined
def latest_arrival(place: Place, leave: int) -> int:
    """Return the last arrival that is allowed and lets a truck leave by `leave`."""
    return min(place[NODE_LIMIT], leave - service_duration(place))


@inlined
def latest_free_arrival(place: Place, arrival: int, leave: int) -> int:
    """Return the last arrival no later than `arrival` is that lets a truck leave by `leave`."""
    return min(as_late(place, arrival), leave - service_duration(place))


@inlined
def start_within(place: Place, time: int, d: int, c: int) -> tuple[int, int]:
    """Return the pair of the start of service, for an arrival at (d, c)."""
    return d, max(c, opening(place, max(time + d, c)))


@inlined
def allowed_within(place: Place, time: int, d: int, c: int) -> tuple[int, int]:
    """Return for which arrivals at the block's beginning one at (d, c) is allowed and starts so.

    The first and the last. For where c itself is not `too_late`.
    """
    return NONE, place[NODE_LIMIT] - d
