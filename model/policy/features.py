"""What a policy sees at each step: its candidates and the state of the open vehicle.

Like the tokens, all numbers are free of units. Training and decoding share this file.
"""

from typing import NamedTuple

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.kernel.instance import MAX_DIMENSIONS, Instance
from model.kernel.leg import lookup, matrix_of
from model.kernel.load import demand_of
from model.kernel.records import Record, Records
from model.kernel.stop import closing, lateness
from model.policy.lookahead import Unit, describe_neighbours, ratio, slack
from model.policy.tokens import NUM_TYPE_FEATURES, Float32Array, Scales
from model.problem import MM_PER_KM, MS_PER_HOUR, UNLIMITED, FloatArray, IntArray
from model.simulation.meeting import NO_VEHICLE
from model.simulation.simulator import (
    DRIVE, LAUNCH, NUM_KINDS, OPEN, OUTLOOK, RETURN, apply, finish, legal_actions,
)
from model.simulation.transition import State
from model.simulation.vehicle_log import Setting, setting_of

NUM_ACTION_FEATURES = 28
NUM_STATE_FEATURES = 14
NUM_GLOBAL_FEATURES = NUM_STATE_FEATURES + NUM_TYPE_FEATURES


class Observation(NamedTuple):
    """What one decision sees, a row per rollout. Candidates are the legal actions, first `count`.

    Action features: kind (4), duration by scale and by nearness, cost, waiting, slack to the end
    of the window, lateness cost, share of the load left and of the capacity, slack to the end of
    the shift, way home from there, slack of distance, of working duration, detour against going
    home now, excess over the nearest candidate, share of the endurance, delay for release, way to
    the nearest unserved customer, to the third nearest, the former's excess over the way from here.
    Of the nearest unserved ones in time: how soon one is served next (a drone recovered), its slack
    (the truck's waiting), the share lost by this action, the detour by one before (by air: that the
    truck would make instead), how soon this one could be served after another.
    """

    count: IntArray  # type: ignore[assignment]  # (rollout,)
    action: IntArray  # (rollout, candidate) codes
    token: IntArray  # (rollout, candidate) node, or number of nodes + type
    outlook: Records  # (rollout, candidate) OUTLOOK
    feature: Float32Array  # (rollout, candidate, NUM_ACTION_FEATURES)
    glob: Float32Array  # (rollout, NUM_GLOBAL_FEATURES) vehicle state, then its type's features
    here: IntArray  # (rollout,) token of the vehicle's place


def empty_observation(rows: int, num_nodes: int, num_types: int) -> Observation:
    """Allocate room for the candidates of every rollout."""
    most = 2 * num_nodes + 1 + num_types
    return Observation(
        count=np.zeros(rows, np.int64),
        action=np.zeros((rows, most), np.int64),
        token=np.zeros((rows, most), np.int64),
        outlook=np.zeros((rows, most), OUTLOOK),
        feature=np.zeros((rows, most, NUM_ACTION_FEATURES), np.float32),
        glob=np.zeros((rows, NUM_GLOBAL_FEATURES), np.float32),
        here=np.zeros(rows, np.int64),
    )


@inlined
def _share(used: int, limit: int) -> float:
    """Return how much of a limit is used, 2 at most; 0 where there is no limit."""
    return 0.0 if limit >= UNLIMITED else min(used / max(1, limit), 2.0)


@inlined
def _describe_customer(setting: Setting, unit: Unit, late_early: FloatArray, vehicle: Record,
                       begun: bool, node: int, outlook: Record, feature: Float32Array) -> None:
    """Describe what serving a customer next means, by truck or drone alike. In place."""
    columns = setting.node[node]
    arrival, end = outlook.arrival, outlook.end
    waiting = outlook.start - arrival
    late = lateness(columns, arrival)
    feature[7] = ratio(waiting, unit.time)
    feature[8] = slack(closing(columns), arrival, unit.time)
    window_cost = late * late_early[node, 0] + waiting * late_early[node, 1]
    feature[9] = ratio(window_cost / MS_PER_HOUR, unit.cost)
    for dimension in range(MAX_DIMENSIONS):
        demand = columns.demand[dimension]
        if demand > 0:
            feature[10] = max(feature[10], demand / vehicle.load[dimension])
            feature[11] = max(feature[11], demand / setting.type.capacity[dimension])
    feature[12] = slack(setting.type.shift_latest, end, unit.time)
    departure = vehicle.departure_best if begun else vehicle.next_start
    feature[15] = slack(setting.type.max_working_duration, end - departure, unit.time)
    feature[19] = ratio(columns.release - vehicle.next_start, unit.time)


@inlined
def _describe_leg(unit: Unit, duration: int, distance: int, km: float, hour: float,
                  feature: Float32Array) -> None:
    """Describe the way to a place. In place."""
    feature[4] = min(duration / unit.time, 5.0)
    feature[5] = ratio(duration, unit.near)
    cost = distance / MM_PER_KM * km + duration / MS_PER_HOUR * hour
    feature[6] = min(cost / unit.cost, 5.0)


@inlined
def _describe_flight(setting: Setting, unit: Unit, here: int, node: int, distance: int,
                     rate: Record, feature: Float32Array) -> None:
    """Describe the flight to a customer, as if the drone came back here. In place."""
    there = lookup(setting.fly, here, node)
    back = min(lookup(setting.fly, node, here), 10 * there)
    _describe_leg(unit, there, 2 * distance, rate.drone_distance, 2 * rate.drone_time,
                  feature)
    feature[18] = _share(there + back, setting.type.endurance)


@inlined
def _nearest_drive(drive: IntArray, here: int, actions: IntArray) -> int:
    """Return the shortest drive from here among the actions."""
    nearest = UNLIMITED
    for action in actions:
        if action % NUM_KINDS == DRIVE:
            nearest = min(nearest, lookup(drive, here, action // NUM_KINDS))
    return nearest


@inlined
def _describe_return(setting: Setting, vehicle: Record, trips: int,
                     feature: Float32Array) -> None:
    """Describe returning to the depot. In place."""
    feature[10] = vehicle.load[0] / max(1, setting.type.capacity[0])
    feature[11] = min(setting.type.max_trips - trips, 4) / 4


@inlined
def _describe_open(columns: Record, fixed: float, used: int, unserved: float, unit: Unit,
                   feature: Float32Array) -> None:
    """Describe opening a vehicle of a type. In place."""
    left = columns.count - used
    feature[6] = ratio(fixed, unit.cost)
    feature[10] = left / (left + 4.0)
    feature[11] = min(columns.capacity[0] / max(1.0, unserved), 2.0)
    feature[14] = columns.drones > 0


@inlined
def _unserved_demand(instance: Instance, state: State, r: int) -> float:
    """Return the demand left in the first dimension."""
    b = state.problem[r]
    nodes, served = instance.node[b], state.served[r]
    total = 0.0
    for node in range(instance.size[b, 0], instance.size[b, 0] + instance.size[b, 1]):
        if not served[node]:
            total += demand_of(nodes[node])[0]
    return total


@inlined
def _describe_state(instance: Instance, scale: Scales, state: State, type_token: Float32Array,
                    r: int, unserved: float, glob: Float32Array) -> None:
    """Describe the open vehicle and what is left to do. In place."""
    b = state.problem[r]
    vehicle = state.vehicle[r]
    k = vehicle.type
    glob[:] = 0.0
    reserve = 0.0
    for kind in range(instance.size[b, 2]):
        left = instance.type[b, kind].count - state.used[r, kind]
        reserve += (left * float(instance.type[b, kind].max_trips)
                    * instance.type[b, kind].capacity[0])
    glob[0] = state.num_unserved[r] / max(1, instance.size[b, 1])
    glob[1] = unserved / scale.amount[b]
    if k == NO_VEHICLE:
        glob[2] = min(unserved / max(1.0, reserve), 2.0)
        return
    columns = instance.type[b, k]
    capacity = max(1, columns.capacity[0])
    trips_left = columns.max_trips - state.log.count[r].trips
    reserve += float(trips_left) * capacity
    clock = vehicle.next_start
    if not vehicle.idle:
        clock = max(vehicle.service_end, vehicle.free)
        home = lookup(matrix_of(instance.duration, b, columns.travel), vehicle.node,
                      columns.ends_at)
        glob[3] = min(home / scale.time[b], 5.0)
        reserve += vehicle.load[0]
    glob[2] = min(unserved / max(1.0, reserve), 2.0)
    glob[4] = vehicle.idle
    glob[5] = min(clock / scale.horizon[b], 2.0)
    glob[6] = vehicle.load[0] / capacity
    glob[7] = max(min((reserve - unserved) / capacity, 2.0), -2.0)
    glob[8] = min(trips_left, 4) / 4
    glob[9] = slack(columns.shift_latest, clock, scale.time[b])
    working = clock - vehicle.departure_best if state.log.count[r].trips else 0
    glob[10] = slack(columns.max_working_duration, working, scale.time[b])
    glob[11] = vehicle.flying / max(1, columns.drones)
    glob[12] = columns.drones > vehicle.flying
    glob[13] = min(vehicle.load[0] / max(1.0, unserved), 2.0)
    for column in range(NUM_TYPE_FEATURES):
        glob[NUM_STATE_FEATURES + column] = type_token[b, k, column]


@inlined
def _describe_opens(instance: Instance, scale: Scales, state: State, r: int, unserved: float,
                    seen: Observation) -> None:
    """Describe the vehicles that may be opened. In place."""
    b = state.problem[r]
    unit = Unit(scale.time[b], scale.near[b], scale.cost[b])
    for index in range(seen.count[r]):
        kind, target = seen.action[r, index] % NUM_KINDS, seen.action[r, index] // NUM_KINDS
        if kind == OPEN:
            feature = seen.feature[r, index]
            feature[:] = 0.0
            feature[OPEN] = 1.0
            seen.token[r, index] = instance.node.shape[1] + target
            _describe_open(instance.type[b, target], instance.rate[b, target].fixed,
                           state.used[r, target], unserved, unit, feature)


@compiled
def _describe_moves(instance: Instance, scale: Scales, state: State, r: int,
                    seen: Observation) -> None:
    """Describe the drives, the launches and the return of the open vehicle. In place."""
    b, k = state.problem[r], state.vehicle[r].type
    setting = setting_of(instance, b, k)
    vehicle = state.vehicle[r]
    rate, late_early = instance.rate[b, k], instance.late_early[b]
    unit = Unit(scale.time[b], scale.near[b], scale.cost[b])
    home, here = setting.type.ends_at, vehicle.node
    distance = matrix_of(instance.distance, b, setting.type.travel)
    flown = matrix_of(instance.distance, b, setting.type.drone_travel)
    trips = state.log.count[r].trips
    actions, features = seen.action[r, : seen.count[r]], seen.feature[r]
    nearest = _nearest_drive(setting.drive, here, actions)
    for index in range(len(actions)):
        kind, node = actions[index] % NUM_KINDS, actions[index] // NUM_KINDS
        if kind == OPEN:
            continue
        feature = features[index]
        feature[:] = 0.0
        feature[kind] = 1.0
        seen.token[r, index] = node
        if kind == LAUNCH:
            _describe_flight(setting, unit, here, node, lookup(flown, here, node), rate, feature)
        else:
            _describe_leg(unit, lookup(setting.drive, here, node), lookup(distance, here, node),
                          rate.distance, rate.time, feature)
        if kind == RETURN:
            _describe_return(setting, vehicle, trips, feature)
            continue
        way, way_home = lookup(setting.drive, here, node), lookup(setting.drive, node, home)
        feature[13] = min(way_home / unit.time, 5.0)
        if kind == DRIVE:
            used = vehicle.distance + lookup(distance, here, node) + lookup(distance, node, home)
            feature[14] = slack(setting.type.max_trip_distance, used, lookup(distance, home, node))
            detour = (way + way_home - lookup(setting.drive, here, home)) / unit.time
            feature[16] = max(min(detour, 5.0), -5.0)
            feature[17] = ratio(way - nearest, unit.near)
        _describe_customer(setting, unit, late_early, vehicle, trips > 0, node,
                           seen.outlook[r, index], feature)
        describe_neighbours(setting, instance.neighbour[b], state.served[r], vehicle.load[0], here,
                            node, seen.outlook[r, index], unit, kind == LAUNCH, feature)


@compiled
def observe(instance: Instance, scale: Scales, state: State, type_token: Float32Array, first: int,
            behind: int, scratch: int, seen: Observation) -> int:
    """List and describe the legal actions of the rollouts `first` to `behind`.

    In place; a rollout without a legal action is finished. Returns the largest count.
    """
    most = 0
    for r in range(first, behind):
        if state.done[r]:
            seen.count[r] = 0
            continue
        seen.count[r] = legal_actions(instance, state, r, scratch, seen.action[r],
                                      seen.outlook[r])
        if seen.count[r] == 0:
            finish(instance, state, r)
            continue
        most = max(most, seen.count[r])
        seen.here[r] = state.vehicle[r].node
        unserved = _unserved_demand(instance, state, r)
        _describe_state(instance, scale, state, type_token, r, unserved, seen.glob[r])
        _describe_opens(instance, scale, state, r, unserved, seen)
        if state.vehicle[r].type != NO_VEHICLE:
            _describe_moves(instance, scale, state, r, seen)
    return most


@compiled
def act(instance: Instance, state: State, first: int, behind: int, choice: IntArray,
        seen: Observation) -> None:
    """Do the chosen candidate of each rollout `first` to `behind`. In place.

    `choice` is (rollout,), an index into the candidates; rollouts without any stay as they are.
    """
    for r in range(first, behind):
        if seen.count[r] > 0:
            apply(instance, state, r, seen.action[r, choice[r]])


@compiled
def step(instance: Instance, scale: Scales, state: State, type_token: Float32Array, first: int,
         behind: int, scratch: int, choice: IntArray, seen: Observation) -> int:
    """Do what was chosen of what was `seen`, then observe; at the beginning, only the latter.

    In place, like `act` and `observe`, in one call. Returns the largest count.
    """
    act(instance, state, first, behind, choice, seen)
    return observe(instance, scale, state, type_token, first, behind, scratch, seen)
