"""Rules without a number that bind a customer or shipment, and the problem without each of them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from model.problem import Customer, Problem
from model.problem.altered import with_customers


def lifted(problem: Problem, nodes: Sequence[int]) -> Iterator[tuple[str, Problem]]:
    """Yield rules that keep vehicles from a customer, as requests name them, and no longer do.

    `nodes` are all ends of a shipment, or one customer. None of one of a shipment's ends: no
    vehicle is tried for one without the others.
    """
    customers, kinds = [problem.customer_at(node) for node in nodes], problem.vehicle_types
    shipment = problem.shipment_at.get(nodes[0])
    if shipment is not None and len(nodes) < len(shipment.nodes):
        return
    if not all(problem.allows(kind, node) for kind in range(len(kinds)) for node in nodes):
        yield "vehicles", _open_to_all(problem, nodes)
    if any(not customer.skills <= kind.skills for kind in kinds for customer in customers):
        yield "skills", _with_all(
            problem, nodes, lambda customer: replace(customer, skills=frozenset()))
    if any(customer.served_by != "either" for customer in customers) and (
            problem.lags_across.keys().isdisjoint(nodes)):
        yield "served_by", _with_all(
            problem, nodes, lambda customer: replace(customer, served_by="either"))
    if any(not {*nodes}.isdisjoint(each.nodes) for each in problem.relations):
        yield "relations", replace(problem, relations=tuple(
            each for each in problem.relations if {*nodes}.isdisjoint(each.nodes)))
    if any(customer.goods & each.goods for each in problem.incompatible_goods
           for customer in customers):
        yield "goods", _with_all(
            problem, nodes, lambda customer: replace(customer, goods=frozenset()))


def _with_all(problem: Problem, nodes: Sequence[int],
              change: Callable[[Customer], Customer]) -> Problem:
    """Return a problem in which some customers are changed."""
    return with_customers(problem, {node: change(problem.customer_at(node)) for node in nodes})


def _open_to_all(problem: Problem, nodes: Sequence[int]) -> Problem:
    """Return the problem in which the table lets any vehicle serve some customers."""
    if problem.may_serve is None:
        return problem
    table = problem.may_serve.copy()
    table[:, [node - problem.num_depots for node in nodes]] = True
    return replace(problem, may_serve=table)
