"""What the search knows of the places of a customer, or a shipment, in a plan without him."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from model.engine.alarm import Alarm
from model.engine.instance import pack
from model.engine.library import call
from model.engine.packing import packed
from model.engine.pausing import EndedError
from model.problem import IntArray, Problem
from model.search.beginning.translate import make_searcher
from model.search.neighbourhood.neighbourhood import make_neighbourhood
from model.search.problem_data import make_data
from model.solution import Solution, renumbered

MOST_PLACES, MOST_PLACED = 48, 11
"""Places of one route, by truck alone and with drones, and placements of each, that the engine
writes at most."""

SERVE, HALT, BEGIN, END, FLY, FLY_FIRST, JOIN, RIDE = range(8)
"""How a node is placed, as `tandem_write_places` tells."""


class Placement(NamedTuple):
    """Where a node comes on a route once all are placed, by its stops from the first one on."""

    node: int
    how: int
    first: int
    last: int
    drone: int


class PricedPlace(NamedTuple):
    """A legal place, and what it costs more to go there."""

    cost: float
    placements: tuple[Placement, ...]


class PlacePrices:
    """A search that isn't gone on with: it prices places in a plan's routes."""

    def __init__(self, problem: Problem, solution: Solution, deadline: float = math.inf) -> None:
        """Open it; no places are priced from a deadline on, on `time.perf_counter`."""
        instance = pack([problem], False)
        neighbourhood = make_neighbourhood(problem, instance)
        data = make_data(problem, instance, neighbourhood=neighbourhood,
                         deadline=Alarm(deadline).setting)
        self.nodes = neighbourhood.numbering.node.tolist()
        self.numbers = neighbourhood.numbering.number.tolist()
        self.laid = data
        self.searcher = make_searcher(
            problem, data, renumbered(solution, self.numbers.__getitem__),
            np.random.SeedSequence(0))
        self._data = packed(data)
        self._costs = np.zeros(MOST_PLACES)
        self._rows = np.zeros((MOST_PLACES, MOST_PLACED, len(Placement._fields)), np.int64)
        active: IntArray = self.searcher.active[:self.searcher.count.active]
        self.routes = tuple(sorted(active.tolist()))
        """Indices of the plan's routes that keep the rules as the search times them."""

    def places(self, node: int, route: int) -> Iterator[PricedPlace]:
        """Yield the places of a customer, or of the shipment whose first end he is, on a route.

        The cheapest by truck alone, then those with drones. Raises `EndedError` at the deadline.
        """
        count = call("tandem_write_places", self._data, self.searcher, self.numbers[node], route,
                     self._costs, self._rows)
        for cost, rows in zip(self._costs[:count].tolist(), self._rows[:count].tolist(),
                              strict=True):
            yield PricedPlace(cost, tuple([self._placed(*row) for row in rows if row[0] >= 0]))

    def all_places(self, node: int) -> list[tuple[int, PricedPlace]] | None:
        """Return the places on all routes, with the index of each; None: there was no time."""
        try:
            return [(route, place) for route in self.routes for place in self.places(node, route)]
        except EndedError:
            return None

    def _placed(self, node: int, how: int, first: int, last: int, drone: int) -> Placement:
        return Placement(self.nodes[node], how, self.nodes[first] if how == RIDE else first, last,
                      drone)
