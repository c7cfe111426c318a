"""What a policy sees at each step: its candidates and the state of the open vehicle.

Like the tokens, all numbers are free of units. Training and decoding share this file.
"""

from model.kernel.compiled import compiled, inlined
from model.kernel.flight import longest_flight
from model.kernel.instance import TIER, Instance
from model.kernel.leg import lookup, matrix_of
from model.kernel.load import (
    capacity_in, delivered_of, demand_of, excess_aboard, num_tiers, picked_of, release_of,
    some_limited,
)
from model.kernel.records import Record, Records
from model.kernel.shift import most_stops, usual_end, usual_working
from model.kernel.stop import closing, lateness
from model.policy.lookahead import Unit, describe_neighbours, ratio, slack
from model.policy.observation import Observation
from model.policy.tokens import NUM_TYPE_FEATURES, Float32Array, Scales
from model.problem import MM_PER_KM, MS_PER_HOUR, UNLIMITED, IntArray
from model.simulation.aboard import part_of
from model.simulation.meeting import NO_VEHICLE
from model.simulation.simulator import (
    DRIVE, LAUNCH, NUM_KINDS, OPEN, RETURN, apply, finish, legal_actions,
)
from model.simulation.transition import State
from model.simulation.vehicle_log import Setting, VehicleLog, log_of, setting_of


@inlined
def _share(used: int, limit: int) -> float:
    """Return how much of a limit is used, 2 at most; 0 where there is no limit."""
    return 0.0 if limit >= UNLIMITED else min(used / max(1, limit), 2.0)


@inlined
def _describe_amounts(setting: Setting, vehicle: Record, node: int, tier: int,
                      feature: Record) -> None:
    """Describe which share of the room a customer takes, both ways. In place."""
    delivered, picked = (delivered_of(setting.amount, node, tier),
                         picked_of(setting.amount, node, tier))
    room = capacity_in(setting.type, tier)
    left, aboard = part_of(vehicle.load, tier), part_of(vehicle.aboard, tier)
    for dimension in range(TIER):
        most = max(1, room[dimension])
        feature.load_share = max(
            feature.load_share, delivered[dimension] / max(1, left[dimension]),
            picked[dimension] / max(1, room[dimension] - aboard[dimension]))
        feature.capacity_share = max(feature.capacity_share, delivered[dimension] / most,
                                     picked[dimension] / most)


@inlined
def _room(kind: Record, vehicle: Record) -> int:
    """Return what the vehicle could still carry in the first dimension, from here on."""
    return min(vehicle.load[0], kind.capacity[0] - vehicle.aboard[0])


@inlined
def _stops_left(kind: Record, log: VehicleLog, idle: bool) -> int:
    """Return how many customers the truck may still serve on its trip.

    Without drones, that is, which may serve others whatever it has served.
    """
    most = UNLIMITED if kind.drones > 0 else most_stops(kind)
    if most >= UNLIMITED or idle:
        return most
    return most - (log.count.stops - log.trip[log.count.trips - 1].first_stop - 1)


@inlined
def _share_of_stops(kind: Record, log: VehicleLog, idle: bool) -> float:
    """Return how many of the customers that a trip may have are left, 1 if any number may be."""
    stops = _stops_left(kind, log, idle)
    return 1.0 if stops >= UNLIMITED else stops / max(1, most_stops(kind))


@inlined
def _describe_customer(setting: Setting, unit: Unit, prices: Records, vehicle: Record,
                       begun: bool, since: int, node: int, outlook: Record,
                       feature: Record) -> None:
    """Describe what serving a customer next means, by truck or drone alike. In place.

    `since` is when the trip begins.
    """
    place = setting.node[node]
    arrival, end = outlook.arrival, outlook.end
    waiting = outlook.start - arrival
    late = lateness(place, arrival)
    feature.waiting = ratio(waiting, unit.time)
    feature.window_slack = slack(closing(place), arrival, unit.time)
    if some_limited(setting.fresh_for):
        excess = excess_aboard(setting.fresh_for, node, since, outlook.start)
        feature.window_slack = min(feature.window_slack, slack(0, excess, unit.time))
    window_cost = late * prices[node].lateness + waiting * prices[node].waiting
    feature.lateness = ratio(window_cost / MS_PER_HOUR, unit.cost)
    for dimension in range(TIER):
        demand = place[0].demand[dimension]
        if demand > 0:
            capacity = setting.type.capacity[dimension]
            feature.load_share = max(feature.load_share, demand / vehicle.load[dimension])
            feature.capacity_share = max(feature.capacity_share, demand / capacity)
    for tier in range(num_tiers(setting.amount)):
        _describe_amounts(setting, vehicle, node, tier, feature)
    feature.shift_slack = slack(usual_end(setting.type), end, unit.time)
    departure = vehicle.departure_best if begun else vehicle.next_start
    feature.working_slack = slack(usual_working(setting.type), end - departure, unit.time)
    feature.release_delay = ratio(release_of(place) - vehicle.next_start, unit.time)


@inlined
def _describe_leg(unit: Unit, duration: int, distance: int, km: float, hour: float,
                  feature: Record) -> None:
    """Describe the way to a place. In place."""
    feature.duration = min(duration / unit.time, 5.0)
    feature.nearness = ratio(duration, unit.near)
    cost = distance / MM_PER_KM * km + duration / MS_PER_HOUR * hour
    feature.cost = min(cost / unit.cost, 5.0)


@inlined
def _describe_drive(setting: Setting, unit: Unit, vehicle: Record, log: VehicleLog,
                    distance: IntArray, node: int, nearest: int, feature: Record) -> None:
    """Describe what a drive to a customer leaves of the trip, and its detour. In place."""
    here, home = vehicle.node, setting.type.ends_at
    way, way_home = lookup(setting.drive, here, node), lookup(setting.drive, node, home)
    used = vehicle.distance + lookup(distance, here, node) + lookup(distance, node, home)
    feature.distance_slack = slack(setting.type.max_trip_distance, used,
                                   lookup(distance, home, node))
    detour = (way + way_home - lookup(setting.drive, here, home)) / unit.time
    feature.detour = max(min(detour, 5.0), -5.0)
    feature.excess = ratio(way - nearest, unit.near)
    stops = _stops_left(setting.type, log, vehicle.idle)
    if stops < UNLIMITED:
        feature.load_share = 1.0 / max(1, stops)
        feature.capacity_share = 1.0 / max(1, most_stops(setting.type))


@inlined
def _describe_flight(setting: Setting, unit: Unit, here: int, node: int, distance: int,
                     rate: Record, feature: Record) -> None:
    """Describe the flight to a customer, as if the drone came back here. In place."""
    there = lookup(setting.fly, here, node)
    back = min(lookup(setting.fly_home, node, here), 10 * there)
    _describe_leg(unit, there, 2 * distance, rate.drone_distance, 2 * rate.drone_time,
                  feature)
    feature.endurance_share = _share(there + back, longest_flight(setting.type))


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
                     feature: Record) -> None:
    """Describe returning to the depot. In place."""
    feature.load_share = _room(setting.type, vehicle) / max(1, setting.type.capacity[0])
    feature.capacity_share = min(setting.type.max_trips - trips, 4) / 4


@inlined
def _describe_open(kind: Record, fixed: float, used: int, unserved: float, unit: Unit,
                   feature: Record) -> None:
    """Describe opening a vehicle of a type. In place."""
    left = kind.count - used
    feature.cost = ratio(fixed, unit.cost)
    feature.load_share = left / (left + 4.0)
    feature.capacity_share = min(kind.capacity[0] / max(1.0, unserved), 2.0)
    feature.distance_slack = kind.drones > 0


@inlined
def _unserved_demand(instance: Instance, state: State, r: int) -> float:
    """Return the demand left in the first dimension: what is delivered or, if more, picked up."""
    b = state.problem[r]
    nodes, served = instance.node[b, 0], state.served[r]
    amounts = instance.amount[b]
    total = picked = 0.0
    size = instance.size[b]
    for node in range(size.depots, size.depots + size.customers):
        if not served[node]:
            total += demand_of(nodes[node])[0]
            if num_tiers(amounts) > 0:
                picked += picked_of(amounts, node, 0)[0]
    return max(total, picked)


@inlined
def _describe_state(instance: Instance, scale: Scales, state: State, type_token: Float32Array,
                    r: int, unserved: float, seen: Record) -> None:
    """Describe the open vehicle and what is left to do. In place."""
    b = state.problem[r]
    vehicle = state.vehicle[r]
    k = vehicle.type
    reserve = 0.0
    for other in range(instance.size[b].types):
        left = instance.type[b, other].count - state.used[r, other]
        reserve += (left * float(instance.type[b, other].max_trips)
                    * instance.type[b, other].capacity[0])
    seen.unserved = state.num_unserved[r] / max(1, instance.size[b].customers)
    seen.unserved_demand = unserved / scale.amount[b]
    if k == NO_VEHICLE:
        seen.demand_by_reserve = min(unserved / max(1.0, reserve), 2.0)
        return
    kind = instance.type[b, k]
    capacity = max(1, kind.capacity[0])
    trips_left = kind.max_trips - state.log.count[r].trips
    reserve += float(trips_left) * capacity
    clock = vehicle.next_start
    if not vehicle.idle:
        clock = max(vehicle.service_end, vehicle.free)
        home = lookup(matrix_of(instance.duration, b, kind.travel), vehicle.node,
                      kind.ends_at)
        seen.way_home = min(home / scale.time[b], 5.0)
        reserve += _room(kind, vehicle)
    seen.demand_by_reserve = min(unserved / max(1.0, reserve), 2.0)
    seen.idle = vehicle.idle
    seen.clock = min(clock / scale.horizon[b], 2.0)
    seen.load_left = min(_room(kind, vehicle) / capacity,
                         _share_of_stops(kind, log_of(state.log, r), vehicle.idle))
    seen.spare_reserve = max(min((reserve - unserved) / capacity, 2.0), -2.0)
    seen.trips_left = min(trips_left, 4) / 4
    seen.shift_slack = slack(usual_end(kind), clock, scale.time[b])
    working = clock - vehicle.departure_best if state.log.count[r].trips else 0
    seen.working_slack = slack(usual_working(kind), working, scale.time[b])
    seen.flying = vehicle.flying / max(1, kind.drones)
    seen.drone_aboard = kind.drones > vehicle.flying
    seen.load_by_demand = min(_room(kind, vehicle) / max(1.0, unserved), 2.0)
    for column in range(NUM_TYPE_FEATURES):
        seen.type[column] = type_token[b, k, column]


@inlined
def _describe_opens(instance: Instance, scale: Scales, state: State, r: int, unserved: float,
                    seen: Observation) -> None:
    """Describe the vehicles that may be opened. In place."""
    b = state.problem[r]
    unit = Unit(scale.time[b], scale.near[b], scale.cost[b])
    for index in range(seen.count[r]):
        kind, target = seen.action[r, index] % NUM_KINDS, seen.action[r, index] // NUM_KINDS
        if kind == OPEN:
            feature = seen.described[r, index]
            seen.feature[r, index] = 0.0
            feature.kind[OPEN] = 1.0
            seen.token[r, index] = instance.node.shape[2] + target
            _describe_open(instance.type[b, target], instance.rate[b, target].fixed,
                           state.used[r, target], unserved, unit, feature)


@compiled
def _describe_moves(instance: Instance, scale: Scales, state: State, r: int,
                    seen: Observation) -> None:
    """Describe the drives, the launches and the return of the open vehicle. In place."""
    b, k = state.problem[r], state.vehicle[r].type
    setting = setting_of(instance, b, k)
    vehicle = state.vehicle[r]
    rate, prices = instance.rate[b, k], instance.price[b]
    unit = Unit(scale.time[b], scale.near[b], scale.cost[b])
    here = vehicle.node
    distance = matrix_of(instance.distance, b, setting.type.travel)
    flown = matrix_of(instance.distance, b, setting.type.drone_travel)
    log = log_of(state.log, r)
    trips = log.count.trips
    since = vehicle.next_start if vehicle.idle else log.trip[trips - 1].start
    actions = seen.action[r, : seen.count[r]]
    nearest = _nearest_drive(setting.drive, here, actions)
    for index in range(len(actions)):
        kind, node = actions[index] % NUM_KINDS, actions[index] // NUM_KINDS
        if kind == OPEN:
            continue
        feature = seen.described[r, index]
        seen.feature[r, index] = 0.0
        feature.kind[kind] = 1.0
        seen.token[r, index] = node
        if kind == LAUNCH:
            _describe_flight(setting, unit, here, node, lookup(flown, here, node), rate, feature)
        else:
            _describe_leg(unit, lookup(setting.drive, here, node), lookup(distance, here, node),
                          rate.distance, rate.time, feature)
        if kind == RETURN:
            _describe_return(setting, vehicle, trips, feature)
            continue
        feature.way_home = min(lookup(setting.drive, node, setting.type.ends_at) / unit.time, 5.0)
        if kind == DRIVE:
            _describe_drive(setting, unit, vehicle, log, distance, node, nearest, feature)
        _describe_customer(setting, unit, prices, vehicle, trips > 0, since, node,
                           seen.outlook[r, index], feature)
        describe_neighbours(setting, instance.neighbour[b], state.served[r],
                            _room(setting.type, vehicle), here, node, seen.outlook[r, index], unit,
                            kind == LAUNCH, feature)


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
        seen.glob[r] = 0.0
        _describe_state(instance, scale, state, type_token, r, unserved, seen.vehicle[r])
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
