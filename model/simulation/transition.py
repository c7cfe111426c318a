"""The state of running plans and what each action does to it, compiled."""

from typing import NamedTuple

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.kernel.flight import launch_begin, ready, recovery_end, take_off, unreachable
from model.kernel.instance import Instance
from model.kernel.leg import lookup
from model.kernel.load import Amount, capacity_of, demand_of, minus
from model.kernel.start import leaves_first
from model.kernel.stop import end_of_service, service_duration, start_of_service, too_late
from model.problem import UNLIMITED, BoolArray, FloatArray, IntArray
from model.simulation.cost import add_cost
from model.simulation.meeting import (
    ABOARD, DRONE_BACK, DRONE_COLUMNS, DRONE_NODE, DRONE_PLACE, DRONE_READY, DRONE_RECOVERY,
    DRONE_SORTIE, DRONE_TAKEOFF, LOOP, MEET, NO_VEHICLE, V_COLUMNS, V_CREW, V_DEPARTURE_BEST,
    V_DISTANCE, V_FLYING, V_FREE, V_IDLE, V_INDEX, V_LOAD, V_NEXT_START, V_NODE, V_SERVICE_END,
    V_START_BEST, V_TYPE, leave_for,
)
from model.simulation.vehicle_log import (
    COUNT_OPS, COUNT_SORTIES, COUNT_STOPS, COUNT_TRIPS, IN_FLIGHT, OP_IS_RECOVERY, OP_SORTIE,
    OP_STOP, SORTIE_ARRIVAL, SORTIE_DRONE, SORTIE_LAUNCH_STOP, SORTIE_NODE, SORTIE_READY,
    SORTIE_RECOVERY_END, SORTIE_RECOVERY_START, SORTIE_RECOVERY_STOP, SORTIE_START, SORTIE_TAKEOFF,
    STOP_ARRIVAL, STOP_LEAVE, STOP_NODE, STOP_START, TRIP_FIRST_OP, TRIP_FIRST_STOP, TRIP_RELEASE,
    TRIP_START, Setting, VehicleLog, empty_logs, first_departure, latest_start, log_of, replay,
    setting_of,
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
    vehicle: IntArray  # (rollout, V_COLUMNS) the open one
    drone: IntArray  # (rollout, drone, DRONE_COLUMNS) its drones
    log: VehicleLog
    cost: FloatArray  # (rollout, 6) of the vehicles closed so far, by term
    fresh: BoolArray  # (problem, type, node) servable alone by a fresh vehicle


def empty_state(instance: Instance, rows: int) -> State:
    """Allocate the state of `rows` rollouts, scratch included, before any vehicle opens."""
    num_problems, num_nodes = instance.node.shape[:2]
    num_types = instance.type.shape[1]
    max_drones = max(1, int(instance.type["drones"].max()))
    state = State(
        problem=np.zeros(rows, np.int64),
        served=np.zeros((rows, num_nodes), np.bool_),
        num_unserved=np.zeros(rows, np.int64),
        used=np.zeros((rows, num_types), np.int64),
        done=np.zeros(rows, np.bool_),
        vehicle=np.zeros((rows, V_COLUMNS), np.int64),
        drone=np.zeros((rows, max_drones, DRONE_COLUMNS), np.int64),
        log=empty_logs(rows, int(instance.size[:, 1].max())),
        cost=np.zeros((rows, 6)),
        fresh=np.zeros((num_problems, num_types, num_nodes), np.bool_),
    )
    state.vehicle[:, V_TYPE] = NO_VEHICLE
    state.drone[:, :, DRONE_SORTIE] = IN_FLIGHT
    return state


@inlined
def log_op(log: VehicleLog, stop: int, sortie: int, is_recovery: bool) -> None:
    """Append a launch or recovery. In place."""
    op = log.op[log.count[COUNT_OPS]]
    op[OP_STOP], op[OP_SORTIE], op[OP_IS_RECOVERY] = stop, sortie, is_recovery
    log.count[COUNT_OPS] += 1


@inlined
def log_stop(log: VehicleLog, node: int, arrival: int, start: int, leave: int) -> None:
    """Append a stop. In place."""
    stop = log.stop[log.count[COUNT_STOPS]]
    stop[STOP_NODE], stop[STOP_ARRIVAL], stop[STOP_START] = node, arrival, start
    stop[STOP_LEAVE] = leave
    log.count[COUNT_STOPS] += 1


@inlined
def log_recoveries(setting: Setting, log: VehicleLog, drones: IntArray, place: int,
                   stop: int) -> None:
    """Append the recoveries decided by `leave_for`, in order. In place."""
    while True:
        chosen = -1
        for d in range(len(drones)):
            if drones[d, DRONE_PLACE] == place and (
                    chosen < 0 or drones[d, DRONE_RECOVERY] < drones[chosen, DRONE_RECOVERY]
                    or (drones[d, DRONE_RECOVERY] == drones[chosen, DRONE_RECOVERY]
                        and drones[d, DRONE_BACK] < drones[chosen, DRONE_BACK])):
                chosen = d
        if chosen < 0:
            return
        drone = drones[chosen]
        sortie = log.sortie[drone[DRONE_SORTIE]]
        sortie[SORTIE_RECOVERY_STOP] = stop
        sortie[SORTIE_RECOVERY_START] = drone[DRONE_RECOVERY]
        sortie[SORTIE_RECOVERY_END] = recovery_end(setting.type, drone[DRONE_RECOVERY])
        log_op(log, stop, drone[DRONE_SORTIE], True)
        drone[DRONE_PLACE] = ABOARD
        drone[DRONE_SORTIE] = IN_FLIGHT


@inlined
def op_times(setting: Setting, log: VehicleLog, row: int) -> tuple[int, int]:
    """Return when a launch or recovery begins and ends."""
    sortie = log.sortie[log.op[row, OP_SORTIE]]
    if log.op[row, OP_IS_RECOVERY]:
        return sortie[SORTIE_RECOVERY_START], sortie[SORTIE_RECOVERY_END]
    return launch_begin(setting.type, sortie[SORTIE_TAKEOFF]), sortie[SORTIE_TAKEOFF]


@inlined
def sort_ops(setting: Setting, log: VehicleLog, first: int) -> None:
    """Put the launches and recoveries from row `first` on, all at one stop, in order. In place."""
    for last in range(first + 1, log.count[COUNT_OPS]):
        row = last
        while row > first and op_times(setting, log, row) < op_times(setting, log, row - 1):
            for column in (OP_SORTIE, OP_IS_RECOVERY):
                log.op[row, column], log.op[row - 1, column] = (log.op[row - 1, column],
                                                                log.op[row, column])
            row -= 1


@inlined
def log_sorties(setting: Setting, log: VehicleLog, vehicle: IntArray, drones: IntArray) -> None:
    """Write what `leave_for` decided of the sorties in flight. In place."""
    here, first = log.count[COUNT_STOPS] - 1, log.count[COUNT_OPS] - vehicle[V_FLYING]
    for d in range(len(drones)):
        if drones[d, DRONE_PLACE] != ABOARD:
            node, takeoff = drones[d, DRONE_NODE], drones[d, DRONE_TAKEOFF]
            sortie = log.sortie[drones[d, DRONE_SORTIE]]
            arrival = takeoff + lookup(setting.fly, vehicle[V_NODE], node)
            sortie[SORTIE_TAKEOFF], sortie[SORTIE_ARRIVAL] = takeoff, arrival
            sortie[SORTIE_START] = start_of_service(setting.node[node], arrival)
            sortie[SORTIE_READY] = drones[d, DRONE_READY]
    log_recoveries(setting, log, drones, LOOP, here)
    sort_ops(setting, log, first)
    log_recoveries(setting, log, drones, MEET, here + 1)


@inlined
def begin_trip(setting: Setting, log: VehicleLog, vehicle: IntArray, release: int) -> None:
    """Begin a trip of the idle vehicle as soon as the parcel is released. In place."""
    start = max(vehicle[V_NEXT_START], release)
    trip = log.trip[log.count[COUNT_TRIPS]]
    trip[TRIP_FIRST_STOP], trip[TRIP_FIRST_OP] = log.count[COUNT_STOPS], log.count[COUNT_OPS]
    trip[TRIP_RELEASE], trip[TRIP_START] = release, start
    log.count[COUNT_TRIPS] += 1
    leave = leaves_first(setting.type, start)
    log_stop(log, vehicle[V_NODE], start, start, leave)
    if log.count[COUNT_TRIPS] == 1:
        vehicle[V_START_BEST] = start
        vehicle[V_DEPARTURE_BEST] = first_departure(setting, log, start)
    vehicle[V_IDLE] = 0
    vehicle[V_SERVICE_END] = leave
    vehicle[V_FREE] = vehicle[V_CREW] = start


@inlined
def hold_trip(setting: Setting, num_depots: int, log: VehicleLog, vehicle: IntArray,
              drones: IntArray, release: int) -> bool:
    """Let the trip begin no earlier than `release`. In place; False if it can't be held so long."""
    trip = log.trip[log.count[COUNT_TRIPS] - 1]
    trip[TRIP_RELEASE] = max(trip[TRIP_RELEASE], release)
    if trip[TRIP_START] >= release:
        return True
    if not replay(setting, num_depots, log, log.count[COUNT_TRIPS] - 1, release, True):
        return False
    here = log.count[COUNT_STOPS] - 1
    stop = log.stop[here]
    vehicle[V_SERVICE_END] = stop[STOP_START]
    if stop[STOP_NODE] >= num_depots:
        vehicle[V_SERVICE_END] += service_duration(setting.node[stop[STOP_NODE]])
    else:
        vehicle[V_SERVICE_END] = leaves_first(setting.type, vehicle[V_SERVICE_END])
    vehicle[V_FREE] = vehicle[V_CREW] = stop[STOP_ARRIVAL]
    last = log.count[COUNT_OPS] - 1
    while last >= 0 and log.op[last, OP_STOP] == here:
        sortie = log.sortie[log.op[last, OP_SORTIE]]
        if log.op[last, OP_IS_RECOVERY]:
            vehicle[V_CREW] = max(vehicle[V_CREW], sortie[SORTIE_RECOVERY_END])
            vehicle[V_FREE] = max(vehicle[V_FREE], sortie[SORTIE_RECOVERY_END])
        else:
            vehicle[V_FREE] = max(vehicle[V_FREE], sortie[SORTIE_TAKEOFF])
        last -= 1
    for d in range(len(drones)):
        if drones[d, DRONE_SORTIE] != IN_FLIGHT:
            sortie = log.sortie[drones[d, DRONE_SORTIE]]
            drones[d, DRONE_TAKEOFF], drones[d, DRONE_READY] = (sortie[SORTIE_TAKEOFF],
                                                                sortie[SORTIE_READY])
    if log.count[COUNT_TRIPS] == 1:
        vehicle[V_START_BEST] = max(vehicle[V_START_BEST], release)
    return True


@inlined
def improve_departure(setting: Setting, num_depots: int, log: VehicleLog,
                      vehicle: IntArray) -> None:
    """Find how late the vehicle could have left without ending its last stop later. In place."""
    if setting.type.max_working_duration < UNLIMITED:
        vehicle[V_START_BEST] = latest_start(setting, num_depots, log, 0, vehicle[V_START_BEST])
    vehicle[V_DEPARTURE_BEST] = first_departure(setting, log, vehicle[V_START_BEST])


@inlined
def board(setting: Setting, vehicle: IntArray, drones: IntArray, sortie: int, node: int,
          takeoff: int) -> int:
    """Put the first drone aboard into the air, to a customer. In place; return which."""
    drone = 0
    while drones[drone, DRONE_SORTIE] != IN_FLIGHT:
        drone += 1
    arrival = takeoff + lookup(setting.fly, vehicle[V_NODE], node)
    drones[drone, DRONE_SORTIE], drones[drone, DRONE_NODE] = sortie, node
    drones[drone, DRONE_TAKEOFF] = takeoff
    drones[drone, DRONE_READY] = ready(setting.type, setting.node[node], arrival)
    vehicle[V_FLYING] += 1
    vehicle[V_FREE] = takeoff
    return drone


@inlined
def launch(setting: Setting, num_depots: int, log: VehicleLog, vehicle: IntArray,
           drones: IntArray, node: int) -> bool:
    """Launch a drone to a customer. In place; False if a window or a distance forbids it.

    Whether the vehicle could have left later is for `improve_departure`.
    """
    release = setting.node[node].release
    if vehicle[V_IDLE]:
        begin_trip(setting, log, vehicle, release)
    elif not hold_trip(setting, num_depots, log, vehicle, drones, release):
        return False
    takeoff = take_off(setting.type, vehicle[V_FREE])
    flight = lookup(setting.fly, vehicle[V_NODE], node)
    arrival = takeoff + flight
    if unreachable(flight) or too_late(setting.node[node], arrival):
        return False
    here = log.count[COUNT_STOPS] - 1
    index = log.count[COUNT_SORTIES]
    drone = board(setting, vehicle, drones, index, node, takeoff)
    sortie = log.sortie[index]
    sortie[SORTIE_DRONE], sortie[SORTIE_NODE], sortie[SORTIE_LAUNCH_STOP] = drone, node, here
    sortie[SORTIE_RECOVERY_STOP] = IN_FLIGHT
    sortie[SORTIE_TAKEOFF], sortie[SORTIE_ARRIVAL] = takeoff, arrival
    sortie[SORTIE_START] = start_of_service(setting.node[node], arrival)
    sortie[SORTIE_READY] = drones[drone, DRONE_READY]
    log.count[COUNT_SORTIES] += 1
    log_op(log, here, index, False)
    log.stop[here, STOP_LEAVE] = max(vehicle[V_SERVICE_END], takeoff)
    take_load(setting, vehicle, node)
    # The start known so far kept the end of service here, not the arrival, on which launches hang.
    vehicle[V_START_BEST] = log.trip[0, TRIP_START]
    return True


@inlined
def drive(setting: Setting, num_depots: int, log: VehicleLog, vehicle: IntArray,
          drones: IntArray, node: int) -> bool:
    """Drive to a customer or home. In place; False if a window or an endurance forbids it.

    Whether the vehicle could have left later is for `improve_departure`.
    """
    is_customer = node >= num_depots
    release = setting.node[node].release
    if vehicle[V_IDLE]:
        begin_trip(setting, log, vehicle, release)
    elif is_customer and not hold_trip(setting, num_depots, log, vehicle, drones, release):
        return False
    left, arrival, free = leave_for(setting, vehicle, drones, node)
    if arrival < 0 or (is_customer and too_late(setting.node[node], arrival)):
        return False
    if vehicle[V_FLYING] > 0:
        here = log.count[COUNT_STOPS] - 1
        log.stop[here, STOP_LEAVE] = max(vehicle[V_SERVICE_END], left)
        log_sorties(setting, log, vehicle, drones)
        vehicle[V_FLYING] = 0
        # The start known so far kept the drones' return, not the last take-off before recoveries.
        vehicle[V_START_BEST] = log.trip[0, TRIP_START]
    start = arrival
    service_end = arrival
    if is_customer:
        start = start_of_service(setting.node[node], arrival)
        service_end = end_of_service(setting.node[node], arrival)
        take_load(setting, vehicle, node)
    log_stop(log, node, arrival, start, max(service_end, free))
    vehicle[V_NODE] = node
    vehicle[V_SERVICE_END], vehicle[V_FREE], vehicle[V_CREW] = service_end, free, free
    if not is_customer:
        vehicle[V_IDLE] = 1
        vehicle[V_DISTANCE] = 0
        vehicle[V_NEXT_START] = free + setting.type.reload_duration
        leave_load(vehicle, capacity_of(setting.type))
    return True


@inlined
def load_left(vehicle: IntArray) -> Amount:
    """Return what the vehicle could still be asked to carry on this trip."""
    return vehicle[V_LOAD], vehicle[V_LOAD + 1], vehicle[V_LOAD + 2]


@inlined
def leave_load(vehicle: IntArray, amount: Amount) -> None:
    """Let an amount be left. In place."""
    vehicle[V_LOAD], vehicle[V_LOAD + 1], vehicle[V_LOAD + 2] = amount


@inlined
def take_load(setting: Setting, vehicle: IntArray, node: int) -> None:
    """Take a customer's demand from the load left. In place."""
    leave_load(vehicle, minus(load_left(vehicle), demand_of(setting.node[node])))


@compiled
def open_vehicle(instance: Instance, state: State, r: int, k: int) -> None:
    """Let a fresh vehicle of type `k` stand ready at its depot. In place."""
    b = state.problem[r]
    vehicle = state.vehicle[r]
    vehicle[:] = 0
    vehicle[V_TYPE], vehicle[V_INDEX] = k, state.used[r, k]
    vehicle[V_NODE] = instance.type[b, k].begins_at
    vehicle[V_IDLE] = 1
    vehicle[V_NEXT_START] = instance.type[b, k].shift_earliest
    leave_load(vehicle, capacity_of(instance.type[b, k]))
    state.drone[r, :, DRONE_SORTIE] = IN_FLIGHT
    state.log.count[r] = 0
    state.used[r, k] += 1


@compiled
def close_vehicle(instance: Instance, state: State, r: int) -> None:
    """Let each trip of the vehicle begin as late as costs nothing and add its cost. In place."""
    b = state.problem[r]
    k = state.vehicle[r, V_TYPE]
    setting = setting_of(instance, b, k)
    log = log_of(state.log, r)
    num_depots = instance.size[b, 0]
    for trip in range(log.count[COUNT_TRIPS]):
        known = log.trip[trip, TRIP_START]
        if trip == 0:
            known = max(known, state.vehicle[r, V_START_BEST])
        start = latest_start(setting, num_depots, log, trip, known)
        if start > log.trip[trip, TRIP_START]:
            replay(setting, num_depots, log, trip, start, True)
    if log.count[COUNT_TRIPS] > 0:
        add_cost(instance, setting, log, b, k, state.cost[r])
