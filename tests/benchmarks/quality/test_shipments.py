"""Instances with pickups and deliveries, read from files of both sets."""

from pathlib import Path

import pytest

from benchmarks.quality.shipments import FIXED, read, run, to_problem
from model.problem import Shipment

BEST = "instance,best_known,vehicles\n"

PLAIN = """2 5 1
0 0 0 0 0 100 0 0 0
1 3 4 2 0 50 10 0 2
2 6 8 -2 0 60 10 1 0
"""

HEADED = """NAME: b
CAPACITY: 5
NODES
0 41.0 2.0 0 0 100 0 0 0
1 41.1 2.1 2 0 50 10 0 2
2 41.2 2.2 -2 0 60 10 1 0
EDGES
0 5 11
5 0 5
9 5 0
EOF
"""


@pytest.mark.parametrize(("name", "text", "length"), [("a", PLAIN, 20.0), ("b", HEADED, 19.0)])
def test_an_instance_is_read_and_planned(tmp_path: Path, name: str, text: str,
                                         length: float) -> None:
    (tmp_path / f"{name}.txt").write_text(text)
    (tmp_path / "best_known.csv").write_text(f"{BEST}{name},{length},1\n")
    instance = read(tmp_path / f"{name}.txt")
    problem = to_problem(instance)
    assert problem.shipments == (Shipment("1", 1, 2, (2000,)),)
    assert (problem.customers[0].latest, problem.customers[1].service_duration) == (50_000, 10_000)
    assert problem.vehicle_types[0].fixed_cost == FIXED
    row = run(instance, 0.1, 0)
    assert (row.vehicles, row.length, row.left_out) == (1, length, 0)
    assert row.gap_percent == pytest.approx(0.0)
