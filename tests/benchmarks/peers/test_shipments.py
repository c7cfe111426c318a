"""How plans of pickup and delivery are compared with those of other solvers."""

import math
from pathlib import Path

import pytest

from benchmarks.peers import shipments
from benchmarks.peers.shipments import Run, by_peer, by_tandem, summary
from benchmarks.quality.shipments import read
from tests.benchmarks.quality.test_shipments import BEST, PLAIN


def test_plans_of_others_are_judged_and_left_out_of_means_where_somebody_is(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.txt").write_text(PLAIN)
    (tmp_path / "best_known.csv").write_text(f"{BEST}a,10.0,1\n")
    instance = read(tmp_path / "a.txt")
    monkeypatch.setattr(shipments, "PEERS", {
        "right": lambda instance, seconds: [[1, 2]], "wrong": lambda instance, seconds: [[2, 1]],
        "none": lambda instance, seconds: []})
    right, none = by_peer("right", instance, 0.1), by_peer("none", instance, 0.1)
    assert (right.vehicles_above, right.gap_percent) == (0, pytest.approx(100))
    assert math.isnan(none.vehicles_above)
    with pytest.raises(RuntimeError, match="wrong, a: "):
        by_peer("wrong", instance, 0.1)
    assert right.cost_gap_percent == pytest.approx(100 / 3)
    above = Run("right", "b", 2, 0.1, 2, math.nan, 40.0)
    other = Run("other", "b", 2, 0.1, 0, 1.0, 2.0)
    assert list(summary([right, above, none, other])) == [
        "| 0.1 | right | 2 of 2 | 1.00 | 1 | 100.00 | 40.00 of 1 |",
        "| 0.1 | none | 0 of 1 | nan | 0 | nan | nan of 0 |",
        "| 0.1 | other | 1 of 1 | 0.00 | 1 | 1.00 | 2.00 of 1 |"]
    assert by_tandem(instance, 0.5).gap_percent == right.gap_percent
