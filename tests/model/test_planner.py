"""The planner over thousands of random problems, with the policies as committed."""

import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from model.judge import memory
from model.judge.check import JudgedRoute, check, judge_route
from model.judge.past import Past
from model.judge.rules import Violation
from model.planner import Listener, Planner, PlanOptions, PlanResult, load_planner
from model.problem import Problem
from model.search.improve import Progress
from model.solution import Route
from model.together.pulling import nobody_served
from training.instances import VARIANTS, generate
from training.variants import InstanceConfig
from tests.seeds import often

pytestmark = pytest.mark.slow

WEIGHTS = Path(__file__).parents[2] / "model" / "weights"
POLICIES = sorted(folder.name for folder in WEIGHTS.iterdir())
NUM_DECODED = often(300)
NUM_IMPROVED = often(160)
NUM_ENDED = often(60)
TIME_LIMIT = 0.02
SPOILED = InstanceConfig(spoiled=1.0, max_spoiled=0.5)


@pytest.fixture(scope="module")
def planner() -> Planner:
    return load_planner(WEIGHTS, POLICIES)


def mixed_problem(rng: np.random.Generator, index: int) -> Problem:
    """Draw a problem; variants take turns, some are spoiled, some drones serve several a sortie."""
    config = SPOILED if index % 3 == 0 else InstanceConfig()
    variants = list(VARIANTS)
    problem = generate(rng, int(rng.integers(1, 26)), variants[index % len(variants)], config)
    if index % 5 > 0:
        return problem
    kinds = [kind if kind.drones is None else
             replace(kind, drones=replace(kind.drones, max_customers_per_sortie=3))
             for kind in problem.vehicle_types]
    return replace(problem, vehicle_types=tuple(kinds))


def plan_checked(planner: Planner, problem: Problem, options: PlanOptions) -> PlanResult:
    """Plan a problem; the plan must be legal and cost what the planner says."""
    result = planner.plan(problem, options)
    evaluation = check(problem, result.solution)
    assert not evaluation.violations
    assert evaluation.cost.total == result.final_cost
    return result


def test_every_decoded_plan_of_random_problems_passes_the_checker(planner: Planner) -> None:
    rng = np.random.default_rng(17)
    unassigned = 0
    for index in range(NUM_DECODED):
        sampled = index % 4 == 0
        options = PlanOptions(POLICIES[index % len(POLICIES)], "sample" if sampled else "greedy",
                              num_samples=3, seed=index, time_limit=0.0)
        result = plan_checked(planner, mixed_problem(rng, index), options)
        assert (result.start, result.search_iterations) == ("policy", 0)
        assert result.decoded_cost == result.final_cost
        assert result.deterministic
        unassigned += len(result.solution.unassigned)
    assert unassigned > often(25)


def test_every_improved_plan_of_random_problems_is_legal_and_no_dearer(planner: Planner) -> None:
    rng = np.random.default_rng(18)
    unassigned = cheaper = 0
    for index in range(NUM_IMPROVED):
        options = PlanOptions(POLICIES[index % len(POLICIES)], seed=index, time_limit=60.0,
                              search_iterations=100, threads=1 + (index % 10 == 0))
        result = plan_checked(planner, mixed_problem(rng, index), options)
        assert result.final_cost <= result.decoded_cost
        assert result.deterministic
        cheaper += result.final_cost < result.decoded_cost * (1 - 1e-9)
        unassigned += len(result.solution.unassigned)
    assert unassigned > often(8)
    assert cheaper > NUM_IMPROVED / 2


def test_every_plan_that_the_clock_ends_is_legal_and_no_dearer(planner: Planner) -> None:
    rng = np.random.default_rng(19)
    for index in range(NUM_ENDED):
        options = PlanOptions(POLICIES[index % len(POLICIES)], seed=index, time_limit=TIME_LIMIT,
                              threads=1 + (index % 10 == 0))
        result = plan_checked(planner, mixed_problem(rng, index), options)
        assert result.final_cost <= result.decoded_cost
        assert not result.deterministic


@pytest.mark.by_clock
@pytest.mark.parametrize("num_customers", [30, 100, 300])
def test_plans_come_in_time(planner: Planner, num_customers: int) -> None:
    for variant in ("vrptw", "mixed"):
        problem = generate(np.random.default_rng(num_customers), num_customers, variant)
        began = time.perf_counter()
        planner.plan(problem, PlanOptions(POLICIES[0], time_limit=60.0, search_iterations=1))
        time_limit = max(0.1, 4 * (time.perf_counter() - began))
        began = time.process_time()
        result = planner.plan(problem, PlanOptions(POLICIES[0], time_limit=time_limit))
        assert time.process_time() - began <= time_limit + 0.2
        assert result.search_iterations > 0


def test_time_limit_runs_from_when_the_request_came(planner: Planner) -> None:
    problem = generate(np.random.default_rng(1), 20, "vrptw")
    began = time.process_time()
    planner.plan(problem, PlanOptions(POLICIES[0], time_limit=60.0), time.perf_counter() - 59.9)
    assert time.process_time() - began < 5


def test_listener_stops_the_search_and_its_plan_is_checked(planner: Planner) -> None:
    problem = generate(np.random.default_rng(2), 30, "hetero")
    told: list[Progress] = []
    began = time.process_time()
    result = planner.plan(problem, PlanOptions(POLICIES[0], time_limit=120.0),
                          listener=Listener(lambda: len(told) > 0, told.append))
    assert time.process_time() - began < 20
    assert check(problem, result.solution).violations == ()
    assert not result.deterministic


@pytest.mark.parametrize("threads", [1, 2])
def test_progress_is_told_and_never_rises(planner: Planner, threads: int) -> None:
    problem = generate(np.random.default_rng(3), 25, "drone")
    costs: list[float] = []
    options = PlanOptions(POLICIES[0], time_limit=60.0, search_iterations=500, threads=threads)
    result = planner.plan(problem, options,
                          listener=Listener(on_progress=lambda told: costs.append(told.cost)))
    assert len(costs) > 10
    assert costs == sorted(costs, reverse=True)
    assert result.final_cost <= costs[-1] * (1 + 1e-9)


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("variant", ["vrptw", "mixed"])
def test_same_seed_iterations_and_threads_give_the_same_plan(
        planner: Planner, threads: int, variant: str) -> None:
    problem = generate(np.random.default_rng(4), 40, variant)
    options = PlanOptions(POLICIES[0], seed=5, time_limit=60.0, search_iterations=4001,
                          threads=threads)
    first = planner.plan(problem, options)
    assert first.deterministic
    assert first.search_iterations == 4001 // threads * threads
    assert first.threads == threads
    for _ in range(3):
        assert planner.plan(problem, options).solution == first.solution


def test_other_seeds_give_other_plans(planner: Planner) -> None:
    problem = generate(np.random.default_rng(4), 40, "vrptw")
    plans = {planner.plan(problem, PlanOptions(POLICIES[0], seed=seed, time_limit=60.0,
                                               search_iterations=100)).solution
             for seed in range(5)}
    assert len(plans) > 1


def test_clock_that_ends_the_search_is_owned_up_to(planner: Planner) -> None:
    problem = generate(np.random.default_rng(4), 30, "vrptw")
    for iterations in (None, 10**12):
        options = PlanOptions(POLICIES[0], time_limit=0.1, search_iterations=iterations)
        assert not planner.plan(problem, options).deterministic


def test_without_time_or_iterations_the_plan_is_the_policys(planner: Planner) -> None:
    problem = generate(np.random.default_rng(6), 20, "drone")
    by_limit = planner.plan(problem, PlanOptions(POLICIES[0], time_limit=0.0,
                                                 search_iterations=50))
    by_count = planner.plan(problem, PlanOptions(POLICIES[0], time_limit=9.0,
                                                 search_iterations=0))
    assert by_limit.solution == by_count.solution
    for result in (by_limit, by_count):
        assert result.start == "policy"
        assert result.search_iterations == 0
        assert result.elapsed.search == 0.0
        assert result.decoded_cost == result.final_cost
        assert result.deterministic


@pytest.mark.parametrize(("variant", "customers", "start"), [
    ("vrptw", 40, "policy"), ("vrptw", 100, "insertion"), ("hetero", 100, "policy"),
    ("table1", 100, "policy"), ("table1", 300, "insertion")])
def test_policy_begins_where_that_is_worth_its_time(
        variant: str, customers: int, start: str, planner: Planner,
        monkeypatch: pytest.MonkeyPatch) -> None:
    # It is not given up, however slow the machine.
    monkeypatch.setattr("model.planner.GIVE_UP_SHARE", 1e9)
    problem = generate(np.random.default_rng(7), customers, variant)
    result = plan_checked(planner, problem, PlanOptions(POLICIES[0], time_limit=0.1))
    assert result.start == start
    assert (result.elapsed.decode == 0.0) == (start == "insertion")
    assert result.final_cost <= result.decoded_cost


@pytest.mark.plans_are_refused
def test_a_plan_that_fails_the_check_never_leaves(
        planner: Planner, monkeypatch: pytest.MonkeyPatch,
        caplog: pytest.LogCaptureFixture) -> None:
    def strict(problem: Problem, route: Route, path: str, past: Past) -> JudgedRoute:
        judged = judge_route(problem, route, path, past)
        return replace(judged, violations=[Violation("CAPACITY", "too much", path)])

    monkeypatch.setattr(memory, "judge_route", strict)
    problem = mixed_problem(np.random.default_rng(1), 1)
    for time_limit in (0.0, 0.05):
        result = planner.plan(problem, PlanOptions(POLICIES[0], time_limit=time_limit))
        assert result.solution == nobody_served(problem)
        assert result.refused > 0
        assert "routes[0]: too much" in caplog.text


def test_unknown_policy_is_refused(planner: Planner) -> None:
    with pytest.raises(ValueError, match="policy: 'best'"):
        planner.plan(mixed_problem(np.random.default_rng(1), 1), PlanOptions("best"))
