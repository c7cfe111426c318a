"""The state of running plans and what each action does to it, compiled."""

from typing import NamedTuple

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.kernel.copying import clear
from model.kernel.drone_types import row_of_drone
from model.kernel.flight import launch_begin, recovery_end, take_off, unreachable
from model.kernel.instance import Instance
from model.kernel.leg import lookup
from model.kernel.load import release_of, some_limited
from model.kernel.records import Record, Records
from model.kernel.start import leaves_first
from model.kernel.stop import end_of_service, service_duration, start_of_service, too_late
from model.problem import UNLIMITED, BoolArray, IntArray
from model.simulation.aboard import empty, holds_all, load_flight, load_stop
from model.simulation.cost import COST, add_cost
from model.simulation.meeting import (
    ABOARD, DRONE, LOOP, MEET, NO_VEHICLE, VEHICLE, leave_for, next_drone, note_charges,
    soonest_takeoff,
)
from model.simulation.vehicle_log import (
    IN_FLIGHT, Setting, VehicleLog, craft_of, empty_logs, first_departure, latest_start, log_of,
    most_excess, replay, setting_of, start_within_work,
)


class State(NamedTuple):
    """Running plans, a row per rollout, then scratch rows. Times in ms since plan start.

    Times of sorties in flight are as if they were launched at once, in the log and in `drone`.
    """

    problem: IntArray  # (rollout,) row in the Instance
    served: BoolArray  # (rollout, node)
    num_unserved: IntArray  # (rollout,)
    used: IntArray  # (rollout, type) vehicles opened
    done: BoolArray  # (rollout,)
    vehicle: Records  # (rollout,) VEHICLE, the open one
    drone: Records  # (rollout, drone) DRONE, its drones
    log: VehicleLog
    cost: Records  # (rollout,) COST of the vehicles closed so far
    fresh: BoolArray  # (problem, type, node) servable alone by a fresh vehicle


def empty_state(instance: Instance, rows: int) -> State:
    """Allocate the state of `rows` rollouts, scratch included, before any vehicle opens."""
    num_problems, num_nodes = instance.node.shape[:3:2]
    num_types = instance.type.shape[1]
    max_drones = max(1, int(instance.type["drones"].max()))
    state = State(
        problem=np.zeros(rows, np.int64),
        served=np.zeros((rows, num_nodes), np.bool_),
        num_unserved=np.zeros(rows, np.int64),
        used=np.zeros((rows, num_types), np.int64),
        done=np.zeros(rows, np.bool_),
        vehicle=np.zeros(rows, VEHICLE),
        drone=np.zeros((rows, max_drones), DRONE),
        log=empty_logs(rows, int(instance.size["customers"].max())),
        cost=np.zeros(rows, COST),
        fresh=np.zeros((num_problems, num_types, num_nodes), np.bool_),
    )
    state.vehicle["type"] = NO_VEHICLE
    state.drone["sortie"] = IN_FLIGHT
    return state


@inlined
def log_op(log: VehicleLog, stop: int, sortie: int, is_recovery: bool) -> None:
    """Append a launch or recovery. In place."""
    op = log.op[log.count.ops]
    op.stop, op.sortie, op.is_recovery = stop, sortie, is_recovery
    log.count.ops += 1


@inlined
def log_stop(log: VehicleLog, node: int, arrival: int, start: int, leave: int) -> None:
    """Append a stop. In place."""
    stop = log.stop[log.count.stops]
    stop.node, stop.arrival, stop.start, stop.leave = node, arrival, start, leave
    log.count.stops += 1


@inlined
def log_recoveries(setting: Setting, log: VehicleLog, drones: Records, place: int,
                   stop: int) -> None:
    """Append the recoveries decided by `leave_for`, in order. In place."""
    while True:
        chosen = -1
        for d in range(len(drones)):
            if drones[d].place == place and (
                    chosen < 0 or drones[d].recovery < drones[chosen].recovery
                    or (drones[d].recovery == drones[chosen].recovery
                        and drones[d].back < drones[chosen].back)):
                chosen = d
        if chosen < 0:
            return
        drone = drones[chosen]
        sortie = log.sortie[drone.sortie]
        sortie.recovery_stop = stop
        sortie.recovery_start = drone.recovery
        sortie.recovery_end = recovery_end(craft_of(setting, drone.row).type, drone.recovery)
        sortie.left = drone.left
        log_op(log, stop, drone.sortie, True)
        drone.place = ABOARD
        drone.sortie = IN_FLIGHT


@inlined
def op_times(setting: Setting, log: VehicleLog, row: int) -> tuple[int, int]:
    """Return when a launch or recovery begins and ends.

    As if each launch were the trip's first: later than that none begins, so that the order is the
    same.
    """
    sortie = log.sortie[log.op[row].sortie]
    if log.op[row].is_recovery:
        return sortie.recovery_start, sortie.recovery_end
    return launch_begin(craft_of(setting, sortie.row).type, sortie.takeoff, 0), sortie.takeoff


@inlined
def sort_ops(setting: Setting, log: VehicleLog, first: int) -> None:
    """Put the launches and recoveries from row `first` on, all at one stop, in order. In place."""
    for last in range(first + 1, log.count.ops):
        row = last
        while row > first and op_times(setting, log, row) < op_times(setting, log, row - 1):
            op, other = log.op[row], log.op[row - 1]
            op.sortie, other.sortie = other.sortie, op.sortie
            op.is_recovery, other.is_recovery = other.is_recovery, op.is_recovery
            row -= 1


@inlined
def log_sorties(setting: Setting, log: VehicleLog, vehicle: Record, drones: Records) -> None:
    """Write what `leave_for` decided of the sorties in flight. In place."""
    here, first = log.count.stops - 1, log.count.ops - vehicle.flying
    for d in range(len(drones)):
        if drones[d].place != ABOARD:
            node, takeoff = drones[d].node, drones[d].takeoff
            sortie = log.sortie[drones[d].sortie]
            arrival = takeoff + lookup(craft_of(setting, drones[d].row).out, vehicle.node, node)
            sortie.takeoff, sortie.arrival = takeoff, arrival
            sortie.start = start_of_service(setting.node[node], arrival)
            sortie.ready = drones[d].ready
    log_recoveries(setting, log, drones, LOOP, here)
    sort_ops(setting, log, first)
    log_recoveries(setting, log, drones, MEET, here + 1)


@inlined
def begin_trip(setting: Setting, log: VehicleLog, vehicle: Record, release: int) -> None:
    """Begin a trip of the idle vehicle as soon as the parcel is released. In place."""
    start = max(vehicle.next_start, release)
    trip = log.trip[log.count.trips]
    trip.first_stop, trip.first_op = log.count.stops, log.count.ops
    trip.release, trip.start = release, start
    log.count.trips += 1
    leave = leaves_first(setting.type, start)
    log_stop(log, vehicle.node, start, start, leave)
    if log.count.trips == 1:
        vehicle.start_best = start
        vehicle.departure_best = first_departure(setting, log, start)
    vehicle.idle = 0
    vehicle.service_end = leave
    vehicle.free = vehicle.crew = start


@inlined
def hold_trip(setting: Setting, num_depots: int, log: VehicleLog, vehicle: Record,
              drones: Records, release: int) -> bool:
    """Let the trip begin no earlier than `release`. In place; False if it can't be held so long."""
    trip = log.trip[log.count.trips - 1]
    trip.release = max(trip.release, release)
    if trip.start >= release:
        return True
    if not replay(setting, num_depots, log, log.count.trips - 1, release, True):
        return False
    note_charges(setting, log, drones)
    here = log.count.stops - 1
    stop = log.stop[here]
    vehicle.service_end = stop.start
    if stop.node >= num_depots:
        vehicle.service_end += service_duration(setting.node[stop.node])
    else:
        vehicle.service_end = leaves_first(setting.type, vehicle.service_end)
    vehicle.free = vehicle.crew = stop.arrival
    last = log.count.ops - 1
    while last >= 0 and log.op[last].stop == here:
        sortie = log.sortie[log.op[last].sortie]
        if log.op[last].is_recovery:
            vehicle.crew = max(vehicle.crew, sortie.recovery_end)
            vehicle.free = max(vehicle.free, sortie.recovery_end)
        else:
            vehicle.free = max(vehicle.free, sortie.takeoff)
        last -= 1
    for d in range(len(drones)):
        if drones[d].sortie != IN_FLIGHT:
            sortie = log.sortie[drones[d].sortie]
            drones[d].takeoff, drones[d].ready = sortie.takeoff, sortie.ready
    if log.count.trips == 1:
        vehicle.start_best = max(vehicle.start_best, release)
    return True


@inlined
def keep_fresh(setting: Setting, num_depots: int, log: VehicleLog, vehicle: Record,
               drones: Records) -> bool:
    """Hold the trip until no parcel is too long aboard. In place; False if that can't be."""
    if not some_limited(setting.fresh_for):
        return True
    excess, held = most_excess(setting, num_depots, log), True
    while excess > 0:
        start = log.trip[log.count.trips - 1].start + excess
        # Drones that don't last then may do if the trip is held even longer.
        held = hold_trip(setting, num_depots, log, vehicle, drones, start)
        left = most_excess(setting, num_depots, log)
        if left >= excess:
            return False
        excess = left
    return held


@inlined
def improve_departure(setting: Setting, num_depots: int, log: VehicleLog,
                      vehicle: Record) -> None:
    """Find how late the vehicle could have left without ending its last stop later. In place."""
    if setting.type.max_working_duration < UNLIMITED:
        vehicle.start_best = latest_start(setting, num_depots, log, 0, vehicle.start_best)
    vehicle.departure_best = first_departure(setting, log, vehicle.start_best)


@inlined
def board(setting: Setting, vehicle: Record, drones: Records, drone: int, sortie: int, node: int,
          takeoff: int) -> None:
    """Put a drone into the air, to a customer. In place."""
    craft = craft_of(setting, drones[drone].row)
    arrival = takeoff + lookup(craft.out, vehicle.node, node)
    drones[drone].sortie, drones[drone].node = sortie, node
    drones[drone].takeoff = takeoff
    drones[drone].ready = end_of_service(craft.node[node], arrival)
    vehicle.flying += 1
    vehicle.free = takeoff


@inlined
def launch(setting: Setting, num_depots: int, log: VehicleLog, vehicle: Record,
           drones: Records, node: int) -> bool:
    """Launch a drone to a customer. In place; False if a window or a distance forbids it.

    Or no drone aboard lifts the parcel. Whether the vehicle could have left later is for
    `improve_departure`.
    """
    release = release_of(setting.node[node])
    if vehicle.idle:
        begin_trip(setting, log, vehicle, release)
        note_charges(setting, log, drones)
    elif not hold_trip(setting, num_depots, log, vehicle, drones, release):
        return False
    drone = next_drone(setting, log, vehicle, drones, node)
    if drone < 0:
        return False
    craft = craft_of(setting, drones[drone].row)
    takeoff = take_off(craft.type, vehicle.free, vehicle.launched + vehicle.flying)
    flight = lookup(craft.out, vehicle.node, node)
    arrival = takeoff + flight
    if unreachable(flight) or too_late(
            setting.node[node], soonest_takeoff(setting, vehicle, craft.type, takeoff) + flight):
        return False
    here = log.count.stops - 1
    index = log.count.sorties
    board(setting, vehicle, drones, drone, index, node, takeoff)
    sortie = log.sortie[index]
    sortie.drone, sortie.row = drone, drones[drone].row
    sortie.node, sortie.launch_stop = node, here
    sortie.recovery_stop = IN_FLIGHT
    sortie.takeoff, sortie.arrival = takeoff, arrival
    sortie.start = start_of_service(setting.node[node], arrival)
    sortie.ready = drones[drone].ready
    log.count.sorties += 1
    log_op(log, here, index, False)
    log.stop[here].leave = max(vehicle.service_end, takeoff)
    load_flight(setting, vehicle, node)
    # The start known so far kept the end of service here, not the arrival, on which launches hang.
    vehicle.start_best = log.trip[0].start
    return True


@inlined
def drive(setting: Setting, num_depots: int, log: VehicleLog, vehicle: Record,
          drones: Records, node: int) -> bool:
    """Drive to a customer or home. In place; False if a window, endurance or load forbids it.

    Whether the vehicle could have left later is for `improve_departure`.
    """
    is_customer = node >= num_depots
    release = release_of(setting.node[node])
    if vehicle.idle:
        begin_trip(setting, log, vehicle, release)
    elif is_customer and not hold_trip(setting, num_depots, log, vehicle, drones, release):
        return False
    left, arrival, free = leave_for(setting, vehicle, drones, node)
    if arrival < 0 or (is_customer and too_late(setting.node[node], arrival)):
        return False
    if not holds_all(setting, vehicle, drones, node, is_customer):
        return False
    load_stop(setting, vehicle, drones, node, is_customer)
    if vehicle.flying > 0:
        here = log.count.stops - 1
        log.stop[here].leave = max(vehicle.service_end, left)
        log_sorties(setting, log, vehicle, drones)
        vehicle.launched, vehicle.flying = vehicle.launched + vehicle.flying, 0
        # The start known so far kept the drones' return, not the last take-off before recoveries.
        vehicle.start_best = log.trip[0].start
    start = arrival
    service_end = arrival
    if is_customer:
        start = start_of_service(setting.node[node], arrival)
        service_end = end_of_service(setting.node[node], arrival)
    log_stop(log, node, arrival, start, max(service_end, free))
    vehicle.node = node
    vehicle.service_end, vehicle.free, vehicle.crew = service_end, free, free
    if not keep_fresh(setting, num_depots, log, vehicle, drones):
        return False
    note_charges(setting, log, drones)
    if not is_customer:
        vehicle.idle = 1
        vehicle.distance = vehicle.launched = 0
        vehicle.next_start = vehicle.free + setting.type.reload_duration
        vehicle.barred_on_trip = 0
        empty(setting.type, vehicle)
    return True


@inlined
def clear_vehicle(vehicle: Record) -> None:
    """Let no vehicle be open. In place."""
    vehicle.type, vehicle.index, vehicle.node, vehicle.idle = NO_VEHICLE, 0, 0, 0
    vehicle.service_end = vehicle.crew = vehicle.free = vehicle.distance = 0
    vehicle.start_best = vehicle.departure_best = vehicle.next_start = 0
    vehicle.launched = vehicle.flying = 0
    vehicle.barred_on_trip = vehicle.barred_on_vehicle = 0
    vehicle.given = vehicle.picked = vehicle.taken = 0
    clear(vehicle.load)
    clear(vehicle.aboard)


@inlined
def clear_log(count: Record) -> None:
    """Let a log be empty. In place."""
    count.trips = count.stops = count.ops = count.sorties = 0


@compiled
def open_vehicle(instance: Instance, state: State, r: int, k: int) -> None:
    """Let a fresh vehicle of type `k` stand ready at its depot. In place."""
    b = state.problem[r]
    vehicle = state.vehicle[r]
    clear_vehicle(vehicle)
    vehicle.type, vehicle.index = k, state.used[r, k]
    vehicle.node = instance.type[b, k].begins_at
    vehicle.idle = 1
    vehicle.next_start = instance.type[b, k].shift_earliest
    empty(instance.type[b, k], vehicle)
    for d in range(state.drone.shape[1]):
        state.drone[r, d].sortie = IN_FLIGHT
        state.drone[r, d].row = row_of_drone(instance.type[b], k, d)
    clear_log(state.log.count[r])
    state.used[r, k] += 1


@compiled
def close_vehicle(instance: Instance, state: State, r: int) -> None:
    """Let each trip of the vehicle begin as late as costs nothing and add its cost. In place."""
    b = state.problem[r]
    k = state.vehicle[r].type
    setting = setting_of(instance, b, k)
    log = log_of(state.log, r)
    num_depots = instance.size[b].depots
    for trip in range(log.count.trips):
        known = log.trip[trip].start
        if trip == 0:
            known = max(known, state.vehicle[r].start_best)
        start = latest_start(setting, num_depots, log, trip, known)
        if trip == 0:
            start = start_within_work(setting, num_depots, log, start)
        if start > log.trip[trip].start:
            replay(setting, num_depots, log, trip, start, True)
    if log.count.trips > 0:
        add_cost(instance, setting, log, b, k, state.cost[r])
