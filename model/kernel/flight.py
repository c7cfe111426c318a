"""What a flight may last, and all instants of one but those on the way. Compiled.

`kind` is the row of the vehicle type, `place` is the customer's row, as for `stop`.
"""

from model.kernel.compiled import inlined
from model.kernel.instance import FAR, NONE
from model.kernel.records import Record, Records
from model.kernel.stop import opening, service_duration, start_of_service
from model.problem import UNREACHABLE


@inlined
def unreachable(duration: int) -> bool:
    """Tell whether a flight duration marks a flight that can't be flown."""
    return duration >= UNREACHABLE


@inlined
def drone_service(kind: Record, place: Records) -> int:
    """Return how long a drone serves a customer: as its type says, else as the customer."""
    own = kind.drone_service_duration
    return own if own >= 0 else service_duration(place)


@inlined
def ready(kind: Record, place: Records, arrival: int) -> int:
    """Return when a drone has served."""
    return start_of_service(place, arrival) + drone_service(kind, place)


@inlined
def take_off(kind: Record, begin: int) -> int:
    """Return when a drone is in the air whose launch begins at `begin`."""
    return begin + kind.launch_duration


@inlined
def launch_begin(kind: Record, takeoff: int) -> int:
    """Return when the launch begins of a drone that takes off at `takeoff`."""
    return takeoff - kind.launch_duration


@inlined
def recovery_end(kind: Record, begin: int) -> int:
    """Return when a drone is aboard whose recovery begins at `begin`."""
    return begin + kind.recovery_duration


@inlined
def launch_duration(kind: Record) -> int:
    """Return how long a launch takes."""
    return kind.launch_duration


@inlined
def handling_duration(kind: Record) -> int:
    """Return how long launch and recovery take together."""
    return kind.launch_duration + kind.recovery_duration


@inlined
def recoveries_take_time(kind: Record) -> bool:
    """Tell whether a recovery can hold up another."""
    return kind.recovery_duration > 0


@inlined
def earliest_back(kind: Record, place: Records, arrival: int, home: int) -> int:
    """Return when a drone is where `home` leads to that is at a customer as the window opens.

    The window in which whoever comes at `arrival` is served.
    """
    return opening(place, arrival) + drone_service(kind, place) + home


@inlined
def held_until(kind: Record, back: int) -> int:
    """Return the earliest take-off after which a drone can be back within its endurance.

    `back` is the earliest that windows allow; the flight itself may be too long.
    """
    return back - kind.endurance


@inlined
def held_takeoff(kind: Record, place: Records, takeoff: int, out: int, home: int) -> int:
    """Return when a drone takes off to one customer that can at `takeoff`: then, or held back.

    `out` and `home` are the durations of its legs.
    """
    held = held_until(kind, earliest_back(kind, place, takeoff + out, home))
    while held > takeoff:
        takeoff = held
        held = held_until(kind, earliest_back(kind, place, takeoff + out, home))
    return takeoff


@inlined
def can_last(kind: Record, duration: int) -> bool:
    """Tell whether a flight, out, service and home, is within the endurance if nothing waits.

    None is that leads where nobody can fly.
    """
    return duration <= kind.endurance


@inlined
def counted_until(kind: Record, back: int, recovery_start: int) -> int:
    """Return until when the endurance counts: as a drone is back, or as its recovery begins."""
    return recovery_start if kind.waiting_counts else back


@inlined
def within_endurance(kind: Record, takeoff: int, back: int, recovery_start: int) -> bool:
    """Tell whether a sortie, back at `back` and recovered from then on, is short enough."""
    return can_last(kind, counted_until(kind, back, recovery_start) - takeoff)


@inlined
def enduring_within(kind: Record, takeoff_d: int, takeoff_c: int, d: int,
                    c: int) -> tuple[int, int]:
    """Return for which arrivals at a block's beginning (d, c) is within the endurance.

    The first and the last; FAR and NONE if there is none. Pairs are as for `stop`; (d, c) is what
    `counted_until` says, and the take-off a pair too. With `time`, both are sums with d as soon as
    that is past `takeoff_c - takeoff_d`, so that a flight too long by d must begin before.
    """
    endurance = kind.endurance
    if d - takeoff_d <= endurance:
        return (c - endurance - takeoff_d if c - takeoff_c > endurance else NONE), FAR
    if c - takeoff_c > endurance:
        return FAR, NONE
    return NONE, endurance + takeoff_c - d
