"""HGS-CVRP, by its package hygese, on a published instance."""

import time
from importlib import import_module
from importlib.metadata import version
from typing import Any

from benchmarks.peers.answers import PeerAnswer, has_rare_rules
from benchmarks.peers.published import Published


def solve(instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
    """Plan within a limit of processor time, all that it knows; None unless it is a plain CVRP."""
    vehicles = instance.vehicles
    if (instance.has_windows or has_rare_rules(instance) or len(vehicles) > 1
            or vehicles[0].fixed_cost or vehicles[0].count < instance.num_customers):
        return None
    hygese: Any = import_module("hygese")
    # It demands coordinates that are not negative; where the origin lies doesn't matter.
    x, y = (instance.coordinates - instance.coordinates.min(axis=0)).T
    data = {"x_coordinates": x, "y_coordinates": y, "distance_matrix": instance.travel,
            "service_times": instance.service, "demands": instance.demand,
            "vehicle_capacity": vehicles[0].capacity, "depot": 0}
    parameters = hygese.AlgorithmParameters(timeLimit=seconds, seed=seed)
    solver = hygese.Solver(parameters=parameters, verbose=False)
    began = time.perf_counter()
    result = solver.solve_cvrp(data)
    elapsed = time.perf_counter() - began
    return PeerAnswer([(0, [list(route)]) for route in result.routes], elapsed, version("hygese"))
