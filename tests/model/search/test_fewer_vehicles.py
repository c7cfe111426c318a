"""Fewer vehicles, where each costs more than all that they do."""

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import Customer, Depot, Problem, Shipment, Travel, VehicleType
from model.search.improve import SearchConfig, improve
from model.solution import Solution

SERVICE, HORIZON = 10_000, 1_000_000
TURNS = 2000


def planted(seed: int, routes: int, is_paired: bool) -> Problem:
    """Return a problem that so many vehicles can serve, whose windows hardly tell by which."""
    rng = np.random.default_rng(seed)
    places, windows = [np.array([50.0, 50.0])], []
    for _ in range(routes):
        clock, here = 0.0, places[0]
        while True:
            there = np.clip(here + rng.normal(0, 25, 2), 0, 100)
            clock += 1000 * float(np.hypot(*(there - here)))
            if clock + SERVICE + 1000 * np.hypot(*(there - places[0])) > HORIZON:
                break
            windows.append((max(0, int(clock) - 40_000), int(clock) + 40_000))
            places.append(there)
            clock, here = clock + SERVICE + 1, there
        if len(windows) % 2:
            windows.pop()
            places.pop()
    coordinates = np.array(places)
    legs = np.floor(1000 * np.linalg.norm(coordinates[:, None] - coordinates, axis=2))
    travel = Travel(legs.astype(np.int64), legs.astype(np.int64))
    customers = tuple(
        Customer(str(node), (0,), service_duration=SERVICE, earliest=window[0], latest=window[1],
                 served_by="truck", unassigned_cost=0.0 if is_paired and node % 2 == 0 else None)
        for node, window in enumerate(windows, 1))
    shipments = tuple(Shipment(str(node), node, node + 1, (1,))
                      for node in range(1, len(customers), 2))
    truck = VehicleType("truck", len(customers), (100,), 0, fixed_cost=1e6, cost_per_km=1.0,
                        latest=HORIZON + SERVICE)
    return Problem((Depot("depot"),), customers, (truck,), (travel,), coordinates, 1e8,
                   shipments=shipments if is_paired else ())


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("is_paired", [False, True])
def test_no_vehicle_more_is_used_than_are_known_to_do(is_paired: bool, threads: int) -> None:
    problem = planted(1, 5, is_paired)
    instance = pack([problem])
    found = improve(problem, instance, Solution((), tuple(range(1, problem.num_nodes))),
                    SearchConfig(turns=TURNS, threads=threads))
    assert check(problem, found.solution).violations == ()
    assert not found.solution.unassigned
    assert len(found.solution.routes) <= 5
    assert instance.type["count"][0, 0] == len(problem.customers)
