"""What vehicles and drones hold: amounts, in all dimensions at once. Compiled."""

from model.kernel.compiled import inlined
from model.kernel.records import Record, Records

Amount = tuple[int, int, int]
"""By dimension, of which there are `MAX_DIMENSIONS`."""

NOTHING = (0, 0, 0)


@inlined
def release_of(place: Records) -> int:
    """Return when a customer's parcel is at the depot."""
    return place[0].release


@inlined
def demand_of(place: Records) -> Amount:
    """Return what a customer's parcel takes."""
    return place[0].demand[0], place[0].demand[1], place[0].demand[2]


@inlined
def demanded(place: Records, dimension: int) -> int:
    """Return what a customer's parcel takes of one dimension."""
    return place[0].demand[dimension]


@inlined
def capacity_of(kind: Record) -> Amount:
    """Return what a vehicle of a type holds."""
    return kind.capacity[0], kind.capacity[1], kind.capacity[2]


@inlined
def payload_of(kind: Record) -> Amount:
    """Return what a type's drone lifts."""
    return kind.payload[0], kind.payload[1], kind.payload[2]


@inlined
def plus(one: Amount, other: Amount) -> Amount:
    """Return the sum of two amounts."""
    return one[0] + other[0], one[1] + other[1], one[2] + other[2]


@inlined
def minus(one: Amount, other: Amount) -> Amount:
    """Return what is left of an amount."""
    return one[0] - other[0], one[1] - other[1], one[2] - other[2]


@inlined
def total(amount: Amount) -> int:
    """Return the sum over dimensions, for comparisons."""
    return amount[0] + amount[1] + amount[2]


@inlined
def within(one: Amount, limit: Amount) -> bool:
    """Tell whether an amount is no more than another in any dimension."""
    return one[0] <= limit[0] and one[1] <= limit[1] and one[2] <= limit[2]


@inlined
def holds(kind: Record, load: Amount) -> bool:
    """Tell whether a vehicle of a type holds a load."""
    return within(load, capacity_of(kind))


@inlined
def fits(kind: Record, load: Amount, place: Records) -> bool:
    """Tell whether a vehicle of a type holds a customer's parcel on top of a load."""
    return holds(kind, plus(load, demand_of(place)))


@inlined
def lifts(kind: Record, payload: Amount) -> bool:
    """Tell whether a type's drone lifts what a sortie carries."""
    return within(payload, payload_of(kind))
