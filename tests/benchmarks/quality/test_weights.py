"""Weights of a policy side by side on fresh problems."""

from pathlib import Path

import numpy as np
import pytest
import torch

from app.serving.settings import Settings
from benchmarks.quality.weights import CLASSES, Case, plan_costs, rows
from training.export import WEIGHTS

pytestmark = pytest.mark.slow

WEIGHTS_FILE = Settings().weights_dir / "attention" / WEIGHTS


def test_problems_depend_on_class_seed_and_number_alone() -> None:
    drawn = [Case(name, seed, number).problem().coordinates.tolist()
             for name in CLASSES[:3] for seed in (1, 2) for number in (0, 2)]
    assert all(first != second for place, first in enumerate(drawn) for second in drawn[:place])
    assert Case(CLASSES[0], 1, 0).problem().coordinates.tolist() == drawn[0]


def test_worse_weights_plan_dearer_and_a_search_cheaper(tmp_path: Path) -> None:
    weights = torch.load(WEIGHTS_FILE, weights_only=True)
    generator = torch.Generator().manual_seed(1)
    torch.save({"policy": {name: value + 0.5 * torch.randn(value.shape, generator=generator)
                           for name, value in weights.items()}}, tmp_path / "checkpoint.pt")
    first, again, worse, searched = plan_costs(
        Case("uniform-50", 1, 0), [WEIGHTS_FILE, WEIGHTS_FILE, tmp_path / "checkpoint.pt"], 20)
    assert searched < first == again < worse


def test_table_has_changes_then_gaps_by_class() -> None:
    costs = {"vrptw": np.array([[100.0, 110.0, 50.0], [200.0, 220.0, 100.0]]),
             "drone": np.array([[10.0, 10.0, 10.0], [30.0, 30.0, 30.0]])}
    table = [[cell.split(" ")[0] for cell in row] for row in rows(costs, 2)]
    assert table[:2] == [["vrptw", "2", "+10.00", "+100.00", "+120.00"],
                         ["drone", "2", "+0.00", "+0.00", "+0.00"]]
    assert table[2][:3] == ["all", "4", f"{100 * (np.sqrt(1.1) - 1):+.2f}"]
