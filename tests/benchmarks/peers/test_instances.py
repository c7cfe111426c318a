"""Tests of `benchmarks.peers.instances`."""

import json
from pathlib import Path

import pytest

from benchmarks.peers.answers import PeerRoute, judge
from benchmarks.peers.instances import UNIFORM_UNIT, load_vrptw_uniform, uniform_set
from benchmarks.peers.published import to_problem

pytestmark = pytest.mark.slow

RECORD = {"name": "tiny", "capacity": 5, "horizon": 4.6, "speed": 1,
          "locations": [[0.0, 0.0], [0.3, 0.4], [0.6, 0.8]], "demand": [0, 2, 3],
          "time_windows": [[0.0, 4.6], [0.5, 0.7], [1.000001, 1.2]],
          "service": [0.0, 0.15, 0.16], "reference_cost": 2.0}


def test_uniform_vrptw_keeps_the_units_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "uniform.jsonl"
    path.write_text(json.dumps(RECORD) + "\n", encoding="utf-8")
    [(name, problem, reference_cost)] = load_vrptw_uniform(path)
    truck, legs = problem.vehicle_types[0], problem.travel[0]
    tour = int(legs.distance[0, 1] + legs.distance[1, 2] + legs.distance[2, 0])
    assert (name, reference_cost) == ("tiny", 2.0)
    assert tour / 1e6 * truck.cost_per_km == pytest.approx(2.0)
    assert legs.duration[0, 1] == UNIFORM_UNIT // 2
    assert problem.customers[1].earliest == 100_000_100
    assert problem.customers[1].demand == (3_000,)
    assert truck.capacity == (5_000,)
    assert truck.latest == 460_000_000


def test_uniform_instances_cost_the_same_as_others_take_them(tmp_path: Path) -> None:
    path = tmp_path / "uniform.jsonl"
    path.write_text(json.dumps(RECORD) + "\n", encoding="utf-8")
    [instance] = uniform_set(path, 2)
    assert uniform_set(path, 3) == []
    [(_, problem, _)] = load_vrptw_uniform(path)
    routes: list[PeerRoute] = [(0, [[1, 2]])]
    verdict = judge(to_problem(instance), routes)
    assert verdict.counts
    same = judge(problem, routes)
    assert verdict.cost == pytest.approx(same.cost, rel=1e-5)
