"""Headings of several languages: what their columns mean, and what they are counted in."""

import pytest

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings

pytestmark = pytest.mark.slow


def read(*rows: str) -> ImportReply:
    """Import a CSV file whose first row has the headings."""
    return import_file("\n".join(rows).encode(), ImportSettings())


def test_a_word_of_two_languages_is_read_in_that_of_the_sheet() -> None:
    dutch = read("Naam,Breedtegraad,Lengtegraad,Aantal,Van,Tot",
                 "Bakker,52.37,4.89,3,0900,1700", "Slager,52.36,4.91,2,1000,1200")
    english = read("name,lat,lon,kg,van", "Anna,48.1,11.5,5,Van 1", "Ben,48.2,11.6,7,Van 2")
    assert [column.meaning for column in dutch.columns][-2:] == ["earliest", "latest"]
    assert english.columns[-1].meaning == "vehicles"


def test_amounts_have_the_names_and_units_of_their_columns() -> None:
    reply = read("name,lat,lon,Gewicht (kg),Kisten", "Anna,48.1,11.5,5,2", "Ben,48.2,11.6,7,1")
    assert reply.request is not None
    assert reply.request["load_dimensions"] == [{"name": "Gewicht", "unit": "kg"},
                                                {"name": "Kisten"}]


def test_an_unsure_encoding_is_shown_by_a_heading_if_no_cell_does() -> None:
    content = "Dirección,lat,lon\nCalle 1,40.4,-3.7\nCalle 2,40.5,-3.8".encode("cp1252")
    (doubt,) = [doubt for doubt in import_file(content, ImportSettings()).doubts
                if doubt.code == "ENCODING_GUESSED"]
    assert "'Dirección'" in doubt.message


def meanings(reply: ImportReply) -> dict[str, str]:
    return {column.heading: column.meaning for column in reply.columns}


@pytest.mark.parametrize(("heading", "cells", "meaning"), [
    ("Bitis (kg)", ("75.1", "43"), "demand"), ("To (kg)", ("480", "720"), "demand"),
    ("Ende [m\u00b3]", ("1.5", "2"), "demand"), ("Sum kg", ("5", "7"), "demand"),
    ("Menge (\u20ac)", ("20", "30"), "ignored"), ("Amount in EUR", ("20", "30"), "ignored"),
    ("Amount", ("20 \u20ac", "30 \u20ac"), "ignored"), ("Penalty (EUR)", ("20", "30"),
                                                     "unassigned_cost"),
    ("Anfahrt (min)", ("20", "30"), "ignored"), ("Anfahrtszeit (min)", ("20", "30"), "ignored"),
    ("Czas montażu (min)", ("20", "30"), "service"), ("Aufbauzeit (Min)", ("20", "30"), "service"),
    ("Temps de montage min", ("20", "30"), "service"), ("Parcel(s)", ("2", "3"), "demand"),
    ("Quantity", ("46000.375", "46000.5"), "ignored")])
def test_a_unit_excludes_what_has_another(heading: str, cells: tuple[str, str],
                                          meaning: str) -> None:
    reply = read(f"name,lat,lon,{heading}", f"Anna,48.1,11.5,{cells[0]}",
                 f"Ben,48.2,11.6,{cells[1]}")
    assert meanings(reply)[heading] == meaning
    assert reply.request is not None
    assert "time_window" not in reply.request["customers"][0]


@pytest.mark.parametrize(("verb", "place"), [
    ("Deliver", "Lat"), ("deliver", "Lng"), ("To deliver", "Long")])
def test_a_verb_beside_a_coordinate_is_no_amount(verb: str, place: str) -> None:
    other = "Longitude" if place == "Lat" else "Latitude"
    found = meanings(read(f"name,{verb} {place},{other},{verb}", "Anna,48.1,11.5,5"))
    assert found == {"name": "name", f"{verb} {place}": "latitude" if place == "Lat" else
                     "longitude", other: other.lower(), verb: "demand"}


@pytest.mark.parametrize(("begin", "end"), [
    ("Deliver after", "Deliver before"), ("Lieferung ab", "Lieferung bis"),
    ("Livraison \u00e0 partir de", "Livraison au plus tard"), ("Dostawa od", "Dostawa do"),
    ("Entrega desde", "Entrega hasta"), ("Arrive after", "Arrive by")])
def test_numbers_of_days_are_times_of_the_day_and_no_amounts(begin: str, end: str) -> None:
    reply = read(f"name,lat,lon,{begin},{end}", "Anna,48.1,11.5,46000.375,46000.5",
                 "Ben,48.2,11.6,46000.5,46000.75")
    assert reply.request is not None
    assert [customer["time_window"] for customer in reply.request["customers"]] == [
        {"earliest": 32400, "latest": 43200}, {"earliest": 43200, "latest": 64800}]


@pytest.mark.parametrize("heading", ["Mobility", "Mobility type", "Mobilität", "Mobilité"])
def test_mobility_is_a_skill_and_no_telephone(heading: str) -> None:
    reply = read(f"name,lat,lon,{heading},Phone", "Anna,48.1,11.5,WC,555 0101",
                 "Ben,48.2,11.6,AMB,555 0102", "Cy,48.2,11.6,STR,555 0103")
    assert reply.request is not None
    first = reply.request["customers"][0]
    assert (first["skills"], first["info"]["phone"]) == (["WC"], "555 0101")


@pytest.mark.parametrize("head", ["id,title", "title,id", "ID,Titel", "Title,Name"])
def test_a_number_or_a_courtesy_beside_a_name_is_not_the_name(head: str) -> None:
    rows = [("17", "Bakery"), ("18", "Cafe"), ("19", "Shop")]
    if head == "Title,Name":
        rows = [("Ms", "Bakery"), ("Mr", "Cafe"), ("Mr", "Shop")]
    elif head == "title,id":
        rows = [(name, number) for number, name in rows]
    reply = read(f"{head},lat,lon", *(f"{first},{second},48.1,11.{place}" for place, (
        first, second) in enumerate(rows)))
    assert reply.request is not None
    assert [customer["id"] for customer in reply.request["customers"]] == [
        "Bakery", "Cafe", "Shop"]


def test_an_end_beside_a_start_is_that_of_the_window() -> None:
    found = meanings(read("name,lat,lon,Start,End", "Anna,48.1,11.5,8:00,9:00"))
    assert [found["Start"], found["End"]] == ["earliest", "latest"]


@pytest.mark.parametrize(("heading", "seconds"), [
    ("Minutes at stop", 300), ("Minutes of service", 300)])
def test_a_unit_that_begins_a_heading_is_stated(heading: str, seconds: float) -> None:
    reply = read(f"name,lat,lon,{heading}", "Anna,48.1,11.5,5", "Ben,48.2,11.6,5")
    assert reply.request is not None
    assert reply.request["customers"][0]["service_duration"] == seconds
    assert "UNIT_GUESSED" not in [doubt.code for doubt in reply.doubts]
