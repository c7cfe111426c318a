"""What an insertion costs where a trip's first launch is shorter than all others."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.engine.library import call
from model.problem import UNLIMITED, Problem
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.priced_places import BEGIN, END, FLY, MOST_PLACED, SERVE
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.problem_data import make_data
from model.search.sharing import slots_of
from model.solution import Solution
from tests.model.tiny import MINUTE
from training.instances import generate

pytestmark = pytest.mark.slow

SEEDS = 12

MOST = 24
"""Places by truck alone that are listed of a route, and with drones."""

Place = tuple[tuple[int, ...], ...]


def swapping(seed: int, count: int) -> Problem:
    """Return a problem with several trips and many sorties."""
    rng = np.random.default_rng(seed)
    problem = generate(rng, count, "drone")
    truck = problem.vehicle_types[0]
    assert truck.drones is not None
    carrier = replace(
        truck, cost_per_hour=20.0, max_trips=8, reload_duration=5 * MINUTE, latest=UNLIMITED,
        max_trip_distance=None, max_working_duration=None,
        drones=replace(
            truck.drones, count=2, swap_duration=int(rng.integers(1, 15)) * MINUTE,
            cost_per_hour=0.0))
    customers = tuple(
        replace(customer, late_cost_per_hour=None, early_cost_per_hour=0.0, service_duration=MINUTE,
                latest=UNLIMITED if rng.random() < 0.7 else customer.latest,
                served_by="drone" if rng.random() < 0.4 else "either")
        for customer in problem.customers)
    return replace(problem, vehicle_types=(carrier,), customers=customers)


def listed(data: ProblemData, searcher: Searcher, node: int, slot: int) -> dict[Place, float]:
    """Return what a customer costs at each place behind a route's first customer."""
    costs, rows = np.zeros(2 * MOST), np.zeros((2 * MOST, MOST_PLACED, 5), np.int64)
    count = call("tandem_write_places", data, searcher, node, slot, costs, rows)
    return {tuple([tuple(row[1:]) for row in place if row[0] >= 0]): cost
            for cost, place in zip(costs[:count].tolist(), rows[:count].tolist(), strict=True)
            if place[0][2] > 1}


def begun(seed: int) -> tuple[Problem, ProblemData, Searcher]:
    """Return a problem and its search, which has planned once by insertion."""
    problem = swapping(seed, 14)
    data = make_data(problem, pack([problem]))
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    searcher = make_searcher(problem, data, nobody, np.random.SeedSequence(seed))
    begin_anew(data, searcher, False)
    return problem, data, searcher


def test_an_insertion_costs_what_the_whole_route_does_timed_again() -> None:
    compared: Counter[tuple[int, ...]] = Counter()
    for seed in range(SEEDS):
        problem, data, searcher = begun(seed)
        timed = data._replace(evaluation=data.evaluation.copy())
        timed.evaluation["priced"] = True
        # How much is aboard is looked at before.
        data.type["capacity"] *= 100
        for slot in searcher.active[: searcher.count.active].tolist():
            for node in range(problem.num_depots, problem.num_nodes):
                if slots_of(searcher)[node] == slot:
                    continue
                part, whole = (listed(each, searcher, node, slot) for each in (data, timed))
                both = part.keys() & whole.keys()
                for place in both:
                    assert part[place] == pytest.approx(whole[place]), (seed, slot, node, place)
                assert len(both) == min(len(part), len(whole)) or 2 * len(both) > len(part)
                compared.update(tuple(row[0] for row in place) for place in both)
    kinds = {(SERVE,), (FLY,), (BEGIN, END, FLY), (SERVE, END, BEGIN), (END, BEGIN, SERVE)}
    assert min(compared[kind] for kind in kinds) > 5, compared
