"""Shipments left out are inserted by ejecting others, or routes stay as they are."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.engine.library import call
from model.judge.check import check
from model.problem import Problem, VehicleType
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import best_plan, make_searcher
from model.search.ejection import can_eject
from model.search.problem_data import make_data
from model.search.route.engine import ANY, anneal
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.sharing import slots_of
from model.solution import Solution
from tests.model.search.test_fewer_vehicles import planted

ROUNDS = 2000


def begun(problem: Problem) -> tuple[ProblemData, Searcher]:
    """Return a search for a problem, with a plan for all by insertion."""
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(0))
    begin_anew(data, searcher, False)
    return data, searcher


def eject(data: ProblemData, searcher: Searcher, rounds: int = ROUNDS,
          gently: bool = False) -> bool:
    """Give up a route, and tell whether all shipments are served without it."""
    data.type["count"][0] = int(searcher.count.active) - 1
    call("tandem_give_up_route", data, searcher)
    made, done = call("tandem_eject", data, searcher, rounds, gently)
    assert made <= rounds
    return bool(done)


@pytest.mark.parametrize("seed", range(4))
def test_all_are_served_by_hardly_more_vehicles_than_can(seed: int) -> None:
    problem = planted(seed, 4, True)
    data, searcher = begun(problem)
    first = int(searcher.count.active)
    used = first
    while eject(data, searcher):
        assert int(searcher.count.missing) == 0
        used = int(searcher.count.active)
        plan = best_plan(data, searcher, range(data.num_nodes))
        assert check(problem, plan).violations == ()
        assert not plan.unassigned
        assert len(plan.routes) == used
        assert float(searcher.value.best) == pytest.approx(check(problem, plan).cost.total)
    assert used <= 5
    assert used < first


def test_ways_become_less_long_where_others_are_moved_gently() -> None:
    cost = {}
    for gently in (False, True):
        cost[gently] = 0.0
        for seed in range(6):
            problem = planted(seed, 4, True)
            data, searcher = begun(problem)
            anneal(data, searcher, 300, ANY)
            assert eject(data, searcher, gently=gently)
            plan = best_plan(data, searcher, range(data.num_nodes))
            assert check(problem, plan).violations == ()
            assert not plan.unassigned
            cost[gently] += check(problem, plan).cost.distance
    assert cost[True] < cost[False]


def test_routes_stay_where_not_all_can_be_served() -> None:
    data, searcher = begun(planted(0, 4, True))
    while eject(data, searcher):
        pass
    routes = np.bincount(slots_of(searcher) + 1)
    missing = int(searcher.count.missing)
    assert missing > 0
    assert not call("tandem_eject", data, searcher, 50, False)[1]
    assert (np.bincount(slots_of(searcher) + 1) == routes).all()
    assert int(searcher.count.missing) == missing


def test_shipments_are_moved_at_random_within_rules() -> None:
    problem = planted(2, 4, True)
    data, searcher = begun(problem)
    before, best = float(searcher.value.cost), float(searcher.value.best)
    call("tandem_move_shipments", data, searcher, 200, False)
    assert float(searcher.value.cost) != before
    assert int(searcher.count.missing) == 0
    assert float(searcher.value.best) <= best
    anneal(data, searcher, 50, ANY)
    plan = best_plan(data, searcher, range(data.num_nodes))
    assert check(problem, plan).violations == ()


def test_shipments_are_moved_by_one_vehicle_more_if_there_is_one() -> None:
    problem = planted(2, 4, True)
    for count, more in ((0, 0), (1, 1)):
        data, searcher = begun(problem)
        used = int(searcher.count.active)
        data.type["count"][0] = used + count
        call("tandem_move_shipments", data, searcher, 400, True)
        assert int(searcher.count.active) == used + more
        assert int(searcher.used[0]) == used + more
        call("tandem_give_up_route", data, searcher)
        call("tandem_eject", data, searcher, ROUNDS, False)
        assert int(searcher.count.missing) == 0
        plan = best_plan(data, searcher, range(data.num_nodes))
        assert check(problem, plan).violations == ()


def _truck(problem: Problem, **changes: object) -> VehicleType:
    return replace(problem.vehicle_types[0], **changes)


def test_shipments_are_ejected_only_where_windows_and_loads_alone_limit() -> None:
    problem = planted(0, 2, True)
    assert can_eject(make_data(problem, pack([problem])))
    paid = replace(problem, vehicle_types=(_truck(problem, cost_per_hour=1.0),))
    assert can_eject(make_data(paid, pack([paid])))
    others = [planted(0, 2, False)]
    others.extend(replace(problem, vehicle_types=(_truck(problem, **changes),)) for changes in (
        {"lifo": True}, {"max_trips": 2}, {"max_working_duration": 500_000},
        {"max_travel_duration": 500_000}, {"max_trip_distance": 10**6}))
    others.append(replace(problem, vehicle_types=problem.vehicle_types * 2))
    others.append(replace(problem, shipments=(
        replace(problem.shipments[0], max_time_between=400_000), *problem.shipments[1:])))
    others.append(replace(problem, customers=(
        replace(problem.customers[0], earliest=0, gaps=((100, 200),)),
        *problem.customers[1:])))
    for other in others:
        assert not can_eject(make_data(other, pack([other])))
