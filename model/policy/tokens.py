"""What an encoder sees of a problem, once per plan: nodes, vehicle types, pairs of nodes.

All numbers are free of units: lengths, times and costs are divided by scales of the problem, so
one policy serves all sizes. Training and decoding share this file.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from model.kernel.instance import ANY, FAR, TIER, Instance
from model.kernel.records import Records
from model.problem import MM_PER_KM, MS_PER_HOUR, UNLIMITED, BoolArray, FloatArray, IntArray

Float32Array = NDArray[np.float32]

NUM_NODE_FEATURES = 26
NUM_TYPE_FEATURES = 34
NUM_PAIR_FEATURES = 4


class Scales(NamedTuple):
    """Units of each problem, a row per problem."""

    time: FloatArray  # (problem,) ms from a depot to a customer, mean
    near: FloatArray  # (problem,) ms from a customer to its nearest neighbour, mean
    horizon: FloatArray  # (problem,) ms, the last limit stated, or a guess
    cost: FloatArray  # (problem,) cost of driving from a depot to a customer, mean
    amount: FloatArray  # (problem,) total demand in the first dimension, or of pickups if more


class Tokens(NamedTuple):
    """What the encoder sees: nodes, then vehicle types, padded."""

    node: Float32Array  # (problem, node, NUM_NODE_FEATURES)
    type: Float32Array  # (problem, type, NUM_TYPE_FEATURES)
    pair: Float32Array  # (problem, node, node, NUM_PAIR_FEATURES) from row to column
    mask: NDArray[np.bool_]  # (problem, node + type) True = a token, False = padding


def scales(instance: Instance) -> Scales:
    """Measure the units of each problem."""
    rows = len(instance.size)
    result = Scales(*(np.ones(rows) for _ in Scales._fields))
    picked = picked_up(instance)
    for b in range(rows):
        depots, customers, types, _ = instance.size[b].tolist()
        if customers == 0:
            continue
        nodes = slice(depots, depots + customers)
        kinds = instance.type[b, :types]
        legs = [instance.duration[b, kind.travel, kind.begins_at, nodes] for kind in kinds]
        result.time[b] = max(1.0, float(np.mean(legs)))
        between = instance.duration[b, kinds[0].travel, nodes, nodes].astype(np.float64)
        result.near[b] = max(1.0, _nearest(between) if customers > 1 else result.time[b])
        closing = instance.node[b, 0, nodes, 0]["window_latest"]
        limits = np.concatenate([closing, kinds["usual_end"]])
        limits = limits[limits < UNLIMITED]
        result.horizon[b] = max(1, limits.max()) if len(limits) else 20 * result.time[b]
        driven = [instance.distance[b, kind.travel, kind.begins_at, nodes].mean()
                  for kind in kinds]
        rate = instance.rate[b, :types]
        cost = float(np.mean(rate["distance"] * driven) / MM_PER_KM
                     + rate["time"].mean() * result.time[b] / MS_PER_HOUR)
        result.cost[b] = cost if cost > 0 else max(1e-9, float(rate["fixed"].mean()) or 1.0)
        delivered = instance.node[b, 0, nodes, 0]["demand"]
        result.amount[b] = max(1, picked[b, nodes, 0].sum(), delivered[:, 0].sum())
    return result


def _nearest(between: FloatArray) -> float:
    """Return the mean way from a customer to the nearest; elsewhere, if nobody is alone."""
    np.fill_diagonal(between, np.inf)
    nearest = between.min(axis=1)
    if not nearest.any():
        nearest = np.where(between > 0, between, np.inf).min(axis=1)
        nearest = nearest[np.isfinite(nearest)]
    return float(nearest.mean()) if len(nearest) else 0.0


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
    num_nodes, num_types = instance.node.shape[2], instance.type.shape[1]
    index = np.arange(num_nodes)
    is_node = index < (instance.size["depots"] + instance.size["customers"])[:, None]
    is_type = np.arange(num_types) < instance.size["types"][:, None]
    node = node_features(instance, scale, coordinates, is_node)
    kind = type_features(instance, scale, is_type)
    return Tokens(
        node=np.where(is_node[..., None], node, 0.0).astype(np.float32),
        type=np.where(is_type[..., None], kind, 0.0).astype(np.float32),
        pair=pair_features(instance, scale),
        mask=np.concatenate([is_node, is_type], axis=1),
    )


def own_rows(instance: Instance) -> Records:
    """Return the first rows of all nodes, (problem, node), with customers' own durations."""
    return instance.node[:, 0, :, 0]


def picked_up(instance: Instance) -> IntArray:
    """Return what is picked up, (problem, node, dimension), in the first dimensions."""
    if instance.amount.shape[2] == 0:
        return np.zeros((*instance.amount.shape[:2], TIER), np.int64)
    picked: IntArray = instance.amount[:, :, 0, TIER:2 * TIER]
    return picked


def node_features(instance: Instance, scale: Scales, coordinates: FloatArray,
                  is_node: NDArray[np.bool_]) -> FloatArray:
    """Describe depots and customers, (problem, node, NUM_NODE_FEATURES)."""
    time, horizon = scale.time[:, None], scale.horizon[:, None]
    hours = time / MS_PER_HOUR / scale.cost[:, None]
    low = np.where(is_node[..., None], coordinates, np.inf).min(axis=1, keepdims=True)
    high = np.where(is_node[..., None], coordinates, -np.inf).max(axis=1, keepdims=True)
    extent = np.maximum((high - low).max(axis=2, keepdims=True), 1e-9)
    place = (coordinates - (low + high) / 2) / extent * 2
    nodes = own_rows(instance)
    is_depot = np.arange(nodes.shape[1]) < instance.size["depots"][:, None]
    demand = np.maximum(nodes["demand"], picked_up(instance))
    seen = demand.shape[-1]
    capacity = np.maximum(instance.type["capacity"].max(axis=1), 1)[:, None, :seen]
    payload = instance.type["payload"].max(axis=1)[:, None, :seen]
    types = np.maximum(instance.size["types"], 1)[:, None]
    is_type = np.arange(instance.type.shape[1]) < instance.size["types"][:, None]
    can_fly = instance.can_fly & is_type[..., None]
    earliest, latest = nodes["window_earliest"], nodes["window_latest"]
    home = instance.duration[:, 0, 0, :]
    return np.stack([
        place[..., 0], place[..., 1], is_depot,
        np.minimum(earliest / horizon, 2), np.minimum(latest / horizon, 2),
        np.minimum((latest - earliest) / horizon, 2), latest >= UNLIMITED,
        nodes["arrival_limit"] < FAR,
        squash(np.maximum(unbounded(latest) - home, 0) / time),
        np.minimum((demand / capacity).max(axis=2), 2), demand[..., 0] / scale.amount[:, None],
        (demand / np.maximum(demand + payload, 1)).max(axis=2),
        squash(nodes["service_duration"] / time),
        np.minimum(nodes["release"] / horizon, 2),
        squash(instance.price["lateness"] * hours), squash(instance.price["waiting"] * hours),
        instance.can_drive.sum(axis=1) / types, can_fly.sum(axis=1) / types,
        squash(home / time), squash(home / scale.near[:, None] / 4),
        *_rarer_of_nodes(instance, scale, is_depot),
    ], axis=2)


def _rarer_of_nodes(instance: Instance, scale: Scales, is_depot: BoolArray) -> list[FloatArray]:
    """Describe what few customers ask for, (problem, node) each.

    What leaving them out costs, the share that is picked up, how much of the horizon lies between
    their windows, their longest time aboard, their setup, and how many of the customers have goods
    that must not go with theirs.
    """
    time, horizon, none = scale.time[:, None], scale.horizon[:, None], np.zeros(is_depot.shape)
    left_out = instance.unassigned_cost[:, None] + instance.unassigned_more
    capacity = np.maximum(instance.type["capacity"].max(axis=1), 1)[:, None, :TIER]
    gap = instance.node[:, 0, :, 1:]
    between = np.where(gap["window_latest"] < FAR, gap["window_earliest"] - gap["window_latest"], 0)
    barred = none
    if instance.goods.shape[1]:
        goods = instance.goods
        away = goods["barred_on_trip"] | goods["barred_on_vehicle"]
        apart = goods["held"][:, None, :] & away[:, :, None] != 0
        barred = apart.sum(axis=2) / np.maximum(instance.size["customers"], 1)[:, None]
    return [
        np.where(is_depot, 0.0, squash(left_out / scale.cost[:, None])),
        np.minimum((picked_up(instance) / capacity).max(axis=2), 2),
        np.minimum(between.sum(axis=2) / horizon, 2),
        squash(instance.fresh_for / time) if instance.fresh_for.shape[1] else none + 1.0,
        squash(instance.setup["setup_duration"] / time) if instance.setup.shape[1] else none,
        barred,
    ]


def pair_features(instance: Instance, scale: Scales) -> Float32Array:
    """Describe the way from each node to each, by the first vehicle type.

    Returns
    -------
    (problem, node, node, NUM_PAIR_FEATURES): duration, nearness, the least lateness-free slack and
    the least waiting at the second node after service at the first.
    """
    problem = np.arange(len(instance.size))
    leg = instance.duration[problem, instance.type["travel"][:, 0]].astype(np.float32)
    time = scale.time[:, None, None].astype(np.float32)
    near = scale.near[:, None, None].astype(np.float32)
    earliest, latest, service = (
        np.minimum(own_rows(instance)[field], 100 * scale.horizon[:, None]).astype(np.float32)
        for field in ("window_earliest", "window_latest", "service_duration"))
    slack = latest[:, None, :] - (earliest + service)[:, :, None] - leg
    waiting = earliest[:, None, :] - (latest + service)[:, :, None] - leg
    return np.stack([leg / (leg + time), near / (leg + near), np.clip(slack / time, -1, 3) / 2,
                     np.clip(waiting / time, -1, 3) / 2], axis=3)


def type_features(instance: Instance, scale: Scales, is_type: NDArray[np.bool_]) -> FloatArray:
    """Describe vehicle types, (problem, type, NUM_TYPE_FEATURES)."""
    kind, rate = instance.type, instance.rate
    time, horizon, cost = scale.time[:, None], scale.horizon[:, None], scale.cost[:, None]
    hours = time / MS_PER_HOUR
    customers = np.maximum(instance.size["customers"], 1)[:, None]
    problem = np.arange(len(kind))[:, None]
    leg = instance.duration[problem, kind["travel"], 0].sum(axis=2) / customers
    driven = instance.distance[problem, kind["travel"], 0].sum(axis=2) / customers
    flight = np.minimum(instance.duration[problem, kind["drone_travel"], 0],
                        10 * time[..., None]).sum(axis=2) / customers
    furthest = np.where(is_type, driven, 0).max(axis=1)[:, None, None]
    flown = np.minimum(instance.distance[problem, kind["drone_travel"], 0],
                       10 * furthest + 1).sum(axis=2) / customers
    capacity = kind["capacity"][..., 0]
    largest = np.maximum(capacity.max(axis=1, keepdims=True), 1)
    drones = kind["drones"]
    has_drones = drones > 0
    return np.stack([
        capacity / largest, np.minimum(capacity / scale.amount[:, None], 1),
        squash(kind["count"] * capacity / scale.amount[:, None]),
        squash(kind["count"] / 4), squash(rate["fixed"] / cost),
        squash(rate["distance"] * driven / MM_PER_KM / cost),
        squash(rate["time"] * hours / cost), squash(leg / time),
        np.minimum(kind["shift_earliest"] / horizon, 2),
        np.minimum(kind["usual_end"] / horizon, 2),
        squash(unbounded(kind["usual_working"]) / time / 8),
        squash(unbounded(kind["max_trip_distance"]) / np.maximum(driven, 1) / 8),
        squash((kind["max_trips"] - 1.0) / 2), squash(kind["reload_duration"] / time),
        kind["speed_changes"] > 0, squash(drones / 2.0),
        np.where(has_drones, squash(kind["payload"][..., 0] / np.maximum(capacity, 1) * 10), 0),
        np.where(has_drones, squash(unbounded(_longest_flights(kind)) / time), 0),
        np.where(has_drones, squash(flight / time), 0),
        np.where(has_drones, squash(rate["drone_distance"] * flown / MM_PER_KM / cost
                                    + rate["drone_time"] * hours / cost), 0),
        instance.can_drive.sum(axis=2) / customers, instance.can_fly.sum(axis=2) / customers,
        *_rarer_of_types(instance, scale, driven),
    ], axis=2)


def _rarer_of_types(instance: Instance, scale: Scales, driven: FloatArray) -> list[FloatArray]:
    """Describe what few vehicles are given, (problem, type) each.

    The ways from where they begin and to where they end; what overtime costs and how much there
    may be; what stops and loads cost; the most stops and sorties; whether pickups come last; other
    depots where they reload; how long launch and recovery take, and how fast batteries are charged.
    """
    kind, rate = instance.type, instance.rate
    time, cost = scale.time[:, None], scale.cost[:, None]
    customers = np.maximum(instance.size["customers"], 1)[:, None]
    problem = np.arange(len(kind))[:, None]
    begin = instance.duration[problem, kind["travel"], kind["begins_at"]].sum(axis=2)
    end = instance.duration[problem, kind["travel"], :, kind["ends_at"]].sum(axis=2)
    over = np.maximum(*(
        np.where(kind[usual] < UNLIMITED, unbounded(kind[longest]) - kind[usual], 0)
        for usual, longest in (("usual_end", "shift_latest"),
                               ("usual_working", "max_working_duration"))))
    per_load = rate["load"] * kind["capacity"][..., 0] * driven / MM_PER_KM
    has_drones = kind["drones"] > 0
    handling = kind["relaunch_duration"] + kind["recovery_duration"]
    return [
        squash(begin / customers / time), squash(end / customers / time),
        np.where(over > 0, squash(rate["overtime"] * time / MS_PER_HOUR / cost), 0),
        squash(over / time), squash(rate["stop"] / cost), squash(per_load / cost),
        squash(unbounded(kind["max_stops"]) / 8),
        np.where(has_drones, squash(unbounded(kind["max_sorties"]) / 2), 0),
        kind["pickup_order"] != ANY, squash(np.maximum(instance.reload.sum(axis=2) - 1, 0)),
        np.where(has_drones, squash(handling / time), 0),
        np.where(has_drones, squash(kind["charge"] / np.maximum(kind["cruise"][..., 0], 1)), 0),
    ]


def _longest_flights(kind: Records) -> IntArray:
    """Return how long drones of types fly at most, with nothing aboard if energy limits them."""
    power = np.maximum(kind["cruise"][..., 0], 1)
    limited = (kind["points"] > 0) & (kind["cruise"][..., 0] > 0)
    longest: IntArray = np.where(limited, kind["battery"] // power, UNLIMITED)
    return np.minimum(kind["endurance"], longest)
