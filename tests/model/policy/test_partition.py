"""Set partitioning, beside all choices there are."""

import numpy as np
import pytest

from model.engine.alarm import Alarm
from model.policy import few_columns, partition
from model.policy.few_columns import TooManyColumnsError, cheapest_by_trying
from model.policy.partition import cheapest_partition
from model.problem import FloatArray, IntArray

SILENT, RUNG = Alarm().setting, Alarm(0.0).setting


@pytest.fixture(params=["by trying", "by programs"], autouse=True)
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Have choices be looked for either way."""
    if request.param == "by programs":
        monkeypatch.setattr(partition, "FEW", -1)


def cheapest(columns: list[IntArray], cost: FloatArray, room: IntArray) -> float:
    """Return what the cheapest choice costs, having looked at all."""
    meets = np.zeros((len(columns), len(room)))
    for index, column in enumerate(columns):
        meets[index, column] = 1
    choices = (np.arange(2 ** len(columns))[:, None] >> np.arange(len(columns))) & 1
    met = choices @ meets
    allowed = np.where(room < 0, met == 1, met <= room).all(axis=1)
    return float((choices[allowed] @ cost).min())


def test_choices_are_the_cheapest_there_are() -> None:
    rng = np.random.default_rng(3)
    shares = 0
    for _ in range(150):
        once = int(rng.integers(3, 7))
        room = np.append(np.full(once, -1), rng.integers(1, 4, 2))
        columns = [np.append(np.sort(rng.choice(once, rng.integers(1, 4), replace=False)),
                             once + rng.integers(2)) for _ in range(8)]
        columns += list(np.arange(once)[:, None])
        cost = np.append(rng.integers(5, 30, 8), np.full(once, 20)).astype(np.float64)
        known = 20.0 * once  # of a choice of the last alone
        chosen = cheapest_partition(columns, cost, room, known, SILENT)
        assert chosen is not None
        assert cost[chosen].sum() == pytest.approx(cheapest(columns, cost, room))
        shares += 0 < cost[chosen].sum() < known
    assert shares > 100


def test_three_pairs_of_three_need_more_than_linear_prices() -> None:
    # Half of each pair meets all rows at less than any whole choice costs.
    columns = [np.array([0, 1]), np.array([1, 2]), np.array([0, 2]),
               np.array([0]), np.array([1]), np.array([2])]
    chosen = cheapest_partition(columns, np.array([2.0, 2.0, 2.0, 2.0, 2.0, 1.9]), np.full(3, -1),
                                6.0, SILENT)
    assert chosen is not None
    assert chosen.tolist() == [True, False, False, False, False, True]


def test_rows_that_no_column_meets_have_no_choice() -> None:
    columns = [np.array([0]), np.array([1])]
    assert cheapest_partition(columns, np.ones(2), np.full(3, -1), 5.0, SILENT) is None


def test_rows_with_no_room_take_no_column() -> None:
    columns = [np.array([0, 1]), np.array([0])]
    chosen = cheapest_partition(columns, np.array([1.0, 3.0]), np.array([-1, 0]), 3.0, SILENT)
    assert chosen is not None
    assert chosen.tolist() == [False, True]


def test_what_takes_long_to_try_is_left_to_programs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(few_columns, "MOST_TRIED", 2)
    columns = [np.array([0, 1]), np.array([1, 2]), np.array([0, 2]),
               np.array([0]), np.array([1]), np.array([2])]
    given = columns, np.array([2.0, 2.0, 2.0, 2.0, 2.0, 1.9]), np.full(3, -1), 6.0
    with pytest.raises(TooManyColumnsError):
        cheapest_by_trying(*given)
    chosen = cheapest_partition(*given, SILENT)
    assert chosen is not None
    assert chosen.tolist() == [True, False, False, False, False, True]


def test_nothing_is_looked_for_after_an_alarm() -> None:
    assert cheapest_partition([np.array([0])], np.ones(1), np.array([-1]), 1.0, RUNG) is None
