"""What an insertion costs where a trip's first launch is shorter than all others."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.engine.library import call
from model.problem import UNLIMITED, Problem
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher, read_routes
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.problem_data import make_data
from model.search.sharing import slots_of
from model.solution import Route, Solution
from tests.model.search.found import copied
from tests.model.tiny import MINUTE
from training.instances import generate

pytestmark = pytest.mark.slow

SEEDS = 12

AT_STOP, BY_SORTIE, FLIGHT_TRIP, TRIP_FROM, TRIP_UNTIL = range(5)
"""Kinds of moves, as in `engine/search/route/edit.h`."""

SPAN = 3
"""Stops behind its launch where a sortie is recovered at most."""


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


def places(route: Route) -> Iterator[tuple[int, int, int]]:
    """Yield moves that change which launch of a trip is the first, or none: kind, stop, last."""
    first = 0
    for trip in route.trips:
        last = first + len(trip.stops) - 1
        for p in range(max(1, first), last + 1):
            yield from ((BY_SORTIE, p, q) for q in range(p, min(p + SPAN, last) + 1))
            if p == last:
                yield FLIGHT_TRIP, p, 0
                continue
            yield AT_STOP, p, 0
            flying = [each for each in trip.sorties
                      if each.launch_stop <= p - first < each.recovery_stop]
            if p > first and not flying and p + 1 < last:
                yield from ((TRIP_FROM, p, 0), (TRIP_UNTIL, p, 0))
        first = last + 1


def begun(seed: int) -> tuple[Problem, ProblemData, Searcher]:
    """Return a problem and its search, which has planned once by insertion."""
    problem = swapping(seed, 14)
    data = make_data(problem, pack([problem]))
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    searcher = make_searcher(problem, data, nobody, np.random.SeedSequence(seed))
    begin_anew(data, searcher, False)
    return problem, data, searcher


def test_an_insertion_costs_what_the_whole_route_does_timed_again() -> None:
    compared = dict.fromkeys((BY_SORTIE, AT_STOP, FLIGHT_TRIP, TRIP_FROM, TRIP_UNTIL), 0)
    refused = 0
    for seed in range(SEEDS):
        problem, data, searcher = begun(seed)
        timed = data._replace(evaluation=data.evaluation.copy())
        timed.evaluation["priced"] = True
        routes = read_routes(data, copied(data, searcher))
        # How much is aboard is looked at before.
        data.type["capacity"] *= 100
        rng = np.random.default_rng(seed)
        for slot, route in zip(searcher.active.tolist(), routes, strict=False):
            others = [node for node in range(problem.num_depots, problem.num_nodes)
                      if slots_of(searcher)[node] != slot]
            for kind, first, last in places(route):
                node = int(rng.choice(others))
                move = kind, slot, first, last
                part, whole = (call("tandem_price_move", each, searcher, *move, node)
                               for each in (data, timed))
                assert part == pytest.approx(whole), (seed, slot, kind, first, last, node)
                refused += part > 1e200
                compared[kind] += part < 1e200
    assert min(refused, *compared.values()) > 5, (refused, compared)
