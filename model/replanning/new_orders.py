"""New orders only behind whom vehicles had before: put there when all others are planned.

The search knows no order of some before others on whichever vehicle. So it plans those who were
there, and each new order then comes to the cheapest place that the judge finds legal.
"""

import time
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from model.counsel.bench import Bench, Setting
from model.counsel.fitting import find_fits, new_violations
from model.counsel.screening import share_over
from model.judge.check import Evaluation
from model.judge.past import Past
from model.problem import Problem, Shipment
from model.solution import Solution


class NewOrder(NamedTuple):
    """An order that the plan before lacks."""

    nodes: tuple[int, ...]
    shipment: Shipment | None
    latest: int  # ms


def new_orders(problem: Problem, past: Past) -> list[NewOrder]:
    """Return the orders that come behind all others, the most urgent first."""
    if not past.had:
        return []
    there = past.told
    shipped = {node for shipment in problem.shipments for node in shipment.nodes}
    found = [NewOrder(each.nodes, each, problem.customer_at(each.delivery).latest)
             for each in problem.shipments if there.isdisjoint(each.nodes)]
    found += [NewOrder((node,), None, problem.customer_at(node).latest)
              for node in range(problem.num_depots, problem.num_nodes)
              if node == problem.first_place(node) and node not in shipped and node not in there]
    return sorted(found, key=lambda order: (order.latest, order.nodes))


def put_after(problem: Problem, setting: Setting, known: tuple[Solution, Evaluation],
               orders: Sequence[NewOrder], until: float) -> tuple[Solution, Evaluation]:
    """Return a plan with new orders where they cost least, those left out for which that is dearer.

    Parameters
    ----------
    problem, setting
        What the plan is for, and what else it is judged by.
    known
        The plan without them, and what the judge says of it.
    orders
        Those that are new.
    until
        When to stop, on `time.perf_counter`.
    """
    solution, evaluation = known
    for number, order in enumerate(orders):
        if time.perf_counter() >= until:
            break
        bench = Bench(problem, solution, order.nodes[0], setting, None, order.shipment)
        for fit in find_fits(bench, 1, share_over(1 / (len(orders) - number), until)).places:
            trial = fit.trial
            if (not new_violations(bench, trial)
                    and trial.evaluation.cost.total <= evaluation.cost.total):
                solution, evaluation = trial.solution, trial.evaluation
    return solution, evaluation


def all_nodes(orders: Iterable[NewOrder]) -> set[int]:
    """Return the first places of some orders."""
    return {node for order in orders for node in order.nodes}
