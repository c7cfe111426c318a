"""Tests of `benchmarks.study`."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from app.requests.conversion.problem import to_problem
from benchmarks.study.__main__ import keep_cheaper, run
from benchmarks.study.cases import customers_of, example, request_of, windows_of
from benchmarks.study.findings import on_fleets, on_search
from benchmarks.study.planning import plan_one
from benchmarks.study.printed import broken_rules, groups, measured, printed_rows, visits
from benchmarks.study.report import write_report
from benchmarks.study.tables import against_table, hours_table, rises, turns_table
from benchmarks.study.tasks import (
    FULL, GREEDY, MIXED, NOBODY, QUICK, SINGLE, Planned, Scale, Task, TripRow, all_tasks,
)

pytestmark = pytest.mark.slow

TINY = Scale(sizes=(25,), cases=2, seeds=1, table1_turns=(5, 20), table1_seeds=1,
             hours=(4.0, 8.0), fleet_turns=2, hour_turns=1, drone_sizes=(25,), drone_cases=1,
             drone_turns=1, policy_turns=(1,))


def task(section: str = "fleets", **fields: object) -> Task:
    """Return a task of 25 customers."""
    plain = Task(section, 25, 2, SINGLE, 8.0, 0, "off", "fixed", "", GREEDY, 50, 1)
    return replace(plain, **fields)


def planned(cost: float, **fields: object) -> Planned:
    """Return a plan that never was."""
    row = Planned(**vars(task()), cost=cost, fixed=10.0, transport=cost - 10.0, lateness=0.0,
                  unassigned=0, vehicles=1, trips=1, sorties=0, driven=100.0, flown=0.0,
                  working_hours=4.0, least_load_rate=0.9, mean_load_rate=0.9,
                  wall_s=1.0, cpu_s=1.0, date="2026-01-01", machine="none")
    return replace(row, **fields)


def trip(load_rate: float, fleet: str = MIXED) -> TripRow:
    """Return a trip that never was."""
    return TripRow(25, 2, fleet, 1, 1, 1, 100.0, 100 * load_rate, load_rate, 50.0, 50.0, 0.5)


def test_printed_plan_breaks_rules() -> None:
    problem = to_problem(request_of(task("table1", customers=100, case=1, drones=1)))
    found = Counter(violation.code for violation in broken_rules(problem, groups()))
    assert found == {"MISSING": 40, "DUPLICATE": 20, "SERVED_BY": 2}


def test_printed_plan_visits_some_never_and_others_often() -> None:
    times = visits(groups())
    assert sum(count == 0 for count in times.values()) == 29
    assert sum(count > 1 for count in times.values()) == 23
    assert (times["35"], times["72"], times["99"]) == (4, 3, 0)


def test_printed_flights_leave_from_where_no_truck_is() -> None:
    assert [len(group.flights) for group in groups()] == [3, 6, 3, 5]
    assert [len(group.stated) for group in groups()] == [1, 0, 0, 0]


def test_printed_plan_is_as_long_as_was_recomputed_before() -> None:
    rows = printed_rows(2)
    for group, truck, drone in zip(groups(), rows[::2], rows[1::2], strict=True):
        row = measured(group)
        assert row.truck_length == pytest.approx(float(truck["recomputed_length"]), abs=0.005)
        assert row.drone_length == pytest.approx(float(drone["recomputed_length"]), abs=0.005)


def test_first_case_of_a_hundred_is_table_1() -> None:
    assert customers_of(100, 1) == example("table1")["customers"]
    request = request_of(task("policies", customers=100, case=1, drones=1))
    assert [kind.count for kind in request.fleet] == [4]


@pytest.mark.parametrize("case", [1, 2])
def test_cases_have_the_kinds_of_table_1_and_stay_the_same(case: int) -> None:
    customers = customers_of(50, case)
    assert Counter(customer["served_by"] for customer in customers) == {
        "drone": 5, "either": 40, "truck": 5}
    assert len({tuple(customer["location"]) for customer in customers}) == 50
    assert len({customer["id"] for customer in customers}) == 50
    assert customers == customers_of(50, case)


def test_fleets_have_the_same_customers() -> None:
    single, mixed = (request_of(task(fleet=fleet)) for fleet in (SINGLE, MIXED))
    assert single.customers == mixed.customers
    assert [kind.capacity for kind in mixed.fleet] == [[100], [150], [200]]
    assert single.fleet[0] == mixed.fleet[1]
    assert {kind.max_working_duration for kind in mixed.fleet} == {8 * 3600}


def test_windows_are_the_same_soft_and_hard() -> None:
    off, soft, hard = (request_of(task("drones", windows=windows)).customers
                       for windows in ("off", "soft", "hard"))
    stated = windows_of(25, 2)
    assert 10 < len(stated) < 25
    for free, lax, strict in zip(off, soft, hard, strict=True):
        assert free.time_window.latest is None
        assert lax.time_window.earliest == strict.time_window.earliest
        assert lax.time_window.latest == strict.time_window.latest
        if strict.id in stated:
            assert lax.time_window.late_cost_per_hour == 30
            assert strict.time_window.late_cost_per_hour is None


def test_speeds_by_time_of_day_are_slower_in_rush_hours_only() -> None:
    fixed, varied = (request_of(task("drones", speeds=speeds)).fleet[0]
                     for speeds in ("fixed", "by time of day"))
    assert not fixed.speed_profile
    assert [(change.from_time / 3600, change.speed_kmh) for change in varied.speed_profile] == [
        (7, 25), (9, 40), (16, 25), (18, 40)]


@pytest.mark.parametrize("scale", [FULL, QUICK])
def test_no_task_is_planned_twice(scale: Scale) -> None:
    tasks = list(all_tasks(scale))
    assert len(tasks) == len(set(tasks))


def test_search_begins_as_the_task_says() -> None:
    costs = {policy: plan_one(task("policies", drones=1, policy=policy, turns=0)).row.cost
             for policy in ("attention", "pointer")}
    assert costs["attention"] != costs["pointer"]
    for policy in (*costs, NOBODY):
        row, again = (plan_one(task("policies", drones=1, policy=policy, turns=25)).row
                      for _ in range(2))
        assert row.cost == again.cost
        assert row.unassigned == 0
        assert row.cost <= costs.get(policy, row.cost)


def test_small_study_is_planned_once_and_reported_the_same_again(tmp_path: Path) -> None:
    page = tmp_path / "study.md"
    study = run(TINY, tmp_path / "runs", workers=1)
    assert [row.task for row in study.rows] == list(all_tasks(TINY))
    write_report(study, page, tmp_path / "runs")
    written = {path.name: path.read_bytes() for path in tmp_path.rglob("*.*")}
    write_report(run(TINY, tmp_path / "runs", workers=1), page, tmp_path / "runs")
    assert {path.name: path.read_bytes() for path in tmp_path.rglob("*.*")} == written
    text = page.read_text()
    for name in ("nodes", "windows", "routes", "turns", "fleets", "trips", "hours", "drones",
                 "policies"):
        assert f"](study/{name}.svg)" in text
        assert written[f"{name}.svg"].startswith(b"<?xml")
    assert "40 MISSING, 20 DUPLICATE, 2 SERVED_BY" in text
    tables = written["tables.md"].decode()
    for title in ("25 customers, as Table 3", "by capacity and hours", "driven, flown and worked"):
        assert title in tables


def test_cheaper_plan_is_kept(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    first, dearer, cheaper = (b'{"cost": {"total": %d}}' % cost for cost in (5, 6, 4))
    for reply, kept in ((first, first), (dearer, first), (cheaper, cheaper)):
        keep_cheaper(path, reply)
        assert path.read_bytes() == kept


def test_turns_are_compared_with_the_reference() -> None:
    rows = [planned(710.53 * share, turns=2_000, seed=seed)
            for seed, share in enumerate((1.0, 1.01, 1.5))]
    assert turns_table(rows)[2:] == ["| 2,000 | 3 | 710.53 | 717.64 | 1065.80 | +1.00 | 1 |"]


def test_fleets_are_compared_by_their_best_seeds() -> None:
    rows = [planned(cost, fleet=fleet, seed=seed)
            for fleet, costs in {SINGLE: (100.0, 90.0), MIXED: (99.0, 120.0), "100": (110.0, 110.0),
                                 "200": (198.0, 198.0)}.items()
            for seed, cost in enumerate(costs)]
    assert against_table(rows)[2:] == [
        "| 25 | 150 | +10.00 ± 0.00 | +10.00 | 1 of 1 |",
        "| 25 | 100 | -10.00 ± 0.00 | -10.00 | 0 of 1 |",
        "| 25 | 200 | -50.00 ± 0.00 | -50.00 | 0 of 1 |",
    ]
    assert "1 of 3 comparisons, by 10.00 %" in on_search(rows)[0]


def test_load_rates_are_held_against_what_was_aimed_at() -> None:
    rows = [planned(100.0), planned(90.0, fleet=MIXED)]
    good, bad = (on_fleets(rows, [trip(0.95), trip(least)]) for least in (0.9, 0.5))
    assert "loaded 92.5 % in the mean" in good[0]
    assert "is reached" in good[0]
    assert "-10.0 %" in good[0]
    assert good[1].startswith("- Every trip of mixed fleets is loaded above 80 %")
    assert "not reached everywhere" in bad[0]
    assert "50 % of the trips" in bad[1]


def test_hours_that_make_a_plan_dearer_are_counted() -> None:
    rows = [planned(cost, section="hours", fleet="100", hours=hours)
            for hours, cost in ((8.0, 101.0), (4.0, 110.0), (6.0, 100.0))]
    assert rises(rows) == (1, 2, pytest.approx(0.01))
    assert hours_table(rows, 25)[2:] == ["| 100 | 110.0 | **100.0** | 101.0 |"]
