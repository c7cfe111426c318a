"""How long the work on a request takes before its search, by what was measured on one core.

`benchmarks.speed.punctuality` tells what came before the search. The constants are what it takes on
memory that was in use before; the first touch of new memory may take as long again, which the clock
sees.
"""

from model.problem import Problem
from model.search.regions.region import customers_of
from model.solution import Solution
from model.travel.obstacles import FEW_EDGES

DRIVE, FLIGHT = 2e-8, 3e-8
"""Seconds for each leg of a way to travel."""

PLANAR, GREAT_CIRCLE = 1e-8, 8e-8
"""Seconds for each leg's distance, once."""

COMPUTED = 1.6e-4
"""Seconds for each place where legs are computed, from a request that was read to a first plan that
was checked."""

EDGE, LOOK, LOOK_AT_FEW = 1e-7, 1e-7, 3e-8
"""Seconds for each edge seen from a place or corner, and for each line of sight between two of
these: the last where areas have few edges."""

REPLANNED_ROUTE, REPLANNED_CUSTOMER = 4e-4, 1e-4
"""Seconds for each route, and each customer on it, of a plan to go on from: it is handed over,
judged before and after, and replied."""

RENUMBERED = 1.3e-8
"""Seconds for each leg of a way to travel that isn't computed: what is left is numbered anew."""


def replanning_seconds(problem: Problem, plan: Solution) -> float:
    """Estimate what going on from a plan takes beside legs and search."""
    served = sum(1 for route in plan.routes for _ in customers_of(route))
    tables = sum(travel.straight is None for travel in problem.travel)
    return (REPLANNED_ROUTE * len(plan.routes) + REPLANNED_CUSTOMER * served
            + RENUMBERED * tables * problem.num_nodes**2)


def legs_seconds(places: int, drives: int, flights: int, geographic: bool) -> float:
    """Estimate how long the matrices take, without ways around no-fly areas."""
    each = drives * DRIVE + flights * FLIGHT + (GREAT_CIRCLE if geographic else PLANAR)
    return each * places**2


def sights_seconds(places: int, corners: int, edges: int) -> float:
    """Estimate how long it takes to find out which places and corners of areas see each other."""
    looks = places**2 / 2 + places * corners + corners**2 / 2
    each = LOOK_AT_FEW if edges <= FEW_EDGES else LOOK
    return (2 * places + corners) * edges * EDGE + looks * each
