"""What vehicles and drones hold: amounts, in all dimensions at once, goods. Compiled.

Amounts are looked at three dimensions at a time, a tier. Mostly there is no more than one, and what
is aboard where a trip begins is the most that ever is: then nothing but `NODE` is asked. Where
somebody has something to be picked up, or there are more dimensions, what each stop asks for is a
row for each tier (`Instance.amount`), and what is aboard around each stop of a trip a `HALT`.
"""

from model.kernel.compiled import inlined
from model.kernel.instance import LAST, TIER
from model.kernel.records import Record, Records, record
from model.problem import IntArray

Amount = tuple[int, int, int]
"""By dimension, of which there are `TIER`."""

NOTHING = (0, 0, 0)

Cargo = tuple[Amount, Amount, Amount, int, int]
"""What a part of a trip or a sortie delivers and picks up, and the most that is aboard of both, in
one tier; sums over all dimensions of what it delivers, and of what it picks up."""

EMPTY = (NOTHING, NOTHING, NOTHING, 0, 0)

HALT = record("leaves", "comes", "picked", "due", "given", "load", "driven", leaving=TIER,
              coming=TIER, before=TIER, behind=TIER)
"""What is aboard around a stop of a trip. Sums over all dimensions: of parcels that leave the truck
there, of what comes aboard, of what was picked up at stops before, of what is delivered at stops
behind, and on the whole trip. The load on leaving in the first dimension, and how far the trip has
come. Of one tier, what leaves and comes; the most that is aboard before the stop, and from leaving
it on."""


@inlined
def amount_of(row: IntArray) -> Amount:
    """Return an amount that stands in a row."""
    return row[0], row[1], row[2]


@inlined
def write_amount(amount: Amount, row: IntArray) -> None:
    """Write an amount into a row. In place."""
    row[0], row[1], row[2] = amount


@inlined
def release_of(place: Records) -> int:
    """Return when a customer's parcel is at the depot."""
    return place[0].release


@inlined
def some_apart(goods: Records) -> bool:
    """Tell whether some goods must not go with others, by the rows of all nodes."""
    return len(goods) > 0


@inlined
def go_together(goods: Record, barred_on_trip: int, barred_on_vehicle: int) -> bool:
    """Tell whether a customer's goods may go with all that bars these."""
    return goods.held & (barred_on_trip | barred_on_vehicle) == 0


@inlined
def barred_on_trip(goods: Record) -> int:
    """Return which goods must not go on a trip with a customer's."""
    return goods.barred_on_trip


@inlined
def barred_on_vehicle(goods: Record) -> int:
    """Return which goods must not go by the vehicle that brings a customer's."""
    return goods.barred_on_vehicle


@inlined
def some_limited(fresh_for: IntArray) -> bool:
    """Tell whether some parcels may be aboard for so long and no longer, by the limits of all."""
    return len(fresh_for) > 0


@inlined
def excess_aboard(fresh_for: IntArray, node: int, departure: int, start: int) -> int:
    """Return by how much a parcel is too long aboard whose service starts at `start`.

    Where its trip has left the depot at `departure`.
    """
    return start - departure - fresh_for[node]


@inlined
def demand_of(place: Records) -> Amount:
    """Return what a customer's parcel takes, in the first tier."""
    return amount_of(place[0].demand)


@inlined
def num_tiers(amounts: IntArray) -> int:
    """Return how many tiers loads have to be looked at in at each stop; 0 if that isn't needed."""
    return amounts.shape[1]


@inlined
def delivered_of(amounts: IntArray, node: int, tier: int) -> Amount:
    """Return what is delivered at a node."""
    row = amounts[node, tier]
    return row[0], row[1], row[2]


@inlined
def picked_of(amounts: IntArray, node: int, tier: int) -> Amount:
    """Return what is picked up at a node."""
    row = amounts[node, tier]
    return row[3], row[4], row[5]


@inlined
def total_delivered(amounts: IntArray, node: int) -> int:
    """Return the sum over all dimensions of what is delivered at a node."""
    return amounts[node, 0, 6]


@inlined
def total_picked(amounts: IntArray, node: int) -> int:
    """Return the sum over all dimensions of what is picked up at a node."""
    return amounts[node, 0, 7]


@inlined
def weight_brought(place: Records) -> int:
    """Return what a customer's parcel weighs, by the drones' table of nodes."""
    return place[0].demand[0]


@inlined
def weight_taken(place: Records) -> int:
    """Return what weighs of that which is picked up at a customer, likewise."""
    return place[0].demand[1]


@inlined
def capacity_of(kind: Record) -> Amount:
    """Return what a vehicle of a type holds, in the first tier."""
    return amount_of(kind.capacity)


@inlined
def capacity_in(kind: Record, tier: int) -> Amount:
    """Return what a vehicle of a type holds."""
    first = tier * TIER
    return kind.capacity[first], kind.capacity[first + 1], kind.capacity[first + 2]


@inlined
def payload_in(kind: Record, tier: int) -> Amount:
    """Return what a type's drone lifts."""
    first = tier * TIER
    return kind.payload[first], kind.payload[first + 1], kind.payload[first + 2]


@inlined
def plus(one: Amount, other: Amount) -> Amount:
    """Return the sum of two amounts."""
    return one[0] + other[0], one[1] + other[1], one[2] + other[2]


@inlined
def minus(one: Amount, other: Amount) -> Amount:
    """Return what is left of an amount."""
    return one[0] - other[0], one[1] - other[1], one[2] - other[2]


@inlined
def larger(one: Amount, other: Amount) -> Amount:
    """Return the larger of two amounts in each dimension."""
    return max(one[0], other[0]), max(one[1], other[1]), max(one[2], other[2])


@inlined
def smaller(one: Amount, other: Amount) -> Amount:
    """Return the smaller of two amounts in each dimension."""
    return min(one[0], other[0]), min(one[1], other[1]), min(one[2], other[2])


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
    """Tell whether a vehicle of a type holds a load, in the first tier."""
    return within(load, capacity_of(kind))


@inlined
def holds_in(kind: Record, load: Amount, tier: int) -> bool:
    """Tell whether a vehicle of a type holds a load."""
    return within(load, capacity_in(kind, tier))


@inlined
def fits(kind: Record, load: Amount, place: Records) -> bool:
    """Tell whether a vehicle of a type holds a customer's parcel on top of a load."""
    return holds(kind, plus(load, demand_of(place)))


@inlined
def lifts(kind: Record, payload: Amount, tier: int) -> bool:
    """Tell whether a type's drone lifts what a sortie carries."""
    return within(payload, payload_in(kind, tier))


@inlined
def cargo_for(amounts: IntArray, node: int, tier: int) -> Cargo:
    """Return the cargo of serving a customer, where all is delivered before anything is taken."""
    delivered, picked = delivered_of(amounts, node, tier), picked_of(amounts, node, tier)
    return (delivered, picked, larger(delivered, picked), total_delivered(amounts, node),
            total_picked(amounts, node))


@inlined
def cargo_at(halt: Record) -> Cargo:
    """Return the cargo of a stop."""
    leaving, coming = amount_of(halt.leaving), amount_of(halt.coming)
    return leaving, coming, larger(leaving, coming), halt.leaves, halt.comes


@inlined
def followed(one: Cargo, other: Cargo) -> Cargo:
    """Return the cargo of a part that is followed by another."""
    return (plus(one[0], other[0]), plus(one[1], other[1]),
            larger(plus(one[2], other[0]), plus(one[1], other[2])),
            one[3] + other[3], one[4] + other[4])


@inlined
def out_of_order(kind: Record, picked: int, delivered: int) -> bool:
    """Tell whether a vehicle of a type may not deliver an amount once it has picked up another."""
    return kind.pickup_order >= LAST and picked > 0 and delivered > 0


@inlined
def comes_first(kind: Record, picked: int, given: int) -> bool:
    """Tell whether a trip may not pick up an amount since it delivers nothing but what is given."""
    return kind.pickup_order == LAST and picked > 0 and given == 0


@inlined
def may_follow(kind: Record, one: Cargo, other: Cargo) -> bool:
    """Tell whether a part of a trip may follow another, by what they deliver and pick up."""
    return not out_of_order(kind, one[4], other[3])


@inlined
def may_be_all(kind: Record, cargo: Cargo, tier: int) -> bool:
    """Tell whether a vehicle of a type may carry no more than this on a trip."""
    return holds_in(kind, cargo[2], tier) and not comes_first(kind, cargo[4], cargo[3])


@inlined
def add_left(halt: Record, amount: Amount, sum_of_all: int) -> None:
    """Let parcels leave the truck at a stop. In place."""
    write_amount(plus(amount_of(halt.leaving), amount), halt.leaving)
    halt.leaves += sum_of_all


@inlined
def add_come(halt: Record, amount: Amount, sum_of_all: int) -> None:
    """Let what was picked up come aboard at a stop. In place."""
    write_amount(plus(amount_of(halt.coming), amount), halt.coming)
    halt.comes += sum_of_all


@inlined
def weigh_trip(kind: Record, halts: Records, first: int, last: int, tier: int) -> bool:
    """Write what is aboard at the stops of a trip, by what leaves and comes aboard at each.

    In place; False if it is too much, or picked up too early.
    """
    load, given, picked, in_order = NOTHING, 0, 0, True
    for p in range(first, last + 1):
        load = plus(load, amount_of(halts[p].leaving))
        given += halts[p].leaves
    due, most = given, load
    for p in range(first, last + 1):
        halt = halts[p]
        write_amount(most, halt.before)
        in_order = in_order and not out_of_order(kind, picked, halt.leaves)
        due -= halt.leaves
        halt.picked, halt.due, halt.given = picked, due, given
        picked += halt.comes
        load = plus(minus(load, amount_of(halt.leaving)), amount_of(halt.coming))
        halt.load = load[0]
        write_amount(load, halt.behind)
        most = larger(most, load)
    for p in range(last - 1, first - 1, -1):
        write_amount(larger(amount_of(halts[p].behind), amount_of(halts[p + 1].behind)),
                     halts[p].behind)
    return in_order and holds_in(kind, most, tier) and not comes_first(kind, picked, given)


@inlined
def has_room(kind: Record, halts: Records, left: int, came: int, amounts: IntArray,
             node: int) -> bool:
    """Tell whether a customer may be served on a trip on top of all others.

    The parcel leaves the truck at stop `left`, or just before it, and what is picked up comes
    aboard at stop `came`, or just behind it, by `halts` (tier, stop) as they are.
    """
    for tier in range(len(halts)):
        before, behind = amount_of(halts[tier, left].before), amount_of(halts[tier, came].behind)
        if not (holds_in(kind, plus(before, delivered_of(amounts, node, tier)), tier)
                and holds_in(kind, plus(behind, picked_of(amounts, node, tier)), tier)):
            return False
    if kind.pickup_order < LAST:
        return True
    delivered, picked = total_delivered(amounts, node), total_picked(amounts, node)
    return not (out_of_order(kind, halts[0, left].picked, delivered)
                or out_of_order(kind, picked, halts[0, came].due)
                or comes_first(kind, picked, halts[0, left].given + delivered))


@inlined
def most_of(first: Record) -> Amount:
    """Return the most that is aboard at any point of a trip, by its first stop's `HALT`."""
    return larger(amount_of(first.before), amount_of(first.behind))
