"""Windows bind unless the longest route fits into all of them."""

from typing import Any

import pytest

from model.dialects.vroom.binding import windows_bind
from model.dialects.vroom.kinds import find_kinds
from tests.model.dialects.vroom.drawn import read

LEG, SERVICE = 100, 20
LONGEST = 3 * LEG + 2 * SERVICE
"""Seconds of the only route through two jobs."""


def binds(vehicle: dict[str, Any], *windows: list[list[int]] | None) -> bool:
    """Tell whether windows bind of two jobs all of whose legs are as long."""
    jobs = [{"id": number, "location_index": number, "service": SERVICE}
            | ({} if stated is None else {"time_windows": stated})
            for number, stated in enumerate(windows, 1)]
    matrix = [[0 if i == j else LEG for j in range(3)] for i in range(3)]
    request, places = read({
        "vehicles": [{"id": 1, "start_index": 0, "end_index": 0} | vehicle], "jobs": jobs,
        "matrices": {"car": {"durations": matrix}}})
    return windows_bind(request, places, find_kinds(request, places))


@pytest.mark.parametrize(("vehicle", "windows", "expected"), [
    ({}, (None, None), False),
    ({"time_window": [0, LONGEST + 1]}, (None, None), False),
    ({"time_window": [0, LONGEST - 1]}, (None, None), True),
    ({"time_window": [0, LONGEST - 1], "speed_factor": 2}, (None, None), False),
    ({"time_window": [0, 2 * LEG + 2 * SERVICE + 1], "max_travel_time": 2 * LEG}, (None, None),
     False),
    ({}, ([[1000, 1000 + LONGEST + 1]], None), False),
    ({}, ([[1000, 1000 + LONGEST + 1]], [[1010, 5000]]), True),
    ({}, ([[0, 10], [1000, 9000]], [[500, 5000]]), False),
    ({"time_window": [2000, 9000]}, ([[0, 2000 + LONGEST]], None), True),
    ({"time_window": [2000, 9000]}, ([[0, 2001 + LONGEST]], None), False),
])
def test_windows_bind_where_a_route_may_wait_or_come_late(
        vehicle: dict[str, Any], windows: tuple[list[list[int]] | None, ...],
        expected: bool) -> None:
    assert binds(vehicle, *windows) == expected
