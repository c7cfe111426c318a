"""Problems that differ from another in some of its customers."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from model.problem.customer import Customer
from model.problem.problem import Problem


def with_customers(problem: Problem, changed: Mapping[int, Customer]) -> Problem:
    """Return a problem in which the customers at some nodes are others."""
    first = problem.num_depots
    return replace(problem, customers=tuple([
        changed.get(node, customer) for node, customer in enumerate(problem.customers, first)]))


def with_copies(problem: Problem, node: int, copies: Sequence[Customer]) -> Problem:
    """Return a problem with more customers, behind all others, at the place of one."""
    at = np.array([*range(problem.num_nodes), *[node] * len(copies)])
    columns = at[problem.num_depots:] - problem.num_depots
    costs = problem.vehicle_costs
    return replace(
        problem, customers=(*problem.customers, *copies), coordinates=problem.coordinates[at],
        travel=tuple([each.among(at) for each in problem.travel]),
        may_serve=None if problem.may_serve is None else problem.may_serve[:, columns],
        vehicle_costs=None if costs is None else costs[:, columns])
