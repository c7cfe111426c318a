"""Chances of being late against days that are drawn otherwise and driven by the judge."""

import numpy as np
import pytest

from benchmarks.days.lateness import Risked, city, risked, table
from model.planner import Planner


def test_chances_come_true_and_a_price_lowers_them() -> None:
    planner = Planner({"any": None})  # type: ignore[dict-item]
    day = city(3, 40)

    free, priced = (risked(planner, day, "3", 4000, price, 60) for price in (0.0, 400.0))

    for run in (free, priced):
        said, came = np.array(run.chances), np.array(run.came)
        assert said.sum() == pytest.approx(came.sum(), abs=0.5)
        # On 60 days of a customer each; the spread of a share is 0.06 at most.
        assert np.abs(said - came).max() < 0.25
        likely = (said > 0.1) & (said < 0.5)
        assert said[likely].mean() == pytest.approx(came[likely].mean(), abs=0.06)
    assert priced.left_out == free.left_out == 0
    assert priced.late_h < free.late_h


def test_table_tells_shares_of_what_costs_nothing() -> None:
    rows = [Risked("0", price, 2, cost, 0, broken, broken, hours, (0.2, 0.01), (0.3, 0.0))
            for price, cost, broken, hours in ((0.0, 100.0, 4.0, 1.0), (50.0, 102.0, 1.0, 0.2))]

    lines = "\n".join(table(rows)).splitlines()

    assert lines[2:4] == ["| 0 | 0.00 | 2 | 4.0 | 100 | 1.00 |",
                          "| 50 | 2.00 | 2 | 1.0 | 25 | 0.20 |"]
    assert lines[-1] == "| 15 to 25 % | 2 | 20.0 | 30.0 |"
