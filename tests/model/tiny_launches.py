"""Where drones of tiny problems may take off."""

from dataclasses import replace

import numpy as np

from model.problem import UNLIMITED, Customer, Depot, Problem
from model.problem.revisits import with_revisits
from tests.model.tiny import MINUTE, draw_tiny


def draw_for_drones(rng: np.random.Generator) -> Problem:
    """Draw a problem of five customers, most of whom drones alone serve, with few limits."""
    while True:
        problem = draw_tiny(rng, drone_share=1.0)
        if problem.num_customers == 5:
            break

    def light(customer: Customer) -> Customer:
        return replace(customer, skills=frozenset(),
                       served_by="drone" if rng.random() < 0.6 else customer.served_by,
                       demand=tuple(min(amount, 1) for amount in customer.demand))

    return replace(problem, customers=tuple(map(light, problem.customers)), vehicle_types=tuple(
        replace(kind, max_trip_distance=None, latest=UNLIMITED, max_working_duration=None)
        for kind in problem.vehicle_types))


def with_few_launch_places(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which drones may take off, and be recovered, at some places alone."""
    return replace(
        problem, depots=tuple(replace(depot, launch=bool(rng.random() < 0.6))
                              for depot in problem.depots),
        customers=tuple(replace(customer, launch=bool(rng.random() < 0.6))
                        for customer in problem.customers))


def with_launch_sites(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem some of whose places are launch sites, with windows and costs of their own.

    Those of the last customers, of whom one is left at least. Not all vehicles stop at all.
    """
    number = min(int(rng.integers(1, 3)), problem.num_customers - 1)
    first, end = problem.num_depots, problem.num_nodes
    gone = range(end - number, end)

    def site(index: int) -> Depot:
        earliest = int(rng.integers(0, 20)) * MINUTE if rng.random() < 0.3 else 0
        width = int(rng.integers(0, 30)) * MINUTE
        return Depot(f"site {index}", "launch_site", earliest=earliest,
                     latest=earliest + width if rng.random() < 0.4 else UNLIMITED,
                     stop_cost=float(rng.integers(0, 3)))

    nodes = np.array([*range(first), *gone, *range(first, end - number)])
    may_stop = rng.random((len(problem.vehicle_types), first + number)) < 0.8
    table = problem.may_serve
    return replace(
        problem, depots=(*problem.depots, *map(site, range(number))),
        customers=problem.customers[:-number], coordinates=problem.coordinates[nodes],
        travel=tuple(travel.among(nodes) for travel in problem.travel), may_stop=may_stop,
        may_serve=None if table is None else table[:, :-number])


def with_some_revisits(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which vehicles of some types may come back to places for their drones."""
    kinds = [kind for kind in range(len(problem.vehicle_types)) if rng.random() < 0.7]
    return with_revisits(problem, kinds)
