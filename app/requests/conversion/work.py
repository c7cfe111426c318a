"""How long the work on a request takes before its search, by what was measured on one core.

`benchmarks.speed.punctuality` tells what came before the search. The constants are what it takes on
memory that was in use before; the first touch of new memory may take as long again, which counts
once it is spent.
"""

from model.problem import Problem
from model.solution import Solution
from model.travel.obstacles import FEW_EDGES

DRIVE, FLIGHT = 2e-8, 3e-8
"""Seconds for each leg of a way to travel."""

PLANAR, GREAT_CIRCLE = 1e-8, 8e-8
"""Seconds for each leg's distance, once."""

COMPUTED = 1.6e-4
"""Seconds for each place where legs are computed, from a request that was read to a first plan that
was checked."""

CORNER, CROSSING = 1e-5, 3e-6
"""Seconds to merge areas, for each of their edges and for each pair of edges that may cross."""

LOOK, LOOK_AT_FEW, BEND, REACH = 7e-8, 2e-8, 1e-9, 2e-7
"""Seconds for each line of sight from a place, to another or to a corner: the second where areas
have few edges; for each pair of corners; and for each corner that is reached from a place."""

REPLANNED_ROUTE, REPLANNED_CUSTOMER = 4e-4, 1e-4
"""Seconds for each route, and each customer on it, of a plan to go on from: it is handed over,
judged before and after, and replied."""

RENUMBERED = 1.3e-8
"""Seconds for each leg of a way to travel that isn't computed: what is left is numbered anew."""


def replanning_seconds(problem: Problem, plan: Solution) -> float:
    """Estimate what going on from a plan takes beside legs and search."""
    served = sum(len(route.served) for route in plan.routes)
    tables = sum(travel.straight is None for travel in problem.travel)
    return (REPLANNED_ROUTE * len(plan.routes) + REPLANNED_CUSTOMER * served
            + RENUMBERED * tables * problem.num_nodes**2)


def legs_seconds(places: int, drives: int, flights: int, geographic: bool) -> float:
    """Estimate how long the matrices take, without ways around no-fly areas."""
    each = drives * DRIVE + flights * FLIGHT + (GREAT_CIRCLE if geographic else PLANAR)
    return each * places**2


def merging_seconds(edges: int, crossings: int) -> float:
    """Estimate how long it takes to merge areas, by how many pairs of their edges may cross."""
    return edges * CORNER + crossings * CROSSING


def sights_seconds(places: int, corners: int, edges: int) -> float:
    """Estimate how long it takes to find ways around areas between all places."""
    looks = places**2 / 2 + places * corners
    each = LOOK_AT_FEW if edges <= FEW_EDGES else LOOK
    return looks * each + corners**2 / 2 * BEND + places * corners * REACH
