"""The planner over thousands of random problems, with the policies as committed."""

from pathlib import Path

import numpy as np
import pytest

from model import planner as planner_module
from model.check import check
from model.planner import Planner, PlanCheckError, PlanOptions, load_planner, small_problem
from model.rules import Violation
from training.instances import VARIANTS, generate
from training.variants import InstanceConfig

WEIGHTS = Path(__file__).parents[2] / "model" / "weights"
POLICIES = sorted(folder.name for folder in WEIGHTS.iterdir())
NUM_PROBLEMS = 2000
SPOILED = InstanceConfig(spoiled=1.0, max_spoiled=0.5)


@pytest.fixture(scope="module")
def planner() -> Planner:
    return load_planner(WEIGHTS, POLICIES)


def test_every_plan_of_random_problems_passes_the_checker(planner: Planner) -> None:
    rng = np.random.default_rng(17)
    variants = list(VARIANTS)
    unassigned = 0
    for index in range(NUM_PROBLEMS):
        config = SPOILED if index % 3 == 0 else InstanceConfig()
        problem = generate(rng, int(rng.integers(1, 26)), variants[index % len(variants)], config)
        sampled = index % 4 == 0
        options = PlanOptions(POLICIES[index % len(POLICIES)], "sample" if sampled else "greedy",
                              num_samples=3, seed=index, time_limit=0.0)
        result = planner.plan(problem, options)
        evaluation = check(problem, result.solution)
        assert not evaluation.violations
        assert evaluation.cost.total == result.final_cost
        unassigned += len(result.solution.unassigned)
    assert unassigned > 100


def test_a_plan_that_fails_the_check_never_leaves(planner: Planner,
                                                  monkeypatch: pytest.MonkeyPatch) -> None:
    def strict(problem: object, solution: object) -> object:
        evaluation = check(problem, solution)  # type: ignore[arg-type]
        wrong = Violation("CAPACITY", "too much", "routes[0]")
        return type(evaluation)(**{**vars(evaluation), "violations": (wrong,)})

    monkeypatch.setattr(planner_module, "check", strict)
    with pytest.raises(PlanCheckError, match=r"routes\[0\]: too much"):
        planner.plan(small_problem(), PlanOptions(POLICIES[0]))


def test_unknown_policy_is_refused(planner: Planner) -> None:
    with pytest.raises(ValueError, match="policy: 'best'"):
        planner.plan(small_problem(), PlanOptions("best"))


def test_warming_tells_its_progress(planner: Planner) -> None:
    told: list[str] = []
    planner.warm(told.append)
    assert [POLICIES[0] in line for line in told[:2]] == [True, True]
