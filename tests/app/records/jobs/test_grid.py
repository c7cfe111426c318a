"""Paths of a sweep's grid."""

from typing import Any

import pytest

from app.records.jobs.grid import places, put, read_path

pytestmark = pytest.mark.slow

DATA = {"fleet": [{"count": 1, "capacity": [5.0, 6.0], "drones": None},
                  {"count": 2, "capacity": [7.0, 8.0], "drones": None}],
        "customers": [], "planar_unit": 1.0}


@pytest.mark.parametrize(("text", "found"), [
    ("planar_unit", [("planar_unit",)]),
    ("fleet[1].count", [("fleet", 1, "count")]),
    ("fleet[*].capacity[0]", [("fleet", 0, "capacity", 0), ("fleet", 1, "capacity", 0)]),
    ("fleet[0].capacity[*]", [("fleet", 0, "capacity", 0), ("fleet", 0, "capacity", 1)]),
])
def test_path_means_its_places(text: str, found: list[Any]) -> None:
    assert places(DATA, read_path(text)) == found


@pytest.mark.parametrize("text", [
    "", ".fleet", "fleet..count", "fleet[", "fleet[-1]", "fleet[1]count", "[0]", "fleet[*]]",
    "fleet .count", "fleet[1].", "fleet.[1]", "fleet[12345678]"])
def test_what_is_no_path_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="no path"):
        read_path(text)


@pytest.mark.parametrize(("text", "reason"), [
    ("speed", "the request has no field 'speed'"),
    ("fleet[*].speed", "fleet\\[0\\] has no field 'speed'"),
    ("fleet[2].count", "fleet has 2 entries"),
    ("fleet.count", "fleet has no field 'count'"),
    ("planar_unit[0]", "planar_unit is no list"),
    ("fleet[0].drones.count", "fleet\\[0\\].drones is null"),
    ("customers[*].demand", "a list on the way is empty"),
])
def test_path_that_leads_nowhere_is_told_why(text: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        places(DATA, read_path(text))


def test_value_is_put_into_its_place() -> None:
    data: dict[str, Any] = {"a": [{"b": 1}, {"b": 2}]}
    put(data, ("a", 1, "b"), 3)
    assert data == {"a": [{"b": 1}, {"b": 3}]}
