"""Tests of `versus` and of what it is made of: peers, workers, results and report."""

import math
import os
import threading
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from importlib.util import find_spec
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest
import typer

from benchmarks.peers import hgs, ortools, pyvrp, versus, vroom, vrpcli
from benchmarks.peers.answers import PeerAnswer, PeerRoute, better, judge, useful_counts
from benchmarks.peers.published import NO_LIMIT, Published, PublishedVehicle, to_problem
from benchmarks.peers.report import markers, table, write
from benchmarks.peers.versus import in_turn, runs
from benchmarks.peers.workers import SOLVERS, NoPlanError, Solver, Worker, require_installed
from benchmarks.results import Result
from benchmarks.rows import append_rows, columns, read_rows

pytestmark = pytest.mark.slow

FILE = """TINY

VEHICLE
NUMBER     CAPACITY
  2         10

CUSTOMER
CUST NO.  XCOORD.   YCOORD.    DEMAND   READY TIME  DUE DATE   SERVICE   TIME

    0      0         0          0          0       100          0
    1      1         0          4          0       100          1
    2      2         0          4          0       100          1
    3      3         0          4          0       100          1
"""


def answer(*routes: PeerRoute) -> PeerAnswer:
    """Return a plan that took a tenth of a second."""
    return PeerAnswer(list(routes), 0.1, "1.0")


def solve_well(instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
    """Plan the tiny instance well, for 4 + 6 units; 2 + 6 is best."""
    return answer((0, [[1, 2]]), (0, [[3]]))


def crash(instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
    """End the process without a word."""
    os._exit(3)


def hang(instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
    """Never come back."""
    threading.Event().wait()
    return None


def crash_on_second(instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
    """Crash on one seed only."""
    return crash(instance, seconds, seed) if seed == 2 else solve_well(instance, seconds, seed)


def decline(instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
    """Be unable to plan such instances."""
    return None


@pytest.fixture
def tiny() -> Published:
    """Three customers on a street, four units each, in the unit of Solomon's set."""
    places = np.arange(4)
    return Published(
        "tiny", "solomon", np.column_stack([places, 0 * places]).astype(np.float64),
        demand=np.array([0, 4, 4, 4]), earliest=np.zeros(4, np.int64),
        latest=np.full(4, 1000), service=np.array([0, 10, 10, 10]),
        release=np.zeros(4, np.int64), travel=10 * np.abs(np.subtract.outer(places, places)),
        vehicles=(PublishedVehicle(2, 10, 0, 1),), max_trips=1, has_windows=True, divisor=10,
        best_known=8.0)


@pytest.fixture
def without_windows(tiny: Published) -> Published:
    """The same as a plain capacitated problem with a vehicle for everybody."""
    return replace(tiny, latest=np.full(4, NO_LIMIT), has_windows=False,
                   vehicles=(PublishedVehicle(3, 10, 0, 1),))


def row(solver: str, gap: float, **others: object) -> Result:
    """Return a result of a plan that counts if it has a gap."""
    is_good = not math.isnan(gap)
    made_up = Result("solomon", "R101", 100, solver, 1, 1.0, 1, 1.0, 10 + gap / 10, 10.0, gap,
                     is_good, True, "1.0", "2026-01-01", "a machine, 2 cores")
    return replace(made_up, **others)


def test_plan_costs_what_its_set_says(tiny: Published) -> None:
    verdict = judge(to_problem(tiny), [(0, [[1, 2]]), (0, [[]]), (0, [[3]])])
    assert verdict.cost == pytest.approx(10.0)
    assert verdict.counts


def test_plan_without_a_customer_is_feasible_but_does_not_count(tiny: Published) -> None:
    verdict = judge(to_problem(tiny), [(0, [[1, 2]])])
    assert (verdict.is_feasible, verdict.num_missing, verdict.counts) == (True, 1, False)
    assert verdict.cost == pytest.approx(4.0)


@pytest.mark.parametrize("routes", [
    [(0, [[1, 2, 3]])],
    [(0, [[1]]), (0, [[2]]), (0, [[3]])],
    [(0, [[1, 2], [3]])],
    [(0, [[1, 2]]), (0, [[2, 3]])],
], ids=["overload", "too many vehicles", "a second trip", "a customer twice"])
def test_plan_that_breaks_a_rule_is_infeasible(tiny: Published, routes: list[PeerRoute]) -> None:
    assert not judge(to_problem(tiny), routes).is_feasible


def test_late_plan_is_infeasible(tiny: Published) -> None:
    hurried = replace(tiny, latest=np.array([1000, 1000, 1000, 30]))
    assert judge(to_problem(hurried), [(0, [[3]]), (0, [[1, 2]])]).is_feasible
    assert not judge(to_problem(hurried), [(0, [[2, 3]]), (0, [[1]])]).is_feasible


def test_several_trips_are_judged_where_they_are_allowed(tiny: Published) -> None:
    one = replace(tiny, max_trips=2, vehicles=(PublishedVehicle(1, 10, 0, 1),))
    assert judge(to_problem(one), [(0, [[1, 2], [3]])]).counts


def test_better_plan_is_complete_before_it_is_cheap(tiny: Published) -> None:
    cheap, dear = answer((0, [[1, 2]])), answer((0, [[1, 2]]), (0, [[3]]))
    best, illegal = answer((0, [[1]]), (0, [[2, 3]])), answer((0, [[1, 2, 3]]))
    assert better(tiny, cheap, dear) is dear
    assert better(tiny, dear, best) is best
    assert better(tiny, illegal, dear) is dear


def test_as_many_vehicles_are_offered_as_windows_need(tiny: Published) -> None:
    many = (PublishedVehicle(50, 100, 0, 1),)
    apart = replace(tiny, vehicles=many)
    assert useful_counts(apart) == [3]
    at_once = replace(tiny, vehicles=many, latest=np.array([1000, 10, 20, 30]),
                      earliest=np.array([0, 10, 20, 30]))
    assert useful_counts(at_once) == [5]
    assert useful_counts(replace(at_once, vehicles=(PublishedVehicle(2, 100, 0, 1),))) == [2]


def test_solvers_decline_what_they_cannot_plan(tiny: Published) -> None:
    reloading = replace(tiny, max_trips=2)
    late = replace(tiny, release=np.array([0, 0, 5, 0]))
    for peer in (hgs, ortools, vroom, vrpcli):
        assert peer.solve(reloading, 1.0, 1) is None
        assert peer.solve(late, 1.0, 1) is None
    assert hgs.solve(tiny, 1.0, 1) is None
    assert vrpcli.solve(tiny, 0.1, 1) is None


@pytest.mark.parametrize("name", ["pyvrp", "vroom", "ortools"])
def test_solver_that_is_installed_finds_the_best_plan(tiny: Published, name: str) -> None:
    if find_spec(SOLVERS[name].module) is None:
        pytest.skip(f"{name} isn't installed")
    # In a process of its own, as benchmarks have it: OR-Tools doesn't go with another HiGHS.
    with ProcessPoolExecutor(1, get_context("spawn")) as executor:
        found = executor.submit(SOLVERS[name].solve, tiny, 0.05, 1).result()
    assert found is not None
    verdict = judge(to_problem(tiny), found.routes)
    assert verdict.counts
    assert verdict.cost == pytest.approx(8.0)


def test_hgs_if_installed_finds_the_best_plan(without_windows: Published) -> None:
    pytest.importorskip("hygese")
    found = hgs.solve(without_windows, 0.05, 1)
    assert found is not None
    assert judge(to_problem(without_windows), found.routes).cost == pytest.approx(8.0)


def test_pyvrp_if_installed_reloads_and_waits_for_releases(tiny: Published) -> None:
    pytest.importorskip("pyvrp")
    late = replace(tiny, max_trips=3, vehicles=(PublishedVehicle(1, 10, 0, 1),),
                   release=np.array([0, 0, 0, 900]))
    found = pyvrp.solve(late, 0.05, 1)
    verdict = judge(to_problem(late), found.routes)
    assert verdict.counts
    assert verdict.cost == pytest.approx(8.0)


def test_crash_costs_one_plan(tiny: Published) -> None:
    worker = Worker(Solver(crash_on_second, "json"))
    try:
        assert worker.run(tiny, 1.0, 1) == solve_well(tiny, 1.0, 1)
        with pytest.raises(NoPlanError, match="code 3"):
            worker.run(tiny, 1.0, 2)
        assert worker.run(tiny, 1.0, 1) == solve_well(tiny, 1.0, 1)
    finally:
        worker.close()


def test_overrun_is_ended(tiny: Published, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("benchmarks.peers.workers.WARM_PATIENCE", 0.1)
    worker = Worker(Solver(hang, "json"))
    with pytest.raises(NoPlanError, match=r"no answer within 0\.1 s"):
        worker.run(tiny, 1.0, 1)


def test_unknown_and_missing_solvers_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(SOLVERS, "absent", Solver(solve_well, "no_such_package"))
    with pytest.raises(ValueError, match="'excel' is none of tandem, "):
        require_installed(["excel"])
    with pytest.raises(ValueError, match="absent needs the package no_such_package"):
        require_installed(["absent"])


def test_sets_take_turns(tiny: Published) -> None:
    a, b, c = (replace(tiny, name=name) for name in "abc")
    assert [instance.name for instance in in_turn([[a, b], [c]])] == ["a", "c", "b"]


def test_solvers_take_turns_and_only_those_with_seeds_are_repeated(tiny: Published) -> None:
    planned = [(run.solver, run.budget, run.seed)
               for run in runs([tiny], ["pyvrp", "vroom"], [0.1, 1.0], num_seeds=2)]
    assert planned == [
        ("pyvrp", 0.1, 1), ("vroom", 0.1, 1), ("vroom", 1.0, 1), ("pyvrp", 1.0, 1),
        ("pyvrp", 0.1, 2), ("pyvrp", 1.0, 2)]


def measure(folder: Path, **options: object) -> list[Result]:
    """Measure a made-up Solomon instance and return all rows of the CSV."""
    (folder / "solomon").mkdir(exist_ok=True)
    (folder / "solomon" / "TINY.txt").write_text(FILE, encoding="utf-8")
    (folder / "best_known.csv").write_text(
        "instance,set,n,best_known_cost\nTINY,solomon,3,8\n", encoding="utf-8")
    output = folder / "runs" / "versus.csv"
    chosen = {"data": folder, "sets": "solomon", "budgets": "0.1", "seeds": 1, "solvers": "good",
              "output": output, **options}
    versus.main(**chosen)
    return read_rows(output, Result)


def test_measurement_goes_on_where_it_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(SOLVERS, "good", Solver(solve_well, "json"))
    monkeypatch.setitem(SOLVERS, "bad", Solver(crash, "json"))
    monkeypatch.setitem(SOLVERS, "unable", Solver(decline, "json"))
    [first] = measure(tmp_path)
    assert first.key == ("solomon", "TINY", "good", 0.1, 1)
    assert (first.n, first.cost, first.gap_percent, first.counts) == (3, 10.0, 25.0, True)
    again = measure(tmp_path, solvers="good,bad,unable")
    assert again[0] == first
    [second] = again[1:]
    assert (second.solver, second.counts, second.version) == ("bad", False, "")
    assert math.isnan(second.cost)


def test_wrong_options_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(SOLVERS, "good", Solver(solve_well, "json"))
    for wrong in ({"solvers": "excel"}, {"sets": "excel"}, {"budgets": "long"}):
        with pytest.raises(typer.BadParameter):
            measure(tmp_path, **wrong)


def test_results_survive_their_file(tmp_path: Path) -> None:
    path = tmp_path / "new" / "versus.csv"
    results = [row("pyvrp", 1.5), row("hgs", math.nan, cost=math.nan, version="")]
    append_rows(path, Result, results[:1])
    append_rows(path, Result, results[1:])
    assert str(read_rows(path, Result)) == str(results)
    assert path.read_text(encoding="utf-8").count(",".join(columns(Result))) == 1


def test_file_that_holds_no_results_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "versus.csv"
    path.write_text("a,b\n1,2\n", encoding="utf-8")
    with pytest.raises(ValueError, match="columns"):
        read_rows(path, Result)
    path.write_text(",".join(columns(Result)) + "\nsolomon,R101\n", encoding="utf-8")
    with pytest.raises(ValueError, match="line 2"):
        read_rows(path, Result)


def test_table_shows_gaps_spread_failures_and_overruns() -> None:
    lines = table([
        row("tandem", 1.0), row("tandem", 2.0, seed=2), row("pyvrp", 3.0),
        row("pyvrp", math.nan, seed=2), row("vroom", 9.0, wall_s=2.5), row("ortools", math.nan)])
    assert lines == [
        "| set (instances) | s | tandem | pyvrp | vroom | ortools | Tandem / best |",
        "| --- | ---: | --- | --- | --- | --- | ---: |",
        "| solomon (1) | 1 | **1.50** ± 0.71 | 3.00 (1 of 2 failed) | 9.00 (took 2.5 s) "
        "| none (1 of 1 failed) | 0.50 |"]


def test_page_keeps_what_is_around_its_part(tmp_path: Path) -> None:
    page = tmp_path / "docs" / "benchmarks.md"
    begin, _ = markers("versus")
    results = [row("tandem", 1.0), row("pyvrp", 0.0, set="cvrp_x", budget_s=0.1)]
    write(results, page)
    plots = {path.name: path.read_bytes() for path in page.parent.glob("*.svg")}
    assert set(plots) == {"anytime.svg", "by_size.svg"}
    text = page.read_text(encoding="utf-8")
    assert "Measured on 2026-01-01, a machine, 2 cores" in text
    kept = text.replace(begin, f"Before.\n{begin}") + "After.\n"
    page.write_text(kept, encoding="utf-8")
    write(results, page)
    assert page.read_text(encoding="utf-8") == kept
    assert {path.name: path.read_bytes() for path in page.parent.glob("*.svg")} == plots


def test_parts_of_a_page_are_written_one_by_one(tmp_path: Path) -> None:
    page = tmp_path / "benchmarks.md"
    page.write_text("\n".join([*markers("versus"), *markers("rule-sets")]), encoding="utf-8")
    write([row("tandem", 1.0)], page, "rule-sets")
    assert page.read_text(encoding="utf-8").startswith("\n".join(markers("versus")))
    assert [path.name for path in tmp_path.iterdir()] == ["benchmarks.md"]


def test_page_without_a_part_of_its_own_is_refused(tmp_path: Path) -> None:
    page = tmp_path / "benchmarks.md"
    page.write_text(f"# Mine\n\n{markers('versus')[1]}\n", encoding="utf-8")
    with pytest.raises(ValueError, match="has no part between"):
        write([row("tandem", 1.0)], page)


@pytest.mark.parametrize("seconds", [0.0, 0.05])
@pytest.mark.parametrize("policy", ["attention", "pointer"])
def test_policies_alone_plan_published_instances(tiny: Published, policy: str,
                                                 seconds: float) -> None:
    found = SOLVERS[policy].solve(tiny, seconds, 1)
    assert found is not None
    assert judge(to_problem(tiny), found.routes).counts
