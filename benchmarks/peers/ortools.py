"""OR-Tools' routing library on a published instance."""

import time
from importlib import import_module
from importlib.metadata import version
from typing import Any

import numpy as np

from benchmarks.peers.answers import PeerAnswer, PeerRoute, better, has_rare_rules, useful_counts
from benchmarks.peers.published import Published

STRATEGIES = ("PATH_CHEAPEST_ARC", "PARALLEL_CHEAPEST_INSERTION")


def solve(instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
    """Return the better of guided local search from two first plans, each given the whole limit.

    None where vehicles may reload. One thread; `seed` changes nothing: the search has none.
    """
    if has_rare_rules(instance):
        return None
    first, second = (_search(instance, seconds, strategy) for strategy in STRATEGIES)
    return better(instance, first, second)


def _search(instance: Published, seconds: float, strategy: str) -> PeerAnswer:
    pywrapcp: Any = import_module("ortools.constraint_solver.pywrapcp")
    enums: Any = import_module("ortools.constraint_solver.routing_enums_pb2")
    counts = useful_counts(instance)
    types = [kind for kind, count in enumerate(counts) for _ in range(count)]
    manager = pywrapcp.RoutingIndexManager(len(instance.demand), len(types), 0)
    routing = pywrapcp.RoutingModel(manager)
    _add_rules(routing, manager, instance, types)
    parameters = pywrapcp.DefaultRoutingSearchParameters()
    parameters.first_solution_strategy = getattr(enums.FirstSolutionStrategy, strategy)
    parameters.local_search_metaheuristic = enums.LocalSearchMetaheuristic.GUIDED_LOCAL_SEARCH
    parameters.time_limit.FromMilliseconds(round(1000 * seconds))
    began = time.perf_counter()
    assignment = routing.SolveWithParameters(parameters)
    elapsed = time.perf_counter() - began
    routes = [] if assignment is None else _read_routes(routing, manager, assignment, types)
    return PeerAnswer(routes, elapsed, version("ortools"))


def _add_rules(routing: Any, manager: Any, instance: Published, types: list[int]) -> None:
    """Add costs, capacities and windows to a model. In place."""
    legs = [routing.RegisterTransitMatrix((instance.travel * vehicle.unit_cost).tolist())
            for vehicle in instance.vehicles]
    for number, kind in enumerate(types):
        routing.SetArcCostEvaluatorOfVehicle(legs[kind], number)
        routing.SetFixedCostOfVehicle(instance.vehicles[kind].fixed_cost, number)
    demand = routing.RegisterUnaryTransitVector(instance.demand.tolist())
    capacities = [instance.vehicles[kind].capacity for kind in types]
    routing.AddDimensionWithVehicleCapacity(demand, 0, capacities, True, "load")
    if not instance.has_windows:
        return
    horizon = int(instance.latest.max())
    durations = routing.RegisterTransitMatrix(
        (instance.travel + instance.service[:, np.newaxis]).tolist())
    routing.AddDimension(durations, horizon, horizon, False, "time")
    times = routing.GetDimensionOrDie("time")
    for node in range(1, instance.num_customers + 1):
        times.CumulVar(manager.NodeToIndex(node)).SetRange(
            int(instance.earliest[node]), int(instance.latest[node]))
    for number in range(len(types)):
        for end in (routing.Start(number), routing.End(number)):
            times.CumulVar(end).SetRange(int(instance.earliest[0]), int(instance.latest[0]))


def _read_routes(routing: Any, manager: Any, assignment: Any, types: list[int]) -> list[PeerRoute]:
    routes: list[PeerRoute] = []
    for number, kind in enumerate(types):
        trip: list[int] = []
        index = assignment.Value(routing.NextVar(routing.Start(number)))
        while not routing.IsEnd(index):
            trip.append(manager.IndexToNode(index))
            index = assignment.Value(routing.NextVar(index))
        routes.append((kind, [trip]))
    return routes
