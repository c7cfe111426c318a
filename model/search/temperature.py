"""Temperatures of the annealing, by what the problem's routes cost."""

import math
from dataclasses import dataclass

from model.search.fewer_vehicles import fixed_costs, vehicles_first
from model.search.route.engine import leg_cost
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.problem_data import are_alike, only_loads_limit

HOT, COLD = 1.0, 0.1
"""First temperature by what a customer costs, last by what a leg between customers does."""

FULL_HEAT = 2600
"""Turns for each customer from which on the first temperature is reached; less, by their root."""

LEAST_HEAT = 0.3
"""Share of the first temperature that is reached even in the shortest search."""

LEAST_HOT = 1.0
"""The first temperature is at least this by a leg."""

HOT_WITH_DRONES, COLD_WITH_DRONES = 0.5, 0.005
"""Both by a leg where trips are split between truck and drone, which many small changes do."""

HOT_FROM_TRUCKS, FULL_HEAT_FROM_TRUCKS = 0.7, 100
"""The same where the search began with trucks alone, and the turns for each customer from which on
that is reached; with less, by their root."""

HOT_BY_SMALL_MOVES, COLD_BY_SMALL_MOVES = 0.7, 0.02
"""The same where such trips are annealed by thousands of small moves a turn, too."""

HOT_IF_LARGE, COLD_IF_LARGE = 6.0, 0.03
"""Both by a leg where loads alone limit the routes of thousands of customers: the savings that it
begins with are far from good where routes are long, and soon are where they are short."""


@dataclass(frozen=True)
class Heat:
    """What the temperatures of a search go by."""

    customer: float  # cost of a customer served, on average, where the search began
    leg: float  # cost between two customers
    types: int  # of vehicles
    drones: bool  # some type has drones
    single_drones: bool  # some type has one, and a choice whom it flies to
    small_moves: bool  # trips of such are annealed by small moves
    large: bool  # there are thousands of customers, and loads alone limit routes
    vehicles_first: bool  # each costs more than all that those there are do
    from_trucks: bool  # the search began with a plan for trucks alone
    hot: float | None  # first temperature by the cost of a leg, if it is stated
    cold: float | None  # last

    @classmethod
    def of(cls, data: ProblemData, searcher: Searcher, is_large: bool, from_trucks: bool,
           hot: float | None, cold: float | None) -> "Heat":
        """Measure the routes as they are, of thousands of customers if `is_large`."""
        missing, is_fleet = int(searcher.count.missing), vehicles_first(data, searcher)
        served = max(1, int(searcher.count.customers) - missing)
        leg, left_out = leg_cost(data, searcher)
        cost = float(searcher.value.cost) - left_out
        fairness = data.fairness
        lacking = fairness.min_vehicles - fairness.used - int(searcher.used.sum())
        cost -= max(0.0, lacking) * fairness.too_few
        if is_fleet:
            cost -= fixed_costs(data, searcher)
        drones = data.type["drones"][:data.num_types]
        # Where parts of trips have ends of shipments alone, none is split, but many fly.
        split = data.strategy.resplit or (bool((drones == 1).any()) and len(data.pair) > 0)
        large = is_large and are_alike(data) and only_loads_limit(data)
        return cls(cost / served, leg, data.num_types,
                   bool((drones > 0).any()), split, data.strategy.small_moves,
                   large, is_fleet, from_trucks, hot, cold)

    def ends(self, turns: float, factor: float) -> tuple[float, float]:
        """Return the first and the last temperature.

        Parameters
        ----------
        turns
            Between them, for each customer.
        factor
            Of the first temperature.
        """
        if self.small_moves:
            hot, cold = HOT_BY_SMALL_MOVES * factor, COLD_BY_SMALL_MOVES
        elif self.single_drones:
            hot, cold = HOT_WITH_DRONES * factor, COLD_WITH_DRONES
            if self.from_trucks:
                hot = HOT_FROM_TRUCKS * factor * _haste(turns, FULL_HEAT_FROM_TRUCKS)
        elif self.large:
            hot, cold = HOT_IF_LARGE * factor, COLD_IF_LARGE
        else:
            # Which of several types drive is far from good at first.
            haste = 1.0 if self.types > 1 else _haste(turns, FULL_HEAT)
            hot, cold = haste * factor * HOT * self.customer / self.leg, COLD
            hot = max(LEAST_HOT, hot)
        return self.leg * (self.hot or hot), self.leg * (self.cold or cold)


def _haste(turns: float, full: float) -> float:
    """Return the share of a first temperature that there is time for; all from `full` turns on."""
    return min(1.0, max(LEAST_HEAT, math.sqrt(turns / full)))
