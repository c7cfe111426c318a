"""Tiny problems some of whose customers have several places, of which one is used."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import numpy as np

from model.problem import Problem
from tests.model.tiny_prices import with_vehicle_costs


def with_choices(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem some of whose customers are other places of others; to come last."""
    free = [node for node in range(problem.num_depots, problem.num_nodes)
            if node not in problem.shipment_at]
    chosen = rng.permutation(free).tolist()
    customers, choices = list(problem.customers), list[tuple[int, ...]]()
    while len(chosen) > 1 and (not choices or rng.random() < 0.5):
        size = int(rng.integers(2, min(3, len(chosen)) + 1))
        places, chosen = tuple(sorted(chosen[:size])), chosen[size:]
        choices.append(places)
        own = problem.customer_at(places[0])
        for node in places[1:]:
            customers[node - problem.num_depots] = replace(
                problem.customer_at(node), demand=own.demand, pickup=own.pickup, goods=own.goods,
                release_time=own.release_time, skills=own.skills, unassigned_cost=0.0)
    problem = replace(problem, customers=tuple(customers), choices=tuple(choices))
    problem = replace(problem, relations=tuple([
        replace(each, nodes=tuple(dict.fromkeys([
            place for node in each.nodes for place in problem.places_of(node)])))
        for each in problem.relations]))
    return with_vehicle_costs(rng, problem) if rng.random() < 0.3 else problem


def by_choice(problem: Problem) -> Iterator[Problem]:
    """Yield the problems in which each customer has one of his places alone."""
    others = {node for places in problem.choices for node in places}
    for chosen in product(*problem.choices):
        nodes = [*range(problem.num_depots),
                 *sorted({*range(problem.num_depots, problem.num_nodes)} - others | {*chosen})]
        source, first = np.array(nodes), problem.num_depots
        columns = source[first:] - first
        yield replace(
            problem, choices=(), coordinates=problem.coordinates[source],
            customers=tuple([replace(problem.customer_at(node), unassigned_cost=problem.customer_at(
                problem.first_place(node)).unassigned_cost) for node in nodes[first:]]),
            travel=tuple([each.among(source) for each in problem.travel]),
            may_serve=None if problem.may_serve is None else problem.may_serve[:, columns],
            vehicle_costs=problem.vehicle_costs_of(range(len(problem.vehicle_types)),
                                                   nodes[first:]),
            relations=problem.relations_among(nodes), shipments=problem.shipments_among(nodes))
