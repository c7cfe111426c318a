"""Tests of `benchmarks.quality.ablation`."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.quality.ablation import (
    BEST_SECONDS, MOVES, MOVES_SECONDS, Sample, Trial, Way, measure, sample, table_of_moves,
    table_of_pairs, table_of_starts, trial, ways,
)
from benchmarks.rows import append_rows, read_rows
from model.planner import PlanCheckError
from model.policy.decode import load_policy
from model.problem import Customer, Problem, VehicleType
from model.solution import Solution

pytestmark = pytest.mark.slow


def made_up(problem: str, size: int, way: Way, cost: float) -> Trial:
    """Return a trial that never was."""
    return Trial(problem, "cvrp", size, way.start, way.seconds, way.without, way.seconds, cost, 0)


def test_sample_is_the_same_every_time_and_for_fewer() -> None:
    more, fewer = sample((4,), 2), sample((4,), 1)
    assert [one.name for one in fewer] == [one.name for one in more if one.index == 0]
    for one, other in zip(fewer, more[::2], strict=True):
        assert np.array_equal(one.problem.coordinates, other.problem.coordinates)


def test_every_way_is_tried_once() -> None:
    chosen = ways((MOVES_SECONDS, 1.0))
    assert len(chosen) == len(set(chosen)) == 5 + len(MOVES)
    assert Way("insertion", BEST_SECONDS) in chosen
    assert ways((0.1,), moves=False) == [Way("insertion", 0.1), Way("policy", 0.1)]


def test_every_problem_is_planned_once_by_every_way() -> None:
    samples = sample((5,), 1, ("cvrp", "drone"))
    chosen = [Way("insertion", 0.05), Way("policy", 0.05), Way("insertion", 0.05, MOVES[0])]
    policy = load_policy(Settings().weights_dir / DEFAULT_POLICY)
    trials = list(measure(samples, policy, chosen))
    assert [(one.problem, one.way) for one in trials] == [
        (one.name, way) for one in samples for way in chosen]
    known = [(one.problem, one.way) for one in trials[1:]]
    assert [one.way for one in measure(samples, policy, chosen, known)] == chosen[:1]


def test_plan_that_breaks_a_rule_is_refused(
    tiny_problem: Callable[..., Problem], truck: VehicleType
) -> None:
    lone = tiny_problem(Customer("a", (1000,)), truck=truck)
    with pytest.raises(PlanCheckError, match="tiny"):
        trial(Sample("tiny", 1, 0, lone), Way("insertion", 1.0), [Solution((), ())], 1.0)


def test_starts_are_compared_with_the_best_plan_of_all() -> None:
    short, long = Way("policy", 0.1), Way("insertion", BEST_SECONDS)
    lines = table_of_starts([made_up("x", 50, short, 121.0), made_up("x", 50, long, 100.0),
                             made_up("y", 100, short, 90.0), made_up("y", 100, long, 99.0)])
    assert lines == [
        "| % | problems | insertion, 3 s | policy, 0.1 s |",
        "| --- | ---: | ---: | ---: |",
        "| cvrp | 2 | 4.88 | 10.00 |",
        "| 50 customers | 1 | 0.00 | 21.00 |",
        "| 100 customers | 1 | 10.00 | 0.00 |",
        "| all | 2 | 4.88 | 10.00 |",
    ]


def test_starts_are_compared_with_each_other() -> None:
    trials = [made_up(name, 50, Way(start, 0.1), cost)
              for name, costs in {"x": (100, 101), "y": (10, 9.9)}.items()
              for start, cost in zip(("insertion", "policy"), costs, strict=True)]
    assert table_of_pairs(trials)[2:] == [
        "| cvrp | 2 | -0.01 ± 1.00 |",
        "| 50 customers | 2 | -0.01 ± 1.00 |",
        "| all | 2 | -0.01 ± 1.00 |",
    ]


def test_moves_are_compared_with_all_of_them() -> None:
    trials = [made_up(name, 50, Way("insertion", MOVES_SECONDS, move), cost)
              for name, costs in {"x": (100, 101, 100, 99, 102),
                                  "y": (10, 10.1, 10, 9.9, 10.2)}.items()
              for move, cost in zip(("", *MOVES), costs, strict=True)]
    assert table_of_moves(trials)[-1] == (
        "| all | 2 | +1.00 ± 0.00 | +0.00 ± 0.00 | -1.00 ± 0.00 | +2.00 ± 0.00 |")


def test_trials_come_back_from_the_file_as_they_were(tmp_path: Path) -> None:
    trials = [made_up("one", 20, Way("policy", 0.1, MOVES[0]), 3.25)]
    append_rows(tmp_path / "ablation.csv", Trial, trials)
    assert read_rows(tmp_path / "ablation.csv", Trial) == trials
