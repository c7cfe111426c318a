"""What a window and a service mean at a customer: all instants of a stop. Compiled.

`place` is a row of nodes, or the `Hours` taken from one for a loop. Callers state when
somebody arrives, and never compare with a field themselves, so that what a window is can change
here alone.

Within a block of stops, times hang on the arrival `time` at its beginning: a pair (d, c) stands
for `max(time + d, c)`, and holds for arrivals in an interval (see `docs/search.md`).
"""

from typing import NamedTuple

from model.kernel.compiled import inlined
from model.kernel.instance import NONE
from model.kernel.records import Record


class Hours(NamedTuple):
    """What a customer's row says of time, as numbers at hand."""

    window_earliest: int
    arrival_limit: int
    service_duration: int
    release: int
    window_latest: int


Place = Record | Hours
"""Either has these fields."""


@inlined
def hours(place: Record) -> Hours:
    """Take from a row what a loop asks for again and again."""
    return Hours(place.window_earliest, place.arrival_limit, place.service_duration, place.release,
                 place.window_latest)


@inlined
def opening(place: Place, arrival: int) -> int:
    """Return the beginning of the window in which whoever comes at `arrival` is served."""
    return place.window_earliest


@inlined
def closing(place: Place) -> int:
    """Return the last arrival that is not late."""
    return place.window_latest


@inlined
def width(place: Place) -> int:
    """Return how long it takes from the first arrival that needn't wait to the last in time."""
    return closing(place) - opening(place, NONE)


@inlined
def service_duration(place: Place) -> int:
    """Return how long a truck serves a customer."""
    return place.service_duration


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
    return arrival > place.arrival_limit


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
    return min(place.arrival_limit, leave - service_duration(place))


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
    return NONE, place.arrival_limit - d
