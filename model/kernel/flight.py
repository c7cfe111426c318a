"""What a flight may last, and all instants of one but those on the way. Compiled.

`columns` are those of the vehicle type, `place` is the customer's row, as for `stop`.
"""

from model.kernel.compiled import inlined
from model.kernel.instance import FAR, NONE
from model.kernel.records import Record
from model.kernel.stop import Place, opening, service_duration, start_of_service
from model.problem import UNREACHABLE


@inlined
def unreachable(duration: int) -> bool:
    """Tell whether a flight duration marks a flight that can't be flown."""
    return duration >= UNREACHABLE


@inlined
def drone_service(columns: Record, place: Place) -> int:
    """Return how long a drone serves a customer: as its type says, else as the customer."""
    own = columns.drone_service_duration
    return own if own >= 0 else service_duration(place)


@inlined
def ready(columns: Record, place: Place, arrival: int) -> int:
    """Return when a drone has served."""
    return start_of_service(place, arrival) + drone_service(columns, place)


@inlined
def take_off(columns: Record, begin: int) -> int:
    """Return when a drone is in the air whose launch begins at `begin`."""
    return begin + columns.launch_duration


@inlined
def launch_begin(columns: Record, takeoff: int) -> int:
    """Return when the launch begins of a drone that takes off at `takeoff`."""
    return takeoff - columns.launch_duration


@inlined
def recovery_end(columns: Record, begin: int) -> int:
    """Return when a drone is aboard whose recovery begins at `begin`."""
    return begin + columns.recovery_duration


@inlined
def launch_duration(columns: Record) -> int:
    """Return how long a launch takes."""
    return columns.launch_duration


@inlined
def handling_duration(columns: Record) -> int:
    """Return how long launch and recovery take together."""
    return columns.launch_duration + columns.recovery_duration


@inlined
def recoveries_take_time(columns: Record) -> bool:
    """Tell whether a recovery can hold up another."""
    return columns.recovery_duration > 0


@inlined
def earliest_back(columns: Record, place: Place, home: int) -> int:
    """Return when a drone that is at a customer as the window opens is where `home` leads to."""
    return opening(place, NONE) + drone_service(columns, place) + home


@inlined
def held_until(columns: Record, back: int) -> int:
    """Return the earliest take-off after which a drone can be back within its endurance.

    `back` is the earliest that windows allow; the flight itself may be too long.
    """
    return back - columns.endurance


@inlined
def held_takeoff(columns: Record, place: Place, takeoff: int, home: int) -> int:
    """Return when a drone takes off to one customer that can at `takeoff`: then, or held back."""
    return max(takeoff, held_until(columns, earliest_back(columns, place, home)))


@inlined
def can_last(columns: Record, duration: int) -> bool:
    """Tell whether a flight, out, service and home, is within the endurance if nothing waits.

    None is that leads where nobody can fly.
    """
    return duration <= columns.endurance


@inlined
def counted_until(columns: Record, back: int, recovery_start: int) -> int:
    """Return until when the endurance counts: as a drone is back, or as its recovery begins."""
    return recovery_start if columns.waiting_counts else back


@inlined
def within_endurance(columns: Record, takeoff: int, back: int, recovery_start: int) -> bool:
    """Tell whether a sortie, back at `back` and recovered from then on, is short enough."""
    return can_last(columns, counted_until(columns, back, recovery_start) - takeoff)


@inlined
def enduring_within(columns: Record, takeoff_d: int, takeoff_c: int, d: int,
                    c: int) -> tuple[int, int]:
    """Return for which arrivals at a block's beginning (d, c) is within the endurance.

    The first and the last; FAR and NONE if there is none. Pairs are as for `stop`; (d, c) is what
    `counted_until` says, and the take-off a pair too. With `time`, both are sums with d as soon as
    that is past `takeoff_c - takeoff_d`, so that a flight too long by d must begin before.
    """
    endurance = columns.endurance
    if d - takeoff_d <= endurance:
        return (c - endurance - takeoff_d if c - takeoff_c > endurance else NONE), FAR
    if c - takeoff_c > endurance:
        return FAR, NONE
    return NONE, endurance + takeoff_c - d
