"""Where truck and drones meet again, and when all that happens from one stop to the next. Compiled.

A sortie takes off at the truck's stop and is recovered at the next or, if it can't be met there
within endurance, at the same stop: a loop. Its launch is held back as long as the customer's window
would let the flight last longer than the endurance, which depends on where it is recovered. So
launches are timed anew once it is known where the truck drives to.
"""

from model.kernel.compiled import inlined
from model.kernel.drone_types import are_several
from model.kernel.energy import battery_of, charged, charges_aboard, first_charge
from model.kernel.flight import (
    can_serve, charged_launch, held_takeoff, launch_begin, left_after, recovery_end, take_off,
    unreachable, within_endurance,
)
from model.kernel.instance import MAX_TIERS, TIER
from model.kernel.leg import lookup
from model.kernel.records import Record, Records, record
from model.kernel.shift import allows_sorties
from model.kernel.stop import end_of_service, too_late
from model.problem import UNLIMITED
from model.simulation.vehicle_log import IN_FLIGHT, Setting, VehicleLog, craft_of, travel_arrival

VEHICLE = record(
    "type", "index", "node", "idle", "service_end", "crew", "free", "distance", "start_best",
    "departure_best", "next_start", "launched", "flying", "given", "picked", "taken",
    "barred_on_trip", "barred_on_vehicle", load=MAX_TIERS * TIER, aboard=MAX_TIERS * TIER)
"""The open vehicle: type (`NO_VEHICLE` before the first opens), index within the type,
node, idle (at the depot, no trip begun), end of service here, end of the recoveries here, end of
the launches after them as if none was held back, distance of the trip, the latest known start of
the first trip that costs nothing, the departure that follows from it, earliest start of the next
trip, launches on the trip before this stop, drones in flight; of the trip, sums over dimensions of
what is delivered and of what is picked up before the stop here and by now; goods that may not be
added to the trip and to the vehicle; the load left by dimension and what of pickups is aboard."""

DRONE = record("row", "sortie", "place", "node", "takeoff", "ready", "back", "recovery", "kept",
               "since", "lacking", "left")
"""A drone: row of its TYPE, sortie (IN_FLIGHT where aboard), where it is to be recovered, customer,
take-off, end of service, arrival at the recovery stop, beginning of recovery. Those in flight were
launched at the truck's stop; when and where they are recovered is for `leave_for` to say. If it is
charged aboard: with what it last came aboard on the trip, and when; what it lacks of a full battery
as it is launched; what it has left on recovery."""
ABOARD, MEET, LOOP = range(3)
"""Places to be recovered at: none, the next stop, this stop."""

NO_VEHICLE = -1
NOT_YET = -1


@inlined
def note_charges(setting: Setting, log: VehicleLog, drones: Records) -> None:
    """Write with what drones have last come aboard on this trip, if they are charged. In place."""
    charging = False
    for d in range(len(drones)):
        kind = setting.types[drones[d].row]
        if charges_aboard(kind):
            charging = True
            drones[d].kept, drones[d].since = first_charge(kind, d)
    if not charging:
        return
    first = log.trip[log.count.trips - 1].first_stop
    for index in range(log.count.sorties):
        sortie = log.sortie[index]
        if sortie.launch_stop >= first and sortie.recovery_stop != IN_FLIGHT:
            drones[sortie.drone].kept, drones[sortie.drone].since = sortie.left, sortie.recovery_end


@inlined
def mark_place(setting: Setting, drone: Record, here: int, to: int) -> None:
    """Mark where a drone is recovered: at `to` if it can fly there, else at `here`. In place."""
    drone.place = ABOARD
    if drone.sortie != IN_FLIGHT:
        node, craft = drone.node, craft_of(setting, drone.row)
        meets = can_serve(craft.type, craft.node[node], lookup(craft.out, here, node),
                          lookup(craft.home, node, to))
        drone.place = MEET if meets else LOOP


@inlined
def has_battery(setting: Setting, log: VehicleLog, row: int) -> bool:
    """Tell whether there is a battery for one more sortie by drones of a row on the last trip."""
    first, flown = log.trip[log.count.trips - 1].first_stop, 1
    for index in range(log.count.sorties):
        if log.sortie[index].row == row and log.sortie[index].launch_stop >= first:
            flown += 1
    return allows_sorties(setting.types[row], flown)


@inlined
def next_drone(setting: Setting, log: VehicleLog, vehicle: Record, drones: Records,
               node: int) -> int:
    """Return the drone that would fly to a customer, of those aboard; -1 if there is none.

    The first that could come back here, else the first that lifts the parcel.
    """
    chosen, several = -1, are_several(setting.type)
    for d in range(len(drones)):
        if drones[d].sortie != IN_FLIGHT:
            continue
        if not several:
            return d
        row = drones[d].row
        if not (setting.can_fly[row, node] and has_battery(setting, log, row)):
            continue
        craft = craft_of(setting, row)
        if can_serve(craft.type, craft.node[node], lookup(craft.out, vehicle.node, node),
                     lookup(craft.home, node, vehicle.node)):
            return d
        chosen = d if chosen < 0 else chosen
    return chosen


@inlined
def order_is_open(setting: Setting, vehicle: Record) -> bool:
    """Tell whether another drone in flight may be the first, so that working may begin sooner."""
    return (are_several(setting.type) and vehicle.flying > 0
            and setting.type.max_working_duration < UNLIMITED)


@inlined
def soonest_takeoff(setting: Setting, vehicle: Record, kind: Record, takeoff: int) -> int:
    """Return when a drone takes off at the soonest that does at `takeoff` behind all in flight.

    One of another type may be launched before these.
    """
    if are_several(setting.type):
        return take_off(kind, vehicle.crew, vehicle.launched)
    return takeoff


@inlined
def next_launch(setting: Setting, drones: Records, here: int, to: int, free: int,
                launched: int) -> tuple[int, int]:
    """Return the drone that can be launched first from `free` on, and its take-off; -1: none.

    `launched` is how many launches of the trip come before.
    """
    chosen, takeoff = -1, 0
    for d in range(len(drones)):
        if drones[d].place != ABOARD and drones[d].takeoff == NOT_YET:
            end = to if drones[d].place == MEET else here
            node, craft, begin = drones[d].node, craft_of(setting, drones[d].row), free
            place, out, home = (craft.node[node], lookup(craft.out, here, node),
                                lookup(craft.home, node, end))
            if charges_aboard(craft.type):
                begin = max(free, charged_launch(craft.type, place, drones[d].kept,
                                                 drones[d].since, out, home))
            soonest = held_takeoff(craft.type, place, take_off(craft.type, begin, launched),
                                   out, home)
            if chosen < 0 or soonest < takeoff:
                chosen, takeoff = d, soonest
    return chosen, takeoff


@inlined
def fly(setting: Setting, drone: Record, here: int, to: int, takeoff: int) -> None:
    """Time the flight of a drone that takes off at `here`. In place."""
    node, craft = drone.node, craft_of(setting, drone.row)
    arrival = takeoff + lookup(craft.out, here, node)
    end = to if drone.place == MEET else here
    drone.takeoff = takeoff
    drone.ready = end_of_service(craft.node[node], arrival)
    drone.back = drone.ready + lookup(craft.home, node, end)
    drone.lacking = 0
    if charges_aboard(craft.type):
        drone.lacking = battery_of(craft.type) - charged(
            craft.type, drone.kept, drone.since, launch_begin(craft.type, takeoff, 1))


@inlined
def next_back(drones: Records, place: int) -> int:
    """Return the drone in the air that is first back at `place`; -1 if there is none."""
    chosen = -1
    for d in range(len(drones)):
        if (drones[d].place == place and drones[d].takeoff != NOT_YET
                and drones[d].recovery == NOT_YET
                and (chosen < 0 or drones[d].back < drones[chosen].back)):
            chosen = d
    return chosen


@inlined
def bring_aboard(setting: Setting, drone: Record, here: int, free: int) -> int:
    """Recover a drone launched at `here` from `free` on; return the end, -1 if it can't last.

    In place.
    """
    begin, node, craft = max(free, drone.back), drone.node, craft_of(setting, drone.row)
    if unreachable(drone.back) or not within_endurance(
            craft.type, drone.takeoff, drone.back, begin):
        return -1
    left = left_after(craft.type, craft.node[node], lookup(craft.out, here, node),
                      drone.back - drone.ready, drone.takeoff, drone.ready, begin)
    if left < drone.lacking:
        return -1
    drone.left = left - drone.lacking
    drone.recovery = begin
    return recovery_end(craft.type, begin)


@inlined
def operate(setting: Setting, vehicle: Record, drones: Records, to: int) -> int:
    """Launch all drones in flight from this stop, and recover those that loop.

    In place; returns when all is done, -1 if a loop can't be recovered within its endurance. What
    can be launched first is; loops are recovered behind, or while a launch is held back.
    """
    here, free = vehicle.node, vehicle.crew
    waiting, looping, before = vehicle.flying, 0, vehicle.launched
    for d in range(len(drones)):
        drones[d].takeoff = drones[d].recovery = NOT_YET
    while waiting + looping > 0:
        launched, takeoff = next_launch(setting, drones, here, to, free, before)
        begin = takeoff
        if launched >= 0:
            begin = launch_begin(craft_of(setting, drones[launched].row).type, takeoff, before)
        landed = next_back(drones, LOOP) if looping > 0 else -1
        if landed >= 0 and (launched < 0 or (
                begin > free and max(free, drones[landed].back) <= begin)):
            free = bring_aboard(setting, drones[landed], here, free)
            if free < 0:
                return -1
            looping -= 1
        else:
            fly(setting, drones[launched], here, to, takeoff)
            free = takeoff
            waiting, before = waiting - 1, before + 1
            if drones[launched].place == LOOP:
                looping += 1
    return free


@inlined
def meet(setting: Setting, drones: Records, here: int, arrival: int) -> int:
    """Recover the drones, launched at `here`, that the truck meets where it arrives.

    In place; returns when all are recovered. Where one can't be within its endurance: -1, and in
    place, it is marked LOOP instead.
    """
    free = arrival
    while True:
        landed = next_back(drones, MEET)
        if landed < 0:
            return free
        free = bring_aboard(setting, drones[landed], here, free)
        if free < 0:
            drones[landed].place = LOOP
            return -1


@inlined
def any_late(setting: Setting, here: int, drones: Records) -> bool:
    """Tell whether a drone in flight reaches its customer too late for a hard window."""
    late = False
    for d in range(len(drones)):
        if drones[d].place != ABOARD:
            node, craft = drones[d].node, craft_of(setting, drones[d].row)
            arrival = drones[d].takeoff + lookup(craft.out, here, node)
            late = late or too_late(craft.node[node], arrival)
    return late


@inlined
def leave_for(setting: Setting, vehicle: Record, drones: Records,
              to: int) -> tuple[int, int, int]:
    """Decide what the sorties in flight do if the truck drives to `to` next.

    In place: marks each as MEET or LOOP with its times. Returns the end of the launches and
    recoveries here, the truck's arrival at `to` and the end of the recoveries there; -1 each if
    some sortie can be recovered neither here nor there, or is launched too late.
    """
    here = vehicle.node
    for d in range(len(drones)):
        mark_place(setting, drones[d], here, to)
    while True:
        left = vehicle.free
        if vehicle.flying > 0:
            left = operate(setting, vehicle, drones, to)
            if left < 0:
                return -1, -1, -1
        arrival = travel_arrival(setting, here, to, max(vehicle.service_end, left))
        if vehicle.flying == 0:
            return left, arrival, arrival
        free = meet(setting, drones, here, arrival)
        if free >= 0:
            break
    if any_late(setting, here, drones):
        return -1, -1, -1
    return left, arrival, free
