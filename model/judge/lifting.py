"""Rules without a number that bind a customer, and the problem without each of them."""

from collections.abc import Iterator
from dataclasses import replace

from model.judge.alternatives import with_customer
from model.problem import Problem


def lifted(problem: Problem, node: int) -> Iterator[tuple[str, Problem]]:
    """Yield rules that keep vehicles from a customer, as requests name them, and no longer do.

    None of a shipment's ends: no vehicle is tried for one without the other.
    """
    customer = problem.customer_at(node)
    if node in problem.shipment_at:
        return
    if not all(problem.allows(kind, node) for kind in range(len(problem.vehicle_types))):
        yield "vehicles", _open_to_all(problem, node)
    if any(not customer.skills <= kind.skills for kind in problem.vehicle_types):
        yield "skills", with_customer(problem, node, replace(customer, skills=frozenset()))
    if customer.served_by != "either" and node not in problem.lags_across:
        yield "served_by", with_customer(problem, node, replace(customer, served_by="either"))
    if any(node in each.nodes for each in problem.relations):
        yield "relations", replace(problem, relations=tuple(
            each for each in problem.relations if node not in each.nodes))
    if any(customer.goods & each.goods for each in problem.incompatible_goods):
        yield "goods", with_customer(problem, node, replace(customer, goods=frozenset()))


def _open_to_all(problem: Problem, node: int) -> Problem:
    """Return the problem in which the table lets any vehicle serve a customer."""
    if problem.may_serve is None:
        return problem
    table = problem.may_serve.copy()
    table[:, node - problem.num_depots] = True
    return replace(problem, may_serve=table)
