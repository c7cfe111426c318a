"""What is drawn from past days and from rates."""

import numpy as np
import pytest

from model.problem import UNLIMITED, Customer
from model.search.waves.forecasts import AreaRate, PastOrder, by_past_days, by_rates

HOUR = 3_600_000


def past(hour: int, node: int = 1, release: int = 0) -> PastOrder:
    return PastOrder(node, hour * HOUR, Customer(f"{hour}", (1,), release_time=release * HOUR))


def test_a_past_day_comes_again_from_now_on() -> None:
    forecast = by_past_days([[past(1), past(3), past(5), past(9)], [past(4, node=2, release=6)]],
                            3 * HOUR, 8 * HOUR)
    seen = {tuple((each.node, each.release_time // HOUR) for each in
                  forecast(np.random.default_rng(seed))) for seed in range(20)}
    assert seen == {((1, 5),), ((2, 6),)}


def test_without_past_days_nothing_can_be_drawn() -> None:
    with pytest.raises(ValueError, match="days"):
        by_past_days([], 0, HOUR)


def test_orders_come_as_often_as_rates_say_and_are_like_those_stated() -> None:
    like = Customer("like", (1,), earliest=HOUR, latest=2 * HOUR, release_time=HOUR // 2,
                    gaps=((HOUR + 1, HOUR + 2),))
    rates = [AreaRate(0, 4 * HOUR, 10.0, ((3, like), (4, Customer("free", (1,))))),
             AreaRate(8 * HOUR, 9 * HOUR, 50.0, ((5, like),))]
    forecast = by_rates(rates, 2 * HOUR, 6 * HOUR)
    draws = [forecast(np.random.default_rng(seed)) for seed in range(200)]
    # Two of the four hours are left.
    assert np.mean([len(draw) for draw in draws]) == pytest.approx(20.0, abs=1.5)
    for each in (each for draw in draws for each in draw):
        placed_at = each.release_time - each.customer.release_time
        assert 2 * HOUR <= placed_at < 4 * HOUR
        if each.node == 3:
            assert (each.customer.earliest, each.customer.latest) == (
                placed_at + HOUR, placed_at + 2 * HOUR)
            assert each.customer.gaps == ((placed_at + HOUR + 1, placed_at + HOUR + 2),)
        else:
            assert (each.node, each.customer.latest) == (4, UNLIMITED)


def test_the_same_seed_draws_the_same() -> None:
    forecast = by_rates([AreaRate(0, HOUR, 30.0, ((1, Customer("a", (1,))),))], 0, HOUR)
    first, again, other = (forecast(np.random.default_rng(seed)) for seed in (1, 1, 2))
    assert first == again != other
