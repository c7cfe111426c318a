"""What a vehicle's log costs, compiled."""

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.kernel.drone_types import first_drone_row, next_drone_row
from model.kernel.instance import Instance
from model.kernel.leg import lookup, matrix_of
from model.kernel.load import delivered_of, picked_of
from model.kernel.records import Record, Records, record
from model.kernel.shift import overtime
from model.kernel.stop import lateness
from model.problem import MM_PER_KM, MS_PER_HOUR, FloatArray
from model.simulation.vehicle_log import Setting, VehicleLog, first_departure
from model.solution import COST_TERMS

COST = record(**dict.fromkeys(COST_TERMS, float))
"""What vehicles cost, by term."""


@inlined
def add_window_cost(instance: Instance, b: int, node: int, arrival: int, start: int,
                    cost: Record) -> None:
    """Add what lateness and earliness at a customer cost. In place."""
    late = lateness(instance.node[b, 0, node], arrival)
    cost.lateness += late / MS_PER_HOUR * instance.price[b, node].lateness
    cost.earliness += (start - arrival) / MS_PER_HOUR * instance.price[b, node].waiting


@inlined
def load_distance(instance: Instance, setting: Setting, log: VehicleLog, b: int,
                  trip: int) -> float:
    """Return the load in the first dimension times the way it is driven, on one trip."""
    first, behind = log.trip[trip].first_stop, log.count.stops
    if trip + 1 < log.count.trips:
        behind = log.trip[trip + 1].first_stop
    legs = matrix_of(instance.distance, b, setting.type.travel)
    carried = 0.0
    for index in range(first, behind - 1):
        load = setting.type.carried
        for other in range(first + 1, behind - 1):
            load += aboard_at(setting, log.stop[other].node, other, other, index)
        for number in range(log.count.sorties):
            sortie = log.sortie[number]
            if first <= sortie.launch_stop < behind:
                load += aboard_at(setting, sortie.node, sortie.launch_stop, sortie.recovery_stop,
                                  index)
        leg = lookup(legs, log.stop[index].node, log.stop[index + 1].node)
        carried += float(load) * float(leg)
    return carried


@inlined
def aboard_at(setting: Setting, node: int, left: int, came: int, stop: int) -> int:
    """Return what of a customer's is on the truck when it leaves a stop, in the first dimension.

    The parcel leaves it at stop `left`, what is picked up comes aboard at stop `came`.
    """
    aboard = 0
    if left > stop:
        aboard += delivered_of(setting.amount, node, 0)[0]
    if came <= stop:
        aboard += picked_of(setting.amount, node, 0)[0]
    return aboard


@inlined
def add_flights(instance: Instance, log: VehicleLog, b: int, row: int, cost: Record) -> None:
    """Add the cost of the flights by drones whose TYPE is at a row. In place."""
    flown, airborne, rate = 0, 0, instance.rate[b, row]
    flights = matrix_of(instance.distance, b, instance.type[b, row].drone_travel)
    for index in range(log.count.sorties):
        sortie = log.sortie[index]
        if sortie.row != row:
            continue
        node = sortie.node
        flown += lookup(flights, log.stop[sortie.launch_stop].node, node)
        flown += lookup(flights, node, log.stop[sortie.recovery_stop].node)
        airborne += sortie.recovery_end - sortie.takeoff
        add_window_cost(instance, b, node, sortie.arrival, sortie.start, cost)
    cost.distance += flown / MM_PER_KM * rate.drone_distance
    cost.time += airborne / MS_PER_HOUR * rate.drone_time


@compiled
def add_cost(instance: Instance, setting: Setting, log: VehicleLog, b: int, k: int,
             cost: Record) -> None:
    """Add the cost of the vehicle in the log. In place."""
    rate = instance.rate[b, k]
    driven = 0
    legs = matrix_of(instance.distance, b, setting.type.travel)
    for index in range(1, log.count.stops):
        node = log.stop[index].node
        driven += lookup(legs, log.stop[index - 1].node, node)
        if node >= instance.size[b].depots:
            add_window_cost(instance, b, node, log.stop[index].arrival,
                            log.stop[index].start, cost)
    end = log.stop[log.count.stops - 1].leave
    working = end - first_departure(setting, log, log.trip[0].start)
    cost.fixed += rate.fixed
    cost.distance += driven / MM_PER_KM * rate.distance
    if rate.load > 0.0:
        carried = 0.0
        for trip in range(log.count.trips):
            carried += load_distance(instance, setting, log, b, trip)
        cost.distance += carried / MM_PER_KM * rate.load
    served = log.count.stops - 2 * log.count.trips
    cost.stops += served * rate.stop
    cost.time += working / MS_PER_HOUR * rate.time
    cost.overtime += overtime(setting.type, end, working) / MS_PER_HOUR * rate.overtime
    row = first_drone_row(setting.types, k)
    while row >= 0:
        add_flights(instance, log, b, row, cost)
        row = next_drone_row(setting.types, row)


def by_term(cost: Records) -> FloatArray:
    """Return costs as a table of numbers, (row, term)."""
    return cost.view(np.float64).reshape(len(cost), -1)
