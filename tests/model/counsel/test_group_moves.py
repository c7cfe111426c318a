"""What it costs if another vehicle serves all who are bound to go together, against all ways."""

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import pytest

from model.counsel.alternatives import find_alternatives
from model.counsel.bench import Bench
from model.counsel.fitting import find_fits, new_violations
from model.counsel.group_moves import companions_to
from model.judge.check import check
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import time_route
from model.problem import Customer, Depot, Problem, Travel, VehicleType
from model.solution import Solution, Vehicle
from tests.model.counsel.test_shipment_places import bench_of, greedy, routes
from tests.model.tiny_company import with_relations
from tests.model.tiny_shipments import with_shipments

MINUTE, KM = 60_000, 1_000_000


def served_by(solution: Solution) -> dict[int, Vehicle]:
    return {node: route.driven_by
            for route in solution.routes for node in route.served}


def leave_out(problem: Problem, solution: Solution, nodes: Iterable[int]) -> Solution:
    """Return a plan without some of those whom it serves."""
    for node in nodes:
        solution = Bench(problem, solution, node).left_out.solution
    return solution


def cheapest_by_vehicle(problem: Problem, left_out: Solution,
                        nodes: tuple[int, ...]) -> dict[Vehicle, float]:
    """Return the lowest cost at which each vehicle serves some nodes more, by all ways there are.
    """
    found: dict[Vehicle, float] = {}
    unassigned = tuple([node for node in left_out.unassigned if node not in nodes])
    for index, decision in routes(problem, left_out, nodes):
        timed = time_route(problem, decision, "", EVERYTHING_OPEN)
        plan = Solution((*left_out.routes[:index], timed.route, *left_out.routes[index + 1:]),
                        unassigned)
        evaluation = check(problem, plan)
        vehicle = decision.driven_by
        if evaluation.is_feasible:
            cost = evaluation.cost.total
            found[vehicle] = min(cost, found.get(vehicle, math.inf))
    return found


def drawn(rng: np.random.Generator) -> Problem:
    """Return five customers, one of whom is in a hurry, and trucks that have some room."""
    ways = [rng.integers(1, 20, (6, 6)) * (1 - np.eye(6, dtype=np.int64)) for _ in range(2)]
    customers = tuple([
        Customer(str(node), (1,), latest=int(rng.choice([30, 200, 400])) * MINUTE)
        for node in range(1, 6)])
    truck = VehicleType("truck", 3, (4,), 0, fixed_cost=9.0, cost_per_km=1.0, cost_per_hour=6.0)
    van = replace(truck, id="van", count=1, cost_per_km=1.5, max_trips=2)
    return Problem((Depot("hub"),), customers, (truck, van),
                   (Travel(ways[0] * MINUTE, ways[1] * KM),), np.zeros((6, 2)), 1000.0)


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("seed", [28, 29, 30, 31, 34, 35, 38, 41])
def test_all_who_go_together_are_moved_at_once_for_the_least_cost(seed: int) -> None:
    rng = np.random.default_rng(seed)
    problem = with_shipments(rng, drawn(rng)) if seed % 2 else drawn(rng)
    problem = with_relations(rng, problem)
    solution = greedy(problem)
    for node in range(problem.num_depots, problem.num_nodes):
        if problem.unit_of(node) != node:
            continue
        bench = bench_of(problem, solution, node)
        moved = [each for each in find_alternatives(bench).alternatives
                 if each.kind == "vehicle" and each.companions]
        if not moved:
            continue
        nodes = (*bench.nodes, *[other for unit in moved[0].companions
                                 for other in unit.nodes])
        left_out = leave_out(problem, solution, nodes)
        lowest = cheapest_by_vehicle(problem, left_out, nodes)
        for each in moved:
            assert each.trial.evaluation == check(problem, each.trial.solution)
            own = served_by(each.trial.solution)
            vehicle, = {own[each] for each in nodes}
            assert vehicle != served_by(solution).get(node)
            if each.trial.evaluation.is_feasible:
                # It may be less on several trips, which aren't tried one and all.
                assert each.trial.evaluation.cost.total <= lowest.get(vehicle, math.inf) + 1e-9
            else:
                assert vehicle not in lowest


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("seed", [28, 31])
@pytest.mark.parametrize("all_left_out", [True, False])
def test_who_goes_along_with_one_who_is_left_out_is_served_with_him_for_the_least_cost(
        seed: int, all_left_out: bool) -> None:
    rng = np.random.default_rng(seed)
    problem = with_shipments(rng, drawn(rng)) if seed % 2 else drawn(rng)
    problem = with_relations(rng, problem)
    whole = greedy(problem)
    for node in range(problem.num_depots, problem.num_nodes):
        if problem.unit_of(node) != node:
            continue
        bench = bench_of(problem, whole, node)
        nodes = (*bench.nodes, *[other for unit in companions_to(bench) for other in unit.nodes])
        plan = leave_out(problem, whole, nodes if all_left_out else bench.nodes)
        bench = bench_of(problem, plan, node)
        fits = find_fits(bench, 5)
        assert fits.is_complete
        for fit in (*fits.places, *fits.others):
            if not fit.companions:
                continue
            moved = (*bench.nodes, *[other for unit in fit.companions for other in unit.nodes])
            assert fit.trial.evaluation == check(problem, fit.trial.solution)
            own = served_by(fit.trial.solution)
            vehicle, = {own[each] for each in moved}
            lowest = cheapest_by_vehicle(problem, leave_out(problem, plan, moved), moved)
            if not new_violations(bench, fit.trial):
                assert fit.trial.evaluation.cost.total <= lowest.get(vehicle, math.inf) + 1e-9
            else:
                assert vehicle not in lowest
        if all_left_out and any(fit.companions for fit in fits.places):
            # A relation binds those alone who are served, but nobody is served without the others.
            assert all({unit.node for unit in fit.companions} == {
                problem.unit_of(other) for other in nodes} - {node} for fit in fits.places)
