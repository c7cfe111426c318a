"""What is doubtful is told, what is wrong is refused with its cell named."""

from typing import Any

import pytest

from app.formats.sheets import importing
from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
from app.formats.sheets.table import NotASheetError

pytestmark = pytest.mark.slow

HEAD = "name,lat,lon,kg,from,to,service (min)"
ROWS = ("Anna,48.10,11.50,5,8:00,10:00,10", "Ben,48.20,11.60,7,9:00,12:00,5",
        "Cleo,48.15,11.55,3,8:30,17:00,5")


def read(*rows: str, head: str = HEAD, **settings: Any) -> ImportReply:
    """Import a CSV file."""
    content = "\n".join([head, *(rows or ROWS)]).encode()
    return import_file(content, ImportSettings.model_validate(settings))


def codes(reply: ImportReply) -> set[str]:
    return {doubt.code for doubt in [*reply.doubts, *(doubt for column in reply.columns
                                                      for doubt in column.doubts)]}


def wrong(reply: ImportReply) -> list[tuple[str, str | None]]:
    assert reply.request is None or not reply.errors
    return [(error.code, error.cell) for error in reply.errors]


@pytest.mark.parametrize(("cell", "value", "code"), [
    ("B3", "48.x", "MISREAD"), ("B3", "91", "OFF_GLOBE"), ("B3", "", "NO_COORDINATES"),
    ("C3", "48.201.5", "MISREAD"), ("D3", "seven", "MISREAD"), ("D3", "-1", "MISREAD"),
    ("D3", "5 l", "MISREAD"), ("E3", "noon", "MISREAD"), ("F3", "8:59", "ENDS_BEFORE"),
    ("F3", "1:00", "ENDS_BEFORE"), ("G3", "soon", "MISREAD"), ("G3", "10:00", "MISREAD")])
def test_a_wrong_cell_is_named(cell: str, value: str, code: str) -> None:
    cells = ROWS[1].split(",")
    cells["ABCDEFG".index(cell[0])] = value
    reply = read(ROWS[0], ",".join(cells), ROWS[2], head=HEAD.replace("kg", "weight kg"))
    assert wrong(reply) == [(code, cell)]
    kept = read(ROWS[0], ",".join(cells), ROWS[2], head=HEAD.replace("kg", "weight kg"),
                leave_out_errors=True)
    assert kept.request is not None
    assert [customer["id"] for customer in kept.request["customers"]] == ["Anna", "Cleo"]
    assert "ROWS_LEFT_OUT" in codes(kept)


def test_every_wrong_cell_is_named_at_once() -> None:
    reply = read("Anna,x,11.5,5,8:00,10:00,10", "Ben,48.2,11.6,y,z,12:00,5")
    assert wrong(reply) == [("MISREAD", "B2"), ("MISREAD", "D3"), ("MISREAD", "E3")]


def test_null_island_is_no_customer() -> None:
    reply = read(*ROWS, "Dora,0,0,1,,,")
    assert wrong(reply) == [("NO_COORDINATES", "B5")]


def test_addresses_without_coordinates_are_told_plainly() -> None:
    reply = read("Anna,Mozartstr. 17,80331,8:00", "Ben,Ring 3,80333,9:00",
                 head="Name,Street,Zip,From")
    assert wrong(reply) == [("NO_COORDINATES", None)]
    assert "addresses, which are not looked up" in reply.errors[0].message
    assert [column.meaning for column in reply.columns] == ["name", "street", "postcode",
                                                            "earliest"]


def test_nothing_is_inherited_and_what_is_assumed_is_told() -> None:
    reply = read()
    assert reply.request is not None
    assert reply.request["depots"] == [{"id": "depot", "location": [11.55, 48.15]}]
    costs = {"fixed": 30, "per_km": 1, "per_hour": 30}
    assert reply.request["fleet"] == [
        {"id": "vehicle", "count": 1, "capacity": [15], "max_trips": 5, "costs": costs}]
    assert set(reply.request) == {"coordinate_system", "load_dimensions", "depots", "customers",
                                  "fleet"}
    assert codes(reply) == {"DEPOT_ASSUMED", "FLEET_ASSUMED", "CAPACITY_ASSUMED", "SHIFT_ASSUMED",
                            "TRIPS_ASSUMED", "HOURS_ASSUMED", "KILOMETRES_ASSUMED", "MIDNIGHT"}


def test_costs_that_nobody_states_go_by_the_currency() -> None:
    francs = read(currency="CHF").request
    assert francs is not None
    assert francs["currency"] == "CHF"
    assert francs["fleet"][0]["costs"] == {"fixed": 45, "per_km": 2, "per_hour": 45}
    [told] = [doubt.message for doubt in read(currency="CHF").doubts
              if doubt.code == "HOURS_ASSUMED"]
    assert "45 CHF" in told
    free = read(currency="CHF", per_hour=0).request
    assert free is not None
    assert free["fleet"][0]["costs"] == {"fixed": 0, "per_km": 2, "per_hour": 0}


def test_what_is_stated_is_taken_and_not_doubted() -> None:
    reply = read(depot="48.0, 11.0", vehicles=4, capacity=[9], shift="7:30-16:00", speed_kmh=30.0,
                 drones=1, drone_capacity=[2], max_trips=1, per_hour=20, per_km=0.5)
    assert reply.request is not None
    assert reply.request["depots"] == [{"id": "depot", "location": [11.0, 48.0]}]
    assert reply.request["fleet"] == [{
        "id": "vehicle", "count": 4, "capacity": [9], "shift": {"earliest": 27000, "latest": 57600},
        "max_trips": 1, "costs": {"fixed": 20, "per_km": 0.5, "per_hour": 20},
        "speed_kmh": 30.0, "drones": {"count": 1, "capacity": [2]}}]
    assert codes(reply) == {"MIDNIGHT"}


@pytest.mark.parametrize(("settings", "code"), [
    ({"depot": "Munich"}, "DEPOT"), ({"depot": "95, 200"}, "DEPOT"),
    ({"capacity": [1, 2]}, "CAPACITY"), ({"shift": "early"}, "SHIFT"),
    ({"shift": "17:00-8:00"}, "SHIFT_ENDS_BEFORE_START"), ({"drones": 1}, "DRONE_CAPACITY"),
    ({"drones": 1, "drone_capacity": [1, 1]}, "CAPACITY"),
])
def test_settings_that_do_not_fit_are_named(settings: dict[str, Any], code: str) -> None:
    assert wrong(read(**settings)) == [(code, None)]


def test_a_row_of_the_file_may_be_the_depot() -> None:
    reply = read("Lager,48.0,11.0,,,,", *ROWS)
    assert reply.request is not None
    assert reply.request["depots"] == [{"id": "depot", "location": [11.0, 48.0]}]
    assert reply.customers == 3
    assert "DEPOT_IN_FILE" in codes(reply)
    reply = read("Hub,48.0,11.0,depot", "Anna,48.1,11.1,customer", head="name,lat,lon,kind")
    assert reply.request is not None
    assert reply.request["depots"][0]["location"] == [11.0, 48.0]


def test_seconds_and_minutes_are_not_mixed_up_without_a_word() -> None:
    reply = read("A,1,1,10,8.30", "B,2,2,10,9.15", head="name,x,y,duration,open time")
    assert reply.request is not None
    first = reply.request["customers"][0]
    assert first["service_duration"] == 600
    assert first["time_window"] == {"earliest": 30600}
    assert "UNIT_GUESSED" in codes(reply)
    stated = read("A,1,1,10,8.30", head="name,x,y,duration,open time", mapping={"columns": [
        {"heading": "Duration", "meaning": "service", "unit": "seconds"}]})
    assert stated.request is not None
    assert stated.request["customers"][0]["service_duration"] == 10
    assert "UNIT_GUESSED" not in codes(stated)


def test_columns_are_corrected_by_a_mapping_found_by_headings() -> None:
    mapping = {"columns": [
        {"heading": "AMOUNT", "meaning": "ignored"}, {"heading": "von/bis", "meaning": "window"},
        {"heading": "Spalte 9", "meaning": "demand", "unit": "boxes"},
        {"heading": "not there", "meaning": "notes"}]}
    reply = read("A,1,1,99,8-10,4,gate 3", head="name,x,y,Amount,Von / Bis,Spalte 9,Sonstiges",
                 mapping=mapping | {"columns": [*mapping["columns"], {
                     "heading": "Sonstiges", "meaning": "info"}]})
    assert reply.request is not None
    assert reply.request["customers"] == [{
        "id": "A", "location": [1, 1], "demand": [4],
        "time_window": {"earliest": 28800, "latest": 36000}, "info": {"Sonstiges": "gate 3"}}]
    assert [column.meaning for column in reply.columns][3:] == ["ignored", "window", "demand",
                                                                "info"]


def test_columns_that_say_something_else_than_their_heading_are_not_used() -> None:
    reply = read("A,1,1,Berlin", "B,2,2,Paris", head="name,x,y,from")
    assert [column.meaning for column in reply.columns][3] == "ignored"
    assert codes(reply) >= {"NOT_USED"}
    assert reply.request is not None


def test_headings_may_lack_if_a_mapping_says_what_columns_mean() -> None:
    assert read("Ben,48.2,11.6,7", head="Anna,48.1,11.5,5").request is None
    reply = read("Ben,48.2,11.6,7", head="Anna,48.1,11.5,5", mapping={"header_row": 0, "columns": [
        {"column": "A", "meaning": "name"}, {"column": "B", "meaning": "latitude"},
        {"column": "C", "meaning": "longitude"}, {"column": "D", "meaning": "demand"}]})
    assert reply.request is not None
    assert [customer["id"] for customer in reply.request["customers"]] == ["Anna", "Ben"]


def test_a_day_is_chosen_of_several() -> None:
    rows = ("A,1,1,23.11.2026", "B,2,2,24.11.2026")
    head = "name,x,y,delivery date"
    assert wrong(read(*rows, head=head)) == [("SEVERAL_DAYS", "D3")]
    reply = read(*rows, head=head, day="2026-11-24")
    assert reply.request is not None
    assert [customer["id"] for customer in reply.request["customers"]] == ["B"]
    assert "OTHER_DAYS" in codes(reply)


@pytest.mark.parametrize(("text", "day", "is_doubtful"), [
    ("23/11/2026", "2026-11-23", False), ("11/23/2026", "2026-11-23", False),
    ("03/04/2026", "2026-04-03", True), ("03.04.2026", "2026-04-03", False),
    ("2026-04-03", "2026-04-03", False),
])
def test_days_before_months_are_found_or_doubted(text: str, day: str, is_doubtful: bool) -> None:
    reply = read(f"A,1,1,{text}", head="name,x,y,delivery date")
    assert reply.day == day
    assert ("DATES_GUESSED" in codes(reply)) == is_doubtful


def test_an_amount_that_may_be_thousands_is_doubted() -> None:
    reply = read('A,1,1,"1,234"', head="name,x,y,kg")
    assert reply.request is not None
    assert reply.request["customers"][0]["demand"] == [1234]
    assert any(doubt.cell == "D2" for doubt in reply.doubts)
    stated = read('A,1,1,"1,234"', head="name,x,y,kg", mapping={"decimals": ","})
    assert stated.request is not None
    assert stated.request["customers"][0]["demand"] == [1.234]


def test_x_and_y_that_are_degrees_are_told() -> None:
    reply = read("A,11.5754,48.1371", "B,11.5654,48.1471", head="name,x,y")
    assert reply.request is not None
    assert reply.request["coordinate_system"] == "geographic"
    assert reply.request["customers"][0]["location"] == [11.5754, 48.1371]
    assert "DEGREES_GUESSED" in codes(reply)


def test_a_place_far_from_all_others_is_told() -> None:
    reply = read(*ROWS, "Dora,11.55,48.15,1,,,")
    assert [doubt.cell for doubt in reply.doubts if doubt.code == "FAR_OFF"] == ["B5"]


def test_who_may_serve_skills_costs_and_vehicles() -> None:
    reply = read("A,1,1,ja,lift; cool,12.5,van,5", "B,2,2,nein,,,,", "C,3,3,drone,,,,",
                 head="name,x,y,drone allowed,skills,penalty,vehicles,late cost per hour")
    assert reply.request is None
    assert {error.code for error in reply.errors} == {"UNKNOWN_VEHICLE"}
    assert reply.errors[0].cell == "G2"
    reply = read("A,1,1,ja,lift; cool,12.5,vehicle-1,5", "B,2,2,nein,,,,", "C,3,3,drone,,,,",
                 head="name,x,y,drone allowed,skills,penalty,vehicles,late cost per hour")
    assert reply.request is not None
    first, second, third = reply.request["customers"]
    assert (first["served_by"], second["served_by"], third["served_by"]) == ("either", "truck",
                                                                             "drone")
    assert first["skills"] == ["lift", "cool"]
    assert first["unassigned_cost"] == 12.5
    assert first["vehicles"] == {"allowed": ["vehicle-1"]}


def test_more_customers_than_can_be_planned_are_refused_in_words(
        monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importing, "MAX_CUSTOMERS", 10)
    rows = [f"{number},1,{number}" for number in range(11)]
    reply = read(*rows, head="name,x,y")
    (error,) = reply.errors
    assert (error.code, error.cell) == ("WRONG_LENGTH", "A12")
    assert "Cut the file in parts" in error.message


@pytest.mark.parametrize(("content", "part"), [
    (b"", "empty"), (b"  \n", "empty"), (b"%PDF-1.7 ...", "PDF"), (b'{"customers": []}', "JSON"),
    (b"<html><table>", "HTML"), (b"PK\x03\x04 nothing", "workbook"),
    (b"\xd0\xcf\x11\xe0 nothing", "workbook"), (b"a\0b\0\0\0c", "can't be read"),
    (b"name,x,y\n", "no rows"), (b"\xff\xfe\x00", "can't be read"),
])
def test_what_is_no_sheet_is_refused_in_words(content: bytes, part: str) -> None:
    with pytest.raises(NotASheetError, match=part):
        import_file(content, ImportSettings())


def test_columns_of_one_heading_are_told_apart_by_their_letters() -> None:
    head = "name,x,y,Menge,Menge"
    reply = read("A,1,1,5,7", head=head, mapping={"columns": [
        {"heading": "Menge", "column": "E", "meaning": "ignored"}]})
    assert reply.request is not None
    assert reply.request["customers"][0]["demand"] == [5]
    again = read("A,1,1,5,7", head=head, mapping=reply.mapping.model_dump())
    assert again.request == reply.request


def test_names_in_two_columns_are_one() -> None:
    reply = read("Ann,Lee,1,1", "Bob,Ray,2,2", head="First name,Last name,x,y")
    assert reply.request is not None
    assert [customer["id"] for customer in reply.request["customers"]] == ["Ann Lee", "Bob Ray"]


@pytest.mark.parametrize(("heading", "cell"), [
    ("WKT", "POINT (11.5754 48.1371)"), ("GPS", '"48.1371, 11.5754"'),
    ("where", '"48.1371, 11.5754"'), ("location", '"[11.5754, 48.1371]"'),
])
def test_a_place_in_one_cell_is_known_by_its_look(heading: str, cell: str) -> None:
    reply = read(f"A,{cell}", head=f"name,{heading}")
    assert reply.request is not None
    assert reply.request["customers"][0]["location"] == [11.5754, 48.1371]


def test_without_headings_columns_are_known_by_their_looks_and_doubted() -> None:
    reply = read("Café,48.1471,11.5654,9:00,12:00", head="Bäckerei,48.1371,11.5754,8:00,10:00")
    assert reply.request is not None
    assert reply.request["customers"][0] == {
        "id": "Bäckerei", "location": [11.5754, 48.1371], "demand": [1],
        "time_window": {"earliest": 28800, "latest": 36000}}
    assert codes(reply) >= {"NO_HEADINGS", "MEANING_BY_CONTENT"}


@pytest.mark.parametrize(("lat", "lon", "cells"), [
    ("48.137.154", "11.575.382", ["B2", "C2"]), ("5334762.1", "691607.9", ["B2"]),
])
def test_coordinates_that_are_no_degrees_are_named(lat: str, lon: str, cells: list[str]) -> None:
    reply = read(f"A,{lat},{lon}", head="name,Breite,Länge")
    assert [error.cell for error in reply.errors] == cells


def test_customers_near_a_pole_have_swapped_coordinates() -> None:
    reply = read("A,39.80,-89.64", "B,39.82,-89.65", head="Customer,Longitude,Latitude")
    assert reply.request is not None
    assert reply.request["customers"][0]["location"] == [-89.64, 39.8]
    assert "SWAPPED" in codes(reply)


def test_ticked_skills_are_named_after_their_column_and_vehicles_have_them() -> None:
    reply = read("A,1,1,x", "B,2,2,", head="name,x,y,Hebebühne")
    assert reply.request is not None
    assert [customer.get("skills") for customer in reply.request["customers"]] == [["Hebebühne"],
                                                                                   None]
    assert reply.request["fleet"][0]["skills"] == ["Hebebühne"]
    assert "SKILLS_ASSUMED" in codes(reply)


def test_drones_that_lack_are_told() -> None:
    assert "NO_DRONES" in codes(read("A,1,1,drone", head="name,x,y,served by"))


def test_time_zones_are_not_passed_over_in_silence() -> None:
    reply = read("A,1,1,2026-11-23T08:00:00+01:00,PT10M", head="name,x,y,window start,service time")
    assert reply.request is not None
    assert reply.request["customers"][0]["time_window"] == {"earliest": 28800}
    assert reply.request["customers"][0]["service_duration"] == 600
    assert [doubt.cell for doubt in reply.doubts if doubt.code == "ZONE_NOT_READ"] == ["D2"]


def test_begins_and_ends_of_windows_are_in_one_unit() -> None:
    reply = read("A,1,1,480,600", "B,2,2,540,720", head="name,x,y,tw_start,tw_end")
    assert reply.request is not None
    assert [customer["time_window"] for customer in reply.request["customers"]] == [
        {"earliest": 28800, "latest": 36000}, {"earliest": 32400, "latest": 43200}]
    reply = read("A,1,1,0,1440", "B,2,2,600,900", head="name,x,y,tw_start,tw_end")
    assert reply.request is not None
    assert reply.request["customers"][0]["time_window"] == {"earliest": 0, "latest": 86400}
    assert "UNIT_GUESSED" in codes(reply)


@pytest.mark.parametrize(("head", "unit"), [("name,x,y", None), ("name,x_km,y_km", 1000),
                                            ("name,x (km),y (km)", 1000)])
def test_the_unit_of_a_plane_is_told(head: str, unit: int | None) -> None:
    reply = read("A,1.5,2.5", "B,3.5,4.5", head=head)
    assert reply.request is not None
    assert reply.request.get("planar_unit") == unit
    assert "PLANE" in codes(reply)


def test_words_of_headings_tell_the_encoding_of_a_short_file() -> None:
    content = ("Nazwa;Szerokość geograficzna;Długość geograficzna;Paczki;Czas obsługi [min]\n"
               "Żabka;51,7592;19,4560;2;5\nSklep;51,7612;19,4580;3;7\n").encode("cp1250")
    reply = import_file(content, ImportSettings())
    assert reply.encoding == "cp1250"
    assert reply.request is not None
    assert reply.request["customers"][0]["id"] == "Żabka"
    assert reply.request["customers"][1]["service_duration"] == 420


def test_a_column_of_degrees_minutes_and_seconds_is_a_place() -> None:
    content = ("Name;Position;kg\nA;48°07'30\"N 11°34'30\"E;3\n"
               "B;48°09'00\"N 11°33'00\"E;2\n").encode()
    reply = import_file(content, ImportSettings())
    assert [column.meaning for column in reply.columns] == ["name", "point", "demand"]
    assert reply.request is not None
    assert reply.request["customers"][1]["location"] == [11.55, 48.15]


def test_unknown_headings_over_names_and_clocks_are_read_by_their_cells_and_doubted() -> None:
    content = ("Kund;Latitud;Longitud;Vikt (kg);Tid från;Tid till;Anmärkning\n"
               "Bageri;59,3293;18,0686;12;08:00;10:00;porttelefon\n"
               "Apotek;59,3393;18,0786;3;09:30;12:00;\n").encode("cp1252")
    reply = import_file(content, ImportSettings())
    assert reply.encoding == "cp1252"
    assert reply.request is not None
    first = reply.request["customers"][0]
    assert (first["id"], first["time_window"]) == ("Bageri", {"earliest": 28800, "latest": 36000})
    assert "MEANING_BY_CONTENT" in codes(reply)


def test_times_that_nothing_uses_are_told() -> None:
    reply = read("A,48.1,11.5,before 9", "B,48.2,11.6,8-12", head="name,lat,lon,wish")
    (doubt,) = reply.columns[3].doubts
    assert doubt.code == "NOT_USED"
    assert "8-12" in doubt.message


def test_what_is_stated_to_be_nothing_is_not_guessed() -> None:
    reply = read("A,48.1,11.5,8:00,9:00", "B,48.2,11.6,8:00,9:00", head="name,lat,lon,aa,bb",
                 mapping={"columns": [{"heading": "aa", "meaning": "ignored"},
                                      {"heading": "bb", "meaning": "ignored"}]})
    assert [column.meaning for column in reply.columns[3:]] == ["ignored", "ignored"]
    assert reply.request is not None
    assert "time_window" not in reply.request["customers"][0]


@pytest.mark.parametrize("cell", ["-", "n/a"])
def test_a_time_that_is_struck_out_is_none(cell: str) -> None:
    reply = read(f"a;48.1;11.5;8:00;12:00\nb;48.2;11.6;{cell};12:00", head="name;lat;lon;von;bis")
    assert (reply.errors, reply.request is None) == ([], False)
