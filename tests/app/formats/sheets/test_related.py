"""Columns of preferred vehicles, and of who goes with whom, become rules of the request."""

from typing import Any

import httpx
import pytest
import xlsxwriter

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
from tests.app.formats.sheets.makes import workbook

pytestmark = pytest.mark.slow

ROWS = ("1;Anna;48,10;11,50;5", "2;Ben;48,20;11,60;7", "3;Cleo;48,15;11,55;3",
        "4;Dora;48,16;11,51;2")
VANS = (("Fahrzeug", "Fahrer", "Anzahl", "Kapazität"), ("Nord", "Meier", 2, 40),
        ("Süd", "Huber", 1, 40))


def content(head: str, *ends: str) -> bytes:
    lines = [f"Nr;Name;Breite;Länge;Menge;{head}",
             *(f"{row};{end}" for row, end in zip(ROWS, ends, strict=True))]
    return "\n".join(lines).encode()


def read(head: str, *ends: str, **answers: str) -> ImportReply:
    """Import four customers with further columns."""
    stated = {f"related:{kind}": answer for kind, answer in answers.items()}
    settings = ImportSettings.model_validate({"vehicles": 2, "mapping": {"answers": stated}})
    return import_file(content(head, *ends), settings)


def related(reply: ImportReply) -> list[tuple[str, list[str]]]:
    assert reply.request is not None, reply.errors
    return [(relation["kind"], relation["customers"])
            for relation in reply.request.get("relations", ())]


def told(reply: ImportReply, code: str) -> list[str | None]:
    return [doubt.cell for doubt in reply.doubts if doubt.code == code]


@pytest.mark.parametrize(("heading", "meaning"), [
    ("Goes with", "together"), ("Zusammen mit", "together"), ("Samen met", "together"),
    ("Not with", "apart"), ("Nicht zusammen mit", "apart"), ("Non con", "apart"),
    ("Ne pas livrer avec", "apart"), ("Preferred vehicle", "preferred_vehicles"),
    ("Stammfahrer", "preferred_vehicles"), ("Regular driver", "preferred_vehicles"),
    ("Cost of other vehicle", "preference_cost"), ("Nicht mit", "forbidden_vehicles"),
    ("Vehicle", "vehicles"), ("Gleiche Tour wie", "together_on_trip"),
    ("Gehört zu", "together"), ("Beliefert nach", "after"),
    ("Not same trip", "apart_on_trip"), ("Mindestabstand (min)", "min_lag"),
    ("Max gap", "max_lag"), ("\u00c9cart maximal", "max_lag")])
def test_headings_of_rules_are_known(heading: str, meaning: str) -> None:
    reply = read(heading, "7", "7", "7", "7")
    assert reply.columns[-1].meaning == meaning


@pytest.mark.parametrize("heading", ["Kerb side", "Eigene Straßenseite", "Approach"])
def test_places_are_reached_on_their_own_side_of_the_street(heading: str) -> None:
    request = read(heading, "yes", "no", "", "curb").request
    assert request is not None
    assert [customer.get("approach") for customer in request["customers"]] == [
        "curb", "any", None, "curb"]
    assert [error.cell for error in read(heading, "yes", "left", "no", "no").errors] == ["F3"]


def test_a_vehicle_that_is_not_there_is_told_at_its_cell() -> None:
    reply = read("Fahrzeug;Nicht mit", ";Ben", ";", ";", ";")
    assert [(error.code, error.cell) for error in reply.errors] == [("UNKNOWN_VEHICLE", "G2")]


def test_groups_of_no_known_kind_are_asked_about() -> None:
    reply = read("Gruppe", "A", "A", "B", "B")
    [question] = [question for question in reply.questions if question.kind == "column"]
    assert {"together", "apart"} < {choice.answer for choice in question.choices}
    assert question.answer == "ignored"
    assert not related(reply)
    alone = read("Klasse", "A", "B", "C", "D")
    assert "together" not in {choice.answer for choice in alone.questions[0].choices}


def test_rows_that_share_a_name_are_a_group() -> None:
    reply = read("Zusammen mit;Not with;Not with", "A;x;", "a;y;", ";Z;X", "b, A;;z")
    assert related(reply) == [("together", ["Anna", "Ben", "Dora"]), ("apart", ["Anna", "Cleo"]),
                              ("apart", ["Cleo", "Dora"])]
    assert not [question for question in reply.questions if question.kind == "related"]
    assert told(reply, "RELATED_TO_NOBODY") == ["F5", "G3"]


def test_a_cell_may_name_another_customer_or_its_order() -> None:
    reply = read("Goes with;Not with", "Cleo;ben", ";Anna", ";", ";3")
    assert related(reply) == [("together", ["Cleo", "Anna"]), ("apart", ["Anna", "Ben"]),
                              ("apart", ["Cleo", "Dora"])]


def test_who_is_named_by_several_is_kept_from_each_of_them() -> None:
    rows = ("", "Anna", "Anna", "")
    reply = read("Not with", *rows)
    [question] = [question for question in reply.questions if question.kind == "related"]
    assert (question.id, question.answer, question.cell) == ("related:apart", "customers", "F3")
    assert related(reply) == [("apart", ["Anna", "Ben"]), ("apart", ["Anna", "Cleo"])]
    assert related(read("Not with", *rows, apart="groups")) == [("apart", ["Ben", "Cleo"])]


def test_numbers_of_groups_are_no_order_numbers_unless_somebody_says_so() -> None:
    rows = ("3", "", "", "3")
    assert related(read("Goes with", *rows)) == [("together", ["Anna", "Dora"])]
    assert related(read("Goes with", *rows, together="customers")) == [
        ("together", ["Cleo", "Anna", "Dora"])]


def test_who_is_both_together_and_apart_is_refused_at_a_cell() -> None:
    reply = read("Goes with;Not with", ";", "a;b", ";", "a;b")
    assert [(error.code, error.cell) for error in reply.errors] == [("CONTRADICTION", "F3")]


def test_rows_of_one_stop_with_other_rules_stay_apart() -> None:
    line = "Anna;48,1;11,5;1"
    file = f"Name;Breite;Länge;Menge;Zusammen mit\n{line};A\n{line};A\n{line};\n"
    reply = import_file(file.encode(), ImportSettings())
    assert reply.request is not None
    assert [customer["demand"] for customer in reply.request["customers"]] == [[2], [1]]


def test_another_vehicle_than_the_preferred_one_costs() -> None:
    reply = read("Preferred vehicle;Cost of other vehicle", "vehicle-2;4,5", "vehicle;3",
                 "Vehicle 1;", "Zeppelin;2")
    assert reply.request is not None
    assert [customer.get("vehicle_costs") for customer in reply.request["customers"]] == [
        {"vehicle": 4.5, "vehicle-2": 0}, None, {"vehicle": 7.5, "vehicle-1": 0}, None]
    assert told(reply, "PREFERENCE_ASSUMED") == ["F4"]
    assert told(reply, "PREFERENCE_UNKNOWN") == ["F5"]


def test_those_on_one_trip_are_bound_to_it() -> None:
    reply = read("Same trip;Other trip than", "A;x", "A;", ";x", ";")
    assert reply.request is not None
    assert reply.request["relations"] == [
        {"kind": "together", "scope": "trip", "customers": ["Anna", "Ben"]},
        {"kind": "apart", "scope": "trip", "customers": ["Anna", "Cleo"]}]


def test_orders_have_the_tighter_of_the_lags_that_rows_state() -> None:
    reply = read("Served before;Served after;Min lag (min);Max lag (h)",
                 "Ben;;10;2", ";Anna;20;", ";;5;", "Cleo;;;")
    assert reply.request is not None
    assert reply.request["relations"] == [
        {"kind": "before", "customers": ["Anna", "Ben"], "min_lag": 1200, "max_lag": 7200},
        {"kind": "before", "customers": ["Dora", "Cleo"]}]
    assert told(reply, "LAG_WITHOUT_ORDER") == ["H4"]


def test_lags_that_exclude_each_other_are_refused_at_a_cell() -> None:
    reply = read("Served before;Min lag (min);Max lag (min)", "Ben;30;20", ";;", ";;", ";;")
    assert [error.cell for error in reply.errors] == ["F2"]


def test_each_vehicle_has_the_price_that_a_row_states() -> None:
    reply = read("Costs by vehicle;Preferred vehicle", "vehicle-2: 4,5 | vehicle: 1;",
                 "vehicle-1: 0;vehicle-1", "Zeppelin: 3;", ";")
    assert reply.request is not None
    assert [customer.get("vehicle_costs") for customer in reply.request["customers"]] == [
        {"vehicle-2": 4.5, "vehicle": 1}, {"vehicle": 7.5, "vehicle-1": 0}, None, None]
    assert told(reply, "PREFERENCE_UNKNOWN") == ["F4"]
    wrong = read("Costs by vehicle", "vehicle 5", "van: 3", "van: 3", "van: 3")
    assert [(error.code, error.cell) for error in wrong.errors] == [("MISREAD", "F2")]


@pytest.mark.parametrize(("prices", "costs", "is_guessed"), [
    ("vehicle-1: 1.234,5 | vehicle-2: 1,5", {"vehicle-1": 1234.5, "vehicle-2": 1.5}, False),
    ("vehicle-1: 1,234.5", {"vehicle-1": 1234.5}, False),
    ("vehicle-1: 1,5 | vehicle-2: 1.234", {"vehicle-1": 1.5, "vehicle-2": 1234}, False),
    ("vehicle-1: 1.234", {"vehicle-1": 1.234}, True)])
def test_prices_are_read_by_the_signs_that_tell(prices: str, costs: dict[str, float],
                                                is_guessed: bool) -> None:
    rows = "Name\tLat\tLon\tMenge\tCosts by vehicle", f"Anna\t48\t11\t5\t{prices}"
    reply = import_file("\n".join(rows).encode(), ImportSettings(vehicles=2))
    assert reply.request is not None
    assert reply.request["customers"][0]["vehicle_costs"] == costs
    assert told(reply, "DECIMALS_GUESSED") == (["E2"] if is_guessed else [])


def test_what_notes_say_behind_a_colon_tells_nothing_where_amounts_do() -> None:
    rows = ("Name\tLat\tLon\tMenge\tHinweis", "Anna\t48\t11\t1,5\tGate: 2.5",
            "Ben\t48\t11\t1,250\tLift: 0.75")
    reply = import_file("\n".join(rows).encode(), ImportSettings(vehicles=2))
    assert reply.request is not None
    assert [each["demand"] for each in reply.request["customers"]] == [[1.5], [1.25]]


def test_a_price_below_nothing_is_refused_at_its_cell() -> None:
    reply = read("Preferred vehicle;Cost of other vehicle", "vehicle-2;-1", ";", ";", ";")
    assert [error.cell for error in reply.errors] == ["G2"]


def test_regular_drivers_are_those_of_the_sheet_of_vehicles() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        for name, rows in (("Kunden", (("Name", "Breite", "Länge", "Stammfahrer"),
                                       ("Anna", 48.1, 11.5, "Meier"), ("Ben", 48.2, 11.6, "nord-2"),
                                       ("Cleo", 48.15, 11.55, "Huber; Meier"))),
                           ("Fahrzeuge", VANS)):
            sheet = book.add_worksheet(name)
            for number, row in enumerate(rows):
                sheet.write_row(number, 0, row)

    reply = import_file(workbook(fill), ImportSettings(per_hour=40))
    assert reply.request is not None
    assert [customer.get("vehicle_costs") for customer in reply.request["customers"]] == [
        {"Süd": 10}, {"Nord": 10, "Süd": 10, "Nord-2": 0}, None]


def test_what_a_sheet_says_is_planned(client: httpx.Client) -> None:
    file = content("Goes with;Not with;Preferred vehicle", "A;;vehicle-2", "A;;", ";Anna;", ";;")
    reply = client.post("/import", content=file, headers={"Content-Type": "text/csv"},
                        params={"settings": '{"vehicles": 2, "max_trips": 1}'})
    request = reply.json()["request"]
    plan = client.post("/plan", json=request)
    assert plan.status_code == 200, plan.text
    serving: dict[str, Any] = {stop["id"]: route["vehicle"] for route in plan.json()["routes"]
                               for trip in route["trips"] for stop in trip["stops"]
                               if stop["kind"] == "customer"}
    assert serving["Anna"] == serving["Ben"] != serving["Cleo"]
    assert plan.json()["cost"]["stops"] == (0 if serving["Anna"] == "vehicle-2" else 7.5)
