"""How a day's next plan is asked for."""

from typing import Any

import pytest

from app.records.days.fold import fold
from app.records.days.planning import asked, waited_for
from app.records.days.rows import Begun, DayTerms, LoggedEvent
from app.records.days.store import BY_CLIENT, BY_SERVICE


@pytest.mark.parametrize(("stated", "beside", "orders", "searched"), [
    ({}, 0.0, 1, 0.6), ({}, 0.6, 1, 0.4), ({}, 5.0, 1, 0.3), ({}, 5.0, 2000, 0.4),
    ({}, 5.0, 9000, 0.6), ({"time_limit": 0.2}, 0.0, 1, 0.2)])
def test_what_takes_long_beside_the_search_shortens_it(
        stated: dict[str, Any], beside: float, orders: int, searched: float) -> None:
    begin = Begun({"depots": [], "fleet": [], "options": stated, "customers": [
        {"id": str(number)} for number in range(orders)]}, DayTerms(2.0, 600.0, 0.0, ""))
    request = asked(begin, fold(begin, [], 0), None, {}, 0.0, 0, beside=beside)
    assert request["options"]["time_limit"] == pytest.approx(searched)


def test_the_first_event_told_since_the_last_plan_has_waited_longest() -> None:
    def event(number: int, received_at: int, kind: str = "order.placed",
              origin: str = BY_CLIENT) -> LoggedEvent:
        return LoggedEvent(number, origin, str(number), kind, 0, None, None, None, None, None,
                           received_at)

    log = [event(1, 1000), event(2, 2000, "plan.changed", BY_SERVICE), event(3, 3000, "plan.seen"),
           event(4, 5000), event(5, 6500)]
    assert waited_for(log, 1, 8000) == 3.0
    assert waited_for(log, 4, 8000) == 1.5
    assert waited_for(log, 5, 8000) == 0.0
