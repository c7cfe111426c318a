"""From the actions of a rollout to the plan they make."""

from collections.abc import Sequence

import numpy as np

from model.kernel.instance import Instance
from model.problem import IntArray, Problem
from model.simulation.meeting import NO_VEHICLE, V_INDEX, V_TYPE
from model.simulation.simulator import apply_route, reset
from model.simulation.transition import State, close_vehicle
from model.simulation.vehicle_log import (
    COUNT_SORTIES, COUNT_STOPS, COUNT_TRIPS, SORTIE_ARRIVAL, SORTIE_DRONE, SORTIE_LAUNCH_STOP,
    SORTIE_NODE, SORTIE_READY, SORTIE_RECOVERY_END, SORTIE_RECOVERY_START, SORTIE_RECOVERY_STOP,
    SORTIE_START, SORTIE_TAKEOFF, TRIP_FIRST_STOP, VehicleLog, log_of,
)
from model.solution import Route, Solution, Sortie, Stop, Trip, Visit


def extract(problem: Problem, instance: Instance, actions: Sequence[int] | IntArray) -> Solution:
    """Return the plan that a rollout's legal actions make.

    Parameters
    ----------
    problem
        The problem planned.
    instance
        The same, packed alone.
    actions
        Codes of all actions, from the first on.
    """
    state = reset(instance, np.zeros(1, np.int64))
    codes = np.array(actions, dtype=np.int64)
    routes = []
    done = 0
    while done < len(codes):
        done = apply_route(instance, state, 0, codes, done)
        routes += _close(instance, state)
    nodes = range(problem.num_depots, problem.num_nodes)
    unassigned = tuple(node for node in nodes if not state.served[0, node])
    return Solution(tuple(routes), unassigned)


def _close(instance: Instance, state: State) -> list[Route]:
    """Close the open vehicle and return its route, if it has one."""
    vehicle = state.vehicle[0]
    if vehicle[V_TYPE] == NO_VEHICLE or state.log.count[0, COUNT_TRIPS] == 0:
        return []
    close_vehicle(instance, state, 0)
    trips = _trips(log_of(state.log, 0))
    return [Route(int(vehicle[V_TYPE]), int(vehicle[V_INDEX]), trips)]


def _trips(log: VehicleLog) -> tuple[Trip, ...]:
    count = log.count.tolist()
    firsts = log.trip[: count[COUNT_TRIPS], TRIP_FIRST_STOP].tolist()
    stops = [Stop(*columns) for columns in log.stop[: count[COUNT_STOPS]].tolist()]
    sorties = log.sortie[: count[COUNT_SORTIES]].tolist()
    trips = []
    for first, behind in zip(firsts, [*firsts[1:], count[COUNT_STOPS]], strict=True):
        flown = tuple(_sortie(columns, first) for columns in sorties
                      if first <= columns[SORTIE_LAUNCH_STOP] < behind)
        trips.append(Trip(tuple(stops[first:behind]), flown))
    return tuple(trips)


def _sortie(columns: list[int], first_stop: int) -> Sortie:
    visit = Visit(columns[SORTIE_NODE], columns[SORTIE_ARRIVAL], columns[SORTIE_START],
                  columns[SORTIE_READY])
    return Sortie(
        drone=columns[SORTIE_DRONE],
        launch_stop=columns[SORTIE_LAUNCH_STOP] - first_stop,
        recovery_stop=columns[SORTIE_RECOVERY_STOP] - first_stop,
        visits=(visit,),
        launch_time=columns[SORTIE_TAKEOFF],
        recovery_start=columns[SORTIE_RECOVERY_START],
        recovery_time=columns[SORTIE_RECOVERY_END],
    )
