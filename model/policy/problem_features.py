"""What an encoder sees of a problem, once per plan: nodes, vehicle types, pairs of nodes.

All numbers are free of units: lengths, times and costs are divided by scales of the problem, so
one policy serves all sizes. Training and decoding share this file.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from model.engine.amount_rows import DIMENSIONS_PER_TIER
from model.engine.instance import FAR, Instance
from model.engine.library import dtype_of
from model.engine.records import Records
from model.engine.structs import Struct
from model.engine.type_rows import ANY
from model.problem import MM_PER_KM, MS_PER_HOUR, UNLIMITED, FloatArray, IntArray

Float32Array = NDArray[np.float32]

NODE = dtype_of("tandem_node_features")
"""A depot or customer: place; when it opens and closes, and by how much that differs; whether it
never closes, and whether it refuses who is late; slack if visited straight from the depot; share of
the largest capacity, of all demand, of demand and payload together; service, release; prices of
lateness and waiting; share of types whose trucks, and whose drones, may serve it; the way home by
scale and by nearness. What few ask for: the cost of leaving it out, the share that is picked up,
how much of the horizon lies between its windows, its longest time aboard, its setup, and how many
of the customers have goods that must not go with its own. Of a shipment's end, which one it is and
where the other lies from there; how many other places its customer has, whose cost of being left
out all of them show; what being served costs on top, in the mean of all types; and how many of the
customers relations keep with it."""

TYPE = dtype_of("tandem_type_features")
"""A vehicle type: capacity by the largest and by all demand, that of all vehicles, how many there
are; costs of a vehicle, of driving by length and by time; the mean way from the depot to customers;
the shift, working duration, length and number of trips, reloading; whether its speed changes; its
drones, their payload, endurance, mean flight from the depot and its cost; the shares of customers
that trucks and drones may serve. What few are given: the mean ways from where it begins and to
where it ends; what overtime costs and how much there may be; what stops and loads cost; the most
stops and sorties; whether pickups come last; other depots where it reloads; how long launch and
recovery take, and how fast batteries are charged; how long its breaks are, how soon a rest is due,
and what serving costs on top in the mean. Legs that may take so long are shown as work that may."""

PLACE, PARTNER = [(NODE.names or ()).index(name) for name in ("x", "partner_x")]
"""Columns of node features that hold a way along each axis of the plane, one behind the other."""

NUM_NODE_FEATURES = NODE.itemsize // 4
NUM_TYPE_FEATURES = TYPE.itemsize // 4
NUM_PAIR_FEATURES = 4


class Scales(Struct):
    """Units of each problem, a row per problem."""


class Tokens(NamedTuple):
    """What the encoder sees: nodes, then vehicle types, padded."""

    node: Float32Array  # (problem, node, NUM_NODE_FEATURES)
    type: Float32Array  # (problem, type, NUM_TYPE_FEATURES)
    pair: Float32Array  # (problem, node, node, NUM_PAIR_FEATURES) from row to column
    mask: NDArray[np.bool_]  # (problem, node + type) True = a token, False = padding


def scales(instance: Instance) -> Scales:
    """Measure the units of each problem."""
    rows = len(instance.size)
    result = Scales(**{name: np.ones(rows) for name in Scales._fields})
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
        result.amount[b] = max(1, np.maximum(picked[b, nodes, 0], 0).sum(), delivered[:, 0].sum())
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
    index = np.arange(instance.node.shape[2])
    is_node = index < (instance.size["depots"] + instance.size["customers"])[:, None]
    # Rows behind those of vehicle types, which are of further types of drones, are no tokens.
    is_type = np.arange(instance.size["types"].max(initial=0)) < instance.size["types"][:, None]
    node = node_features(instance, scale, coordinates, is_node)
    kind = type_features(instance, scale, is_type)
    return Tokens(
        node=np.where(is_node[..., None], _floats(node), np.float32(0)),
        type=np.where(is_type[..., None], _floats(kind), np.float32(0)),
        pair=pair_features(instance, scale),
        mask=np.concatenate([is_node, is_type], axis=1),
    )


def _floats(rows: Records) -> Float32Array:
    """Return rows of floats as an array (problem, row, number)."""
    return np.ascontiguousarray(rows).view(np.float32).reshape(*rows.shape, -1)


def own_rows(instance: Instance) -> Records:
    """Return the first rows of all nodes, (problem, node), with customers' own durations."""
    return instance.node[:, 0, :, 0]


def picked_up(instance: Instance) -> IntArray:
    """Return what is picked up, (problem, node, dimension), in the first dimensions."""
    if instance.amount.shape[2] == 0:
        return np.zeros((*instance.amount.shape[:2], DIMENSIONS_PER_TIER), np.int64)
    picked: IntArray = instance.amount[:, :, 0, DIMENSIONS_PER_TIER:2 * DIMENSIONS_PER_TIER]
    return picked


def node_features(instance: Instance, scale: Scales, coordinates: FloatArray,
                  is_node: NDArray[np.bool_]) -> Records:
    """Describe depots and customers, (problem, node) NODE."""
    time, horizon = scale.time[:, None], scale.horizon[:, None]
    hours = time / MS_PER_HOUR / scale.cost[:, None]
    low = np.where(is_node[..., None], coordinates, np.inf).min(axis=1, keepdims=True)
    high = np.where(is_node[..., None], coordinates, -np.inf).max(axis=1, keepdims=True)
    extent = np.maximum((high - low).max(axis=2, keepdims=True), 1e-9)
    place = (coordinates - (low + high) / 2) / extent * 2
    nodes = own_rows(instance)
    demand = np.maximum(nodes["demand"], picked_up(instance))
    earliest, latest = nodes["window_earliest"], nodes["window_latest"]
    home = instance.duration[:, 0, 0, :]
    seen = np.zeros(nodes.shape, NODE)
    seen["x"], seen["y"] = place[..., 0], place[..., 1]
    seen["is_depot"] = np.arange(nodes.shape[1]) < instance.size["depots"][:, None]
    seen["opening"] = np.minimum(earliest / horizon, 2)
    seen["closing"] = np.minimum(latest / horizon, 2)
    seen["width"] = np.minimum((latest - earliest) / horizon, 2)
    seen["never_closes"] = latest >= UNLIMITED
    seen["may_not_be_late"] = nodes["arrival_limit"] < FAR
    seen["slack_from_depot"] = squash(np.maximum(unbounded(latest) - home, 0) / time)
    seen["share_of_demand"] = demand[..., 0] / scale.amount[:, None]
    seen["service"] = squash(nodes["service_duration"] / time)
    seen["release"] = np.minimum(nodes["release"] / horizon, 2)
    seen["lateness_price"] = squash(instance.price["lateness"] * hours)
    seen["waiting_price"] = squash(instance.price["waiting"] * hours)
    seen["way_home"] = squash(home / time)
    seen["nearness"] = squash(home / scale.near[:, None] / 4)
    _describe_who_serves(instance, demand, seen)
    _describe_rarer_of_nodes(instance, scale, seen)
    _describe_relations(instance, scale, place, seen)
    return seen


def _describe_who_serves(instance: Instance, demand: IntArray, seen: Records) -> None:
    """Describe which share of vehicles customers take, and of the types that serve them. In place.
    """
    of = demand.shape[-1]
    capacity = np.maximum(instance.type["capacity"].max(axis=1), 1)[:, None, :of]
    payload = instance.type["payload"].max(axis=1)[:, None, :of]
    types = np.maximum(instance.size["types"], 1)[:, None]
    is_type = np.arange(instance.type.shape[1]) < instance.size["types"][:, None]
    seen["capacity_share"] = np.minimum((demand / capacity).max(axis=2), 2)
    seen["payload_share"] = (demand / np.maximum(demand + payload, 1)).max(axis=2)
    seen["can_drive"] = instance.can_drive.sum(axis=1) / types
    seen["can_fly"] = (instance.can_fly & is_type[..., None]).sum(axis=1) / types


def _describe_rarer_of_nodes(instance: Instance, scale: Scales, seen: Records) -> None:
    """Describe what few customers ask for. In place."""
    time, horizon = scale.time[:, None], scale.horizon[:, None]
    left_out = instance.unassigned_cost[:, None] + instance.unassigned_more
    if instance.pair.shape[1]:
        left_out = np.take_along_axis(left_out, instance.pair["unit"], axis=1)
    capacity = np.maximum(instance.type["capacity"].max(axis=1), 1)[:, None, :DIMENSIONS_PER_TIER]
    gap = instance.node[:, 0, :, 1:]
    between = np.where(gap["window_latest"] < FAR, gap["window_earliest"] - gap["window_latest"], 0)
    is_customer = seen["is_depot"] == 0
    seen["unassigned_cost"] = is_customer * squash(left_out / scale.cost[:, None])
    picked = np.maximum(picked_up(instance), 0)
    seen["pickup_share"] = np.minimum((picked / capacity).max(axis=2), 2)
    seen["between_windows"] = np.minimum(between.sum(axis=2) / horizon, 2)
    seen["max_time_aboard"] = (
        squash(instance.max_time_aboard / time) if instance.max_time_aboard.shape[1] else 1.0)
    if instance.setup.shape[1]:
        seen["setup"] = squash(instance.setup["setup_duration"] / time)
    if instance.goods.shape[1]:
        goods = instance.goods
        away = goods["barred_on_trip"] | goods["barred_on_vehicle"]
        apart = goods["held"][:, None, :] & away[:, :, None] != 0
        apart &= ~np.eye(apart.shape[1], dtype=np.bool_)
        seen["barred"] = apart.sum(axis=2) / np.maximum(instance.size["customers"], 1)[:, None]


def _describe_relations(instance: Instance, scale: Scales, place: FloatArray,
                      seen: Records) -> None:
    """Describe who belongs together, and what serving customers costs on top. In place.

    `place` (problem, node, 2) is where nodes lie, -1..1.
    """
    customers = np.maximum(instance.size["customers"], 1)[:, None]
    is_customer = seen["is_depot"] == 0
    pair = instance.pair
    if pair.shape[1]:
        is_end = pair["partner"] >= 0
        partner = np.where(is_end, pair["partner"], np.arange(pair.shape[1]))
        away = np.take_along_axis(place, partner[..., None], axis=1) - place
        seen["partner_x"], seen["partner_y"] = away[..., 0] / 2, away[..., 1] / 2
        seen["is_pickup"] = is_end & (pair["is_delivery"] == 0)
        seen["is_delivery"] = is_end & (pair["is_delivery"] == 1)
        alike = (pair["unit"][:, None] == pair["unit"][..., None]).sum(axis=2)
        seen["other_places"] = np.where(is_end, 0.0, squash(np.maximum(alike - 1, 0) / 1.0))
    if instance.vehicle_cost.shape[1]:
        types = np.maximum(instance.size["types"], 1)[:, None]
        price = instance.vehicle_cost.sum(axis=1) / types / scale.cost[:, None]
        seen["price"] = is_customer * squash(price)
    if instance.goods.shape[1]:
        goods = instance.goods
        kept = goods["kept_on_trip"] | goods["kept_on_vehicle"]
        together = kept[:, None, :] & kept[:, :, None] != 0
        together &= ~np.eye(together.shape[1], dtype=np.bool_)
        seen["kept"] = together.sum(axis=2) / customers


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


def type_features(instance: Instance, scale: Scales, is_type: NDArray[np.bool_]) -> Records:
    """Describe vehicle types, (problem, type) TYPE."""
    kind, rate = (rows[:, :is_type.shape[1]] for rows in (instance.type, instance.rate))
    time, horizon, cost = scale.time[:, None], scale.horizon[:, None], scale.cost[:, None]
    customers = np.maximum(instance.size["customers"], 1)[:, None]
    problem = np.arange(len(kind))[:, None]
    driven = instance.distance[problem, kind["travel"], 0].sum(axis=2) / customers
    leg = instance.duration[problem, kind["travel"], 0].sum(axis=2) / customers
    capacity = kind["capacity"][..., 0]
    seen = np.zeros(kind.shape, TYPE)
    seen["capacity"] = capacity / np.maximum(capacity.max(axis=1, keepdims=True), 1)
    seen["share_of_demand"] = np.minimum(capacity / scale.amount[:, None], 1)
    seen["fleet_share"] = squash(kind["count"] * capacity / scale.amount[:, None])
    seen["count"] = squash(kind["count"] / 4)
    seen["fixed"] = squash(rate["fixed"] / cost)
    seen["per_km"] = squash(rate["distance"] * driven / MM_PER_KM / cost)
    seen["per_hour"] = squash(rate["time"] * (time / MS_PER_HOUR) / cost)
    seen["way_home"] = squash(leg / time)
    seen["shift_earliest"] = np.minimum(kind["shift_earliest"] / horizon, 2)
    seen["usual_end"] = np.minimum(kind["usual_end"] / horizon, 2)
    longest = np.minimum(kind["usual_working"], kind["max_travel_duration"])
    seen["usual_working"] = squash(unbounded(longest) / time / 8)
    seen["max_trip_distance"] = squash(
        unbounded(kind["max_trip_distance"]) / np.maximum(driven, 1) / 8)
    seen["max_trips"] = squash((kind["max_trips"] - 1.0) / 2)
    seen["reload"] = squash(kind["reload_duration"] / time)
    seen["speed_changes"] = kind["speed_changes"] > 0
    for field, allowed in (("can_drive", instance.can_drive), ("can_fly", instance.can_fly)):
        seen[field] = allowed[:, :is_type.shape[1]].sum(axis=2) / customers
    _describe_drones(instance, scale, np.where(is_type, driven, 0).max(axis=1), seen)
    _describe_rarer_of_types(instance, scale, driven, seen)
    return seen


def _describe_drones(instance: Instance, scale: Scales, furthest: FloatArray,
                     seen: Records) -> None:
    """Describe what drones lift, how long they last, and what a flight costs. In place.

    `furthest` (problem,) is the longest of the types' mean drives from the depot.
    """
    kind, rate = (rows[:, :seen.shape[1]] for rows in (instance.type, instance.rate))
    time, cost = scale.time[:, None], scale.cost[:, None]
    customers = np.maximum(instance.size["customers"], 1)[:, None]
    flies = kind["drones"] > 0
    problem = np.arange(len(kind))[:, None]
    flight = np.minimum(instance.duration[problem, kind["drone_travel"], 0],
                        10 * time[..., None]).sum(axis=2) / customers
    flown = np.minimum(instance.distance[problem, kind["drone_travel"], 0],
                       10 * furthest[:, None, None] + 1).sum(axis=2) / customers
    capacity = np.maximum(kind["capacity"][..., 0], 1)
    handling = kind["relaunch_duration"] + kind["recovery_duration"]
    seen["drones"] = squash(kind["drones"] / 2.0)
    seen["payload"] = flies * squash(kind["payload"][..., 0] / capacity * 10)
    seen["endurance"] = flies * squash(unbounded(_longest_flights(kind)) / time)
    seen["flight_home"] = flies * squash(flight / time)
    seen["per_flight"] = flies * squash(rate["drone_distance"] * flown / MM_PER_KM / cost
                                        + rate["drone_time"] * (time / MS_PER_HOUR) / cost)
    seen["max_sorties"] = flies * squash(unbounded(kind["max_sorties"]) / 2)
    seen["handling"] = flies * squash(handling / time)
    seen["charge"] = flies * squash(kind["charge"] / np.maximum(kind["cruise"][..., 0], 1))


def _describe_rarer_of_types(instance: Instance, scale: Scales, driven: FloatArray,
                             seen: Records) -> None:
    """Describe what few vehicles are given. In place."""
    kind, rate = (rows[:, :seen.shape[1]] for rows in (instance.type, instance.rate))
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
    reload = instance.reload[:, :seen.shape[1]].sum(axis=2)
    seen["way_out"] = squash(begin / customers / time)
    seen["way_back"] = squash(end / customers / time)
    seen["overtime_price"] = np.where(
        over > 0, squash(rate["overtime"] * time / MS_PER_HOUR / cost), 0)
    seen["overtime"] = squash(over / time)
    seen["per_stop"], seen["per_load"] = squash(rate["stop"] / cost), squash(per_load / cost)
    seen["max_stops"] = squash(unbounded(kind["max_stops"]) / 8)
    seen["pickup_order"] = kind["pickup_order"] != ANY
    seen["other_depots"] = squash(np.maximum(reload - 1, 0))
    soonest = np.where(kind["must_rest"] == 1, np.minimum(kind["max_driving"], kind["max_work"]),
                       UNLIMITED)
    seen["breaks"] = squash(kind["break_duration"].sum(axis=2) / time)
    seen["driving_limit"] = 1 - squash(unbounded(soonest) / time / 8)
    if instance.vehicle_cost.shape[1]:
        price = instance.vehicle_cost[:, :seen.shape[1]].sum(axis=2) / customers
        seen["price"] = squash(price / cost)


def _longest_flights(kind: Records) -> IntArray:
    """Return how long drones of types fly at most, with nothing aboard if energy limits them."""
    power = np.maximum(kind["cruise"][..., 0], 1)
    limited = (kind["points"] > 0) & (kind["cruise"][..., 0] > 0)
    longest: IntArray = np.where(limited, kind["battery"] // power, UNLIMITED)
    return np.minimum(kind["endurance"], longest)
