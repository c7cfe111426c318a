"""What a flight may last, and all instants of one but those on the way. Compiled.

`kind` is the row of the vehicle type, `place` the customer's rows from its drones' table of nodes,
`launched` how many launches of the trip come before one.
"""

from model.kernel.compiled import inlined
from model.kernel.energy import (
    after_hovering, after_leg, battery_of, charged_by, charges_aboard, hovers_at_customers,
    is_limited, longest_cruise, longest_hover,
)
from model.kernel.instance import FAR, NONE
from model.kernel.load import weight_brought, weight_taken
from model.kernel.plain import is_plain
from model.kernel.records import Record, Records
from model.kernel.stop import opening, service_duration
from model.problem import UNREACHABLE


@inlined
def unreachable(duration: int) -> bool:
    """Tell whether a flight duration marks a flight that can't be flown."""
    return duration >= UNREACHABLE


@inlined
def launch_duration(kind: Record, launched: int) -> int:
    """Return how long a launch takes: before all but a trip's first, a battery is swapped."""
    swaps = launches_differ(kind) and launched > 0
    return kind.relaunch_duration if swaps else kind.launch_duration


@inlined
def launches_differ(kind: Record) -> bool:
    """Tell whether it matters which launch is the first of a trip."""
    return not is_plain(kind) and kind.relaunch_duration != kind.launch_duration


@inlined
def take_off(kind: Record, begin: int, launched: int) -> int:
    """Return when a drone is in the air whose launch begins at `begin`."""
    return begin + launch_duration(kind, launched)


@inlined
def launch_begin(kind: Record, takeoff: int, launched: int) -> int:
    """Return when the launch begins of a drone that takes off at `takeoff`."""
    return takeoff - launch_duration(kind, launched)


@inlined
def recovery_end(kind: Record, begin: int) -> int:
    """Return when a drone is aboard whose recovery begins at `begin`."""
    return begin + kind.recovery_duration


@inlined
def gone_by(kind: Record, leave: int) -> int:
    """Return when a drone takes off at the latest whose truck would leave at `leave` without it.

    If no window holds it back. A usual launch is taken to be over by then, a swap to begin, and
    where it has to be charged, nothing is known.
    """
    if charges_aboard(kind):
        return FAR
    return take_off(kind, leave, 1) if launches_differ(kind) else leave


@inlined
def handling_duration(kind: Record) -> int:
    """Return how long launch and recovery take together, but for a trip's first launch."""
    return kind.relaunch_duration + kind.recovery_duration


@inlined
def takes_no_time(kind: Record, is_recovery: bool, launched: int) -> bool:
    """Tell whether a recovery, or else a launch, ends as it begins."""
    return (kind.recovery_duration if is_recovery else launch_duration(kind, launched)) == 0


@inlined
def earliest_back(place: Records, arrival: int, home: int) -> int:
    """Return when a drone is where `home` leads to that is at a customer as the window opens.

    The window in which whoever comes at `arrival` is served.
    """
    return opening(place, arrival) + service_duration(place) + home


@inlined
def longest_hold(kind: Record, flight: int, left: int, weight: int) -> int:
    """Return in how long after its take-off windows may let a drone be back.

    Its endurance; and where it hovers before windows, what it can beside the `flight`, services
    included, after which so much is `left` of its battery, with the most `weight` aboard.
    """
    limit = kind.endurance
    if hovers_at_customers(kind) and left >= 0:
        limit = min(limit, flight + longest_hover(kind, left, weight))
    return limit


@inlined
def held_until(back: int, limit: int) -> int:
    """Return the earliest take-off after which a drone can be back within a limit.

    `back` is the earliest that windows allow; the flight itself may be too long.
    """
    return back - limit


@inlined
def held_takeoff(kind: Record, place: Records, takeoff: int, out: int, home: int) -> int:
    """Return when a drone takes off to one customer that can at `takeoff`: then, or held back.

    `out` and `home` are the durations of its legs.
    """
    limit = kind.endurance
    if hovers_at_customers(kind):
        limit = longest_hold(kind, out + service_duration(place) + home,
                             after_flight(kind, place, out, home),
                             max(weight_brought(place), weight_taken(place)))
    held = held_until(earliest_back(place, takeoff + out, home), limit)
    while held > takeoff:
        takeoff = held
        held = held_until(earliest_back(place, takeoff + out, home), limit)
    return takeoff


@inlined
def after_flight(kind: Record, place: Records, out: int, home: int) -> int:
    """Return what is left of the battery after a flight to one customer without any waiting."""
    weight = weight_brought(place)
    left = after_leg(kind, battery_of(kind), weight, out)
    if hovers_at_customers(kind):
        left = after_hovering(kind, left, weight, service_duration(place))
    return after_leg(kind, left, weight_taken(place), home)


@inlined
def can_last(kind: Record, duration: int) -> bool:
    """Tell whether a flight, out, service and home, is within the endurance if nothing waits.

    None is that leads where nobody can fly.
    """
    return duration <= kind.endurance


@inlined
def can_serve(kind: Record, place: Records, out: int, home: int) -> bool:
    """Tell whether a flight to one customer is within endurance and energy if nothing waits."""
    return (can_last(kind, out + service_duration(place) + home)
            and (not is_limited(kind) or after_flight(kind, place, out, home) >= 0))


@inlined
def can_wait(kind: Record, place: Records, out: int, home: int, waiting: int) -> bool:
    """Tell whether energy lasts for a flight to one customer and so long a wait to be recovered."""
    if not is_limited(kind):
        return True
    return after_hovering(kind, after_flight(kind, place, out, home), weight_taken(place),
                          waiting) >= 0


@inlined
def charged_launch(kind: Record, place: Records, kept: int, since: int, out: int,
                   home: int) -> int:
    """Return from when on the launch may begin of a flight to one customer, at once if it can't be.

    The drone is charged aboard since then, with what it has kept.
    """
    return charged_by(kind, kept, since, after_flight(kind, place, out, home))


@inlined
def left_after(kind: Record, place: Records, out: int, home: int, takeoff: int, served: int,
               recovery_start: int) -> int:
    """Return what a sortie to one customer, waiting included, leaves of a full battery.

    Nothing where none limits it.
    """
    if not is_limited(kind):
        return 0
    left = after_flight(kind, place, out, home)
    if hovers_at_customers(kind):
        waited = served - service_duration(place) - takeoff - out
        left = after_hovering(kind, left, weight_brought(place), waited)
    return after_hovering(kind, left, weight_taken(place), recovery_start - served - home)


@inlined
def counted_until(kind: Record, back: int, recovery_start: int) -> int:
    """Return until when the endurance counts: as a drone is back, or as its recovery begins."""
    return recovery_start if kind.waiting_counts else back


@inlined
def within_endurance(kind: Record, takeoff: int, back: int, recovery_start: int) -> bool:
    """Tell whether a sortie, back at `back` and recovered from then on, is short enough."""
    return can_last(kind, counted_until(kind, back, recovery_start) - takeoff)


@inlined
def endurance_of(kind: Record) -> int:
    """Return how long `counted_until` may be from the take-off."""
    return kind.endurance


@inlined
def longest_flight(kind: Record) -> int:
    """Return how long a drone may fly with nothing aboard, for those who only want an idea."""
    return min(kind.endurance, longest_cruise(kind))


@inlined
def lasting_within(limit: int, begin_d: int, begin_c: int, d: int, c: int) -> tuple[int, int]:
    """Return for which arrivals at a block's beginning it is at most `limit` from one to another.

    The first and the last; FAR and NONE if there is none. Pairs are as for `stop`, (d, c) never
    before the other. With `time`, both are sums with d as soon as that is past `begin_c - begin_d`,
    so that what lasts too long by d must begin before.
    """
    if d - begin_d <= limit:
        return (c - limit - begin_d if c - begin_c > limit else NONE), FAR
    if c - begin_c > limit:
        return FAR, NONE
    return NONE, limit + begin_c - d
