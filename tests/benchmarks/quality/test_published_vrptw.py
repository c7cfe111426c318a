"""A policy on published test sets."""

import json
from pathlib import Path

import pytest

from benchmarks.quality.published_vrptw import SETS, main

pytestmark = pytest.mark.slow


def test_the_best_of_samples_costs_no_more_and_a_search_comes_to_the_best_known(
        tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    record = {"name": "a", "capacity": 10, "horizon": 4.6, "speed": 1.0,
              "locations": [[0, 0], [0, 0.5], [0.5, 0.5], [0.5, 0]], "demand": [0, 1, 1, 1],
              "time_windows": [[0, 4.6]] * 4, "service": [0, 0.2, 0.2, 0.2],
              "reference_cost": 2.0}
    for name in SETS:
        (tmp_path / f"{name}.jsonl").write_text(json.dumps(record) + "\n")
    main(tmp_path, seconds=0.1)
    rows = [line.split(" | ") for line in capsys.readouterr().out.splitlines()[2:]]
    costs = [float(mean.split()[0]) for _, _, mean, *_ in rows]
    assert [each[2] for each in zip(costs[::3], costs[1::3], costs[2::3], strict=True)] == [2, 2]
    assert all(one >= other for one, other in zip(costs[::3], costs[1::3], strict=True))
