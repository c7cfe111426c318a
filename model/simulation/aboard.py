"""What the open vehicle has aboard, and what its drones bring. Compiled.

The load left is what could still be asked to be carried from where the trip begins to the stop
where the vehicle is, so what is delivered from now on. Drones in flight bring what they pick up to
this stop or to the next, as `leave_for` has decided.
"""

from model.kernel.compiled import inlined
from model.kernel.instance import MAX_TIERS, TIER
from model.kernel.load import (
    NOTHING, Amount, amount_of, barred_on_trip, barred_on_vehicle, capacity_in, comes_first,
    delivered_of, demand_of, go_together, holds_in, minus, num_tiers, out_of_order, picked_of, plus,
    smaller, some_apart, total_delivered, total_picked, within,
)
from model.kernel.records import Record, Records
from model.problem import IntArray
from model.simulation.meeting import LOOP, MEET
from model.simulation.vehicle_log import Setting


@inlined
def part_of(row: IntArray, tier: int) -> Amount:
    """Return an amount of one tier."""
    first = tier * TIER
    return row[first], row[first + 1], row[first + 2]


@inlined
def write_part(amount: Amount, row: IntArray, tier: int) -> None:
    """Write an amount of one tier. In place."""
    first = tier * TIER
    row[first], row[first + 1], row[first + 2] = amount


@inlined
def load_left(vehicle: Record) -> Amount:
    """Return what the vehicle could still be asked to carry on this trip, in the first tier."""
    return amount_of(vehicle.load)


@inlined
def empty(kind: Record, vehicle: Record) -> None:
    """Let nothing be aboard of what a vehicle of a type holds. In place."""
    vehicle.given = vehicle.picked = vehicle.taken = 0
    for tier in range(MAX_TIERS):
        write_part(capacity_in(kind, tier), vehicle.load, tier)
        write_part(NOTHING, vehicle.aboard, tier)


@inlined
def brought(setting: Setting, vehicle: Record, drones: Records, place: int, tier: int) -> Amount:
    """Return what drones in flight have picked up that are recovered at a place."""
    amount = NOTHING
    if vehicle.flying > 0:
        for d in range(len(drones)):
            if drones[d].place == place:
                amount = plus(amount, picked_of(setting.amount, drones[d].node, tier))
    return amount


@inlined
def total_brought(setting: Setting, vehicle: Record, drones: Records, place: int) -> int:
    """Return the sum over all dimensions of what is `brought`."""
    amount = 0
    if vehicle.flying > 0:
        for d in range(len(drones)):
            if drones[d].place == place:
                amount += total_picked(setting.amount, drones[d].node)
    return amount


@inlined
def on_leaving(setting: Setting, vehicle: Record, drones: Records, tier: int) -> Amount:
    """Return what of pickups is aboard when the truck leaves its stop."""
    return plus(part_of(vehicle.aboard, tier), brought(setting, vehicle, drones, LOOP, tier))


@inlined
def on_arriving(setting: Setting, vehicle: Record, drones: Records, node: int, is_customer: bool,
                tier: int) -> Amount:
    """Return what of pickups is aboard when the truck is done at the next stop."""
    amount = plus(on_leaving(setting, vehicle, drones, tier),
                  brought(setting, vehicle, drones, MEET, tier))
    return plus(amount, picked_of(setting.amount, node, tier)) if is_customer else amount


@inlined
def total_there(setting: Setting, vehicle: Record, drones: Records, node: int,
                is_customer: bool) -> tuple[int, int]:
    """Return the sums over all dimensions of what was picked up before and at the next stop."""
    before = vehicle.taken + total_brought(setting, vehicle, drones, LOOP)
    there = before + total_brought(setting, vehicle, drones, MEET)
    return before, there + (total_picked(setting.amount, node) if is_customer else 0)


@inlined
def holds_all(setting: Setting, vehicle: Record, drones: Records, node: int,
              is_customer: bool) -> bool:
    """Tell whether the truck may carry all that it has on its way to a node and there."""
    for tier in range(num_tiers(setting.amount)):
        demand = delivered_of(setting.amount, node, tier) if is_customer else NOTHING
        here = on_leaving(setting, vehicle, drones, tier)
        there = on_arriving(setting, vehicle, drones, node, is_customer, tier)
        if not (holds_in(setting.type, plus(here, demand), tier)
                and holds_in(setting.type, there, tier)):
            return False
    if num_tiers(setting.amount) == 0:
        return True
    delivered = total_delivered(setting.amount, node) if is_customer else 0
    before, taken = total_there(setting, vehicle, drones, node, is_customer)
    return not (out_of_order(setting.type, before, delivered)
                or comes_first(setting.type, taken, vehicle.given + delivered))


@inlined
def bar_goods(setting: Setting, vehicle: Record, node: int) -> None:
    """Bar what a customer's goods must not go with. In place."""
    if some_apart(setting.goods):
        vehicle.barred_on_trip |= barred_on_trip(setting.goods[node])
        vehicle.barred_on_vehicle |= barred_on_vehicle(setting.goods[node])


@inlined
def load_stop(setting: Setting, vehicle: Record, drones: Records, node: int,
              is_customer: bool) -> None:
    """Take aboard what a drive to a node asks for. In place."""
    if is_customer:
        bar_goods(setting, vehicle, node)
    if num_tiers(setting.amount) == 0:
        if is_customer:
            write_part(minus(load_left(vehicle), demand_of(setting.node[node])), vehicle.load, 0)
        return
    vehicle.picked, taken = total_there(setting, vehicle, drones, node, is_customer)
    for tier in range(num_tiers(setting.amount)):
        demand = delivered_of(setting.amount, node, tier) if is_customer else NOTHING
        here = on_leaving(setting, vehicle, drones, tier)
        there = on_arriving(setting, vehicle, drones, node, is_customer, tier)
        left = smaller(part_of(vehicle.load, tier), minus(capacity_in(setting.type, tier), here))
        write_part(minus(left, demand), vehicle.load, tier)
        write_part(there, vehicle.aboard, tier)
    vehicle.taken = taken
    if is_customer:
        vehicle.given += total_delivered(setting.amount, node)


@inlined
def is_within(setting: Setting, vehicle: Record, node: int) -> bool:
    """Tell whether a customer's parcel is within the load left."""
    for tier in range(1, num_tiers(setting.amount)):
        if not within(delivered_of(setting.amount, node, tier), part_of(vehicle.load, tier)):
            return False
    return within(demand_of(setting.node[node]), load_left(vehicle))


@inlined
def may_carry(setting: Setting, vehicle: Record, node: int) -> bool:
    """Tell whether a customer's parcel may go with all that the vehicle's trip carries."""
    return is_within(setting, vehicle, node) and (
        not some_apart(setting.goods) or go_together(
            setting.goods[node], vehicle.barred_on_trip, vehicle.barred_on_vehicle))


@inlined
def may_launch(setting: Setting, vehicle: Record, node: int) -> bool:
    """Tell whether a parcel may still leave the truck by a drone at this stop.

    Whether there is room for what the drone brings is for `holds_all`, on the way home.
    """
    return num_tiers(setting.amount) == 0 or not out_of_order(
        setting.type, vehicle.picked, total_delivered(setting.amount, node))


@inlined
def given_by_flight(setting: Setting, node: int) -> int:
    """Return the sum over all dimensions of a parcel, where orders of pickups may matter."""
    return total_delivered(setting.amount, node) if num_tiers(setting.amount) > 0 else 0


@inlined
def load_flight(setting: Setting, vehicle: Record, node: int) -> None:
    """Take aboard what a drone delivers that is launched at this stop. In place."""
    bar_goods(setting, vehicle, node)
    vehicle.given += given_by_flight(setting, node)
    if num_tiers(setting.amount) == 0:
        write_part(minus(load_left(vehicle), demand_of(setting.node[node])), vehicle.load, 0)
    for tier in range(num_tiers(setting.amount)):
        left = minus(part_of(vehicle.load, tier), delivered_of(setting.amount, node, tier))
        write_part(left, vehicle.load, tier)
