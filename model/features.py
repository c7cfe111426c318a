"""What a policy sees: tokens once per problem, candidates and a vehicle state once per step.

All numbers are free of units: lengths, times and costs are divided by scales of the problem, so
one policy serves all sizes. Training and decoding share this file.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from model.compiled import compiled
from model.instance import (
    MAX_DIMENSIONS, NODE_DEMAND, NODE_EARLIEST, NODE_HARD, NODE_LATEST, NODE_RELEASE,
    NODE_SERVICE, RATE_DRONE_HOUR, RATE_DRONE_KM, RATE_FIXED, RATE_HOUR, RATE_KM, TYPE_CAPACITY,
    TYPE_COUNT, TYPE_DEPOT, TYPE_DRONE_TRAVEL, TYPE_DRONES, TYPE_EARLIEST, TYPE_ENDURANCE,
    TYPE_LATEST, TYPE_MAX_DISTANCE, TYPE_MAX_TRIPS, TYPE_MAX_WORKING, TYPE_PAYLOAD, TYPE_PROFILE,
    TYPE_RELOAD, TYPE_TRAVEL, Instance,
)
from model.problem import MM_PER_KM, MS_PER_HOUR, UNLIMITED, FloatArray, IntArray
from model.schedule import COUNT_TRIPS, Setting, setting_of
from model.simulator import (
    DRIVE, LAUNCH, NUM_KINDS, OPEN, OUTLOOK_ARRIVAL, OUTLOOK_END, OUTLOOK_START, RETURN, apply,
    finish, legal_actions,
)
from model.transition import (
    NO_VEHICLE, V_DEPARTURE_BEST, V_DISTANCE, V_FLYING, V_FREE, V_IDLE, V_LOAD, V_NEXT_START,
    V_NODE, V_SERVICE_END, V_TYPE, State,
)

Float32Array = NDArray[np.float32]

NUM_NODE_FEATURES = 20
NUM_TYPE_FEATURES = 22
NUM_ACTION_FEATURES = 20
NUM_STATE_FEATURES = 14
NUM_GLOBAL_FEATURES = NUM_STATE_FEATURES + NUM_TYPE_FEATURES
NUM_PAIR_FEATURES = 4


class Scales(NamedTuple):
    """Units of each problem, a row per problem."""

    time: FloatArray  # (problem,) ms from a depot to a customer, mean
    near: FloatArray  # (problem,) ms from a customer to its nearest neighbour, mean
    horizon: FloatArray  # (problem,) ms, the last limit stated, or a guess
    cost: FloatArray  # (problem,) cost of driving from a depot to a customer, mean
    amount: FloatArray  # (problem,) total demand in the first dimension


class Unit(NamedTuple):
    """The units of one problem that steps need: ms, ms, cost."""

    time: float
    near: float
    cost: float


class Tokens(NamedTuple):
    """What the encoder sees: nodes, then vehicle types, padded."""

    node: Float32Array  # (problem, node, NUM_NODE_FEATURES)
    type: Float32Array  # (problem, type, NUM_TYPE_FEATURES)
    pair: Float32Array  # (problem, node, node, NUM_PAIR_FEATURES) from row to column
    mask: NDArray[np.bool_]  # (problem, node + type) True = a token, False = padding


class Observation(NamedTuple):
    """What one decision sees, a row per rollout. Candidates are the legal actions, first `count`.

    Action features: kind (4), duration by scale and by nearness, cost, waiting, slack to the end
    of the window, lateness cost, share of the load left and of the capacity, slack to the end of
    the shift, way home from there, slack of distance, of working duration, detour against going
    home now, excess over the nearest candidate, share of the endurance, delay for release.
    """

    count: IntArray  # type: ignore[assignment]  # (rollout,)
    action: IntArray  # (rollout, candidate) codes
    token: IntArray  # (rollout, candidate) node, or number of nodes + type
    outlook: IntArray  # (rollout, candidate, 3) of `legal_actions`
    feature: Float32Array  # (rollout, candidate, NUM_ACTION_FEATURES)
    glob: Float32Array  # (rollout, NUM_GLOBAL_FEATURES) vehicle state, then its type's features
    here: IntArray  # (rollout,) token of the vehicle's place


def scales(instance: Instance) -> Scales:
    """Measure the units of each problem."""
    rows = len(instance.size)
    result = Scales(*(np.ones(rows) for _ in Scales._fields))
    for b in range(rows):
        depots, customers, types = instance.size[b, :3].tolist()
        if customers == 0:
            continue
        nodes = slice(depots, depots + customers)
        kinds = instance.type[b, :types]
        legs = [instance.duration[b, kind[TYPE_TRAVEL], kind[TYPE_DEPOT], nodes] for kind in kinds]
        result.time[b] = max(1.0, float(np.mean(legs)))
        between = instance.duration[b, kinds[0, TYPE_TRAVEL], nodes, nodes].astype(np.float64)
        np.fill_diagonal(between, np.inf)
        nearest = between.min(axis=1)
        near = float(nearest.mean()) if customers > 1 else result.time[b]
        result.near[b] = max(1.0, near)
        limits = np.concatenate([instance.node[b, nodes, NODE_LATEST], kinds[:, TYPE_LATEST]])
        limits = limits[limits < UNLIMITED]
        result.horizon[b] = max(1, limits.max()) if len(limits) else 20 * result.time[b]
        driven = [instance.distance[b, kind[TYPE_TRAVEL], kind[TYPE_DEPOT], nodes].mean()
                  for kind in kinds]
        rate = instance.rate[b, :types]
        cost = float(np.mean(rate[:, RATE_KM] * driven) / MM_PER_KM
                     + rate[:, RATE_HOUR].mean() * result.time[b] / MS_PER_HOUR)
        result.cost[b] = cost if cost > 0 else max(1e-9, float(rate[:, RATE_FIXED].mean()) or 1.0)
        result.amount[b] = max(1, instance.node[b, nodes, NODE_DEMAND].sum())
    return result


def squash(value: FloatArray) -> FloatArray:
    """Map 0..inf to 0..1, inf included."""
    return 1.0 - 1.0 / (1.0 + value)


def unbounded(limit: IntArray) -> FloatArray:
    """Return limits with infinity for "no limit"."""
    return np.where(limit >= UNLIMITED, np.inf, limit)


def tokens(instance: Instance, scale: Scales, coordinates: FloatArray) -> Tokens:
    """Describe nodes and vehicle types.

    Parameters
    ----------
    instance
        Packed problems.
    scale
        Their units.
    coordinates
        (problem, node, 2) planar, any unit.
    """
    num_nodes, num_types = instance.node.shape[1], instance.type.shape[1]
    index = np.arange(num_nodes)
    is_node = index < (instance.size[:, 0] + instance.size[:, 1])[:, None]
    is_type = np.arange(num_types) < instance.size[:, 2:3]
    node = node_features(instance, scale, coordinates, is_node)
    kind = type_features(instance, scale, is_type)
    return Tokens(
        node=np.where(is_node[..., None], node, 0.0).astype(np.float32),
        type=np.where(is_type[..., None], kind, 0.0).astype(np.float32),
        pair=pair_features(instance, scale),
        mask=np.concatenate([is_node, is_type], axis=1),
    )


def node_features(instance: Instance, scale: Scales, coordinates: FloatArray,
                  is_node: NDArray[np.bool_]) -> FloatArray:
    """Describe depots and customers, (problem, node, NUM_NODE_FEATURES)."""
    time, horizon = scale.time[:, None], scale.horizon[:, None]
    hours = time / MS_PER_HOUR / scale.cost[:, None]
    low = np.where(is_node[..., None], coordinates, np.inf).min(axis=1, keepdims=True)
    high = np.where(is_node[..., None], coordinates, -np.inf).max(axis=1, keepdims=True)
    extent = np.maximum((high - low).max(axis=2, keepdims=True), 1e-9)
    place = (coordinates - (low + high) / 2) / extent * 2
    columns = instance.node
    is_depot = np.arange(columns.shape[1]) < instance.size[:, :1]
    capacity = np.maximum(instance.type[:, :, TYPE_CAPACITY:TYPE_PAYLOAD].max(axis=1), 1)[:, None]
    payload = instance.type[:, :, TYPE_PAYLOAD:].max(axis=1)[:, None]
    demand = columns[:, :, NODE_DEMAND:]
    types = np.maximum(instance.size[:, 2], 1)[:, None]
    earliest, latest = columns[:, :, NODE_EARLIEST], columns[:, :, NODE_LATEST]
    home = instance.duration[:, 0, 0, :]
    return np.stack([
        place[..., 0], place[..., 1], is_depot,
        np.minimum(earliest / horizon, 2), np.minimum(latest / horizon, 2),
        np.minimum((latest - earliest) / horizon, 2), latest >= UNLIMITED, columns[:, :, NODE_HARD],
        squash(np.maximum(unbounded(latest) - home, 0) / time),
        np.minimum((demand / capacity).max(axis=2), 2), demand[..., 0] / scale.amount[:, None],
        (demand / np.maximum(demand + payload, 1)).max(axis=2),
        squash(columns[:, :, NODE_SERVICE] / time),
        np.minimum(columns[:, :, NODE_RELEASE] / horizon, 2),
        squash(instance.late_early[..., 0] * hours), squash(instance.late_early[..., 1] * hours),
        instance.can_drive.sum(axis=1) / types, instance.can_fly.sum(axis=1) / types,
        squash(home / time), squash(home / scale.near[:, None] / 4),
    ], axis=2)


def pair_features(instance: Instance, scale: Scales) -> Float32Array:
    """Describe the way from each node to each, by the first vehicle type.

    Returns
    -------
    (problem, node, node, NUM_PAIR_FEATURES): duration, nearness, the least lateness-free slack and
    the least waiting at the second node after service at the first.
    """
    problem = np.arange(len(instance.size))
    leg = instance.duration[problem, instance.type[:, 0, TYPE_TRAVEL]].astype(np.float32)
    time = scale.time[:, None, None].astype(np.float32)
    near = scale.near[:, None, None].astype(np.float32)
    columns = np.minimum(instance.node, 100 * scale.horizon[:, None, None]).astype(np.float32)
    earliest, latest = columns[:, :, NODE_EARLIEST], columns[:, :, NODE_LATEST]
    service = columns[:, :, NODE_SERVICE]
    slack = latest[:, None, :] - (earliest + service)[:, :, None] - leg
    waiting = earliest[:, None, :] - (latest + service)[:, :, None] - leg
    return np.stack([leg / (leg + time), near / (leg + near), np.clip(slack / time, -1, 3) / 2,
                     np.clip(waiting / time, -1, 3) / 2], axis=3)


def type_features(instance: Instance, scale: Scales, is_type: NDArray[np.bool_]) -> FloatArray:
    """Describe vehicle types, (problem, type, NUM_TYPE_FEATURES)."""
    kind, rate = instance.type, instance.rate
    time, horizon, cost = scale.time[:, None], scale.horizon[:, None], scale.cost[:, None]
    hours = time / MS_PER_HOUR
    customers = np.maximum(instance.size[:, 1], 1)[:, None]
    problem = np.arange(len(kind))[:, None]
    leg = instance.duration[problem, kind[..., TYPE_TRAVEL], 0].sum(axis=2) / customers
    driven = instance.distance[problem, kind[..., TYPE_TRAVEL], 0].sum(axis=2) / customers
    flight = np.minimum(instance.duration[problem, kind[..., TYPE_DRONE_TRAVEL], 0],
                        10 * time[..., None]).sum(axis=2) / customers
    furthest = np.where(is_type, driven, 0).max(axis=1)[:, None, None]
    flown = np.minimum(instance.distance[problem, kind[..., TYPE_DRONE_TRAVEL], 0],
                       10 * furthest + 1).sum(axis=2) / customers
    capacity = kind[..., TYPE_CAPACITY]
    largest = np.maximum(capacity.max(axis=1, keepdims=True), 1)
    drones = kind[..., TYPE_DRONES]
    has_drones = drones > 0
    return np.stack([
        capacity / largest, np.minimum(capacity / scale.amount[:, None], 1),
        squash(kind[..., TYPE_COUNT] * capacity / scale.amount[:, None]),
        squash(kind[..., TYPE_COUNT] / 4), squash(rate[..., RATE_FIXED] / cost),
        squash(rate[..., RATE_KM] * driven / MM_PER_KM / cost),
        squash(rate[..., RATE_HOUR] * hours / cost), squash(leg / time),
        np.minimum(kind[..., TYPE_EARLIEST] / horizon, 2),
        np.minimum(kind[..., TYPE_LATEST] / horizon, 2),
        squash(unbounded(kind[..., TYPE_MAX_WORKING]) / time / 8),
        squash(unbounded(kind[..., TYPE_MAX_DISTANCE]) / np.maximum(driven, 1) / 8),
        squash((kind[..., TYPE_MAX_TRIPS] - 1.0) / 2), squash(kind[..., TYPE_RELOAD] / time),
        kind[..., TYPE_PROFILE] > 0, squash(drones / 2.0),
        np.where(has_drones, squash(kind[..., TYPE_PAYLOAD] / np.maximum(capacity, 1) * 10), 0),
        np.where(has_drones, squash(unbounded(kind[..., TYPE_ENDURANCE]) / time), 0),
        np.where(has_drones, squash(flight / time), 0),
        np.where(has_drones, squash(rate[..., RATE_DRONE_KM] * flown / MM_PER_KM / cost
                                    + rate[..., RATE_DRONE_HOUR] * hours / cost), 0),
        instance.can_drive.sum(axis=2) / customers, instance.can_fly.sum(axis=2) / customers,
    ], axis=2)


def empty_observation(rows: int, num_nodes: int, num_types: int) -> Observation:
    """Allocate room for the candidates of every rollout."""
    most = 2 * num_nodes + 1 + num_types
    return Observation(
        count=np.zeros(rows, np.int64),
        action=np.zeros((rows, most), np.int64),
        token=np.zeros((rows, most), np.int64),
        outlook=np.zeros((rows, most, 3), np.int64),
        feature=np.zeros((rows, most, NUM_ACTION_FEATURES), np.float32),
        glob=np.zeros((rows, NUM_GLOBAL_FEATURES), np.float32),
        here=np.zeros(rows, np.int64),
    )


@compiled
def _ratio(value: float, scale: float) -> float:
    """Squash a length of any size to 0..1, half at `scale`."""
    return value / (value + scale) if value > 0 else 0.0


@compiled
def _slack(limit: int, used: int, scale: float) -> float:
    """Squash what a limit leaves to 0..1, half at `scale`; 1 where there is no limit."""
    return 1.0 if limit >= UNLIMITED else _ratio(float(limit - used), scale)


@compiled
def _share(used: int, limit: int) -> float:
    """Return how much of a limit is used, 2 at most; 0 where there is no limit."""
    return 0.0 if limit >= UNLIMITED else min(used / max(1, limit), 2.0)


@compiled
def _describe_customer(setting: Setting, unit: Unit, late_early: FloatArray, vehicle: IntArray,
                       begun: bool, node: int, outlook: IntArray, feature: Float32Array) -> None:
    """Describe what serving a customer next means, by truck or drone alike. In place."""
    columns = setting.node[node]
    arrival, end = outlook[OUTLOOK_ARRIVAL], outlook[OUTLOOK_END]
    waiting = outlook[OUTLOOK_START] - arrival
    late = max(0, arrival - columns[NODE_LATEST])
    feature[7] = _ratio(waiting, unit.time)
    feature[8] = _slack(columns[NODE_LATEST], arrival, unit.time)
    window_cost = late * late_early[node, 0] + waiting * late_early[node, 1]
    feature[9] = _ratio(window_cost / MS_PER_HOUR, unit.cost)
    for dimension in range(MAX_DIMENSIONS):
        demand = columns[NODE_DEMAND + dimension]
        if demand > 0:
            feature[10] = max(feature[10], demand / vehicle[V_LOAD + dimension])
            feature[11] = max(feature[11], demand / setting.type[TYPE_CAPACITY + dimension])
    feature[12] = _slack(setting.type[TYPE_LATEST], end, unit.time)
    departure = vehicle[V_DEPARTURE_BEST] if begun else vehicle[V_NEXT_START]
    feature[15] = _slack(setting.type[TYPE_MAX_WORKING], end - departure, unit.time)
    feature[19] = _ratio(columns[NODE_RELEASE] - vehicle[V_NEXT_START], unit.time)


@compiled
def _describe_leg(unit: Unit, duration: int, distance: int, km: float, hour: float,
                  feature: Float32Array) -> None:
    """Describe the way to a place. In place."""
    feature[4] = min(duration / unit.time, 5.0)
    feature[5] = _ratio(duration, unit.near)
    cost = distance / MM_PER_KM * km + duration / MS_PER_HOUR * hour
    feature[6] = min(cost / unit.cost, 5.0)


@compiled
def _describe_return(setting: Setting, vehicle: IntArray, trips: int,
                     feature: Float32Array) -> None:
    """Describe returning to the depot. In place."""
    feature[10] = vehicle[V_LOAD] / max(1, setting.type[TYPE_CAPACITY])
    feature[11] = min(setting.type[TYPE_MAX_TRIPS] - trips, 4) / 4


@compiled
def _describe_open(columns: IntArray, fixed: float, used: int, unserved: float, unit: Unit,
                   feature: Float32Array) -> None:
    """Describe opening a vehicle of a type. In place."""
    left = columns[TYPE_COUNT] - used
    feature[6] = _ratio(fixed, unit.cost)
    feature[10] = left / (left + 4.0)
    feature[11] = min(columns[TYPE_CAPACITY] / max(1.0, unserved), 2.0)
    feature[14] = columns[TYPE_DRONES] > 0


@compiled
def _unserved_demand(instance: Instance, state: State, r: int) -> float:
    """Return the demand left in the first dimension."""
    b = state.problem[r]
    nodes, served = instance.node[b], state.served[r]
    total = 0.0
    for node in range(instance.size[b, 0], instance.size[b, 0] + instance.size[b, 1]):
        if not served[node]:
            total += nodes[node, NODE_DEMAND]
    return total


@compiled
def _describe_state(instance: Instance, scale: Scales, state: State, type_token: Float32Array,
                    r: int, unserved: float, glob: Float32Array) -> None:
    """Describe the open vehicle and what is left to do. In place."""
    b = state.problem[r]
    vehicle = state.vehicle[r]
    k = vehicle[V_TYPE]
    glob[:] = 0.0
    reserve = 0.0
    for kind in range(instance.size[b, 2]):
        left = instance.type[b, kind, TYPE_COUNT] - state.used[r, kind]
        reserve += (left * float(instance.type[b, kind, TYPE_MAX_TRIPS])
                    * instance.type[b, kind, TYPE_CAPACITY])
    glob[0] = state.num_unserved[r] / max(1, instance.size[b, 1])
    glob[1] = unserved / scale.amount[b]
    if k == NO_VEHICLE:
        glob[2] = min(unserved / max(1.0, reserve), 2.0)
        return
    columns = instance.type[b, k]
    capacity = max(1, columns[TYPE_CAPACITY])
    trips_left = columns[TYPE_MAX_TRIPS] - state.log.count[r, COUNT_TRIPS]
    reserve += float(trips_left) * capacity
    clock = vehicle[V_NEXT_START]
    if not vehicle[V_IDLE]:
        clock = max(vehicle[V_SERVICE_END], vehicle[V_FREE])
        home = instance.duration[b, columns[TYPE_TRAVEL], vehicle[V_NODE], columns[TYPE_DEPOT]]
        glob[3] = min(home / scale.time[b], 5.0)
        reserve += vehicle[V_LOAD]
    glob[2] = min(unserved / max(1.0, reserve), 2.0)
    glob[4] = vehicle[V_IDLE]
    glob[5] = min(clock / scale.horizon[b], 2.0)
    glob[6] = vehicle[V_LOAD] / capacity
    glob[7] = max(min((reserve - unserved) / capacity, 2.0), -2.0)
    glob[8] = min(trips_left, 4) / 4
    glob[9] = _slack(columns[TYPE_LATEST], clock, scale.time[b])
    working = clock - vehicle[V_DEPARTURE_BEST] if state.log.count[r, COUNT_TRIPS] else 0
    glob[10] = _slack(columns[TYPE_MAX_WORKING], working, scale.time[b])
    glob[11] = vehicle[V_FLYING] / max(1, columns[TYPE_DRONES])
    glob[12] = columns[TYPE_DRONES] > vehicle[V_FLYING]
    glob[13] = min(vehicle[V_LOAD] / max(1.0, unserved), 2.0)
    glob[NUM_STATE_FEATURES:] = type_token[b, k]


@compiled
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
            _describe_open(instance.type[b, target], instance.rate[b, target, RATE_FIXED],
                           state.used[r, target], unserved, unit, feature)


@compiled
def _describe_moves(instance: Instance, scale: Scales, state: State, r: int,
                    seen: Observation) -> None:
    """Describe the drives, the launches and the return of the open vehicle. In place."""
    b, k = state.problem[r], state.vehicle[r, V_TYPE]
    setting = setting_of(instance, b, k)
    vehicle = state.vehicle[r]
    rate, late_early = instance.rate[b, k], instance.late_early[b]
    unit = Unit(scale.time[b], scale.near[b], scale.cost[b])
    home, here = setting.type[TYPE_DEPOT], vehicle[V_NODE]
    drive, fly = setting.drive[here], setting.fly[here]
    distance = instance.distance[b, setting.type[TYPE_TRAVEL]]
    flown = instance.distance[b, setting.type[TYPE_DRONE_TRAVEL], here]
    trips = state.log.count[r, COUNT_TRIPS]
    actions, features = seen.action[r, : seen.count[r]], seen.feature[r]
    nearest = UNLIMITED
    for action in actions:
        if action % NUM_KINDS == DRIVE:
            nearest = min(nearest, drive[action // NUM_KINDS])
    for index in range(len(actions)):
        kind, node = actions[index] % NUM_KINDS, actions[index] // NUM_KINDS
        if kind == OPEN:
            continue
        feature = features[index]
        feature[:] = 0.0
        feature[kind] = 1.0
        seen.token[r, index] = node
        if kind == LAUNCH:
            there = fly[node]
            back = min(setting.fly[node, here], 10 * there)
            _describe_leg(unit, there, 2 * flown[node], rate[RATE_DRONE_KM],
                          2 * rate[RATE_DRONE_HOUR], feature)
            feature[18] = _share(there + back, setting.type[TYPE_ENDURANCE])
        else:
            _describe_leg(unit, drive[node], distance[here, node], rate[RATE_KM], rate[RATE_HOUR],
                          feature)
        if kind == RETURN:
            _describe_return(setting, vehicle, trips, feature)
            continue
        way_home = setting.drive[node, home]
        feature[13] = min(way_home / unit.time, 5.0)
        if kind == DRIVE:
            used = vehicle[V_DISTANCE] + distance[here, node] + distance[node, home]
            feature[14] = _slack(setting.type[TYPE_MAX_DISTANCE], used, distance[home, node])
            detour = (drive[node] + way_home - drive[home]) / unit.time
            feature[16] = max(min(detour, 5.0), -5.0)
            feature[17] = _ratio(drive[node] - nearest, unit.near)
        _describe_customer(setting, unit, late_early, vehicle, trips > 0, node,
                           seen.outlook[r, index], feature)


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
        seen.here[r] = state.vehicle[r, V_NODE]
        unserved = _unserved_demand(instance, state, r)
        _describe_state(instance, scale, state, type_token, r, unserved, seen.glob[r])
        _describe_opens(instance, scale, state, r, unserved, seen)
        if state.vehicle[r, V_TYPE] != NO_VEHICLE:
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
