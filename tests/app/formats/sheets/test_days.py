"""Days of an import, planned by their clocks, and what looks wrong with what was made."""

from typing import Any

import pytest
from pydantic_core import to_json

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
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


def planned_by_weekday(headings: str, *rows: str, **settings: Any) -> ImportReply:
    content = "\n".join((f"Name;Lat;Lon;{headings}", *rows)).encode()
    return import_file(content, ImportSettings.model_validate(settings))


@pytest.mark.parametrize("headings", [
    "Mon;Tue;Wed", "Mo;Di;Mi", "Montag;Dienstag;Mittwoch", "lundi;mardi;mercredi",
    "Kisten Mo;Kisten Di;Kisten Mi", "pon;wt;\u015br", "Pzt;Sal\u0131;\u00c7ar\u015famba",
    "segunda-feira;ter\u00e7a-feira;quarta-feira"])
def test_of_columns_for_days_of_the_week_that_of_the_day_is_planned(headings: str) -> None:
    rows = "A;48.1;11.5;2;;3", "B;48.2;11.6;;4;", "C;48.3;11.7;1;-;1"
    reply = planned_by_weekday(headings, *rows, day="2026-12-02")
    assert reply.request is not None, reply.errors
    assert [(customer["id"], customer["demand"]) for customer in reply.request["customers"]] == [
        ("A", [3]), ("C", [1])]
    assert "OTHER_DAYS" in [doubt.code for doubt in reply.doubts]
    asked = planned_by_weekday(headings, *rows)
    assert [(error.code, error.cell) for error in asked.errors] == [("SEVERAL_DAYS", "D1")]
    [question] = [question for question in asked.questions if question.kind == "day"]
    assert [choice.answer for choice in question.choices] == ["monday", "tuesday", "wednesday"]
    answered = planned_by_weekday(headings, *rows, mapping={"answers": {"weekday": "tuesday"}})
    assert answered.request is not None
    assert [customer["id"] for customer in answered.request["customers"]] == ["B"]


def test_days_of_the_week_may_be_ticked_or_have_windows() -> None:
    ticked = planned_by_weekday("Boxes;Mon;Tue;Wed", "A;48.1;11.5;2;x;;x", "B;48.2;11.6;3;;x;no",
                                day="2026-12-02")
    timed = planned_by_weekday("Mon;Tue;Wed", "A;48.1;11.5;8-10;;9-12", "B;48.2;11.6;;8-10;",
                               day="2026-12-02")
    assert ticked.request is not None
    assert timed.request is not None
    assert [customer["demand"] for customer in ticked.request["customers"]] == [[2]]
    assert [customer["time_window"] for customer in timed.request["customers"]] == [
        {"earliest": 32400, "latest": 43200}]


def test_ends_of_windows_are_no_days() -> None:
    reply = planned_by_weekday("od;do", "A;48.1;11.5;8:00;9:00")
    assert [column.meaning for column in reply.columns][3:] == ["earliest", "latest"]
