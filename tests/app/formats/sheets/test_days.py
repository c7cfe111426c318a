"""Days of an import, planned by their clocks, and what looks wrong with what was made."""

import pytest
from pydantic_core import to_json

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportSettings
from app.requests.reading import read_request
from tests.app.formats.sheets.test_importing import codes, read

pytestmark = pytest.mark.slow


def test_a_day_in_a_zone_is_planned_by_its_clocks() -> None:
    rows = ("Anna,47.38,8.54,29.03.2026 08:30,29.03.2026 10:00",
            "Ben,47.39,8.51,29.03.2026 09:00,30.03.2026 01:30")
    head = "name,lat,lon,open,close"
    plain = read(*rows, head=head)
    assert plain.request is not None
    assert (plain.day, "plan_start" in plain.request) == ("2026-03-29", False)
    reply = read(*rows, head=head, time_zone="Europe/Berlin", shift="7:00-18:00")
    assert reply.request is not None
    assert reply.request["plan_start"] == "2026-03-29T00:00:00"
    assert reply.request["time_zone"] == "Europe/Berlin"
    assert [customer["time_window"] for customer in reply.request["customers"]] == [
        {"earliest": "08:30", "latest": "10:00"}, {"earliest": "09:00", "latest": "+1 01:30"}]
    assert reply.request["fleet"][0]["shift"] == {"earliest": "07:00", "latest": "18:00"}
    assert "MIDNIGHT" not in codes(reply)
    parsed = read_request(to_json(reply.request), policies=None)
    window = parsed.customers[0].time_window
    assert window is not None
    assert (window.earliest, window.latest) == (7.5 * 3600, 9 * 3600)  # clocks jump at two
    wrong = read(*rows, head=head, time_zone="Nowhere/Town")
    assert wrong.request is None
    assert wrong.errors


def test_what_looks_wrong_with_the_request_is_warned_of() -> None:
    reply = read("Anna,47.38,8.54", "Ben,47.39,8.51", head="name,lat,lon")
    assert [warning.code for warning in reply.warnings] == ["AS_THE_CROW_FLIES"]
    on_roads = import_file(b"name,lat,lon\nAnna,47.38,8.54\n", ImportSettings(),
                           road_profiles={"truck"})
    assert on_roads.warnings == []
