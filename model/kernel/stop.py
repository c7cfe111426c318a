"""What windows and a service mean at a customer: all instants of a stop. Compiled.

`place` is a node's rows, in the table of whoever serves there. Callers state when somebody arrives,
and never compare with a field themselves, so that what a window is can change here alone.

Within a block of stops, times hang on the arrival `time` at its beginning: a pair (d, c) stands
for `max(time + d, c)`, and holds for arrivals in an interval (see `docs/search.md`).
"""

from model.kernel.compiled import inlined, pasted
from model.kernel.instance import FAR, NONE
from model.kernel.plain import is_plain
from model.kernel.records import Record, Records


@pasted
def places_of(places: Records, kind: Record) -> Records:
    """Return the rows of all nodes, (node, row), as trucks of a type meet them."""
    return places[0 if is_plain(kind) else kind.variant]


@pasted
def places_by_air(places: Records, kind: Record) -> Records:
    """Return the rows of all nodes, (node, row), as drones of a type meet them."""
    return places[kind.drone_variant]


@pasted
def num_rows(place: Records) -> int:
    """Return how many rows each node has."""
    return 1 if is_plain(place[0]) else len(place)


@inlined
def are_single(place: Records) -> bool:
    """Tell whether nobody has several windows, by anyone's rows."""
    return num_rows(place) == 1


@inlined
def opening(place: Records, arrival: int) -> int:
    """Return the beginning of the window in which whoever comes at `arrival` is served."""
    opens = place[0].window_earliest
    for gap in range(1, num_rows(place)):
        if arrival <= place[gap].window_latest:
            break
        opens = place[gap].window_earliest
    return opens


@inlined
def closing(place: Records) -> int:
    """Return the last arrival that is not late."""
    return place[0].window_latest


@inlined
def width(place: Records) -> int:
    """Return in how much time whoever arrives needn't wait and isn't late."""
    wide = closing(place) - place[0].window_earliest
    for gap in range(1, num_rows(place)):
        if place[gap].window_latest == FAR:
            break
        wide -= place[gap].window_earliest - place[gap].window_latest
    return wide


@inlined
def service_duration(place: Records) -> int:
    """Return how long service takes."""
    return place[0].service_duration


@inlined
def start_of_service(place: Records, arrival: int) -> int:
    """Return when service begins; early arrival waits."""
    return max(arrival, opening(place, arrival))


@inlined
def end_of_service(place: Records, arrival: int) -> int:
    """Return when a customer is served."""
    return start_of_service(place, arrival) + service_duration(place)


@inlined
def too_late(place: Records, arrival: int) -> bool:
    """Tell whether a hard window forbids an arrival."""
    return arrival > place[0].arrival_limit


@inlined
def latest_allowed(place: Records) -> int:
    """Return the last arrival that is allowed."""
    return place[0].arrival_limit


@inlined
def lateness(place: Records, arrival: int) -> int:
    """Return by how much an arrival is late."""
    return max(0, arrival - closing(place))


@inlined
def waiting(place: Records, arrival: int) -> int:
    """Return how long whoever arrives waits for the window."""
    return start_of_service(place, arrival) - arrival


@inlined
def as_late(place: Records, arrival: int) -> int:
    """Return the last arrival that is no later, by its window, than `arrival`."""
    return max(arrival, closing(place))


@inlined
def in_same_window(place: Records, arrival: int) -> int:
    """Return the last arrival that is served in the same window as `arrival`, and no later."""
    for gap in range(1, num_rows(place)):
        if arrival <= place[gap].window_latest:
            return min(place[gap].window_latest, as_late(place, arrival))
    return as_late(place, arrival)


@inlined
def _no_later_than(place: Records, start: int) -> int:
    """Return the last arrival that starts by `start`, which is no earlier than the first opening.

    Who would come between two windows has to come while the one before is open.
    """
    for gap in range(1, num_rows(place)):
        if place[gap].window_latest < start < place[gap].window_earliest:
            return place[gap].window_latest
    return start


@inlined
def latest_arrival(place: Records, leave: int) -> int:
    """Return the last arrival that is allowed and lets a truck leave by `leave`."""
    return min(place[0].arrival_limit, _no_later_than(place, leave - service_duration(place)))


@inlined
def latest_free_arrival(place: Records, arrival: int, leave: int) -> int:
    """Return the last arrival no later than `arrival` is that lets a truck leave by `leave`."""
    return min(as_late(place, arrival), _no_later_than(place, leave - service_duration(place)))


@inlined
def start_within(place: Records, time: int, d: int, c: int) -> tuple[int, int]:
    """Return the pair of the start of service, for an arrival at (d, c)."""
    return d, max(c, opening(place, max(time + d, c)))


@inlined
def allowed_within(place: Records, time: int, d: int, c: int) -> tuple[int, int]:
    """Return for which arrivals at the block's beginning one at (d, c) is allowed and starts so.

    The first and the last: those that are served in the same window. For where c itself is not
    `too_late`.
    """
    first, arrival = NONE, max(time + d, c)
    for gap in range(1, num_rows(place)):
        if arrival <= place[gap].window_latest:
            return first, min(place[gap].window_latest, latest_allowed(place)) - d
        if c <= place[gap].window_latest:
            first = place[gap].window_latest + 1 - d
    return first, latest_allowed(place) - d
