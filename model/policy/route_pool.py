"""The cheapest plan by routes of all samples, whichever plans they were drawn for.

Vehicles don't meet in the decision process: routes of several samples are a plan if together they
serve nobody twice and need no more vehicles of a type than there are. Most samples have some good
routes and some bad ones; the cheapest choice is a problem of set partitioning.

References
----------
Balinski and Quandt (1964), on an integer program for a delivery problem, Operations Research 12.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from model.engine.alarm import Alarm, has_rung
from model.engine.instance import Instance
from model.engine.library import packed
from model.policy.partition import cheapest_partition
from model.policy.keeping import serves, vehicles_nearby
from model.policy.rolling import NOTHING, Rollout
from model.problem import BoolArray, FloatArray, IntArray
from model.simulation.state import by_term, empty_costs
from model.simulation.actions import NUM_KINDS, OPEN, price_routes, reset

REGION = 100
"""Customers whose routes are chosen together, at most: the time for more grows fast."""

MOST_ROUTES = 1500
"""Routes that are kept; of more the older half is forgotten, but for the best plan's."""

LEAST_SAVING = 1e-9
"""Share of the cost by which a plan has to be cheaper, so that it isn't but otherwise rounded."""


class PooledRoute(NamedTuple):
    """What a vehicle does."""

    actions: IntArray  # (action,) codes, from its opening on
    type: int  # of the vehicle
    nodes: IntArray  # (customer,) sorted, with all other places of each
    cost: float


class RoutePool:
    """The cheapest route seen for each type of vehicle and set of customers.

    Parameters
    ----------
    instance
        The problem, packed alone.
    """

    def __init__(self, instance: Instance) -> None:
        self._instance = instance
        # Packed once, since plans come by the hundred.
        self._alone = packed(instance), reset(instance, np.zeros(1, np.int64))
        self._routes: dict[tuple[int, bytes], PooledRoute] = {}
        self._by_actions: dict[bytes, tuple[int, bytes]] = {}
        goods = instance.goods
        # What hangs on other vehicles can't be made alone.
        self._are_apart = not (instance.hub.shape[1] or instance.across.shape[1]
                               or goods["kept_on_trip"].any() or goods["kept_on_vehicle"].any())

    def add(self, actions: IntArray) -> None:
        """Add the routes of a plan, given the codes of all its actions. In place."""
        if not self._are_apart:
            return
        new = [codes for codes in _split(actions) if codes.tobytes() not in self._by_actions]
        if not new:
            return
        price = empty_costs(len(new))
        price_routes(*self._alone, 0, np.concatenate(new), price)
        for codes, cost in zip(new, by_term(price).sum(axis=1).tolist(), strict=True):
            nodes = self._places_of(codes[serves(codes)] // NUM_KINDS)
            route = PooledRoute(codes, int(codes[0] // NUM_KINDS), nodes, cost)
            key = route.type, nodes.tobytes()
            self._by_actions[codes.tobytes()] = key
            if key not in self._routes or cost < self._routes[key].cost:
                self._routes[key] = route

    def improved(self, best: Rollout, rng: np.random.Generator,
                 alarm: IntArray | None = None) -> Rollout:
        """Return the cheapest plan that is found by the routes seen, at most as dear as `best`.

        That is `best` where vehicles share batteries, or places to charge, where some customers go
        together, or are served in an order by any vehicles.

        Parameters
        ----------
        best
            A plan whose routes were added.
        rng
            Draws the customers near whom routes are chosen anew where there are more than `REGION`.
        alarm
            Setting of an alarm at which the best so far is returned.
        """
        alarm = Alarm().setting if alarm is None else alarm
        if not self._are_apart:
            return best
        self._forget(best)
        for _ in range(-(-int(self._instance.size[0].customers) // REGION)):
            if has_rung(alarm) or len(best.actions) == 0:
                break
            best = self._improved_near(best, rng, alarm)
        return best

    def _places_of(self, nodes: IntArray) -> IntArray:
        """Return all places of some customers, sorted."""
        pair = self._instance.pair[0]
        if not len(pair):
            return np.sort(nodes)
        return np.flatnonzero(np.isin(pair["unit"], pair["unit"][nodes]))

    def _forget(self, best: Rollout) -> None:
        """Forget the older half of the routes, if there are too many. In place."""
        if len(self._routes) > MOST_ROUTES:
            newer = list(self._routes.items())[-MOST_ROUTES // 2:]
            self._routes, self._by_actions = dict(newer), {}
            self.add(best.actions)

    def _improved_near(self, best: Rollout, rng: np.random.Generator, alarm: IntArray) -> Rollout:
        routes = [self._routes[self._by_actions[codes.tobytes()]]
                  for codes in _split(best.actions)]
        anew, customers = np.zeros(len(routes), np.bool_), 0
        for vehicle in vehicles_nearby(self._instance, best.actions, rng).tolist():
            customers += len(routes[vehicle].nodes)
            if customers > REGION and anew.any():
                break
            anew[vehicle] = True
        kept = [route for route, is_anew in zip(routes, anew.tolist(), strict=True) if not is_anew]
        old = [route for route, is_anew in zip(routes, anew.tolist(), strict=True) if is_anew]
        chosen = self._cheapest(kept, old, alarm)
        if chosen is None:
            return best
        plan = [*kept, *chosen]
        cost = self._cost(plan, ~_served(self._instance, plan))
        if cost >= best.cost * (1.0 - LEAST_SAVING):
            return best
        return Rollout(np.concatenate([NOTHING.actions, *(route.actions for route in plan)]), cost)

    def _cheapest(self, kept: Sequence[PooledRoute], old: Sequence[PooledRoute],
                  alarm: IntArray) -> list[PooledRoute] | None:
        """Return the cheapest routes in the place of old ones beside those kept; None if none."""
        may_serve = ~_served(self._instance, kept)
        left_out = may_serve & ~_served(self._instance, old)
        too_many = np.flatnonzero(left_out)[REGION:]
        may_serve[too_many] = left_out[too_many] = False
        routes = [route for route in self._routes.values() if may_serve[route.nodes].all()]
        nodes = np.flatnonzero(may_serve)
        row_of = np.searchsorted(nodes, np.arange(len(may_serve)))
        room = self._instance.type["count"][0] - _by_type(self._instance, kept)
        columns = [np.append(row_of[route.nodes], len(nodes) + route.type) for route in routes]
        columns += list(np.arange(len(nodes))[:, None])  # those who leave a customer out
        price = np.append([route.cost for route in routes], self._penalties(may_serve))
        known = self._cost(old, left_out)
        if known <= 0.0:
            return None
        chosen = cheapest_partition(columns, price, np.append(np.full(len(nodes), -1), room),
                                    known, alarm)
        if chosen is None:
            return None
        return [routes[index] for index in np.flatnonzero(chosen[:len(routes)]).tolist()]

    def _cost(self, routes: Sequence[PooledRoute], left_out: BoolArray) -> float:
        return sum(route.cost for route in routes) + float(self._penalties(left_out).sum())

    def _penalties(self, left_out: BoolArray) -> FloatArray:
        """Return what it costs to leave out each of some customers, given as (node,)."""
        penalties: FloatArray = (self._instance.unassigned_cost[0]
                                 + self._instance.unassigned_more[0, left_out])
        return penalties


def _split(actions: IntArray) -> list[IntArray]:
    """Return the codes of each vehicle."""
    opened = np.flatnonzero(actions % NUM_KINDS == OPEN)
    return np.split(actions, opened)[1:]


def _served(instance: Instance, routes: Sequence[PooledRoute]) -> BoolArray:
    """Return (node,) whom routes serve; depots, and what isn't there, count as served."""
    size = instance.size[0]
    served = np.ones(instance.node.shape[2], np.bool_)
    served[size.depots:size.depots + size.customers] = False
    for route in routes:
        served[route.nodes] = True
    return served


def _by_type(instance: Instance, routes: Sequence[PooledRoute]) -> IntArray:
    """Return (type,) how many routes there are."""
    types = np.array([route.type for route in routes], np.int64)
    return np.bincount(types, minlength=instance.type.shape[1])
