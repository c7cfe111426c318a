"""Sheets of vehicles and of the whole plan state the rules of a working day; one shows them all."""

from typing import Any

import httpx
import pytest
import xlsxwriter
from pydantic_core import to_json

from app.console.routes import STATIC_DIR
from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
from app.requests.reading import read_request
from tests.app.formats.sheets.makes import workbook

pytestmark = pytest.mark.slow

EXAMPLE = STATIC_DIR / "examples" / "working-day.xlsx"

CUSTOMERS = (("Name", "Breite", "Länge"), ("Anna", 48.1, 11.5), ("Ben", 48.2, 11.6))


def read(name: str, *rows: tuple[Any, ...], **settings: Any) -> ImportReply:
    """Import two customers with another sheet."""
    def fill(book: xlsxwriter.Workbook) -> None:
        for title, lines in (("Kunden", CUSTOMERS), (name, rows)):
            sheet = book.add_worksheet(title)
            for number, row in enumerate(lines):
                sheet.write_row(number, 0, row)

    return import_file(workbook(fill), ImportSettings.model_validate(settings))


def vehicles(*rows: tuple[Any, ...]) -> list[dict[str, Any]]:
    reply = read("Fahrzeuge", *rows)
    assert reply.request is not None, reply.errors
    fleet: list[dict[str, Any]] = reply.request["fleet"]
    return fleet


def codes(reply: ImportReply) -> set[str]:
    return {doubt.code for doubt in reply.doubts}


def test_breaks_have_lengths_of_their_own() -> None:
    first, second, third = vehicles(
        ("Fahrzeug", "Kapazität", "Pause 1", "Dauer Pause 1 (min)", "Pause 2", "Pause 2 Dauer",
         "Pause bezahlt", "Pause unterwegs", "Pause Beladung bis", "Pause spätestens nach"),
        ("A", 40, "11:00-14:00", 45, "15:00-16:00", 15, "nein", "ja", 20, None),
        ("B", 40, None, None, None, 20, None, None, None, 4),
        ("C", 40, None, None, None, None, "ja", None, None, None))
    assert first["breaks"] == [
        {"id": "break-1", "duration": 2700, "start": {"earliest": 39600, "latest": 47700},
         "paid": False, "at": "anywhere", "max_load": [20]},
        {"id": "break-2", "duration": 900, "start": {"earliest": 54000, "latest": 56700},
         "paid": False, "at": "anywhere", "max_load": [20]}]
    assert second["breaks"] == [{"id": "break", "duration": 1200, "start": {"latest": 14400},
                                 "after_departure": True}]
    assert "breaks" not in third


def test_numbered_breaks_are_headings_of_vehicles() -> None:
    van, = vehicles(("Vehicle", "Capacity", "Break 1", "Break 1 min", "Break 2", "Break 2 min"),
                    ("van 1", 10, "12:00-14:00", 30, "15:00-16:00", 15))
    assert [each["duration"] for each in van["breaks"]] == [1800, 900]


def test_driving_rules_are_published_ones_or_a_firms_own() -> None:
    reply = read("Fahrzeuge", (
        "Fahrzeug", "Kapazität", "Lenkzeiten", "Lenkzeit bis Pause", "Lenkzeit am Tag",
        "Arbeitszeit bis Pause", "Lenkpause", "Lenkpause geteilt", "Bereits gefahren", "LIFO"),
        ("A", 40, "EU 561", None, 8, None, None, None, 1.5, "ja"),
        ("B", 40, None, 3, None, None, None, None, None, "nein"),
        ("C", 40, None, None, None, 5, 30, "10 + 20 min", None, None))
    assert reply.request is not None, reply.errors
    first, second, third = reply.request["fleet"]
    assert first["driving_rules"] == {"preset": "eu-561", "max_driving_per_day": 28800,
                                      "driven_before": 5400}
    assert first["lifo"] is True
    assert second["driving_rules"] == {"max_driving": 10800, "break_duration": 2700}
    assert third["driving_rules"] == {"max_work_before_break": 18000, "break_duration": 1800,
                                      "split": [600, 1200]}
    assert "lifo" not in second | third
    assert "RESTS_ASSUMED" in codes(reply)


@pytest.mark.parametrize(("heading", "cell"), [
    ("Lenkpause geteilt", "halb"), ("LIFO", "vielleicht"), ("Pause bezahlt", "oft")])
def test_what_cannot_be_read_of_a_driver_is_refused(heading: str, cell: str) -> None:
    reply = read("Fahrzeuge", ("Fahrzeug", "Kapazität", "Lenkzeit bis Pause", heading),
                 ("A", 40, 4, cell))
    assert [error.code for error in reply.errors] == ["DRIVING_RULES"]
    assert f"{cell!r} (Fahrzeuge!D2)" in reply.errors[0].message


def test_rests_without_a_rule_are_told() -> None:
    unused = read("Fahrzeuge", ("Fahrzeug", "Kapazität", "Lenkpause", "Lenkzeit bis Pause"),
                  ("A", 40, 45, None))
    assert "RESTS_UNUSED" in codes(unused)
    used = read("Fahrzeuge", ("Fahrzeug", "Kapazität", "Lenkpause", "Lenkzeit bis Pause"),
                ("A", 40, 45, 4))
    assert "RESTS_UNUSED" not in codes(used)


def test_a_sheet_says_what_the_whole_plan_costs() -> None:
    reply = read("Plan", ("Regel", "Wert"), ("Mindestens Fahrzeuge", 2),
                 ("Ausgleich nach", "Kunden"), ("Ausgleichskosten", 2.5),
                 ("Kosten je Stunde Gesamtdauer", 20), ("Wetter", "schön"))
    assert reply.request is not None, reply.errors
    assert reply.request["fairness"] == {
        "min_vehicles": 2, "balance": {"measure": "stops", "cost": 2.5},
        "makespan_cost_per_hour": 20}
    assert {"RULES_IN_FILE", "RULES_UNUSED"} <= codes(reply)
    [question] = [question for question in reply.questions if question.sheet == "Plan"]
    assert question.answer == "rules"
    stated = read("Plan", ("Mindestens Fahrzeuge", 2), fairness={"min_vehicles": 1})
    assert stated.request is not None
    assert stated.request["fairness"] == {"min_vehicles": 1}


def test_what_is_wrong_with_rules_of_the_plan_is_told() -> None:
    wrong = read("Plan", ("Ausgleich nach", "Laune"), ("Ausgleichskosten", 1))
    assert "Plan!B1" in wrong.errors[0].message
    half = read("Plan", ("Ausgleich nach", "Stopps"), ("Mindestens Fahrzeuge", 1))
    assert "BALANCE_INCOMPLETE" in codes(half)
    broken = read("Plan", ("Mindestens Fahrzeuge", 1.4))
    assert "Plan!B1: 1.4" in broken.errors[0].message
    twice = read("Plan", ("Mindestens Fahrzeuge", 2), ("Mindestens Fahrzeuge", 1))
    assert twice.request is not None
    assert twice.request["fairness"] == {"min_vehicles": 2}
    assert "RULES_UNUSED" in codes(twice)
    ignored = read("Plan", ("Mindestens Fahrzeuge", 2), mapping={
        "answers": {"sheet:Plan": "ignored"}})
    assert ignored.request is not None
    assert "fairness" not in ignored.request


def test_a_customer_may_be_called_as_a_rule_is() -> None:
    shops = read("Kunden 2", ("Name", "Breite", "Länge"), ("Balance", 48.1, 11.5),
                 ("Yoga", 48.2, 11.6), ("Dauer", 48.3, 11.6))
    assert shops.request is not None, shops.errors
    assert "fairness" not in shops.request


def test_the_example_shows_every_rule_and_is_planned(searching: httpx.Client) -> None:
    reply = import_file(EXAMPLE.read_bytes(), ImportSettings())
    assert reply.request is not None, reply.errors
    assert not [column for column in reply.columns if column.meaning == "ignored"]
    assert {question.kind for question in reply.questions} == {"sheet", "orders"}
    request = read_request(to_json(reply.request), policies=None)
    assert {(relation.kind, relation.scope, relation.min_lag > 0)
            for relation in request.relations} == {
        ("together", "vehicle", False), ("together", "trip", False), ("apart", "vehicle", False),
        ("before", "vehicle", True)}
    assert [kind.lifo for kind in request.fleet] == [False, True]
    assert request.fairness.balance is not None
    plan = searching.post("/plan", json=reply.request | {
        "options": {"time_limit": 60, "search_iterations": 300}})
    assert plan.status_code == 200, plan.text
    assert plan.json()["status"] == "complete"
    vehicles = {stop["id"]: route["vehicle"] for route in plan.json()["routes"]
                for trip in route["trips"] for stop in trip["stops"]}
    assert vehicles["Bakery"] == vehicles["Florist"] == vehicles["Caf\u00e9"]
    assert vehicles["Joiner"] == vehicles["Painter"] != vehicles["Pharmacy"]


@pytest.mark.parametrize(("begin", "end", "length"), [
    ("Przerwa od", "Przerwa do", "Przerwa min"), ("Pause von", "Pause bis", "Pausendauer"),
    ("Break start", "Break end", "Break (min)"), ("Lunch from", "Lunch to", "Lunch min"),
    ("Pause début", "Pause fin", "Durée pause (min)"), ("Descanso desde", "Descanso hasta",
                                                        "Descanso min")])
def test_a_break_has_its_begin_its_end_and_its_length_in_columns(begin: str, end: str,
                                                                 length: str) -> None:
    van, = vehicles(("Fahrzeug", "Kapazität", begin, end, length), ("A", 5, "12:00", "13:00", 30))
    assert van["breaks"] == [{"id": "break", "duration": 1800,
                              "start": {"earliest": 43200, "latest": 45000}}]


def test_two_breaks_have_their_begins_and_ends_in_columns() -> None:
    van, = vehicles(("Vehicle", "Capacity", "Break 1 from", "Break 1 to", "Break 2 from",
                     "Break 2 to"), ("A", 5, "10:00", "10:15", "12:00", "12:45"))
    assert [(pause["duration"], pause["start"]["earliest"]) for pause in van["breaks"]] == [
        (900, 36000), (2700, 43200)]


@pytest.mark.parametrize(("heading", "cell"), [
    ("Pause", "30 min"), ("Break", 30), ("Lunch", "0:30")])
def test_a_break_may_be_no_more_than_a_length(heading: str, cell: str | int) -> None:
    van, = vehicles(("Fahrzeug", "Kapazität", heading), ("A", 5, cell))
    [pause] = van["breaks"]
    assert (pause["duration"], pause["after_departure"]) == (1800, True)


@pytest.mark.parametrize(("begin", "end"), [
    ("Praca od", "Praca do"), ("Available from", "Available to"), ("Work start", "Work end"),
    ("Arbeitszeit Beginn", "Arbeitszeit Ende"), ("Schicht ab", "Schicht bis"),
    ("Clock in", "Clock out"), ("Verfügbar von", "Verfügbar bis"), ("Jornada inicio",
                                                                    "Jornada fin")])
def test_shifts_begin_and_end_in_other_words(begin: str, end: str) -> None:
    van, = vehicles(("Fahrzeug", "Kapazität", begin, end), ("A", 5, "7:00", "17:00"))
    assert van["shift"] == {"earliest": 25200, "latest": 61200}
