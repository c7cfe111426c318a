"""Rows of two places become shipments, other places of customers, and what drivers keep to."""

from typing import Any

import httpx
import pytest
import xlsxwriter

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
from tests.app.formats.sheets.makes import workbook

pytestmark = pytest.mark.slow

ENGLISH = """\
Order;Pickup name;Pickup lat;Pickup lon;Pickup from;Pickup until;Client;Delivery lat;Delivery lon;\
Delivery until;Qty;Max ride time (min);Max detour
A1;Mill;48.10;11.50;8:00;10:00;Baker;48.2;11.6;12:00;3;60;1.5
A2;Mine;48.11;11.51;8:00;10:00;Smith;48.3;11.6;12:00;4;;
A3;;;;;;Shop;48.3;11.7;12:00;4;;
"""

TWO_ROWS = """\
Auftrag;Art;Kunde;Breite;Länge;Menge;von;bis
7;Abholung;Mühle;48,1;11,5;3;8:00;9:00
7;Lieferung;Bäcker;48,2;11,6;;;11:00
8;Lieferung;Laden;48,25;11,6;3;;
"""


def read(text: str, **settings: Any) -> ImportReply:
    return import_file(text.encode(), ImportSettings.model_validate(settings))


def request(reply: ImportReply) -> dict[str, Any]:
    assert reply.request is not None, reply.errors
    return reply.request


def told(reply: ImportReply) -> list[tuple[str, str | None]]:
    return [(doubt.code, doubt.cell) for doubt in reply.doubts
            if doubt.code.startswith(("SHIPMENT", "OTHER", "RELAT", "BREAK"))]


@pytest.mark.parametrize(("headings", "meanings"), [
    ("Pickup address,Pick-up zip,Collection time,Drop-off address,Qty",
     "pickup_address,pickup_postcode,pickup_window,address,demand"),
    ("Abholadresse,Abhol-PLZ,Abholung von,Abholung bis,Lieferadresse,Liefer-PLZ,Ladezeit",
     "pickup_address,pickup_postcode,pickup_earliest,pickup_latest,address,postcode,service"),
    ("Adresse d'enlèvement,Adresse de livraison,Poids", "pickup_address,address,demand"),
    ("Dirección de recogida,Dirección de entrega", "pickup_address,address"),
    ("from lat,from lon,to lat,to lon,from,to",
     "pickup_latitude,pickup_longitude,latitude,longitude,earliest,latest"),
    ("Address,Alternative address,Alternative phone", "address,alternative_address,phone"),
    ("Name,Abholadresse,Abholmenge", "name,address,pickup"),
    ("Kunde,Lat,Lon,Nach Kunde,Alternative zu",
     "name,latitude,longitude,after,alternative_to")])
def test_headings_tell_which_place_they_are_about(headings: str, meanings: str) -> None:
    reply = read(f"{headings}\n" + ",".join(
        "48.1" if "lat" in name.lower() else "11.5" if "lon" in name.lower() else
        "9-10" if "window" in meaning else "9:00" if meaning in ("earliest", "latest")
        or meaning.startswith(("pickup_earl", "pickup_lat")) else "7"
        for name, meaning in zip(headings.split(","), meanings.split(","), strict=True)))
    assert [column.meaning for column in reply.columns] == meanings.split(",")


def test_a_row_of_two_places_is_a_shipment_and_one_of_one_a_customer() -> None:
    reply = read(ENGLISH)
    assert (reply.customers, reply.shipments) == (1, 2)
    first, second = request(reply)["shipments"]
    assert first == {
        "id": "A1", "amount": [3], "max_time_between": 3600, "max_detour": 1.5,
        "pickup": {"location": [11.5, 48.1], "info": {"name": "Mill"},
                   "time_window": {"earliest": 28800, "latest": 36000}},
        "delivery": {"location": [11.6, 48.2], "info": {"name": "Baker", "order": "A1"},
                     "time_window": {"earliest": 0, "latest": 43200}}}
    assert "max_time_between" not in second
    assert [customer["id"] for customer in request(reply)["customers"]] == ["Shop"]
    assert request(reply)["fleet"][0]["capacity"] == [11]


def test_rows_of_one_order_are_asked_about() -> None:
    reply = read(TWO_ROWS, day="2026-11-27", time_zone="Europe/Berlin")
    [question] = [question for question in reply.questions if question.kind == "shipments"]
    assert (question.answer, question.cell) == ("shipments", "A2")
    [shipment] = request(reply)["shipments"]
    assert (shipment["id"], shipment["amount"]) == ("7", [3])
    assert shipment["pickup"]["time_window"] == {"earliest": "08:00", "latest": "09:00"}
    apart = request(read(TWO_ROWS, mapping={"answers": {"shipments": "apart"}}))
    assert "shipments" not in apart
    assert [customer.get("pickup") for customer in apart["customers"]] == [[3], None, None]


def test_rows_named_as_one_shipment_are_its_ends_in_their_order() -> None:
    reply = read("Pair,Name,Lat,Lon,Qty\nx,A,48.1,11.5,2\nx,B,48.2,11.5,2\ny,C,48.3,11.5,1\n")
    [shipment] = request(reply)["shipments"]
    assert (shipment["pickup"]["info"]["name"], shipment["amount"]) == ("A", [2])
    assert told(reply) == [("SHIPMENT_OF_ONE_ROW", "A4"), ("SHIPMENT_IN_ORDER", "A2")]


def test_several_pickups_of_one_order_are_parts_of_a_shipment() -> None:
    rows = TWO_ROWS + "7;Abholung;Müller;48,15;11,5;4;;\n"
    [shipment] = request(read(rows))["shipments"]
    assert [(part["id"], part["amount"], part["location"]) for part in shipment["pickups"]] == [
        ("pickup-1", [3], [11.5, 48.1]), ("pickup-2", [4], [11.5, 48.15])]
    assert not {"amount", "pickup"} & shipment.keys()
    assert request(read(rows))["fleet"][0]["capacity"] == [10]
    lacking = read(rows.replace(";4;;", ";;;"))
    assert [(error.code, error.cell) for error in lacking.errors] == [("SHIPMENT_AMOUNTS", "F5")]
    [shipment] = request(read(rows, day="2026-11-27", time_zone="Europe/Berlin"))["shipments"]
    assert [part.get("time_window") for part in shipment["pickups"]] == [
        {"earliest": "08:00", "latest": "09:00"}, None]


def test_a_parcel_that_is_there_after_all_windows_of_its_pickup_is_refused() -> None:
    rows = ("Order;Kind;Name;Lat;Lon;Qty;Window;Available from\n"
            "7;pickup;A;48.1;11.1;2;8:00-9:00, 10:00-11:00;12:00\n7;delivery;C;48.3;11.3;;;\n")
    for more, cells in (("", ["G2"]), ("7;pickup;B;48.2;11.2;1;7:00-8:00;\n", ["G2", "G4"])):
        reply = read(rows + more)
        assert [(error.code, error.cell) for error in reply.errors] == [
            ("WINDOW_ENDS_BEFORE_START", cell) for cell in cells]


@pytest.mark.parametrize(("rows", "error"), [
    ("x,A,48.1,11.5,2,\nx,B,48.2,11.5,3,", ("SHIPMENT_AMOUNTS", "E3")),
    ("x,A,48.1,11.5,2,\nx,B,48.2,11.5,2,\nx,C,48.3,11.5,1,", ("SHIPMENT_ROWS", "A2")),
    ("x,A,48.1,11.5,2,\nx,B,92,11.5,2,", ("OFF_GLOBE", "C3")),
    (",A,48.1,11.5,2,\n,B,48.2,11.5,2,Zoe", ("ALTERNATIVE", "F3"))])
def test_what_makes_no_shipment_and_nobodys_place_is_refused_at_its_cell(
        rows: str, error: tuple[str, str]) -> None:
    reply = read(f"Pair,Name,Lat,Lon,Qty,Alternative to\n{rows}\n")
    assert [(found.code, found.cell) for found in reply.errors] == [error]


def test_other_places_stand_in_columns_or_rows() -> None:
    reply = read("Name,Lat,Lon,Qty,Until,Alternative Lat,Alternative Lon,Alternative cost,"
                 "Alternative to,Served after\n"
                 "Anna,48.1,11.5,3,10:00,48.12,11.52,2,,\nLocker 7,48.11,11.51,,9:00,,,,anna,\n"
                 "Ben,48.2,11.5,3,,,,,,Anna\nBen,48.21,11.5,3,,,,,yes,\n")
    anna, ben = request(reply)["customers"]
    assert anna["alternatives"] == [
        {"id": "other place", "location": [11.52, 48.12], "cost": 2},
        {"id": "Locker 7", "location": [11.51, 48.11],
         "time_window": {"earliest": 0, "latest": 32400}}]
    assert [place["location"] for place in ben["alternatives"]] == [[11.5, 48.21]]
    assert told(reply) == [("OTHER_PLACES", "F2")]
    assert request(reply)["relations"] == [{"kind": "before", "customers": ["Anna", "Ben"]}]


def test_orders_hold_for_one_vehicle_or_any() -> None:
    file = "Name,Lat,Lon,Qty,Served before\nA,48.1,11.5,1,B\nB,48.2,11.5,1,\nC,48.3,11.5,1,{}\n"
    [relation] = request(read(file.format("Zoe"), mapping={"answers": {"orders": "any"}}))[
        "relations"]
    assert relation == {"kind": "before", "customers": ["A", "B"], "same_vehicle": False}
    assert told(read(file.format("Zoe"))) == [("RELATED_TO_NOBODY", "E4")]
    around = read(file.replace("B,48.2,11.5,1,", "B,48.2,11.5,1,A").format(""))
    assert [(error.code, error.cell) for error in around.errors] == [("CONTRADICTION", "E3")]


def test_shipments_go_with_others_and_come_before_or_after_them() -> None:
    lines = TWO_ROWS.splitlines()
    file = "\n".join([f"{lines[0]};Zusammen mit;Nach Kunde", f"{lines[1]};;", f"{lines[2]};9;",
                      "9;Lieferung;Ende;48,3;11,6;3;;;;7", "10;Lieferung;Anfang;48,3;11,7;3;;;;",
                      "11;Abholung;Quelle;48,2;11,7;3;;;;10", "11;Lieferung;Ziel;48,1;11,7;;;;;"])
    assert [(found["kind"], found["customers"]) for found in request(read(file))["relations"]] == [
        ("before", ["7/delivery", "Ende"]), ("before", ["Anfang", "11/pickup"]),
        ("together", ["Ende", "7/delivery"])]


def test_vehicles_have_breaks_and_driving_rules() -> None:
    def fill(book: xlsxwriter.Workbook) -> None:
        rows = (("Fahrzeug", "Kapazität", "Pause", "Pausendauer", "Max. Arbeitszeit", "Lenkzeiten"),
                ("A", 40, "11:00-14:00", 45, 9, "nein"), ("B", 40, "12:00-12:30"),
                ("C", 40, None, 30, 8.5), ("D", 40, None, None, None, "EU 561/2006"),
                ("E", 40, None, None, None, "561 + 2002/15"))
        customers = (("Name", "Breite", "Länge"), ("Anna", 48.1, 11.5))
        for name, lines in (("Kunden", customers), ("Fahrzeuge", rows)):
            sheet = book.add_worksheet(name)
            for number, row in enumerate(lines):
                sheet.write_row(number, 0, row)

    reply = import_file(workbook(fill), ImportSettings())
    first, second, third, *ruled = request(reply)["fleet"]
    assert first["breaks"] == [{"id": "break", "duration": 2700,
                                "start": {"earliest": 39600, "latest": 47700}}]
    assert first["max_working_duration"] == 32400
    assert second["breaks"] == [{"id": "break", "duration": 1800, "at": "anywhere",
                                 "start": {"earliest": 43200, "latest": 43200}}]
    assert third["breaks"] == [{"id": "break", "duration": 1800, "start": {"latest": 21600},
                                "after_departure": True}]
    assert [kind.get("driving_rules", {}).get("preset") for kind in (first, *ruled)] == [
        None, "eu-561", "eu-561+2002-15"]
    assert [code for code, _ in told(reply)] == ["BREAKS_ASSUMED"] * 2


def test_what_a_sheet_of_shipments_says_is_planned(searching: httpx.Client) -> None:
    settings = '{"vehicles": 1, "time_zone": "Europe/Berlin", "day": "2026-11-27"}'
    reply = searching.post("/import", content=ENGLISH.encode(), params={"settings": settings},
                           headers={"Content-Type": "text/csv"})
    plan = searching.post("/plan", json=reply.json()["request"]
                          | {"options": {"time_limit": 60, "search_iterations": 300}})
    assert plan.status_code == 200, plan.text
    kinds = [(stop["kind"], stop["id"]) for trip in plan.json()["routes"][0]["trips"]
             for stop in trip["stops"]]
    assert kinds.index(("pickup", "A1")) < kinds.index(("delivery", "A1"))
    assert plan.json()["summary"]["served"] == 5


PLACES = ((4.8357, 45.764), (4.88, 45.77))


def both_ends(headings: str) -> ImportReply:
    """Read two orders with coordinates in one cell at each end."""
    first, second = (f'"{latitude},{longitude}"' for longitude, latitude in PLACES)
    return read(f"name,{headings},weight\nA,{first},{second},5\nB,{first},{second},2\n",
                depot="45.760,4.850", vehicles=2, capacity=[50], shift="8:00-18:00")


@pytest.mark.parametrize("headings", [
    "pickup.latlng,dropoff.latlng", "pickup coordinates,delivery coordinates", "from,to",
    "von,nach", "Start,End", "Abholkoordinaten,Lieferkoordinaten", "origin,destination",
    "coordenadas de recogida,coordenadas de entrega", "pickup address,delivery address",
    "pickup position,coordinates"])
def test_goods_go_from_pickup_to_delivery_by_coordinates_in_one_cell(headings: str) -> None:
    made = request(both_ends(headings))
    assert made["customers"] == []
    for shipment, amount in zip(made["shipments"], (5, 2), strict=True):
        assert shipment["amount"] == [amount]
        assert shipment["pickup"]["location"] == list(PLACES[0])
        assert shipment["delivery"]["location"] == list(PLACES[1])


@pytest.mark.parametrize("headings", ["foo,bar", "location A,location B"])
def test_a_second_place_that_no_heading_tells_is_asked(headings: str) -> None:
    reply = both_ends(headings)
    assert [question.kind for question in reply.questions] == ["column"]
    assert reply.questions[0].column == "C"


def test_windows_and_notes_of_both_ends_go_with_them() -> None:
    made = request(read(
        "pickup.latlng,pickup.timeslot,dropoff.latlng,dropoff.timeslot,weight,pickup.comments\n"
        '"45.7640,4.8357",2026-06-10 09:00 - 2026-06-10 10:00,"45.7700,4.8800",'
        "2026-06-10 09:30 - 2026-06-10 11:00,5.5,Ring twice\n",
        depot="45.760,4.850", vehicles=2, capacity=[50], shift="8:00-18:00"))
    (shipment,) = made["shipments"]
    assert shipment["pickup"] == {
        "location": [4.8357, 45.764], "time_window": {"earliest": 32400, "latest": 36000},
        "info": {"notes": "Ring twice"}}
    assert shipment["delivery"]["location"] == [4.88, 45.77]
    assert shipment["delivery"]["time_window"] == {"earliest": 34200, "latest": 39600}


def test_coordinates_of_a_pickup_alone_are_the_customers_own() -> None:
    made = request(read('name,pickup coordinates,weight\nA,"45.764,4.8357",5\n',
                        depot="45.760,4.850", vehicles=2, capacity=[50], shift="8:00-18:00"))
    assert made["customers"][0]["location"] == [4.8357, 45.764]


@pytest.mark.parametrize("heading", ["Ready at", "Ready time", "Bereit ab"])
def test_a_parcel_is_ready_where_it_is_fetched(heading: str) -> None:
    reply = read(f"Order,Pickup lat,Pickup lon,{heading},Delivery lat,Delivery lon,Deliver by\n"
                 "1,48.1,11.5,9:00,48.2,11.6,12:00\n")
    [shipment] = request(reply)["shipments"]
    assert shipment["pickup"]["time_window"] == {"earliest": 32400}
    assert shipment["delivery"]["time_window"] == {"earliest": 0, "latest": 43200}


@pytest.mark.parametrize("headings", [
    "Kind,Breite,Länge,Schule,Schule Breite,Schule Länge,Schulbeginn,Max. Fahrzeit (min),Rollstuhl",
    "Child,Home lat,Home lon,School,School lat,School lon,School begins at,Longest ride (min),"
    "Wheelchair",
    "Élève,Latitude,Longitude,École,École latitude,École longitude,École début,Trajet max (min),"
    "Fauteuil roulant"])
def test_children_are_at_school_before_it_begins(headings: str) -> None:
    reply = read(f"{headings}\nAnn,48.1,11.5,Park,48.2,11.6,8:00,45,x\n"
                 "Bob,48.11,11.51,Park,48.2,11.6,8:15,45,\n")
    first, second = request(reply)["shipments"]
    assert (first["id"], first["amount"], first["max_time_between"]) == ("Ann", [1], 2700)
    assert first["pickup"]["location"] == [11.5, 48.1]
    assert (first["delivery"]["location"], first["delivery"]["time_window"]) == (
        [11.6, 48.2], {"earliest": 0, "latest": 28800})
    assert first["skills"] == [headings.split(",")[-1]]
    assert "skills" not in second


def test_they_leave_school_after_it_ends() -> None:
    for heading in ("School ends", "Schulschluss", "Fin cours"):
        reply = read(f"Name,Lat,Lon,{heading}\nAnn,48.1,11.5,13:00\n")
        assert request(reply)["customers"][0]["time_window"] == {"earliest": 46800}


def test_a_longest_ride_without_a_second_place_is_told() -> None:
    reply = read("Name,Lat,Lon,Longest ride (min)\nAnn,48.1,11.5,45\n")
    assert [doubt.cell for doubt in reply.doubts if doubt.code == "RIDE_UNUSED"] == ["D2"]
    assert not [doubt for doubt in read(ENGLISH).doubts if doubt.code == "RIDE_UNUSED"]


@pytest.mark.parametrize("heading", ["Return time", "Rückfahrt", "Hora de vuelta", "Trajet retour"])
def test_a_ride_back_in_the_row_is_a_shipment_of_its_own(heading: str) -> None:
    reply = read(f"Passenger,Pickup lat,Pickup lon,Dropoff lat,Dropoff lon,Deliver by,{heading},"
                 "Seats,Mobility\nAnn,48.1,11.5,48.2,11.6,9:00,11:30,2,WC\n"
                 "Bob,48.1,11.5,48.2,11.6,10:00,,1,\n", mapping={"columns": [
                     {"heading": "Seats", "meaning": "demand"}]})
    out, other, back = request(reply)["shipments"]
    assert (out["id"], other["id"], back["id"]) == ("Ann", "Bob", "Ann (2)")
    assert [back[end]["location"] for end in ("pickup", "delivery")] == [[11.6, 48.2], [11.5, 48.1]]
    assert back["pickup"]["time_window"] == {"earliest": 41400}
    assert "time_window" not in back["delivery"]
    assert (back["amount"], back["skills"]) == ([2], ["WC"])
    assert out["delivery"]["time_window"] == {"earliest": 0, "latest": 32400}
    assert "RIDES_BACK" in [doubt.code for doubt in reply.doubts]
