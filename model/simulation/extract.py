"""From the actions of a rollout to the plan they make."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from model.engine.breaks import PLACES, BrokenRoute
from model.engine.instance import Instance
from model.engine.library import packed
from model.engine.packing import Packed
from model.engine.records import read_rows
from model.problem import IntArray, Problem
from model.simulation.actions import apply_route, close_vehicle, reset
from model.simulation.state import NO_VEHICLE, State, VehicleLogs
from model.solution import (
    Route, Solution, Sortie, Stop, TakenBreak, Trip, Visit, with_handling,
)


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
    given = packed(instance), packed(state)
    codes = np.array(actions, dtype=np.int64)
    routes = []
    done = 0
    while done < len(codes):
        done = apply_route(*given, 0, codes, done)
        routes += _close(problem, instance, state, given)
    return Solution(tuple(routes), problem.left_out(np.flatnonzero(state.served[0]).tolist()))


def _close(problem: Problem, instance: Instance, state: State,
           given: tuple[Packed, Packed]) -> list[Route]:
    """Close the open vehicle and return its route, if it has one.

    `given` is what the engine takes: the problem, and the state.
    """
    vehicle, = read_rows(state.vehicle[:1])
    if vehicle.type == NO_VEHICLE or state.log.count["trips"][0] == 0:
        return []
    close_vehicle(*given, 0)
    return [Route(vehicle.type, vehicle.index, _trips(problem, instance, vehicle.type, state.log))]


def _trips(problem: Problem, instance: Instance, index: int,
           logs: VehicleLogs) -> tuple[Trip, ...]:
    kind, (count,) = problem.vehicle_types[index], read_rows(logs.count[:1])
    firsts = logs.trip["first_stop"][0, : count.trips].tolist()
    stops: list[Stop] = []
    for node, ready, start, leave, _ in logs.stop[0, : count.stops].tolist():
        setup = problem.setup_between(stops[-1].node, node) if stops else 0
        stops.append(Stop(node, ready - setup, start, leave, setup))
    sorties = read_rows(logs.sortie[0, : count.sorties])
    begin = int(logs.trip[0, 0]["start"])
    broken = BrokenRoute(instance.type[0], (instance.profile_time[0], instance.profile_factor[0]),
                         index, begin) if kind.breaks or kind.driving else None
    trips = []
    for first, behind in zip(firsts, [*firsts[1:], count.stops], strict=True):
        flown = tuple(_sortie(problem, row, stops[row.launch_stop].node, first) for row in sorties
                      if first <= row.launch_stop < behind)
        breaks: tuple[TakenBreak, ...] = ()
        if broken is not None:
            rests = logs.stop[0, first:behind]["rests"].tolist()
            breaks = _breaks(instance, index, stops[first:behind], rests, broken)
        trips.append(Trip(with_handling(stops[first:behind], kind.launch_duration,
                                        kind.recovery_duration), flown, breaks))
    return tuple(trips)


def _breaks(instance: Instance, k: int, stops: Sequence[Stop], rests: Sequence[int],
            broken: BrokenRoute) -> tuple[TakenBreak, ...]:
    """Return the breaks of a trip, packed as `rests` behind each of its stops."""
    kind, first, taken = instance.type[0, k], int(instance.size[0].depots), list[TakenBreak]()
    legs, served = instance.duration[0, kind.travel], instance.node[0, kind.variant, :, 0]
    for place, (here, there) in enumerate(pairwise(stops)):
        duration = legs.item(here.node, there.node)
        if kind.speed_changes < 0:
            duration -= there.setup
        taken += [TakenBreak(number, place, PLACES[where], arrival, start, end)
                  for number, where, arrival, start, end in broken.drive(
                      rests[place], here.departure, duration,
                      int(served[here.node].service_duration) if here.node >= first else 0)]
    return tuple(taken)


def _sortie(problem: Problem, row: Any, launch_node: int, first_stop: int) -> Sortie:
    setup = problem.setup_between(launch_node, row.node)
    visit = Visit(row.node, row.arrival - setup, row.start, row.ready, setup)
    return Sortie(
        drone=row.drone,
        launch_stop=row.launch_stop - first_stop,
        recovery_stop=row.recovery_stop - first_stop,
        visits=(visit,),
        launch_time=row.takeoff,
        recovery_start=row.recovery_start,
        recovery_time=row.recovery_end,
    )
