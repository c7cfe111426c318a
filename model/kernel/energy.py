"""What flying takes of a drone's battery. Compiled.

`kind` is the row of the vehicle type. What is `left` of a battery is `EMPTY` once more was asked of
it than it held.
"""

from model.kernel.compiled import inlined
from model.kernel.instance import FAR
from model.kernel.plain import is_plain
from model.kernel.records import Record
from model.problem import IntArray

EMPTY = -1


@inlined
def is_limited(kind: Record) -> bool:
    """Tell whether a type's drones have a battery that limits them."""
    return not is_plain(kind) and kind.points > 0


@inlined
def hovers_at_customers(kind: Record) -> bool:
    """Tell whether waiting and serving at a customer take of the battery."""
    return is_limited(kind) and kind.lands == 0


@inlined
def battery_of(kind: Record) -> int:
    """Return what a sortie may take."""
    return kind.battery


@inlined
def charges_aboard(kind: Record) -> bool:
    """Tell whether drones are charged aboard; else each launch has a full battery."""
    return not is_plain(kind) and kind.charge > 0


@inlined
def first_charge(kind: Record, drone: int) -> tuple[int, int]:
    """Return what a drone has before the first sortie of its truck's trip, and since when."""
    return kind.first_charge[drone], kind.shift_earliest


@inlined
def charged(kind: Record, kept: int, since: int, time: int) -> int:
    """Return what a drone has at an instant that came aboard at `since` with what it has `kept`."""
    rest = max(0, time - since)
    # The product might not fit 64 bits.
    full = rest > (kind.battery - kept) // kind.charge
    return kind.battery if full else kept + rest * kind.charge


@inlined
def charged_by(kind: Record, kept: int, since: int, left: int) -> int:
    """Return when a drone has what a flight takes that leaves so much `left` of a full battery.

    At once if that is more than it holds. It came aboard as for `charged`.
    """
    missing = kind.battery - left - kept
    if left < 0 or missing <= 0:
        return since
    return since + (missing + kind.charge - 1) // kind.charge


@inlined
def power_at(kind: Record, powers: IntArray, weight: int) -> int:
    """Return a power with so much aboard, rounded down."""
    weights, upper = kind.weights, 1
    while upper + 1 < kind.points and weights[upper] < weight:
        upper += 1
    lower = upper - 1
    rise = (powers[upper] - powers[lower]) * (weight - weights[lower])
    return max(0, powers[lower] + rise // (weights[upper] - weights[lower]))


@inlined
def spend(left: int, power: int, duration: int) -> int:
    """Return what is left after a power was needed for so long."""
    if left < 0 or power == 0:
        return left
    # The product might not fit 64 bits.
    return EMPTY if duration > left // power else left - power * duration


@inlined
def longest_cruise(kind: Record) -> int:
    """Return how long an empty drone flies on its battery; FAR if for ever."""
    power = kind.cruise[0]
    return FAR if kind.points == 0 or power == 0 else kind.battery // power


@inlined
def after_leg(kind: Record, left: int, weight: int, duration: int) -> int:
    """Return what is left after a leg, climb and descent included, with so much aboard."""
    flight = duration - kind.climb_duration - kind.descent_duration
    left = spend(left, power_at(kind, kind.cruise, weight), max(0, flight))
    if kind.climb_duration > 0:
        left = spend(left, power_at(kind, kind.climb, weight), kind.climb_duration)
    if kind.descent_duration > 0:
        left = spend(left, power_at(kind, kind.descent, weight), kind.descent_duration)
    return left


@inlined
def after_hovering(kind: Record, left: int, weight: int, duration: int) -> int:
    """Return what is left after hovering with so much aboard."""
    return spend(left, power_at(kind, kind.hover, weight), duration)


@inlined
def longest_hover(kind: Record, left: int, weight: int) -> int:
    """Return how long a drone can hover with so much aboard; FAR if for ever."""
    power = power_at(kind, kind.hover, weight)
    return FAR if power == 0 else left // power
