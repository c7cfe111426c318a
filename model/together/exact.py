"""The best plan by trucks of a few customers, from every order of every group of them."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from model.judge.network import network_of
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import TimedRoute, time_route
from model.judge.timing import RouteDecision
from model.problem import Problem
from model.solution import Route, Solution
from model.together.orders import AllOrders, RouteOrder, TooManyOrdersError

MOST_CUSTOMERS = 8
"""For so many all groups are looked at."""

MOST_WAYS = 40_000
"""So many ways from one customer to the next are tried in all: some 0.4 s."""

MOST_SUMS = 1_000_000
"""So many plans are added up at most: some 0.3 s."""

Routes = Mapping[int, TimedRoute]
"""The cheapest route of each group, by nodes as bits."""


def best_by_trucks(problem: Problem, should_stop: Callable[[], bool]) -> Solution | None:
    """Return the cheapest plan without flights.

    None if there is no time for it, orders are too many, or depots have only so much for who flies.
    """
    if problem.limits_hubs:
        return None
    customers = np.arange(problem.num_depots, problem.num_nodes)
    left, routes = MOST_WAYS, []
    try:
        for kind in range(len(problem.vehicle_types)):
            orders = AllOrders(network_of(problem, kind, customers), left, should_stop)
            routes.append(_cheapest(problem, kind, orders, should_stop))
            left -= orders.tried
        return _assembled(problem, routes, should_stop)
    except TooManyOrdersError:
        return None


def _cheapest(problem: Problem, kind: int, orders: AllOrders,
              should_stop: Callable[[], bool]) -> Routes:
    """Return the cheapest route of each group that a vehicle can serve."""
    found = {}
    for group, tried in orders.by_group().items():
        if should_stop():
            raise TooManyOrdersError
        best = _cheapest_order(problem, kind, tried)
        if best is not None:
            found[group] = best
    return found


def _cheapest_order(problem: Problem, kind: int, orders: Sequence[RouteOrder]) -> TimedRoute | None:
    best: TimedRoute | None = None
    for order in sorted(orders, key=lambda order: order.bound):
        if best is not None and best.judged.cost.total <= order.bound:
            break
        timed = time_route(problem, RouteDecision(kind, 0, order.trips), "", EVERYTHING_OPEN)
        if not timed.judged.violations and (best is None or timed.rank < best.rank):
            best = timed
    return best


class _Some(NamedTuple):
    """Some vehicles' routes."""

    cost: float
    routes: tuple[tuple[int, int], ...]  # type and group of each


def _assembled(problem: Problem, routes: Sequence[Routes],
               should_stop: Callable[[], bool]) -> Solution:
    """Return the cheapest plan of such routes, as many of each type as there are vehicles."""
    plans, sums = {0: _Some(0.0, ())}, 0
    for kind, vehicles in enumerate(problem.vehicle_types):
        costs = [(group, timed.judged.cost.total) for group, timed in routes[kind].items()]
        for _ in range(min(vehicles.count, problem.num_customers)):
            sums += len(plans) * len(costs)
            if sums > MOST_SUMS or should_stop():
                raise TooManyOrdersError
            plans = _with_one_more(plans, kind, costs)
    nodes = range(problem.num_depots, problem.num_nodes)
    left_out = {node: problem.cost_of_leaving_out(problem.customer_at(node)) for node in nodes}
    served = min(plans, key=lambda group: plans[group].cost + sum(
        [cost for node, cost in left_out.items() if not group >> node & 1]))
    numbers, placed = [0] * len(routes), []
    for kind, group in plans[served].routes:
        placed.append(Route(kind, numbers[kind], routes[kind][group].route.trips))
        numbers[kind] += 1
    return Solution(tuple(placed), tuple([node for node in nodes if not served >> node & 1]))


def _with_one_more(plans: Mapping[int, _Some], kind: int,
                   costs: Sequence[tuple[int, float]]) -> dict[int, _Some]:
    """Return the cheapest plans by the group that they serve, where one more vehicle may drive."""
    more = dict(plans)
    for served, plan in plans.items():
        for group, cost in costs:
            if served & group:
                continue
            known = more.get(served | group)
            if known is None or plan.cost + cost < known.cost:
                more[served | group] = _Some(plan.cost + cost, (*plan.routes, (kind, group)))
    return more
