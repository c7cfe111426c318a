from dataclasses import replace

import numpy as np
import pytest

from model.counsel.alternatives import find_alternatives
from model.counsel.bench import Bench
from model.counsel.screening import Screen
from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.solution import Solution, Vehicle
from tests.model.tiny import (
    draw_tiny, with_gaps, with_limits_aboard, with_own_costs, with_setups, with_table,
)
from tests.seeds import seeds

MINUTE = 60_000

A, B, C, D = 1, 2, 3, 4
"""Nodes of the customers at km 1 to 4: two minutes a km by truck, one by drone."""


def plan(problem, *decisions, unassigned=()):
    return Solution(tuple(schedule(problem, decision) for decision in decisions), unassigned)


def route(*nodes, vehicle=0, sorties=(), start=None):
    return RouteDecision(0, vehicle, (TripDecision((0, *nodes, 0), sorties, start=start),))


def found_for(problem, solution, node):
    bench = Bench(problem, solution, node)
    assert bench.plan.evaluation.is_feasible
    return bench, {(each.kind, each.window): each
                   for each in find_alternatives(bench).alternatives}


def added(bench, alternative):
    return alternative.trial.evaluation.cost.total - bench.plan.evaluation.cost.total


def codes(alternative):
    return {violation.code for violation in alternative.trial.evaluation.violations}


def test_each_alternative_costs_what_it_costs_by_hand(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=replace(truck, cost_per_km=1.0, fixed_cost=3.0))
    # One truck to a, b and c and back: 6 km; the other to d and back: 8 km.
    solution = plan(problem, route(A, B, C), route(D, vehicle=1))
    bench, found = found_for(problem, solution, B)
    assert {kind for kind, _ in found} == {"place", "vehicle", "unassigned"}
    # On the way back instead of on the way out, or on the way to d: no detour.
    assert added(bench, found["place", None]) == 0
    assert added(bench, found["vehicle", None]) == 0
    assert found["vehicle", None].trial.place.vehicle == Vehicle(0, 1)
    assert added(bench, found["unassigned", None]) == 1000
    # Without d, the second truck stays at home: 8 km and what it costs to use it.
    bench, found = found_for(problem, solution, D)
    assert bench.left_out.evaluation.cost.total == 1000 + 3 + 6
    assert added(bench, found["vehicle", None]) == 8 - (6 + 8) - 3


def test_place_that_breaks_a_rule_says_which(tiny_problem, customers, truck):
    a, b, c, d = customers
    problem = tiny_problem(a, b, replace(c, demand=(9500,)), d, truck=truck)
    solution = plan(problem, route(A, vehicle=1), route(C), unassigned=(B, D))
    _, found = found_for(problem, solution, A)
    assert codes(found["vehicle", None]) == {"CAPACITY"}
    assert found["unassigned", None].trial.evaluation.is_feasible


def test_drone_instead_of_truck_and_the_other_way_round(tiny_problem, customers, truck, drones):
    carrier = replace(truck, count=1, cost_per_km=1.0, drones=replace(drones, cost_per_km=0.25))
    problem = tiny_problem(*customers, truck=carrier)
    by_truck = plan(problem, route(A, B, C, D))
    # A truck to c saves 2 km, a flight from c to d and back costs 2 km.
    bench, found = found_for(problem, by_truck, D)
    assert found["by", None].trial.place.by == "drone"
    assert added(bench, found["by", None]) == pytest.approx(-2 + 2 * 0.25)
    flown = plan(problem, route(A, B, C, sorties=(SortieDecision((D,), 3, 3),)))
    bench, found = found_for(problem, flown, D)
    assert found["by", None].trial.place.by == "truck"
    assert added(bench, found["by", None]) == pytest.approx(2 - 2 * 0.25)


def test_flights_go_on_elsewhere_when_their_stop_goes(tiny_problem, customers, truck, drones):
    carrier = replace(truck, count=1, cost_per_km=1.0, drones=drones)
    problem = tiny_problem(*customers, truck=carrier)
    solution = plan(problem, route(A, C, sorties=(SortieDecision((D,), 2, 2),)), unassigned=(B,))
    bench = Bench(problem, solution, C)
    assert bench.left_out.evaluation.is_feasible
    (sortie,) = bench.left_out.solution.routes[0].trips[0].sorties
    assert [visit.node for visit in sortie.visits] == [D]


def test_served_by_and_table_forbid_whole_vehicles(tiny_problem, customers, truck, drones):
    a, b, c, d = customers
    carrier = replace(truck, drones=drones)
    problem = tiny_problem(replace(a, served_by="truck"), b, c, d, truck=carrier)
    _, found = found_for(problem, plan(problem, route(A, B, C, D)), A)
    assert codes(found["by", None]) == {"SERVED_BY"}


def test_each_other_window_has_its_price(tiny_problem, customers, truck):
    a, *others = customers
    a = replace(a, earliest=0, latest=100 * MINUTE, gaps=((10 * MINUTE, 60 * MINUTE),))
    problem = tiny_problem(a, *others, truck=replace(truck, count=1, cost_per_hour=60.0))
    solution = plan(problem, route(A, B, C, D))
    bench, found = found_for(problem, solution, A)
    # 36 minutes of work in any case; a in the second window comes last, or the truck starts late.
    assert added(bench, found["window", 1]) == 0
    a, b, *others = problem.customers
    tight = replace(problem, customers=(a, replace(b, latest=20 * MINUTE), *others))
    bench, found = found_for(tight, solution, A)
    # b until minute 20: done with b, c and d at minute 29 at the soonest, at 35 is at a.
    assert found["window", 1].trial.evaluation.is_feasible
    assert added(bench, found["window", 1]) > 0


def test_left_out_customer_gets_a_price_on_each_vehicle(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=replace(truck, cost_per_km=1.0))
    bench = Bench(problem, plan(problem, route(A, B, C), unassigned=(D,)), D)
    prices = {each.trial.place and each.trial.place.vehicle: (each.kind, added(bench, each))
              for each in find_alternatives(bench).alternatives}
    assert prices == {Vehicle(0, 0): ("vehicle", 2 - 1000), Vehicle(0, 1): ("vehicle", 8 - 1000)}


def greedy(problem):
    """Serve everyone where it costs least, one after another."""
    solution = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    for node in range(problem.num_depots, problem.num_nodes):
        bench = Bench(problem, solution, node)
        legal = [each.trial for each in find_alternatives(bench).alternatives
                 if each.window is None and each.trial.evaluation.is_feasible]
        best = min(legal, key=lambda trial: trial.rank, default=None)
        if best is not None:
            solution = best.solution
    return solution


@pytest.mark.thorough_after(5)
@pytest.mark.parametrize("seed", seeds(40))
def test_what_is_said_is_what_the_judge_says(seed):
    rng = np.random.default_rng(seed)
    problem = with_own_costs(rng, draw_tiny(rng))
    problem = with_gaps(rng, problem, 0.4) if seed % 2 else problem
    problem = with_table(rng, problem) if seed % 3 == 0 else problem
    problem = with_limits_aboard(rng, with_setups(rng, problem)) if seed % 4 == 3 else problem
    solution = greedy(problem)
    assert check(problem, solution).is_feasible
    for node in range(problem.num_depots, problem.num_nodes):
        bench = Bench(problem, solution, node)
        for each in find_alternatives(bench).alternatives:
            evaluation = each.trial.evaluation
            judged = check(problem, each.trial.solution)
            if each.window is None:
                assert evaluation == judged
            elif evaluation.is_feasible:
                assert judged.is_feasible or {item.code for item in judged.violations} == {
                    "TIME_MISMATCH"}


@pytest.mark.parametrize("seed", seeds(20))
def test_whoever_is_put_back_costs_what_he_did(seed):
    rng = np.random.default_rng(100 + seed)
    problem = draw_tiny(rng)
    solution = greedy(problem)
    for node in range(problem.num_depots, problem.num_nodes):
        bench = Bench(problem, solution, node)
        if bench.found is None or any(trip.sorties for trip in
                                      solution.routes[bench.found.route].trips):
            continue
        back = bench.put(bench.found.place)
        assert back.evaluation.is_feasible
        assert back.evaluation.cost.total <= bench.plan.evaluation.cost.total + 1e-9


@pytest.mark.parametrize("seed", seeds(12))
def test_small_plan_has_the_cheapest_place_of_each_vehicle_found(seed):
    rng = np.random.default_rng(200 + seed)
    problem = with_gaps(rng, draw_tiny(rng), 0.3)
    solution = greedy(problem)
    for node in range(problem.num_depots, problem.num_nodes):
        bench = Bench(problem, solution, node)
        told = {each.trial.place.vehicle: each.trial
                for each in find_alternatives(bench).alternatives
                if each.kind == "vehicle" and each.trial.place is not None}
        screen = Screen(problem, bench.left_out.solution, node, bench.setting.past)
        for (vehicle, _), guesses in screen.guesses().items():
            trials = [bench.put(guess.place) for guess in guesses] if vehicle in told else []
            for trial in trials:
                if trial.evaluation.is_feasible:
                    assert told[vehicle].evaluation.is_feasible
                    assert (told[vehicle].evaluation.cost.total
                            <= trial.evaluation.cost.total + 1e-9)
