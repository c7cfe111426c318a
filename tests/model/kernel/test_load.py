"""Tests of compiled loads against plain sums."""

from dataclasses import replace

import numpy as np

from model.kernel.compiled import compiled
from model.kernel.instance import MAX_DIMENSIONS, pack
from model.kernel.load import (
    NOTHING, capacity_of, demand_of, fits, holds, lifts, minus, plus, total, within,
)
from model.kernel.records import Record, Records
from model.problem import IntArray, Problem
from tests.model.tiny import draw_tiny


@compiled
def judged(kind: Record, places: Records) -> tuple[bool, bool, bool]:
    """Tell whether a vehicle holds all customers, holds the last on top, a drone lifts them."""
    load = NOTHING
    for index in range(len(places) - 1):
        load = plus(load, demand_of(places[index]))
    everything = plus(load, demand_of(places[-1]))
    return holds(kind, everything), fits(kind, load, places[-1]), lifts(kind, everything)


@compiled
def left(kind: Record, place: Record) -> tuple[bool, int, int]:
    """Tell whether a customer's demand is within a capacity, both amounts, and what is left."""
    capacity, demand = capacity_of(kind), demand_of(place)
    return within(demand, capacity), total(demand), total(minus(capacity, demand))


def drawn(seed: int) -> list[tuple[Problem, IntArray, list[int]]]:
    """Return problems of up to three dimensions, their first vehicle type's row, some customers."""
    rng = np.random.default_rng(seed)
    found = []
    for index in range(200):
        problem = draw_tiny(rng)
        count = index % MAX_DIMENSIONS + 1
        drones = problem.vehicle_types[0].drones
        kind = replace(
            problem.vehicle_types[0], capacity=tuple(rng.integers(2, 9, count).tolist()),
            drones=drones and replace(drones, capacity=tuple(rng.integers(1, 5, count).tolist())))
        problem = replace(
            problem, vehicle_types=(kind,), amount_decimals=(3,) * count,
            customers=tuple(replace(customer, demand=tuple(rng.integers(0, 4, count).tolist()))
                            for customer in problem.customers))
        chosen = rng.permutation(np.arange(problem.num_depots, problem.num_nodes))
        found.append((problem, pack([problem]).type[0, 0],
                      chosen[: rng.integers(1, len(chosen) + 1)].tolist()))
    return found


def test_loads_fit_in_all_dimensions_or_not_at_all() -> None:
    seen = set()
    for problem, vehicle_type, nodes in drawn(seed=21):
        kind = problem.vehicle_types[0]
        load = np.sum([problem.customer_at(node).demand for node in nodes], axis=0)
        held = bool((load <= kind.capacity).all())
        lifted = bool((load <= (kind.drones.capacity if kind.drones else 0)).all())
        assert judged(vehicle_type, pack([problem]).node[0][nodes]) == (held, held, lifted)
        seen.add((held, lifted))
    assert seen >= {(True, True), (True, False), (False, False)}


def test_what_is_left_is_what_was_there_less_the_demand() -> None:
    for problem, vehicle_type, nodes in drawn(seed=22):
        kind, demand = problem.vehicle_types[0], problem.customer_at(nodes[0]).demand
        inside = all(one <= most for one, most in zip(demand, kind.capacity, strict=True))
        assert left(vehicle_type, pack([problem]).node[0, nodes[0]]) == (
            inside, sum(demand), sum(kind.capacity) - sum(demand))
