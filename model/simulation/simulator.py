"""The decision process, compiled: begin, list the legal actions, act, over a batch of rollouts.

One action per step, vehicle after vehicle: drive to a customer, launch a drone to a customer,
return to the depot, open a vehicle of a type. A sortie is recovered at the next stop, or at the
stop that launched it when it could not be met at the next within endurance. An action is legal
exactly when the plan so far, that action and a direct return to the depot make a legal plan, all
as soon as possible but the first departure, which is as late as costs nothing: a working duration
is not kept by being late. So no legal action leads into an illegal plan.
"""

import numpy as np

from model.kernel.clock import is_steady
from model.kernel.compiled import compiled, inlined
from model.kernel.copying import copy_rows
from model.kernel.flight import take_off, unreachable
from model.kernel.instance import Instance
from model.kernel.leg import lookup, matrix_of
from model.kernel.load import demand_of, within
from model.kernel.start import counted_from, has_begun, leaves_first
from model.kernel.stop import end_of_service, start_of_service, too_late
from model.problem import IntArray
from model.simulation.cost import COST_UNASSIGNED
from model.simulation.meeting import (
    DRONE_SORTIE, DRONE_TAKEOFF, NO_VEHICLE, V_DEPARTURE_BEST, V_DISTANCE, V_FLYING, V_FREE, V_IDLE,
    V_NEXT_START, V_NODE, V_START_BEST, V_TYPE, leave_for,
)
from model.simulation.transition import (
    State, board, close_vehicle, drive, empty_state, improve_departure, launch, load_left,
    open_vehicle,
)
from model.simulation.vehicle_log import (
    COUNT_OPS, COUNT_SORTIES, COUNT_STOPS, COUNT_TRIPS, IN_FLIGHT, SORTIE_ARRIVAL, SORTIE_START,
    STOP_ARRIVAL, STOP_START, TRIP_START, Setting, VehicleLog, first_departure, log_of, replay,
    setting_of, start_to_depart, travel_arrival,
)

DRIVE, LAUNCH, RETURN, OPEN = range(4)
NUM_KINDS = 4

NO, YES, UNSURE = range(3)
OUTLOOK_ARRIVAL, OUTLOOK_START, OUTLOOK_END = range(3)


def encode_action(kind: int, target: int) -> int:
    """Return the code of an action; `target` is a customer's node, a depot's node or a type."""
    return target * NUM_KINDS + kind


@inlined
def _judge_end(setting: Setting, end: int, departure: int, rigid: bool) -> int:
    """Judge the return home: within the shift and, leaving at `departure`, the working duration.

    `rigid` tells that the vehicle could not leave later than `departure` without ending later.
    """
    departure = counted_from(setting.type, departure)
    rigid = rigid or has_begun(setting.type)
    if end > setting.type.shift_latest:
        return NO
    if end - departure <= setting.type.max_working_duration:
        return YES
    return NO if rigid else UNSURE


@inlined
def _judge_drive(setting: Setting, vehicle: IntArray, drones: IntArray, earliest: int, node: int,
                 outlook: IntArray) -> int:
    """Judge driving to a customer whose parcel the trip carries already. Writes `outlook`.

    `earliest` is the vehicle's earliest departure, -1 if it has none yet.
    """
    place = setting.node[node]
    idle = vehicle[V_IDLE] == 1
    if idle:
        leave = max(vehicle[V_NEXT_START], place.release)
        out = leaves_first(setting.type, leave)
        arrival = travel_arrival(setting, vehicle[V_NODE], node, out)
        free = arrival
    else:
        leave = vehicle[V_NEXT_START]
        _, arrival, free = leave_for(setting, vehicle, drones, node)
        if arrival < 0:
            return NO
    if too_late(place, arrival):
        return NO
    start = start_of_service(place, arrival)
    served = max(free, end_of_service(place, arrival))
    end = travel_arrival(setting, node, setting.type.ends_at, served)
    outlook[OUTLOOK_ARRIVAL], outlook[OUTLOOK_START], outlook[OUTLOOK_END] = arrival, start, end
    departure = leaves_first(setting.type, leave)
    if earliest >= 0:
        departure = vehicle[V_DEPARTURE_BEST] if vehicle[V_FLYING] == 0 else earliest
    rigid = (start == arrival and vehicle[V_FLYING] == 0 and leave == vehicle[V_NEXT_START]
             and is_steady(setting.type))
    return _judge_end(setting, end, departure, rigid)


@inlined
def _judge_launch(setting: Setting, vehicle: IntArray, drones: IntArray, departure: int,
                  node: int, outlook: IntArray) -> int:
    """Judge a launch during a trip that carries the parcel already. Writes `outlook`.

    `departure` is the vehicle's earliest.
    """
    place = setting.node[node]
    flight = lookup(setting.fly, vehicle[V_NODE], node)
    takeoff = take_off(setting.type, vehicle[V_FREE])
    arrival = takeoff + flight
    if unreachable(flight) or too_late(place, arrival):
        return NO
    free = vehicle[V_FREE]
    drone = board(setting, vehicle, drones, 0, node, takeoff)
    _, home, end = leave_for(setting, vehicle, drones, setting.type.ends_at)
    drones[drone, DRONE_SORTIE] = IN_FLIGHT
    vehicle[V_FLYING] -= 1
    vehicle[V_FREE] = free
    if home < 0:
        return NO
    arrival = drones[drone, DRONE_TAKEOFF] + flight
    outlook[OUTLOOK_ARRIVAL] = arrival
    outlook[OUTLOOK_START], outlook[OUTLOOK_END] = start_of_service(place, arrival), end
    return _judge_end(setting, end, departure, False)


@inlined
def _copy_vehicle(state: State, r: int, to: int) -> None:
    """Copy the open vehicle of one row to another. In place."""
    logs = state.log
    count = logs.count[r]
    copy_rows(state.vehicle[r : r + 1], state.vehicle[to : to + 1], 1)
    copy_rows(logs.count[r : r + 1], logs.count[to : to + 1], 1)
    copy_rows(state.drone[r], state.drone[to], state.drone.shape[1])
    copy_rows(logs.trip[r], logs.trip[to], count[COUNT_TRIPS])
    copy_rows(logs.stop[r], logs.stop[to], count[COUNT_STOPS])
    copy_rows(logs.op[r], logs.op[to], count[COUNT_OPS])
    copy_rows(logs.sortie[r], logs.sortie[to], count[COUNT_SORTIES])


@inlined
def _works_within(setting: Setting, num_depots: int, log: VehicleLog, vehicle: IntArray) -> bool:
    """Tell whether a vehicle come home could have left so late as to keep its working duration.

    Cheaper than `improve_departure`: one start is tried, since all before one that costs nothing
    cost nothing.
    """
    needed = vehicle[V_FREE] - setting.type.max_working_duration
    if first_departure(setting, log, vehicle[V_START_BEST]) >= needed:
        return True
    if has_begun(setting.type):
        return False
    return replay(setting, num_depots, log, 0, start_to_depart(setting, log, needed), False)


@compiled
def legal_by_trial(instance: Instance, state: State, r: int, scratch: int, kind: int, node: int,
                   outlook: IntArray) -> bool:
    """Tell whether an action on a customer is legal by doing it and the return home on scratch.

    Exact for every customer that the load, the kind and the number of trips allow.
    """
    b, k = state.problem[r], state.vehicle[r, V_TYPE]
    setting = setting_of(instance, b, k)
    num_depots = instance.size[b, 0]
    _copy_vehicle(state, r, scratch)
    vehicle, log = state.vehicle[scratch], log_of(state.log, scratch)
    drones = state.drone[scratch, : setting.type.drones]
    if kind == LAUNCH:
        if not launch(setting, num_depots, log, vehicle, drones, node):
            return False
    elif not drive(setting, num_depots, log, vehicle, drones, node):
        return False
    here = log.count[COUNT_STOPS] - 1
    if not drive(setting, num_depots, log, vehicle, drones, setting.type.ends_at):
        return False
    arrival, start = log.stop[here, STOP_ARRIVAL], log.stop[here, STOP_START]
    if kind == LAUNCH:
        sortie = log.sortie[log.count[COUNT_SORTIES] - 1]
        arrival, start = sortie[SORTIE_ARRIVAL], sortie[SORTIE_START]
    end = vehicle[V_FREE]
    outlook[OUTLOOK_ARRIVAL], outlook[OUTLOOK_START], outlook[OUTLOOK_END] = arrival, start, end
    return (end <= setting.type.shift_latest
            and _works_within(setting, num_depots, log, vehicle))


@compiled
def _legal_services(instance: Instance, state: State, r: int, scratch: int, actions: IntArray,
                    outlooks: IntArray) -> int:
    """Write the legal drives and launches of one rollout with an open vehicle; return how many."""
    b, k = state.problem[r], state.vehicle[r, V_TYPE]
    vehicle = state.vehicle[r]
    setting = setting_of(instance, b, k)
    trips = state.log.count[r, COUNT_TRIPS]
    idle = vehicle[V_IDLE] == 1
    if idle and trips >= setting.type.max_trips:
        return 0
    legs = matrix_of(instance.distance, b, setting.type.travel)
    here, home = vehicle[V_NODE], setting.type.ends_at
    reach = setting.type.max_trip_distance - vehicle[V_DISTANCE]
    began = 0 if idle else state.log.trip[r, trips - 1, TRIP_START]
    drones = state.drone[r, : setting.type.drones]
    may_launch = vehicle[V_FLYING] < setting.type.drones
    can_drive, can_fly, served = instance.can_drive[b, k], instance.can_fly[b, k], state.served[r]
    earliest = -1
    if trips > 0:
        earliest = first_departure(setting, log_of(state.log, r), state.log.trip[r, 0, TRIP_START])
    found = 0
    for node in range(instance.size[b, 0], instance.size[b, 0] + instance.size[b, 1]):
        if served[node] or not within(demand_of(setting.node[node]), load_left(vehicle)):
            continue
        held = not idle and began < setting.node[node].release
        if can_drive[node] and lookup(legs, here, node) + lookup(legs, node, home) <= reach:
            verdict = UNSURE
            if not held:
                verdict = _judge_drive(setting, vehicle, drones, earliest, node,
                                       outlooks[found])
            if verdict == YES or (verdict == UNSURE and legal_by_trial(
                    instance, state, r, scratch, DRIVE, node, outlooks[found])):
                actions[found] = node * NUM_KINDS + DRIVE
                found += 1
        if may_launch and can_fly[node]:
            verdict = UNSURE
            if not held and not idle:
                verdict = _judge_launch(setting, vehicle, drones, earliest, node, outlooks[found])
            if verdict == YES or (verdict == UNSURE and legal_by_trial(
                    instance, state, r, scratch, LAUNCH, node, outlooks[found])):
                actions[found] = node * NUM_KINDS + LAUNCH
                found += 1
    return found


@inlined
def _open_legal(instance: Instance, state: State, r: int, k: int) -> bool:
    """Tell whether a vehicle of type `k` may open: one is left and has a customer to serve."""
    b = state.problem[r]
    if state.used[r, k] >= instance.type[b, k].count:
        return False
    for node in range(instance.size[b, 0], instance.size[b, 0] + instance.size[b, 1]):
        if state.fresh[b, k, node] and not state.served[r, node]:
            return True
    return False


@compiled
def legal_actions(instance: Instance, state: State, r: int, scratch: int, actions: IntArray,
                  outlooks: IntArray) -> int:
    """Write the codes of the legal actions of one rollout and what each leads to.

    In place; returns how many. `outlooks` (action, 3): for customers, the arrival, the start of
    service, and the end of the trip if the vehicle went home afterwards.
    """
    found = 0
    if state.done[r]:
        return 0
    vehicle = state.vehicle[r]
    if vehicle[V_TYPE] != NO_VEHICLE:
        found = _legal_services(instance, state, r, scratch, actions, outlooks)
        if not vehicle[V_IDLE]:
            home = instance.type[state.problem[r], vehicle[V_TYPE]].ends_at
            actions[found] = home * NUM_KINDS + RETURN
            return found + 1
        if state.log.count[r, COUNT_TRIPS] == 0:
            return found
    for k in range(instance.size[state.problem[r], 2]):
        if _open_legal(instance, state, r, k):
            actions[found] = k * NUM_KINDS + OPEN
            found += 1
    return found


@compiled
def apply(instance: Instance, state: State, r: int, action: int) -> None:
    """Do one legal action of one rollout. In place."""
    kind, target = action % NUM_KINDS, action // NUM_KINDS
    b, k = state.problem[r], state.vehicle[r, V_TYPE]
    if kind == OPEN:
        if k != NO_VEHICLE:
            close_vehicle(instance, state, r)
        open_vehicle(instance, state, r, target)
        return
    setting = setting_of(instance, b, k)
    vehicle, log = state.vehicle[r], log_of(state.log, r)
    drones = state.drone[r, : setting.type.drones]
    if kind == LAUNCH:
        launch(setting, instance.size[b, 0], log, vehicle, drones, target)
    else:
        legs = matrix_of(instance.distance, b, setting.type.travel)
        vehicle[V_DISTANCE] += lookup(legs, vehicle[V_NODE], target)
        drive(setting, instance.size[b, 0], log, vehicle, drones, target)
    improve_departure(setting, instance.size[b, 0], log, vehicle)
    if kind != RETURN:
        state.served[r, target] = True
        state.num_unserved[r] -= 1


@compiled
def apply_route(instance: Instance, state: State, r: int, actions: IntArray, first: int) -> int:
    """Do legal actions of one rollout, the `first` and all before the next vehicle opens.

    In place; returns the index of the action that opens it, or how many there are.
    """
    apply(instance, state, r, actions[first])
    index = first + 1
    while index < len(actions) and actions[index] % NUM_KINDS != OPEN:
        apply(instance, state, r, actions[index])
        index += 1
    return index


@compiled
def finish(instance: Instance, state: State, r: int) -> None:
    """End a rollout that has no legal action left: close its vehicle, count who is left.

    In place.
    """
    if state.vehicle[r, V_TYPE] != NO_VEHICLE:
        close_vehicle(instance, state, r)
    b = state.problem[r]
    state.cost[r, COST_UNASSIGNED] += state.num_unserved[r] * instance.unassigned_cost[b]
    if state.num_unserved[r] > 0:
        for node in range(instance.size[b, 0], instance.size[b, 0] + instance.size[b, 1]):
            if not state.served[r, node]:
                state.cost[r, COST_UNASSIGNED] += instance.unassigned_more[b, node]
    state.done[r] = True


@compiled
def _mark_fresh(instance: Instance, state: State, scratch: int) -> None:
    """Find who could be served alone by a fresh vehicle of each type. In place."""
    row = scratch - 1
    for b in range(instance.size.shape[0]):
        state.problem[row] = b
        actions = np.zeros(2 * instance.size[b, 1] + 1, np.int64)
        outlooks = np.zeros((len(actions), 3), np.int64)
        for k in range(instance.size[b, 2]):
            open_vehicle(instance, state, row, k)
            for index in range(_legal_services(instance, state, row, scratch, actions, outlooks)):
                state.fresh[b, k, actions[index] // NUM_KINDS] = True
    state.used[row] = 0
    state.vehicle[row] = 0
    state.vehicle[row, V_TYPE] = NO_VEHICLE


def max_steps(instance: Instance) -> int:
    """Return how many times the longest rollout may be observed at most.

    Each step serves a customer, opens a vehicle or returns, and neither trip nor vehicle stays
    empty; the observation after the last step finds nothing to do.
    """
    return 3 * int(instance.size[:, 1].max()) + 2


def reset(instance: Instance, rollouts: IntArray, num_scratch: int = 1) -> State:
    """Begin one rollout for each entry of `rollouts`.

    Parameters
    ----------
    instance
        Packed problems.
    rollouts
        (rollout,) row of the problem that each rollout plans; at least one.
    num_scratch
        Scratch rows behind the rollouts, one for each thread that will run some of them.
    """
    count = len(rollouts)
    state = empty_state(instance, count + num_scratch)
    _mark_fresh(instance, state, count)
    state.problem[:count] = rollouts
    state.num_unserved[:count] = instance.size[rollouts, 1]
    return state
