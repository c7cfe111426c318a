"""Tests of `benchmarks.quality.drones`, on a street with three customers."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
import typer

from benchmarks.quality import drones
from benchmarks.quality.drones import DroneResult, Run, judge, plan, result, table
from benchmarks.quality.truck_drone_rules import LOOPS, TruckDroneInstance
from benchmarks.rows import append_rows, read_rows
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import Customer, DroneType, Problem, VehicleType
from model.solution import Solution

pytestmark = pytest.mark.slow

BEST_WITHOUT_LOOPS = 4.0
"""The truck serves a, the drone b on the way out and c on the way home, or the other way round."""


@pytest.fixture
def problem(tiny_problem: Callable[..., Problem]) -> Problem:
    """A kilometre costs 1, by drone a quarter; a drone serves one customer at a time."""
    drone = DroneType(1, (1000,), travel=1, cost_per_km=0.25)
    truck = VehicleType("truck", 1, (10_000,), 0, cost_per_km=1.0, drones=drone)
    return tiny_problem(*(Customer(name, (1000,)) for name in "abc"), truck=truck)


@pytest.fixture
def instance(problem: Problem) -> TruckDroneInstance:
    """A set that forbids loops."""
    return TruckDroneInstance("tiny", "made_up", 3, problem, BEST_WITHOUT_LOOPS, "optimal",
                              frozenset({LOOPS}), (problem,), heuristic=5.0)


def scheduled(problem: Problem, stops: tuple[int, ...], *sorties: SortieDecision) -> Solution:
    """Return a plan of one trip; whom it doesn't visit is left out."""
    served = {*stops, *(node for sortie in sorties for node in sortie.nodes)}
    route = schedule(problem, RouteDecision(0, 0, (TripDecision(stops, sorties),)))
    return Solution((route,), tuple(sorted({1, 2, 3} - served)))


def driven(problem: Problem) -> Solution:
    """The truck serves everybody, for 6."""
    return scheduled(problem, (0, 1, 2, 3, 0))


def looped(problem: Problem) -> Solution:
    """The drone loops from b to c, for 4.5."""
    return scheduled(problem, (0, 1, 2, 0), SortieDecision((3,), 2, 2))


def row(**others: object) -> DroneResult:
    """Return a result that reached its reference."""
    made_up = DroneResult("made_up", "tiny", 3, "optimal", 1, 1.0, 1, 1.0, 4.0, 4.0, 0.0, -20.0,
                          feasible=True, complete=True, broken=0, date="2026-01-01",
                          machine="a machine, 2 cores")
    return replace(made_up, **others)


def test_gaps_are_those_to_the_reference_and_the_heuristic(instance: TruckDroneInstance) -> None:
    verdict = judge(instance, [driven(instance.problem)])
    judged = result(Run(instance, 1, 1.0, 1), verdict, 0.5)
    assert judged.counts
    assert (judged.cost, judged.gap_percent, judged.heuristic_gap_percent) == (6.0, 50.0, 20.0)


def test_plan_that_its_set_forbids_has_no_gap(instance: TruckDroneInstance) -> None:
    judged = result(Run(instance, 1, 1.0, 1), judge(instance, [looped(instance.problem)]), 0.5)
    assert (judged.failed, judged.broken, judged.counts) == (False, 1, False)
    assert judged.cost == pytest.approx(4.5)
    assert math.isnan(judged.gap_percent)


def test_plan_that_leaves_a_customer_out_fails(instance: TruckDroneInstance) -> None:
    verdict = judge(instance, [scheduled(instance.problem, (0, 1, 2, 0))])
    assert (verdict.failed, verdict.feasible, verdict.complete) == (True, True, False)


def test_best_variant_counts_and_legal_is_better_than_cheap(instance: TruckDroneInstance) -> None:
    both = replace(instance, variants=(instance.problem,) * 2)
    verdict = judge(both, [looped(instance.problem), driven(instance.problem)])
    assert (verdict.cost, verdict.broken) == (6.0, 0)
    with pytest.raises(ValueError, match="shorter"):
        judge(both, [driven(instance.problem)])


def test_search_keeps_to_the_rules_of_the_set(instance: TruckDroneInstance) -> None:
    verdict = judge(instance, plan(instance, 0.1, seed=1, threads=1))
    assert (verdict.failed, verdict.broken) == (False, 0)
    assert verdict.cost == pytest.approx(BEST_WITHOUT_LOOPS)


def test_rows_come_back_from_the_file_as_they_were(tmp_path: Path) -> None:
    path = tmp_path / "new" / "drones.csv"
    assert read_rows(path, DroneResult) == []
    first, second = row(), row(instance="other", feasible=False, seed=2, cost=4.25)
    append_rows(path, DroneResult, [first])
    append_rows(path, DroneResult, [second])
    assert read_rows(path, DroneResult) == [first, second]


def test_table_has_a_line_for_each_group() -> None:
    lines = table([
        row(), row(instance="worse", gap_percent=2.0, heuristic_gap_percent=math.nan),
        row(instance="forbidden", broken=1, gap_percent=math.nan, heuristic_gap_percent=math.nan),
        row(instance="late", feasible=False, gap_percent=math.nan,
            heuristic_gap_percent=math.nan),
        row(budget_s=10.0),
    ])
    assert lines[2:] == [
        "| made_up | 3 | optimal | 1 | 1 | 4 | 1.000 | 2.00 | 1/2 | -20.000 | 1 | 1 |",
        "| made_up | 3 | optimal | 10 | 1 | 1 | 0.000 | 0.00 | 1/1 | -20.000 | 0 | 0 |",
    ]


def test_sample_is_the_same_every_time(instance: TruckDroneInstance) -> None:
    many = [replace(instance, name=str(number)) for number in range(9)]
    large = [replace(one, size=50) for one in many]
    chosen = drones.sample([*many, *large], 4)
    assert [one.size for one in chosen] == [3] * 4 + [50] * 4
    assert chosen == drones.sample([*many, *large], 4)
    assert drones.sample(many, None) == many


def test_runs_that_have_a_row_are_not_repeated(
    instance: TruckDroneInstance, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(drones, "LOADERS", {"made_up": lambda folder: [instance]})
    monkeypatch.setattr(drones, "count_processor_time", lambda: None)  # not for all tests
    output, markdown = tmp_path / "drones.csv", tmp_path / "drones.md"
    for seeds in (1, 2, 2):
        drones.main(tmp_path, output, "made_up", "0.05", seeds=seeds, markdown=markdown)
        assert [one.seed for one in read_rows(output, DroneResult)] == list(range(1, seeds + 1))
    assert markdown.read_text("utf-8").splitlines() == table(read_rows(output, DroneResult))


def test_unknown_sets_are_refused(tmp_path: Path) -> None:
    with pytest.raises(typer.BadParameter, match="no moons"):
        drones.main(tmp_path, tmp_path / "drones.csv", "moons")
