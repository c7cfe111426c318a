"""When zones apply, by days and hours worked out by hand."""

from datetime import UTC, datetime, timedelta
from typing import Any

import pytest
from pydantic import TypeAdapter

from app.maps.airspace.applying import NEVER_ENDS, PlannedSpan, applies
from app.maps.airspace.reading import read_zones
from app.schemas.airspace import Zones
from tests.app.maps.airspace.published import ed269, zone

ZONES: TypeAdapter[Any] = TypeAdapter(Zones)
THURSDAY = datetime(2026, 11, 26, 8, tzinfo=UTC)
SHIFT = PlannedSpan(THURSDAY, THURSDAY + timedelta(hours=8))  # until 16:00


def applied(*applicability: dict[str, Any], span: PlannedSpan | None = SHIFT) -> bool:
    reading = read_zones(ZONES.validate_python(ed269(zone(applicability=list(applicability)))))
    assert reading.doubts == []
    return applies(reading.zones[0].periods, span)


def weekly(day: list[str], start: str | None, end: str | None, **more: Any) -> dict[str, Any]:
    times = {"startTime": start, "endTime": end}
    return {"permanent": "NO", "schedule": [
        {"day": day} | {name: value for name, value in times.items() if value}]} | more


def between(start: str | None, end: str | None) -> dict[str, Any]:
    stated = {"permanent": "NO", "startDateTime": start, "endDateTime": end}
    return {name: value for name, value in stated.items() if value}


@pytest.mark.parametrize(("applicability", "expected"), [
    ([], True),
    ([{"permanent": "YES"}], True),
    ([between("2026-11-01T00:00:00Z", "2026-12-01T00:00:00.00Z")], True),
    ([between("2026-11-26T15:59:00Z", None)], True),
    ([between("2026-11-26T16:01:00Z", None)], False),
    ([between(None, "2026-11-26T07:59:00Z")], False),
    ([between(None, "2026-11-26T10:30:00+02:00")], True),
    ([between(None, "2026-11-26T09:30:00+02:00")], False),
    ([weekly(["THU"], "10:00Z", "11:00Z")], True),
    ([weekly(["FRI"], "10:00Z", "11:00Z")], False),
    ([weekly(["ANY"], "17:00:00.00Z", "23:59:59.00Z")], False),
    ([weekly(["ANY"], "15:00:00Z", "23:59:59Z")], True),
    ([weekly(["WED"], "22:00Z", "09:00Z")], True),  # over midnight into the shift
    ([weekly(["THU"], "22:00Z", "09:00Z")], False),
    ([weekly(["THU"], "17:30+02:00", "18:30+02:00")], True),  # from 15:30 on
    ([weekly(["THU"], "18:30+02:00", "19:30+02:00")], False),
    ([weekly(["THU"], None, "07:00Z")], False),
    ([weekly(["THU"], "17:00Z", None)], False),
    ([weekly(["THU"], "15:00Z", "24:00Z")], True),
    ([weekly(["THU"], "10:00Z", "11:00Z", endDateTime="2026-11-26T09:00:00Z")], False),
    ([weekly(["FRI"], "10:00Z", "11:00Z"), weekly(["THU"], "10:00Z", "11:00Z")], True),
])
def test_a_zone_applies_at_its_times(applicability: list[dict[str, Any]], expected: bool) -> None:
    assert applied(*applicability) == expected


def test_whenever_it_is_planned_every_zone_applies() -> None:
    assert applied(weekly(["FRI"], "10:00Z", "11:00Z"), span=None)


def test_a_plan_without_end_meets_all_that_lies_ahead() -> None:
    span = PlannedSpan(THURSDAY, NEVER_ENDS)
    assert applied(weekly(["WED"], "10:00Z", "11:00Z"), span=span)
    assert applied(between("2027-05-01T00:00:00Z", None), span=span)
    assert not applied(between(None, "2026-11-25T00:00:00Z"), span=span)
