"""Orders that ask for a crew are served by the vehicles that have one."""

from typing import Any

import pytest

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
from tests.console.spreadsheets import book

ORDERS: list[tuple[Any, ...]] = [("Klient", "Lat", "Lon", "Ekipa")]
VANS: list[tuple[Any, ...]] = [
    ("Pojazd", "Załoga", "Ładowność m3"), ("WX 1", "2 os.", 12), ("WX 2", "3 os.", 12),
    ("WX 3", "1 os.", 8)]


def read(*crews: str, vans: list[tuple[Any, ...]] = VANS) -> ImportReply:
    orders = [(f"K{number}", 52.1 + number / 100, 21.0, crew) for number, crew in enumerate(crews)]
    return import_file(book(("Zlecenia", [*ORDERS, *orders]), ("Pojazdy", vans)), ImportSettings())


def test_as_many_people_as_asked_for_or_more() -> None:
    reply = read("2 os.", "1 os.", "3 os.", "WX 3")
    assert reply.request is not None, reply.errors
    assert [customer["vehicles"]["allowed"] for customer in reply.request["customers"]] == [
        ["WX 1", "WX 2"], ["WX 1", "WX 2", "WX 3"], ["WX 2"], ["WX 3"]]
    assert [doubt.cell for doubt in reply.doubts if doubt.code == "CREWS"] == ["D2"]


def test_crews_by_name_are_those_of_the_vehicles() -> None:
    vans: list[tuple[Any, ...]] = [("Pojazd", "Ekipa", "kg"), ("V1", "Nord", 5), ("V2", "Süd", 5)]
    reply = read("süd", "NORD", vans=[(*vans[0][:2], "Ładowność"), *vans[1:]])
    assert reply.request is not None, reply.errors
    assert [customer["vehicles"]["allowed"] for customer in reply.request["customers"]] == [
        ["V2"], ["V1"]]


@pytest.mark.parametrize("crew", ["4 os.", "Ost", "2 kg"])
def test_a_crew_that_no_vehicle_has_is_told(crew: str) -> None:
    assert {error.code for error in read(crew).errors} == {"UNKNOWN_VEHICLE"}


def test_crews_are_the_vehicles_where_nothing_else_names_these() -> None:
    vans: list[tuple[Any, ...]] = [("Ekipa", "Ładowność"), ("E1", 5), ("E2", 5)]
    reply = read("E2", "E1", vans=vans)
    assert reply.request is not None, reply.errors
    assert [kind["id"] for kind in reply.request["fleet"]] == ["E1", "E2"]
