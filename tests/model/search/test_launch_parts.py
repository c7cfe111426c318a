"""Parts of trips planned at best, with stops at launch sites and revisits."""

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import (
    MM_PER_KM, MS_PER_HOUR, Customer, Depot, DroneType, Problem, Travel, VehicleType,
)
from model.problem.revisits import with_revisits
from model.search.improve import SearchConfig, improve
from model.solution import Solution

pytestmark = pytest.mark.slow

UNIT = 10_000

# Places on a plane, the depot first; how many times faster a drone is; the least makespan, by a
# dynamic program of its own, with revisits and without.
TOURS = (
    ([[57, 22], [77, 64], [33, 60], [94, 43], [48, 88], [69, 25], [31, 20], [14, 96], [54, 84],
      [53, 53], [21, 68]], 3, 157.381542121, 161.095051548),
    ([[85, 70], [29, 63], [25, 62], [15, 49], [59, 50], [88, 9], [49, 2], [4, 46], [27, 1],
      [78, 95], [95, 62]], 3, 176.734461030, 179.946467541),
    ([[3, 2], [5, 43], [59, 41], [85, 83], [26, 67], [37, 38], [77, 4], [23, 47], [86, 69],
      [78, 91], [77, 48]], 2, 237.391252882, 238.228365885),
)


def tour(places: list[list[int]], faster: int) -> Problem:
    """Return a problem of one truck with a drone, of which the makespan alone costs."""
    points = np.array(places, np.float64)
    length = np.hypot(*(points[:, None] - points).transpose(2, 0, 1)) * UNIT
    drive, fly = (np.rint(legs).astype(np.int64) for legs in (length, length / faster))
    truck = VehicleType(
        "truck", 1, (len(places),), travel=0, cost_per_hour=MS_PER_HOUR / UNIT,
        drones=DroneType(1, (1,), travel=1))
    customers = tuple(Customer(str(node), (1,)) for node in range(1, len(places)))
    return Problem((Depot("0"),), customers, (truck,), (Travel(drive, drive), Travel(fly, fly)),
                   points, unassigned_cost=1000.0 * MM_PER_KM)


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize(("places", "faster", "least", "least_without"), TOURS)
def test_tours_of_ten_with_revisits_are_the_shortest_at_once(
        places: list[list[int]], faster: int, least: float, least_without: float) -> None:
    problem = with_revisits(tour(places, faster), [0])
    for seed in range(2):
        nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
        found = improve(problem, pack([problem]), nobody, SearchConfig(seed=seed, turns=1000))
        verdict = check(problem, found.solution)
        assert verdict.violations == ()
        assert verdict.cost.total == pytest.approx(least, rel=1e-4)
        assert verdict.cost.total < least_without * (1 - 1e-3)
