"""A day of drones from hubs by OR-Tools, for which each hub is a problem of pickups and deliveries.

Orders are picked up at their nearest hub once they are there, at no distance, and delivered by the
same drone; what takes time there is part of the legs. Where a parcel is taken back to the hub and
out again, it is as if it had been picked up later.
"""

import time
from importlib import import_module
from typing import Any

import numpy as np

from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import IntArray, Problem, VehicleType
from model.solution import Solution

LONG_AFTER = 36_000
"""Seconds by the wall clock."""

Routes = list[list[int]]
"""Places in their order, by vehicle: 0 the hub, then pickups, then deliveries."""


def plan_by_ortools(problem: Problem, seconds: float) -> Solution:
    """Return a plan, each hub's a share of the time by its orders; by the clock of the processor.
    """
    kinds, first = problem.vehicle_types, problem.num_depots
    away = np.stack([problem.travel[kind.travel].duration[kind.depot, first:] for kind in kinds])
    nearest, routes, served = away.argmin(axis=0), [], set[int]()
    for k, kind in enumerate(kinds):
        nodes = (np.flatnonzero(nearest == k) + first).tolist()
        share = seconds * len(nodes) / problem.num_customers
        for number, places in enumerate(_routes_of(problem, kind, nodes, share)):
            trips = _trips(places, nodes)
            served.update(node for trip in trips for node in trip)
            routes.append(schedule(problem, RouteDecision(k, number, tuple(
                [TripDecision((kind.depot, *trip, kind.depot)) for trip in trips]))))
    return Solution(tuple(routes), tuple(sorted(
        {*range(first, problem.num_nodes)} - served)))


def _trips(places: list[int], nodes: list[int]) -> list[list[int]]:
    """Return the customers of each trip, by the places that a vehicle is at."""
    trips: list[list[int]] = [[]]
    for place in places:
        if place > len(nodes):
            trips[-1].append(nodes[place - len(nodes) - 1])
        elif trips[-1]:
            trips.append([])
    return [trip for trip in trips if trip]


def _routes_of(problem: Problem, kind: VehicleType, nodes: list[int], seconds: float) -> Routes:
    """Return the routes of a hub's vehicles."""
    pywrapcp: Any = import_module("ortools.constraint_solver.pywrapcp")
    enums: Any = import_module("ortools.constraint_solver.routing_enums_pb2")
    number = len(nodes)
    manager = pywrapcp.RoutingIndexManager(2 * number + 1, kind.count, 0)
    routing = pywrapcp.RoutingModel(manager)
    _add_rules(routing, manager, problem, kind, nodes)
    parameters = pywrapcp.DefaultRoutingSearchParameters()
    parameters.first_solution_strategy = enums.FirstSolutionStrategy.PARALLEL_CHEAPEST_INSERTION
    parameters.local_search_metaheuristic = enums.LocalSearchMetaheuristic.GUIDED_LOCAL_SEARCH
    # Other work on the machine counts by this clock, which has to be stated.
    parameters.time_limit.FromSeconds(LONG_AFTER)
    end = time.process_time() + seconds
    routing.AddSearchMonitor(routing.solver().CustomLimit(lambda: time.process_time() > end))
    found = routing.SolveWithParameters(parameters)
    routes = []
    for vehicle in range(kind.count if found else 0):
        places, index = [], found.Value(routing.NextVar(routing.Start(vehicle)))
        while not routing.IsEnd(index):
            places.append(manager.IndexToNode(index))
            index = found.Value(routing.NextVar(index))
        if places:
            routes.append(places)
    return routes


def _add_rules(routing: Any, manager: Any, problem: Problem, kind: VehicleType,
               nodes: list[int]) -> None:
    """Add costs, loads, windows and pairs to a model. In place; costs are in thousandths."""
    number, hub = len(nodes), kind.depot
    where = np.array([hub, *[hub] * number, *nodes])
    legs, rows = problem.travel[kind.travel], where[:, None]
    distance = np.rint(legs.distance[rows, where] * kind.cost_per_km / 1000).astype(np.int64)
    routing.SetArcCostEvaluatorOfAllVehicles(routing.RegisterTransitMatrix(distance.tolist()))
    routing.SetFixedCostOfAllVehicles(round(kind.fixed_cost * 1000))
    customers = [problem.customer_at(node) for node in nodes]
    carried = [0, *[each.demand[0] for each in customers], *[-each.demand[0] for each in customers]]
    routing.AddDimension(routing.RegisterUnaryTransitVector(carried), 0, kind.capacity[0], True,
                         "load")
    durations = _durations(legs.duration[rows, where], kind,
                           [kind.service_at(each) for each in customers])
    horizon = max(customer.latest for customer in customers) + 10**7
    routing.AddDimension(routing.RegisterTransitMatrix(durations.tolist()), horizon, horizon,
                         False, "time")
    times = routing.GetDimensionOrDie("time")
    for index, customer in enumerate(customers):
        pickup, delivery = (manager.NodeToIndex(1 + index + side) for side in (0, number))
        times.CumulVar(pickup).SetRange(customer.release_time, horizon)
        times.CumulVar(delivery).SetRange(customer.earliest, customer.latest)
        routing.AddPickupAndDelivery(pickup, delivery)
        routing.solver().Add(routing.VehicleVar(pickup) == routing.VehicleVar(delivery))
        routing.solver().Add(times.CumulVar(pickup) <= times.CumulVar(delivery))


def _durations(legs: IntArray, kind: VehicleType, services: list[int]) -> IntArray:
    """Return how long each leg takes, with the service before it and what is done at the hub."""
    number = len(services)
    durations: IntArray = legs.copy()
    durations[number + 1:] += np.array(services)[:, None]
    durations[:number + 1, number + 1:] += kind.launch_duration
    durations[number + 1:, :number + 1] += kind.recovery_duration
    durations[number + 1:, 1:number + 1] += kind.reload_duration
    return durations
