"""How a day's next plan is asked for."""

from typing import Any

import pytest

from app.records.days.fold import fold
from app.records.days.planning import asked
from app.records.days.rows import Begun, DayTerms


@pytest.mark.parametrize(("stated", "beside", "orders", "searched"), [
    ({}, 0.0, 1, 0.6), ({}, 0.6, 1, 0.4), ({}, 5.0, 1, 0.3), ({}, 5.0, 2000, 0.4),
    ({}, 5.0, 9000, 0.6), ({"time_limit": 0.2}, 0.0, 1, 0.2)])
def test_what_takes_long_beside_the_search_shortens_it(
        stated: dict[str, Any], beside: float, orders: int, searched: float) -> None:
    begin = Begun({"depots": [], "fleet": [], "options": stated, "customers": [
        {"id": str(number)} for number in range(orders)]}, DayTerms(2.0, 600.0, 0.0, ""))
    request = asked(begin, fold(begin, [], 0), None, {}, 0.0, 0, beside=beside)
    assert request["options"]["time_limit"] == pytest.approx(searched)
