"""Days of which a departure comes due while nobody tells anything."""

from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.serving.settings import Settings
from tests.app.conftest import SearchingPlanner, ready, serving
from tests.app.records.days.living import PROBLEM, begun, followed, plan_of, standing
from tests.conftest import eventually

pytestmark = pytest.mark.slow

EVERY = 60


def problem(ago: float, **more: Any) -> dict[str, Any]:
    """Return a day that began so many seconds ago, whose orders may wait."""
    start = datetime.now(UTC) - timedelta(seconds=ago)
    return PROBLEM | {"plan_start": start.isoformat(), "forecast": {"every": EVERY}} | more


def times_told(client: httpx.Client, day: str) -> list[tuple[float, str | None]]:
    """Return when a day was told the time, and by which name."""
    return [(each["at"], each["event_id"])
            for each in followed(client, day, standing(client, day).revision)
            if each["kind"] == "clock"]


def test_who_waits_is_decided_anew_as_a_departure_comes_due(tmp_path: Path) -> None:
    settings = Settings(data_dir=tmp_path, drain_seconds=0, role="api")
    with serving(SearchingPlanner(), settings) as client:
        day = begun(ready(client), problem(EVERY - 6), clock=None)
        waits = [each["id"] for each in plan_of(client, day)["outlook"] if not each["leaves"]]
        assert waits
    # Also by a process that began later, and once.
    with serving(SearchingPlanner(), settings) as client:
        ready(client)
        eventually(lambda: standing(client, day).plan_number > 1)
        assert times_told(client, day) == [(EVERY, None)]
        eventually(lambda: standing(client, day).is_planned)
        assert standing(client, day).plan_number == 2


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("more", [
    {"forecast": None},
    {"customers": [{**each, "time_window": {"latest": 3 * EVERY}}
                   for each in PROBLEM["customers"][:1]]}])
def test_days_of_which_nobody_waits_are_told_nothing(tmp_path: Path, more: dict[str, Any]) -> None:
    with serving(SearchingPlanner(), Settings(data_dir=tmp_path, role="api")) as client:
        waiting = begun(ready(client), problem(EVERY - 4), clock=None)
        day = begun(client, problem(EVERY - 4, **more), clock=None)
        eventually(lambda: times_told(client, waiting) != [])
        assert times_told(client, day) == []
