"""The best plan takes over what is better in others, and stays legal."""

import math
import time
from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.engine.instance import pack
from model.problem import Problem, Relation
from model.search import worker
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.improve import SearchConfig, improve
from model.search.route.engine import ANY, anneal, take_better_parts
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.problem_data import make_data
from model.solution import Solution
from training.instances import generate
from tests.model.fliers import charging, from_hubs
from tests.model.search.found import at_best, read_plan, served_by
from tests.seeds import often, seeds

pytestmark = pytest.mark.slow

Routes = dict[frozenset[int], float]

VARIANTS = ("cvrp", "vrptw", "soft", "hetero", "multitrip", "drone", "table1", "mixed", "appointed")


def searched(problem: Problem, seed: int, turns: int) -> tuple[ProblemData, Searcher]:
    """Return a search that is hot, so that its plan is not its best."""
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(seed))
    begin_anew(data, searcher, False)
    searcher.value.temperature, searcher.value.cooling = searcher.value.cost / 50, 1.0
    anneal(data, searcher, turns, ANY)
    return data, searcher


def routes_of(searcher: Searcher, data: ProblemData) -> Routes:
    """Return the customers of each route and what it costs, those left out being routes, too."""
    routes: Routes = {frozenset([node]): data.unassigned_cost + data.unassigned_more[node]
                      for node in searcher.missing[:searcher.count.missing].tolist()}
    return routes | {frozenset(served): float(searcher.cost[slot]) for served, slot in zip(
        served_by(searcher), searcher.active.tolist(), strict=False)}


def cheapest(routes: Routes, left: frozenset[int]) -> float:
    """Return what the cheapest of all choices of routes costs that serves everyone left once."""
    if not left:
        return 0.0
    first = min(left)
    return min((cost + cheapest(routes, left - route) for route, cost in routes.items()
                if first in route and route <= left), default=math.inf)


def test_best_plan_is_the_cheapest_of_the_routes_of_two() -> None:
    better = 0
    for seed in seeds(40):
        problem = generate(np.random.default_rng(seed), 40, "cvrp")
        kind, = problem.vehicle_types
        few = 3 * max(customer.demand[0] for customer in problem.customers)
        problem = replace(problem, vehicle_types=(replace(kind, count=40, capacity=(few,)),))
        data, searcher = searched(problem, seed, 20)
        before = float(searcher.value.best)
        both, other = (routes_of(each, data) for each in (at_best(data, searcher), searcher))
        both |= {route: min(cost, both.get(route, cost)) for route, cost in other.items()}
        take_better_parts(data, searcher)
        everyone = frozenset(range(data.num_depots, data.num_nodes))
        assert float(searcher.value.best) == pytest.approx(cheapest(both, everyone), rel=1e-9)
        better += bool(searcher.value.best < before - 1e-9)
    assert better >= often(4)


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("variant", VARIANTS)
def test_plan_put_together_keeps_all_rules(variant: str) -> None:
    for seed in range(4):
        problem = generate(np.random.default_rng(seed), 40, variant)
        data, searcher = searched(problem, seed, 20)
        for _ in range(20):
            anneal(data, searcher, 5, ANY)
            take_better_parts(data, searcher)
            evaluation = check(problem, read_plan(data, searcher))
            assert evaluation.violations == ()
            assert evaluation.cost.total <= float(searcher.value.best) * (1 + 1e-9)


def test_plans_put_together_take_no_more_than_hubs_have() -> None:
    """Of batteries; where places to charge are shared in time, none are put together."""
    better = 0
    for seed in range(6):
        problem, charged = from_hubs(np.random.default_rng(seed), 60, batteries=8), seed % 2 > 0
        if charged:
            problem = charging(problem, 2)
        data, searcher = searched(problem, seed, 20)
        for _ in range(20):
            anneal(data, searcher, 20, ANY)
            before = float(searcher.value.best)
            take_better_parts(data, searcher)
            better += float(searcher.value.best) < before
            evaluation = check(problem, read_plan(data, searcher))
            assert evaluation.violations == ()
            assert evaluation.cost.total <= float(searcher.value.best) * (1 + 1e-9)
    assert better > 2


def test_who_goes_together_does_so_in_plans_put_together() -> None:
    for seed in (0, 6, 9):
        rng = np.random.default_rng(seed)
        problem = generate(rng, 40, "cvrp")
        nodes = rng.permutation(range(problem.num_depots, problem.num_nodes)).tolist()
        pairs = tuple(Relation("together", (min(pair), max(pair)), "vehicle")
                      for pair in zip(nodes[::2], nodes[1::2], strict=True))
        # So cheap that now one of two is left out, now the other.
        for price in (5.0, 20.0, 40.0):
            paired = replace(problem, relations=pairs, unassigned_cost=price)
            data, searcher = searched(paired, seed, 20)
            for _ in range(30):
                anneal(data, searcher, 5, ANY)
                take_better_parts(data, searcher)
                assert check(paired, read_plan(data, searcher)).violations == ()


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize(("variant", "threads"), [
    ("vrptw", 1), ("hetero", 2), ("drone", 1), ("mixed", 2), ("multitrip", 1)])
def test_search_that_looks_often_is_legal_and_repeatable(
        variant: str, threads: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(worker, "TURNS_A_LOOK", 1)
    monkeypatch.setattr(worker, "MOST_LOOKS", 1_000_000)
    problem = generate(np.random.default_rng(7), 60, variant)
    config = SearchConfig(seed=3, threads=threads, turns=2000 * threads)
    found, again = (improve(problem, pack([problem]), Solution((), ()), config) for _ in range(2))
    evaluation = check(problem, found.solution)
    assert evaluation.violations == ()
    assert evaluation.cost.total <= found.cost * (1 + 1e-9)
    assert found.solution == again.solution


def test_clock_has_no_say_in_when_turns_are_looked_at() -> None:
    problem = generate(np.random.default_rng(5), 80, "cvrp")
    nothing, instance = Solution((), ()), pack([problem])
    config = SearchConfig(seed=1, turns=8000)
    by_turns = improve(problem, instance, nothing, config)
    by_both = improve(problem, instance, nothing, config, deadline=time.perf_counter() + 600)
    assert by_turns.solution == by_both.solution


def test_search_finds_more_by_putting_parts_together(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(worker, "TURNS_A_LOOK", 1)
    monkeypatch.setattr(worker, "LINKED_LOOKS", 1)
    problem = generate(np.random.default_rng(9), 420, "cvrp")
    configs = [SearchConfig(seed=seed, turns=10_000) for seed in range(3)]

    def costs() -> list[float]:
        return [improve(problem, pack([problem]), Solution((), ()), config).cost
                for config in configs]

    together = costs()
    monkeypatch.setattr(worker, "take_better_parts", lambda data, searcher: None)
    alone = costs()
    assert all(one <= other for one, other in zip(together, alone, strict=True))
    assert sum(together) < sum(alone)


def test_nothing_is_put_together_where_no_time_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    looked: list[int] = []
    monkeypatch.setattr(worker, "take_better_parts", lambda data, searcher: looked.append(1))
    monkeypatch.setattr(worker, "LOOK", 1e6)
    monkeypatch.setattr(worker, "TURNS_A_LOOK", 1)
    problem = generate(np.random.default_rng(5), 30, "cvrp")
    end = time.perf_counter() + 0.3
    improve(problem, pack([problem]), Solution((), ()), SearchConfig(seed=1), deadline=end)
    assert not looked
