"""Trucks that stop again, for their drones alone, where somebody has been served, or at depots."""

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from model.problem.customer import Depot
from model.problem.problem import Problem


def with_revisits(problem: Problem, kinds: Collection[int]) -> Problem:
    """Return a problem in which vehicles of some types may come back to places for their drones.

    Each such place is a launch site more, named as the customer or depot there: one that may be
    stopped at once the same vehicle, or a drone of its, has served that customer. No vehicle of
    another type stops there.
    """
    nodes = [node for node in range(problem.num_nodes)
             if problem.may_launch_at(node) and not (
                 node < problem.num_depots and problem.depots[node].kind != "depot")]
    if not kinds or not nodes:
        return problem
    sites = [_site(problem, node) for node in nodes]
    first = problem.num_depots
    source = np.array([*range(first), *nodes, *range(first, problem.num_nodes)])
    may_stop = np.zeros((len(problem.vehicle_types), first + len(sites)), np.bool_)
    may_stop[:, :first] = True if problem.may_stop is None else problem.may_stop
    may_stop[sorted(kinds), first:] = True
    return replace(
        problem, depots=(*problem.depots, *sites), may_stop=may_stop,
        travel=tuple(travel.among(source) for travel in problem.travel),
        coordinates=problem.coordinates[source])


def _site(problem: Problem, node: int) -> Depot:
    place = problem.place_at(node)
    return Depot(place.id, "launch_site", site=place.site, zones=place.zones,
                 after=place.id if node >= problem.num_depots else None)
