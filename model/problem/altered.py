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


def differ_in_last(problem: Problem, other: Problem) -> bool:
    """Tell whether two problems with held legs differ in their last customer alone, if at all.

    He has one place, and nobody's place or order hangs on him. What leaving somebody out costs
    may differ, too, where that isn't stated.
    """
    last = problem.num_nodes - 1
    if (problem.num_nodes != other.num_nodes or not problem.customers
            or any(getattr(problem, name) != getattr(other, name) for name in _ALIKE)
            or problem.customers[:-1] != other.customers[:-1]
            or problem.shipments or problem.choices
            or any(last in each.nodes for each in problem.relations)
            or len(problem.travel) != len(other.travel)
            or any(each.straight is not None for each in (*problem.travel, *other.travel))):
        return False
    return all(_are_equal(mine[:last, :last], theirs[:last, :last])
               for each, same in zip(problem.travel, other.travel, strict=True)
               for mine, theirs in zip(each.arrays(), same.arrays(), strict=True)) and all(
        _are_equal(_columns(problem, name), _columns(other, name))
        for name in ("may_serve", "vehicle_costs")) and _are_equal(problem.may_stop, other.may_stop)


_ALIKE = ("depots", "vehicle_types", "amount_decimals", "must_serve", "incompatible_goods",
          "relations", "shipments", "choices", "fairness")


def _columns(problem: Problem, name: str) -> np.ndarray | None:
    table: np.ndarray | None = getattr(problem, name)
    return None if table is None else table[:, :-1]


def _are_equal(mine: np.ndarray | None, other: np.ndarray | None) -> bool:
    return (mine is None) == (other is None) and (
        mine is None or other is None or np.array_equal(mine, other))
