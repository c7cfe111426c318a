"""A search of some milliseconds for one order at a time, in a plan that lacks it.

The plan is opened once. The order is then put into it under one set of rules after another, and
each time its neighbourhood alone is ruined and recreated.
"""

import math
from collections.abc import Iterable
from dataclasses import replace
from itertools import count

import numpy as np

from model.engine.instance import customer_row
from model.engine.library import call
from model.engine.plans import told
from model.problem import Customer, Problem
from model.search.priced_places import PlacePrices
from model.search.route.engine import ANY, BY_FAR, LONGEST_STRING, anneal, leg_cost
from model.search.sharing import make_rooms
from model.search.temperature import COLD
from model.solution import Route, Solution, renumbered

FOREVER = 2**40
"""Turns for which the search stays near the order."""

MISSED = 1000.0
"""What leaving out the order, or one whom the plan serves, costs more, by what the plan costs: room
is made by going elsewhere alone."""

NEW = -1
"""Number of a vehicle that has none yet."""

WINDOW = "window_earliest", "arrival_limit", "window_latest"


class OrderSearch(PlacePrices):
    """Searches near an order, from a plan without it, and prices places on its routes.

    Parameters
    ----------
    problem
        The problem, in which the order may be served by truck and by drone, within a window that
        opens later than at once and closes if any that follows does.
    solution
        A plan that leaves the order out.
    node
        The order's.
    """

    def __init__(self, problem: Problem, solution: Solution, node: int) -> None:
        super().__init__(problem, solution)
        self._number = self.numbers[node]
        self._solution = solution
        self.is_read = self.routes == tuple(range(len(solution.routes)))
        """Whether all routes keep the rules as the search times them."""
        [self._room] = make_rooms(self.laid, self.searcher, [np.random.SeedSequence(0)])
        self._seed = self._room.rng.copy()
        self._without = float(self.searcher.value.cost) - problem.cost_of_leaving_out(
            problem.customer_at(node))
        stays = [self._number, *[self.numbers[each] for each in Solution(solution.routes).served]]
        self.laid.unassigned_more[stays] += MISSED * max(1.0, abs(self._without))
        self.laid.must_serve[stays] = True
        self._stays = frozenset(stays)
        self._temperature = COLD * leg_cost(self.laid, self.searcher)[0]
        self._can = self.laid.can[:, :, self._number].copy()
        self._flies = np.array([kind.flies for kind in problem.vehicle_types])

    def ask(self, customer: Customer) -> float:
        """Put the order into the plan with the window, and the means, of a customer. In place.

        `customer` is the order but for these. Returns what it costs more, infinite if the order
        finds no place. The same plan and order give the same, whatever was asked before.
        """
        earliest, limit, _, _, latest, _ = customer_row(customer)
        rows = self.laid.node[:, self._number, 0]
        for name, value in zip(WINDOW, (earliest, limit, latest), strict=True):
            rows[name] = value
        by_truck, by_drone = customer.served_by != "drone", customer.served_by != "truck"
        can = self.laid.can[:, :, self._number]
        can[:] = self._can & (by_truck, by_drone)
        driven = np.where(self._flies, by_drone, by_truck)
        can[:len(driven), 0] = self._can[:len(driven), 0] & driven
        room = self._room
        call("tandem_price_alone", self._data, room, self._number)
        call("tandem_take_all", self._data, self.searcher, room)
        room.rng[:], room.absences[:] = self._seed, 0
        return self._gone_on(1, BY_FAR)

    def improve(self, turns: int) -> float:
        """Go on for some turns near the order; returns what it costs more then. In place."""
        room = self._room
        room.value.temperature, room.value.cooling = self._temperature, 1.0
        room.value.longest = LONGEST_STRING
        room.count.stay, room.count.focus = FOREVER, self._number
        return self._gone_on(turns, ANY)

    def _gone_on(self, turns: int, order: int) -> float:
        """Return what the order costs more after some turns; infinite if anybody is left out."""
        room = self._room
        anneal(self._data, room, turns, order)
        if not self._stays.isdisjoint(room.best_missing[:room.count.best_missing].tolist()):
            return math.inf
        return float(room.value.best) - self._without

    def plan(self) -> Solution:
        """Return the best plan with the order; routes that are the same stops stay as they are."""
        before = self._solution.routes
        routes: dict[int, Route] = dict(enumerate(before))
        changed = {route.vehicle: route for route in told(
            "tandem_tell_changed", self._data, self._room, self.searcher)}
        for slot, route in changed.items():
            is_same = slot < len(before) and before[slot].vehicle_type == route.vehicle_type
            routes[slot] = replace(route, vehicle=before[slot].vehicle if is_same else NEW)
        routes = {slot: route for slot, route in routes.items() if route.trips}
        for slot in changed.keys() & routes.keys():
            route = routes[slot]
            if route.vehicle == NEW:
                route = replace(route, vehicle=_free(route.vehicle_type, routes.values()))
            routes[slot] = renumbered(Solution((route,)), self.nodes.__getitem__).routes[0]
        missing = self._room.best_missing[:self._room.count.best_missing].tolist()
        return Solution(tuple([routes[slot] for slot in sorted(routes)]),
                        tuple(sorted([self.nodes[node] for node in missing])))


def _free(kind: int, routes: Iterable[Route]) -> int:
    """Return the least number of a vehicle of a type that drives none of some routes."""
    taken = {route.vehicle for route in routes if route.vehicle_type == kind}
    return next(number for number in count() if number not in taken)
