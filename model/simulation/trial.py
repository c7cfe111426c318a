"""Actions done on a scratch row, and the return home, to tell whether they are legal. Compiled."""

from model.kernel.compiled import compiled, inlined
from model.kernel.copying import copy_records
from model.kernel.instance import Instance
from model.kernel.leg import lookup, matrix_of
from model.kernel.load import go_together, some_apart
from model.kernel.records import Record, record
from model.simulation.transition import State, drive, launch
from model.simulation.vehicle_log import (
    Setting, VehicleLog, first_departure, log_of, setting_of, start_within_work,
)

OUTLOOK = record("arrival", "start", "end")
"""What an action on a customer leads to: the arrival, the start of service, and the end of the trip
if the vehicle went home afterwards."""


@inlined
def _copy_vehicle(state: State, r: int, to: int) -> None:
    """Copy the open vehicle of one row to another. In place."""
    logs = state.log
    count = logs.count[r]
    state.vehicle[to], logs.count[to] = state.vehicle[r], count
    copy_records(state.drone[r], state.drone[to], state.drone.shape[1])
    copy_records(logs.trip[r], logs.trip[to], count.trips)
    copy_records(logs.stop[r], logs.stop[to], count.stops)
    copy_records(logs.op[r], logs.op[to], count.ops)
    copy_records(logs.sortie[r], logs.sortie[to], count.sorties)


@inlined
def _works_within(setting: Setting, num_depots: int, log: VehicleLog, vehicle: Record) -> bool:
    """Tell whether a vehicle come home could have left so late as to keep its working duration.

    Cheaper than `improve_departure`.
    """
    start = start_within_work(setting, num_depots, log, vehicle.start_best)
    return vehicle.free - first_departure(
        setting, log, start) <= setting.type.max_working_duration


@compiled
def legal_by_trial(instance: Instance, state: State, r: int, scratch: int, reload: int,
                   by_drone: bool, node: int, outlook: Record) -> bool:
    """Tell whether an action on a customer is legal by doing it and the return home on scratch.

    Exact for every customer that the load, the kind and the number of trips allow. If `reload` is
    a node, and not -1, the trip ends there before.
    """
    b, k = state.problem[r], state.vehicle[r].type
    setting = setting_of(instance, b, k)
    num_depots = instance.size[b].depots
    _copy_vehicle(state, r, scratch)
    vehicle, log = state.vehicle[scratch], log_of(state.log, scratch)
    drones = state.drone[scratch, : setting.type.drones]
    if reload >= 0 and not drive(setting, num_depots, log, vehicle, drones, reload):
        return False
    if by_drone:
        if not launch(setting, num_depots, log, vehicle, drones, node):
            return False
    elif not drive(setting, num_depots, log, vehicle, drones, node):
        return False
    here = log.count.stops - 1
    if not drive(setting, num_depots, log, vehicle, drones, setting.type.ends_at):
        return False
    arrival, start = log.stop[here].arrival, log.stop[here].start
    if by_drone:
        sortie = log.sortie[log.count.sorties - 1]
        arrival, start = sortie.arrival, sortie.start
    end = vehicle.free
    outlook.arrival, outlook.start, outlook.end = arrival, start, end
    return (end <= setting.type.shift_latest
            and _works_within(setting, num_depots, log, vehicle))


@compiled
def may_reload(instance: Instance, state: State, r: int, scratch: int, place: int,
                outlook: Record) -> bool:
    """Tell whether the trip may end at a place that is not where the route may: if another follows.

    Somebody can be served from there before the vehicle goes where its route ends.
    """
    b, k = state.problem[r], state.vehicle[r].type
    kind = instance.type[b, k]
    legs = matrix_of(instance.distance, b, kind.travel)
    home, reach = kind.ends_at, kind.max_trip_distance
    driven = state.vehicle[r].distance + lookup(legs, state.vehicle[r].node, place)
    if driven > reach:
        return False
    size, goods = instance.size[b], instance.goods[b]
    for node in range(size.depots, size.depots + size.customers):
        if state.served[r, node] or (some_apart(goods) and not go_together(
                goods[node], 0, state.vehicle[r].barred_on_vehicle)):
            continue
        if (instance.can_drive[b, k, node]
                and lookup(legs, place, node) + lookup(legs, node, home) <= reach
                and legal_by_trial(instance, state, r, scratch, place, False, node, outlook)):
            return True
        if (instance.can_fly[b, k, node] and lookup(legs, place, home) <= reach
                and legal_by_trial(instance, state, r, scratch, place, True, node, outlook)):
            return True
    return False
