"""What would be dropped without a word is asked, and answers are gone by."""

from typing import Any

import pytest
import xlsxwriter

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings, QuestionReply
from tests.app.formats.sheets.makes import workbook

pytestmark = pytest.mark.slow

HEAD = "Name;Breite;Länge;Menge"
ROWS = ("Anna;48,10;11,50;5", "Ben;48,20;11,60;7", "Cleo;48,15;11,55;3")


def imported(content: bytes, answers: dict[str, str] | None = None, **settings: Any) -> ImportReply:
    mapping = {"answers": answers or {}}
    return import_file(content, ImportSettings.model_validate({"mapping": mapping, **settings}))


def read(head: str, ends: list[str], answers: dict[str, str] | None = None) -> ImportReply:
    """Import the three customers with further columns."""
    lines = [f"{HEAD};{head}", *(f"{row};{end}" for row, end in zip(ROWS, ends, strict=True))]
    return imported("\n".join(lines).encode(), answers)


def names(reply: ImportReply) -> list[str]:
    assert reply.request is not None
    return [customer["id"] for customer in reply.request["customers"]]


def asked(reply: ImportReply, kind: str) -> QuestionReply:
    [question] = [question for question in reply.questions if question.kind == kind]
    return question


def test_a_column_that_nothing_uses_is_asked_about_and_its_answer_taken() -> None:
    reply = read("Klasse", ["4", "1", "2"])
    question = asked(reply, "column")
    assert (question.id, question.column, question.cell) == ("column:klasse", "E", "E2")
    assert (question.default, question.answer) == ("ignored", "ignored")
    assert not question.is_answered
    assert {"demand", "info", "ignored"} <= {choice.answer for choice in question.choices}
    assert question.examples == ["4", "1", "2"]
    answered = read("Klasse", ["4", "1", "2"], {"column:klasse": "service"})
    assert answered.request is not None
    assert [customer["service_duration"] for customer in answered.request["customers"]] == [
        240, 60, 120]
    assert asked(answered, "column").is_answered
    assert answered.mapping.answers == {"column:klasse": "service"}


def test_a_column_set_aside_by_the_mapping_is_answered() -> None:
    content = "\n".join([f"{HEAD};Klasse", *(f"{row};{number}" for number, row in
                                             enumerate(ROWS))]).encode()
    mapping = {"columns": [{"heading": "Klasse", "meaning": "ignored"}]}
    reply = import_file(content, ImportSettings.model_validate({"mapping": mapping}))
    assert asked(reply, "column").is_answered


def test_an_answer_that_is_none_is_an_error() -> None:
    reply = read("Klasse", ["4", "1", "2"], {"column:klasse": "colour"})
    assert [error.code for error in reply.errors] == ["ANSWER"]
    assert reply.request is None
    unasked = read("Klasse", ["4", "1", "2"], {"sheet:Tuesday": "also"})
    assert unasked.errors == []


def sheet_of(book: xlsxwriter.Workbook, name: str, rows: list[list[Any]]) -> Any:
    sheet = book.add_worksheet(name)
    for number, row in enumerate(rows):
        sheet.write_row(number, 0, row)
    return sheet


def monday(book: xlsxwriter.Workbook, name: str = "Montag") -> Any:
    return sheet_of(book, name, [["Kunde", "Breite", "Länge", "Kisten"], ["Anna", 48.1, 11.5, 5],
                                 ["Ben", 48.2, 11.6, 7], ["Cleo", 48.15, 11.55, 3]])


def tuesday(book: xlsxwriter.Workbook) -> Any:
    return sheet_of(book, "Dienstag", [["Kisten", "Kunde", "Breite", "Länge", "Hinweis"],
                                       [2, "Dora", 48.3, 11.4, "Hof"]])


def fleet(book: xlsxwriter.Workbook) -> Any:
    return sheet_of(book, "Fahrzeuge", [
        ["Kennzeichen", "Kapazität (Kisten)", "Schicht", "Kosten pro km"],
        ["M-AB 1", 40, "6-14", 0.4], ["M-AB 2", 25, "22-5", 0.5]])


def test_rows_that_are_hidden_are_left_out_unless_they_are_asked_for() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        monday(book).set_row(2, None, None, {"hidden": True})

    reply = imported(workbook(fill))
    question = asked(reply, "hidden_rows")
    assert names(reply) == ["Anna", "Cleo"]
    assert (question.cell, question.values["rows"], question.values["by_filter"]) == ("A3", "3", 0)
    assert names(imported(workbook(fill), {question.id: "plan"})) == ["Anna", "Ben", "Cleo"]


def test_rows_left_out_by_a_filter_are_asked_about() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        sheet = monday(book)
        sheet.autofilter(0, 0, 3, 3)
        for row in (1, 2):
            sheet.set_row(row, None, None, {"hidden": True})

    question = asked(imported(workbook(fill)), "hidden_rows")
    assert (question.values["by_filter"], question.values["rows"]) == (1, "2-3")


def test_another_days_sheet_is_asked_about_and_read_as_well_or_instead() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        monday(book)
        tuesday(book)

    reply = imported(workbook(fill))
    question = asked(reply, "sheet")
    assert (question.id, question.default) == ("sheet:Dienstag", "ignored")
    assert question.values["count"] == 1  # its heading is no customer
    assert names(reply) == ["Anna", "Ben", "Cleo"]
    both = imported(workbook(fill), {question.id: "also"})
    assert names(both) == ["Anna", "Ben", "Cleo", "Dora"]
    assert both.request is not None
    assert [customer["demand"] for customer in both.request["customers"]] == [[5], [7], [3], [2]]
    instead = imported(workbook(fill), {question.id: "instead"})
    assert (instead.sheet, names(instead)) == ("Dienstag", ["Dora"])


def test_a_wrong_cell_of_a_further_sheet_is_named_with_it() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        monday(book)
        tuesday(book).write(1, 2, "north")

    reply = imported(workbook(fill), {"sheet:Dienstag": "also"})
    assert [error.cell for error in reply.errors] == ["Dienstag!C2"]


def test_a_sheet_of_vans_is_read_as_the_fleet() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        monday(book)
        fleet(book)

    reply = imported(workbook(fill))
    assert asked(reply, "sheet").answer == "vehicles"
    assert reply.request is not None
    first, second = reply.request["fleet"]
    assert (first["id"], first["capacity"], first["shift"]) == (
        "M-AB 1", [40], {"earliest": 6 * 3600, "latest": 14 * 3600})
    assert second["shift"] == {"earliest": 22 * 3600, "latest": 29 * 3600}
    assert second["costs"] == {"fixed": 30, "per_km": 0.5, "per_hour": 30}
    ignored = imported(workbook(fill), {"sheet:Fahrzeuge": "ignored"})
    assert ignored.request is not None
    assert ignored.request["fleet"][0]["id"] == "vehicle"


def test_a_hidden_sheet_is_asked_about() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        monday(book)
        tuesday(book).hide()

    assert asked(imported(workbook(fill)), "sheet").values["is_hidden"] == 1


@pytest.mark.parametrize(("heading", "wording"), [
    ("Status", "storniert"), ("Status", "Storno"), ("Auftragsstatus", "abgesagt"),
    ("State", "cancelled"), ("Statut", "annulé"), ("Bemerkung", "STORNIERT wegen Urlaub"),
    ("Storno", "x"), ("Status", "geliefert")])
def test_cancelled_orders_are_left_out_unless_they_are_asked_for(heading: str,
                                                                 wording: str) -> None:
    ends = ["", wording, ""] if heading in ("Bemerkung", "Storno") else ["offen", wording, "offen"]
    reply = read(heading, ends)
    question = asked(reply, "status")
    assert names(reply) == ["Anna", "Cleo"]
    assert question.cell == "E3"
    assert names(read(heading, ends, {question.id: "plan"})) == ["Anna", "Ben", "Cleo"]


def test_what_is_not_cancelled_is_planned_without_a_question() -> None:
    reply = read("Bemerkung", ["nicht storniert", "Hof", ""])
    assert names(reply) == ["Anna", "Ben", "Cleo"]
    assert reply.questions == []


def test_sums_are_left_out_and_asked_about() -> None:
    content = "\n".join([HEAD, *ROWS[:2], "Zwischensumme;;;12", ROWS[2], "Summe;;;15"]).encode()
    reply = imported(content)
    assert names(reply) == ["Anna", "Ben", "Cleo"]
    assert asked(reply, "total_rows").values["rows"] == "4, 6"


def test_pickups_are_pickups() -> None:
    reply = read("Art", ["Lieferung", "Abholung", "Lieferung"])
    assert reply.request is not None
    anna, ben, _ = reply.request["customers"]
    assert (anna["demand"], "pickup" in anna) == ([5], False)
    assert (ben["demand"], ben["pickup"]) == ([0], [7])
    assert reply.questions == []


@pytest.mark.parametrize(("heading", "ends"), [
    ("Auftragsart", ["Zustellung", "Retoure", "Lieferung"]), ("Abholung", ["", "x", ""]),
    ("Abholung", ["nein", "ja", "nein"]),
    ("Pickup", ["no", "yes", "no"]), ("Type", ["Delivery", "Pickup", ""])])
def test_pickups_are_known_by_words_and_by_ticks(heading: str, ends: list[str]) -> None:
    reply = read(heading, ends)
    assert reply.request is not None
    assert [customer.get("pickup") for customer in reply.request["customers"]] == [None, [7], None]
    assert reply.questions == []


def test_a_kind_of_order_that_is_not_known_is_asked_about() -> None:
    reply = read("Art", ["Lieferung", "Umtausch", "Lieferung"])
    question = asked(reply, "order_kind")
    assert question.default == "delivery"
    assert names(read("Art", ["Lieferung", "Umtausch", "Lieferung"],
                      {question.id: "leave_out"})) == ["Anna", "Cleo"]
    answered = read("Art", ["Lieferung", "Umtausch", "Lieferung"], {question.id: "pickup"})
    assert answered.request is not None
    assert answered.request["customers"][1]["pickup"] == [7]


def test_an_order_that_stands_twice_is_asked_about() -> None:
    content = "\n".join([f"{HEAD};Auftrag", "Anna;48,10;11,50;5;4711", "Anna;48,10;11,50;5;4711",
                         "Ben;48,20;11,60;7;4712"]).encode()
    reply = imported(content)
    assert asked(reply, "same_rows").default == "together"

    def amounts(reply: ImportReply) -> list[list[float]]:
        assert reply.request is not None
        return [customer["demand"] for customer in reply.request["customers"]]

    assert amounts(reply) == [[10], [7]]
    assert amounts(imported(content, {"same_rows": "once"})) == [[5], [7]]


def test_amounts_to_pick_up_stand_in_columns_of_their_own() -> None:
    reply = read("Leergut", ["2", "0", ""])
    assert reply.request is not None
    assert [customer.get("pickup") for customer in reply.request["customers"]] == [[2], None, None]
    assert reply.request["fleet"][0]["capacity"] == [15]


def test_the_fleet_of_an_english_file_is_read() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        monday(book)
        sheet_of(book, "Fleet", [
            ["Van", "Driver", "Max payload (kg)", "Shift start", "Shift end", "Home base"],
            ["V1", "Bob", 500, "6:00", "14:00", "north"], ["V2", "Ann", 600, "7:00", "", ""]])

    reply = imported(workbook(fill))
    assert reply.request is not None
    first, second = reply.request["fleet"]
    assert (first["id"], first["capacity"], second["shift"]) == ("V1", [500], {"earliest": 25200})
    [unused] = [doubt for doubt in reply.doubts if doubt.code == "FLEET_UNUSED"]
    assert "Home base" in unused.message


def test_vehicles_that_are_not_there_and_drones_are_not_planned() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        monday(book)
        sheet_of(book, "Fahrzeuge", [
            ["Fahrzeug", "Anzahl", "Anzahl Drohnen", "Kapazität kg", "Schicht"],
            ["V1", 2, 1, 40, "6-14"], ["V2", 0, 1, 25, "6-14"]])

    reply = imported(workbook(fill))
    assert reply.request is not None
    assert [(kind["id"], kind["count"]) for kind in reply.request["fleet"]] == [("V1", 2)]
    [unused] = [doubt for doubt in reply.doubts if doubt.code == "FLEET_UNUSED"]
    assert "Anzahl Drohnen" in unused.message


def test_shifts_and_driving_rules_are_read_as_dispatchers_head_them() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        monday(book)
        sheet_of(book, "Fahrzeuge", [
            ["Fahrzeug", "Kapazität kg", "Schicht von", "Schicht bis", "Lenkregel"],
            ["V1", 40, "7:00", "17:00", "EU 561"]])

    reply = imported(workbook(fill))
    assert reply.request is not None, reply.errors
    [kind] = reply.request["fleet"]
    assert (kind["shift"], kind["driving_rules"]) == (
        {"earliest": 25200, "latest": 61200}, {"preset": "eu-561"})


def test_of_several_days_one_is_asked_for() -> None:
    reply = read("Datum", ["23.11.2026", "24.11.2026", "23.11.2026"])
    question = asked(reply, "day")
    assert (question.default, [choice.answer for choice in question.choices]) == (
        None, ["2026-11-23", "2026-11-24"])
    assert [error.code for error in reply.errors] == ["SEVERAL_DAYS"]
    answered = read("Datum", ["23.11.2026", "24.11.2026", "23.11.2026"], {"day": "2026-11-23"})
    assert names(answered) == ["Anna", "Cleo"]
