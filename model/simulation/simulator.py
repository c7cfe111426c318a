"""The decision process, compiled: begin, list the legal actions, act, over a batch of rollouts.

One action per step, vehicle after vehicle: drive to a customer, launch a drone to a customer,
return to a depot, open a vehicle of a type. A sortie is recovered at the next stop, or at the
stop that launched it when it could not be met at the next within endurance. An action is legal
exactly when the plan so far, that action and a direct return to the depot make a legal plan, all
as soon as possible but the first departure, which is as late as costs nothing: a working duration
is not kept by being late. So no legal action leads into an illegal plan. Where a route may not end
at a depot, a trip may only if a further one can follow.
"""

import numpy as np

from model.kernel.clock import is_steady
from model.kernel.compiled import compiled, inlined
from model.kernel.flight import take_off, unreachable
from model.kernel.instance import Instance
from model.kernel.leg import lookup, matrix_of
from model.kernel.load import release_of, some_limited
from model.kernel.records import Record, Records
from model.kernel.shift import allows_sorties, allows_stops
from model.kernel.start import counted_from, has_begun, leaves_first
from model.kernel.stop import end_of_service, start_of_service, too_late
from model.problem import FloatArray, IntArray
from model.simulation.aboard import given_by_flight, holds_all, may_carry, may_launch
from model.simulation.meeting import (
    NO_VEHICLE, leave_for, next_drone, order_is_open, soonest_takeoff,
)
from model.simulation.transition import (
    State, board, clear_vehicle, close_vehicle, drive, empty_state, improve_departure, launch,
    open_vehicle,
)
from model.simulation.trial import OUTLOOK, legal_by_trial, may_reload
from model.simulation.vehicle_log import (
    IN_FLIGHT, Setting, VehicleLog, craft_of, first_departure, log_of, setting_of, travel_arrival,
)

DRIVE, LAUNCH, RETURN, OPEN = range(4)
NUM_KINDS = 4

NO, YES, UNSURE = range(3)


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
def _judge_drive(setting: Setting, vehicle: Record, drones: Records, earliest: int, node: int,
                 outlook: Record) -> int:
    """Judge driving to a customer whose parcel the trip carries already. Writes `outlook`.

    `earliest` is the vehicle's earliest departure, -1 if it has none yet.
    """
    place = setting.node[node]
    idle = vehicle.idle == 1
    if idle:
        leave = max(vehicle.next_start, release_of(place))
        out = leaves_first(setting.type, leave)
        arrival = travel_arrival(setting, vehicle.node, node, out)
        free = arrival
    else:
        leave = vehicle.next_start
        _, arrival, free = leave_for(setting, vehicle, drones, node)
        if arrival < 0:
            return NO
    if not holds_all(setting, vehicle, drones, node, True):
        return NO
    if too_late(place, arrival):
        return NO
    start = start_of_service(place, arrival)
    served = max(free, end_of_service(place, arrival))
    end = travel_arrival(setting, node, setting.type.ends_at, served)
    outlook.arrival, outlook.start, outlook.end = arrival, start, end
    departure = leaves_first(setting.type, leave)
    if earliest >= 0:
        departure = vehicle.departure_best if vehicle.flying == 0 else earliest
    rigid = (start == arrival and vehicle.flying == 0 and leave == vehicle.next_start
             and is_steady(setting.type))
    return _judge_end(setting, end, departure, rigid)


@inlined
def _judge_launch(setting: Setting, log: VehicleLog, vehicle: Record, drones: Records,
                  departure: int, node: int, outlook: Record) -> int:
    """Judge a launch during a trip that carries the parcel already. Writes `outlook`.

    `departure` is the vehicle's earliest.
    """
    drone = next_drone(setting, log, vehicle, drones, node)
    if drone < 0:
        return NO
    place, craft = setting.node[node], craft_of(setting, drones[drone].row)
    flight = lookup(craft.out, vehicle.node, node)
    takeoff = take_off(craft.type, vehicle.free, vehicle.launched + vehicle.flying)
    arrival = soonest_takeoff(setting, vehicle, craft.type, takeoff) + flight
    if unreachable(flight) or too_late(place, arrival):
        return NO
    free = vehicle.free
    board(setting, vehicle, drones, drone, 0, node, takeoff)
    delivered = given_by_flight(setting, node)
    vehicle.given += delivered
    _, home, end = leave_for(setting, vehicle, drones, setting.type.ends_at)
    is_held = home >= 0 and holds_all(setting, vehicle, drones, setting.type.ends_at, False)
    drones[drone].sortie = IN_FLIGHT
    vehicle.given -= delivered
    vehicle.flying -= 1
    vehicle.free = free
    if not is_held:
        return NO
    arrival = drones[drone].takeoff + flight
    outlook.arrival = arrival
    outlook.start, outlook.end = start_of_service(place, arrival), end
    return _judge_end(setting, end, departure, False)


@inlined
def _may_go_on(instance: Instance, setting: Setting, b: int, k: int, vehicle: Record,
               trips: int) -> bool:
    """Tell whether a vehicle may begin a further trip where it is."""
    return trips < setting.type.max_trips and instance.reload[b, k, vehicle.node]


@inlined
def _may_add(setting: Setting, vehicle: Record, log: VehicleLog) -> tuple[bool, bool]:
    """Tell whether a trip, or the next one, may have a stop more, and a sortie, by their number."""
    served = 0
    if vehicle.idle == 0:
        served = log.count.stops - log.trip[log.count.trips - 1].first_stop - 1
    flown = vehicle.launched + vehicle.flying
    return (allows_stops(setting.type, served + 1),
            vehicle.flying < setting.type.drones and allows_sorties(setting.type, flown + 1))


@compiled
def _legal_services(instance: Instance, state: State, r: int, scratch: int, actions: IntArray,
                    outlooks: Records) -> int:
    """Write the legal drives and launches of one rollout with an open vehicle; return how many."""
    b, k = state.problem[r], state.vehicle[r].type
    vehicle, log = state.vehicle[r], log_of(state.log, r)
    setting = setting_of(instance, b, k)
    trips = state.log.count[r].trips
    idle = vehicle.idle == 1
    if idle and trips > 0 and not _may_go_on(instance, setting, b, k, vehicle, trips):
        return 0
    legs = matrix_of(instance.distance, b, setting.type.travel)
    here, home = vehicle.node, setting.type.ends_at
    reach = setting.type.max_trip_distance - vehicle.distance
    began = 0 if idle else state.log.trip[r, trips - 1].start
    drones = state.drone[r, : setting.type.drones]
    may_drive, can_launch = _may_add(setting, vehicle, log)
    can_drive, can_fly, served = instance.can_drive[b, k], instance.can_fly[b, k], state.served[r]
    earliest = first_departure(setting, log, log.trip[0].start) if trips > 0 else -1
    found, size = 0, instance.size[b]
    trying = some_limited(setting.fresh_for) or order_is_open(setting, vehicle)
    for node in range(size.depots, size.depots + size.customers):
        if served[node] or not may_carry(setting, vehicle, node):
            continue
        held = trying or (not idle and began < release_of(setting.node[node]))
        if (may_drive and can_drive[node]
                and lookup(legs, here, node) + lookup(legs, node, home) <= reach):
            verdict = UNSURE
            if not held:
                verdict = _judge_drive(setting, vehicle, drones, earliest, node, outlooks[found])
            if verdict == YES or (verdict == UNSURE and legal_by_trial(
                    instance, state, r, scratch, -1, False, node, outlooks[found])):
                actions[found] = node * NUM_KINDS + DRIVE
                found += 1
        if can_launch and can_fly[node] and may_launch(setting, vehicle, node):
            verdict = UNSURE
            if not held and not idle:
                verdict = _judge_launch(setting, log, vehicle, drones, earliest, node,
                                        outlooks[found])
            if verdict == YES or (verdict == UNSURE and legal_by_trial(
                    instance, state, r, scratch, -1, True, node, outlooks[found])):
                actions[found] = node * NUM_KINDS + LAUNCH
                found += 1
    return found


@compiled
def _legal_returns(instance: Instance, state: State, r: int, scratch: int, actions: IntArray,
                   outlooks: Records, found: int) -> int:
    """Write, behind those found, where the vehicle's trip may end; return how many there are."""
    b, k = state.problem[r], state.vehicle[r].type
    kind = instance.type[b, k]
    actions[found] = kind.ends_at * NUM_KINDS + RETURN
    found += 1
    if kind.changes_ends == 1 and state.log.count[r].trips < kind.max_trips:
        for place in range(instance.size[b].depots):
            if (place != kind.ends_at and instance.reload[b, k, place]
                    and may_reload(instance, state, r, scratch, place, outlooks[found])):
                actions[found] = place * NUM_KINDS + RETURN
                found += 1
    return found


@inlined
def _open_legal(instance: Instance, state: State, r: int, k: int) -> bool:
    """Tell whether a vehicle of type `k` may open: one is left and has a customer to serve."""
    b = state.problem[r]
    if state.used[r, k] >= instance.type[b, k].count:
        return False
    size = instance.size[b]
    for node in range(size.depots, size.depots + size.customers):
        if state.fresh[b, k, node] and not state.served[r, node]:
            return True
    return False


@compiled
def legal_actions(instance: Instance, state: State, r: int, scratch: int, actions: IntArray,
                  outlooks: Records) -> int:
    """Write the codes of the legal actions of one rollout and what each leads to.

    In place; returns how many. `outlooks` (action,) OUTLOOK is written for customers alone.
    """
    found = 0
    if state.done[r]:
        return 0
    vehicle = state.vehicle[r]
    if vehicle.type != NO_VEHICLE:
        found = _legal_services(instance, state, r, scratch, actions, outlooks)
        if not vehicle.idle:
            return _legal_returns(instance, state, r, scratch, actions, outlooks, found)
        if (state.log.count[r].trips == 0
                or vehicle.node != instance.type[state.problem[r], vehicle.type].ends_at):
            return found
    for k in range(instance.size[state.problem[r]].types):
        if _open_legal(instance, state, r, k):
            actions[found] = k * NUM_KINDS + OPEN
            found += 1
    return found


@compiled
def apply(instance: Instance, state: State, r: int, action: int) -> None:
    """Do one legal action of one rollout. In place."""
    kind, target = action % NUM_KINDS, action // NUM_KINDS
    b, k = state.problem[r], state.vehicle[r].type
    if kind == OPEN:
        if k != NO_VEHICLE:
            close_vehicle(instance, state, r)
        open_vehicle(instance, state, r, target)
        return
    setting = setting_of(instance, b, k)
    vehicle, log = state.vehicle[r], log_of(state.log, r)
    drones = state.drone[r, : setting.type.drones]
    if kind == LAUNCH:
        launch(setting, instance.size[b].depots, log, vehicle, drones, target)
    else:
        legs = matrix_of(instance.distance, b, setting.type.travel)
        vehicle.distance += lookup(legs, vehicle.node, target)
        drive(setting, instance.size[b].depots, log, vehicle, drones, target)
    improve_departure(setting, instance.size[b].depots, log, vehicle)
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
def price_routes(instance: Instance, state: State, r: int, actions: IntArray, cost: FloatArray,
                 price: FloatArray) -> None:
    """Write what each vehicle costs, (vehicle, term), as if there were no other. In place.

    `actions` are legal ones of some plan; `cost` is the state's, as a table of numbers.
    """
    vehicle = done = 0
    while done < len(actions):
        cost[r] = 0.0
        state.used[r] = 0
        done = apply_route(instance, state, r, actions, done)
        close_vehicle(instance, state, r)
        clear_vehicle(state.vehicle[r])
        price[vehicle] = cost[r]
        vehicle += 1


@compiled
def finish(instance: Instance, state: State, r: int) -> None:
    """End a rollout that has no legal action left: close its vehicle, count who is left.

    In place.
    """
    if state.vehicle[r].type != NO_VEHICLE:
        close_vehicle(instance, state, r)
    b = state.problem[r]
    state.cost[r].unassigned += state.num_unserved[r] * instance.unassigned_cost[b]
    if state.num_unserved[r] > 0:
        size = instance.size[b]
        for node in range(size.depots, size.depots + size.customers):
            if not state.served[r, node]:
                state.cost[r].unassigned += instance.unassigned_more[b, node]
    state.done[r] = True


@compiled
def _mark_fresh(instance: Instance, state: State, scratch: int) -> None:
    """Find who could be served alone by a fresh vehicle of each type. In place."""
    row = scratch - 1
    for b in range(instance.size.shape[0]):
        state.problem[row] = b
        actions = np.zeros(2 * instance.size[b].customers + 1, np.int64)
        outlooks = np.zeros(len(actions), OUTLOOK)
        for k in range(instance.size[b].types):
            open_vehicle(instance, state, row, k)
            for index in range(_legal_services(instance, state, row, scratch, actions, outlooks)):
                state.fresh[b, k, actions[index] // NUM_KINDS] = True
    state.used[row] = 0
    clear_vehicle(state.vehicle[row])


def max_steps(instance: Instance) -> int:
    """Return how many times the longest rollout may be observed at most.

    Each step serves a customer, opens a vehicle or returns, and neither trip nor vehicle stays
    empty; the observation after the last step finds nothing to do.
    """
    return 3 * int(instance.size["customers"].max()) + 2


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
    state.num_unserved[:count] = instance.size["customers"][rollouts]
    return state
