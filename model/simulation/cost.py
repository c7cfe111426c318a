"""What a vehicle's log costs, compiled."""

from model.kernel.compiled import compiled, inlined
from model.kernel.instance import Instance
from model.kernel.leg import lookup, matrix_of
from model.kernel.stop import lateness
from model.problem import MM_PER_KM, MS_PER_HOUR, FloatArray
from model.simulation.vehicle_log import (
    COUNT_SORTIES, COUNT_STOPS, SORTIE_ARRIVAL, SORTIE_LAUNCH_STOP, SORTIE_NODE,
    SORTIE_RECOVERY_END, SORTIE_RECOVERY_STOP, SORTIE_START, SORTIE_TAKEOFF, STOP_ARRIVAL,
    STOP_LEAVE, STOP_NODE, STOP_START, TRIP_START, Setting, VehicleLog, first_departure,
)

COST_FIXED, COST_DISTANCE, COST_TIME, COST_LATENESS, COST_EARLINESS, COST_UNASSIGNED = range(6)


@inlined
def add_window_cost(instance: Instance, b: int, node: int, arrival: int, start: int,
                    cost: FloatArray) -> None:
    """Add what lateness and earliness at a customer cost. In place."""
    late = lateness(instance.node[b, node], arrival)
    cost[COST_LATENESS] += late / MS_PER_HOUR * instance.late_early[b, node, 0]
    cost[COST_EARLINESS] += (start - arrival) / MS_PER_HOUR * instance.late_early[b, node, 1]


@compiled
def add_cost(instance: Instance, setting: Setting, log: VehicleLog, b: int, k: int,
             cost: FloatArray) -> None:
    """Add the cost of the vehicle in the log. In place."""
    rate = instance.rate[b, k]
    driven, flown, airborne = 0, 0, 0
    legs = matrix_of(instance.distance, b, setting.type.travel)
    flights = matrix_of(instance.distance, b, setting.type.drone_travel)
    for index in range(1, log.count[COUNT_STOPS]):
        node = log.stop[index, STOP_NODE]
        driven += lookup(legs, log.stop[index - 1, STOP_NODE], node)
        if node >= instance.size[b, 0]:
            add_window_cost(instance, b, node, log.stop[index, STOP_ARRIVAL],
                            log.stop[index, STOP_START], cost)
    for index in range(log.count[COUNT_SORTIES]):
        sortie = log.sortie[index]
        node = sortie[SORTIE_NODE]
        flown += lookup(flights, log.stop[sortie[SORTIE_LAUNCH_STOP], STOP_NODE], node)
        flown += lookup(flights, node, log.stop[sortie[SORTIE_RECOVERY_STOP], STOP_NODE])
        airborne += sortie[SORTIE_RECOVERY_END] - sortie[SORTIE_TAKEOFF]
        add_window_cost(instance, b, node, sortie[SORTIE_ARRIVAL], sortie[SORTIE_START], cost)
    end = log.stop[log.count[COUNT_STOPS] - 1, STOP_LEAVE]
    working = end - first_departure(setting, log, log.trip[0, TRIP_START])
    cost[COST_FIXED] += rate.fixed
    cost[COST_DISTANCE] += driven / MM_PER_KM * rate.distance
    cost[COST_DISTANCE] += flown / MM_PER_KM * rate.drone_distance
    cost[COST_TIME] += working / MS_PER_HOUR * rate.time
    cost[COST_TIME] += airborne / MS_PER_HOUR * rate.drone_time
