"""Spreadsheets with addresses and no coordinates."""

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from app.cli.commands import cli
from app.formats.sheets.addresses import Finder
from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
from app.maps.addresses.addresses import Addresses
from app.maps.addresses.geocoder import Candidates, GeocoderUnavailableError
from tests.app.maps.addresses.conftest import helsinki  # noqa: F401
from tests.app.maps.addresses.stated import StatedGeocoder, place

pytestmark = pytest.mark.slow

HEAD = "Name,Street,Zip,Town,kg"
ROWS = ("Anna,Ring 1,10000,Adorf,5", "Ben,Ring 2,10000,Adorf,5", "Cleo,Ring 3,10000,Adorf,5",
        "Dora,Ring 4,10000,Adorf,5")
KNOWN: dict[str, Candidates] = {
    f"Ring {number}, 10000 Adorf": (place(f"Ring {number}", 10 + number / 1000, 50.0),)
    for number in range(1, 5)}


def read(*rows: str, head: str = HEAD, known: dict[str, Candidates] | None = None,
         error: GeocoderUnavailableError | None = None, **settings: Any) -> ImportReply:
    """Import a CSV file where these addresses are known."""
    geocoder = StatedGeocoder({**KNOWN, **(known or {})}, error)
    return import_file("\n".join([head, *(rows or ROWS)]).encode(),
                       ImportSettings.model_validate(settings),
                       Finder(Addresses([geocoder]), 20.0))


def doubts(reply: ImportReply) -> list[tuple[str, str | None]]:
    return [(doubt.code, doubt.cell) for doubt in reply.doubts if doubt.code.startswith("ADDRESS")]


def test_addresses_are_looked_up_row_by_row() -> None:
    reply = read()
    assert (reply.errors, doubts(reply)) == ([], [])
    assert reply.request is not None
    assert [customer["location"] for customer in reply.request["customers"]] == [
        [10.001, 50.0], [10.002, 50.0], [10.003, 50.0], [10.004, 50.0]]
    assert reply.request["customers"][0]["info"]["address"] == "Ring 1, 10000 Adorf"
    assert reply.request["coordinate_system"] == "geographic"
    assert reply.looked_up is not None
    assert (reply.looked_up.asked, reply.looked_up.known) == (4, 4)
    assert [(found.cell, found.label) for found in reply.looked_up.places][:2] == [
        ("B2", "Ring 1"), ("B3", "Ring 2")]


def test_coordinates_that_are_stated_are_not_looked_up() -> None:
    reply = read("Anna,Ring 1,10000,Adorf,5,50.5,10.5", "Ben,Ring 2,10000,Adorf,5,,",
                 head=f"{HEAD},lat,lon")
    assert reply.request is not None
    assert [customer["location"] for customer in reply.request["customers"]] == [
        [10.5, 50.5], [10.002, 50.0]]


def test_what_is_below_house_level_is_doubted_at_its_cell() -> None:
    reply = read(*ROWS[:2], "Eva,Weg,10000,Adorf,1", known={
        "Weg, 10000 Adorf": (place("Weg, Adorf", 10.0, 50.0, "street"),)})
    assert reply.request is not None
    assert doubts(reply) == [("ADDRESS_INEXACT", "B4")]
    assert reply.looked_up is not None
    assert [found.doubt is None for found in reply.looked_up.places] == [True, True, False]


def test_place_far_from_all_others_is_doubted() -> None:
    reply = read(*ROWS, "Eva,Weg 1,10000,Adorf,1", known={
        "Weg 1, 10000 Adorf": (place("Weg 1, Elsewhere", 20.0, 50.0),)})
    assert doubts(reply) == [("ADDRESS_FAR", "B6")]


def test_of_several_places_that_near_the_others_is_taken_and_told() -> None:
    far, near = place("Weg 1, Cedorf", 14.0, 50.0), place("Weg 1, Adorf", 10.01, 50.0)
    reply = read(*ROWS, "Eva,Weg 1,,,1", known={"Weg 1": (far, near)})
    assert reply.request is not None
    assert reply.request["customers"][4]["location"] == [10.01, 50.0]
    assert doubts(reply) == [("ADDRESS_NEAREST", "B6")]


def test_rows_that_are_not_found_are_refused_by_their_cells() -> None:
    several = place("Weg 1, Adorf", 10.0, 50.01), place("Weg 1, Bedorf", 10.0, 49.99)
    reply = read(*ROWS, "Eva,Weg 1,,,1", "Finn,Nowhere 1,,,1", "Gina,,,,1",
                 known={"Weg 1": several})
    assert [(error.code, error.cell) for error in reply.errors] == [
        ("ADDRESS_AMBIGUOUS", "B6"), ("ADDRESS_NOT_FOUND", "B7"), ("NO_COORDINATES", "B8")]
    assert reply.request is None
    kept = read(*ROWS, "Finn,Nowhere 1,,,1", leave_out_errors=True)
    assert kept.request is not None
    assert len(kept.request["customers"]) == 4


def test_rows_that_are_not_found_may_keep_their_addresses() -> None:
    several = place("Weg 1, Adorf", 10.0, 50.01), place("Weg 1, Bedorf", 10.0, 49.99)
    reply = read(*ROWS, "Eva,Weg 1,,,1", "Finn,Nowhere 1,,,1", "Gina,,,,1",
                 known={"Weg 1": several}, not_found="address", leave_out_errors=True)
    assert [(error.code, error.cell) for error in reply.errors] == [("NO_COORDINATES", "B8")]
    assert doubts(reply) == [("ADDRESS_AMBIGUOUS", "B6"), ("ADDRESS_NOT_FOUND", "B7")]
    assert reply.request is not None
    assert [customer["location"] for customer in reply.request["customers"]][3:] == [
        [10.004, 50.0], {"address": "Weg 1"}, {"address": "Nowhere 1"}]
    alone = read("Eva,Nowhere 1,,,1", "Finn,Nowhere 2,,,1", not_found="address")
    assert [error.code for error in alone.errors] == ["DEPOT"]


def test_what_is_not_looked_up_in_time_is_told_with_how_much_is_known() -> None:
    reply = read(*ROWS, "Eva,Weg 1,,,1", "Finn,Weg 2,,,1",
                 error=GeocoderUnavailableError("The geocoder didn't answer in time."))
    assert reply.request is None
    assert [error.code for error in reply.errors] == ["ADDRESSES_PENDING"]
    assert "4 of 6 addresses" in reply.errors[0].message
    assert reply.looked_up is not None
    assert (reply.looked_up.asked, reply.looked_up.known) == (6, 4)


def test_depot_may_be_an_address() -> None:
    reply = read(depot="Ring 1, 10000 Adorf")
    assert reply.request is not None
    assert reply.request["depots"] == [{"id": "depot", "location": [10.001, 50.0]}]
    assert "DEPOT_FOUND" in {doubt.code for doubt in reply.doubts}
    assert [error.code for error in read(depot="Nowhere").errors] == ["DEPOT"]
    named = read("Depot,Ring 1,10000,Adorf,", *ROWS[1:])
    assert named.request is not None
    assert named.request["depots"] == [{"id": "depot", "location": [10.001, 50.0]}]


def test_without_a_geocoder_addresses_may_be_kept_to_be_placed_by_hand() -> None:
    def by_hand(*rows: str, **settings: Any) -> ImportReply:
        return import_file("\n".join([f"{HEAD},lat,lon", *rows]).encode(),
                           ImportSettings.model_validate({"not_found": "address"} | settings))

    some = by_hand("Anna,Ring 1,10000,Adorf,5,50.5,10.5", "Ben,Ring 2,10000,Adorf,5,,")
    assert some.request is not None
    assert [customer["location"] for customer in some.request["customers"]] == [
        [10.5, 50.5], {"address": "Ring 2, 10000 Adorf"}]
    assert [(doubt.code, doubt.cell) for doubt in some.doubts
            if doubt.code.endswith("BY_HAND")] == [("PLACED_BY_HAND", "B3")]
    rows = [f"{row},," for row in ROWS]
    assert [error.code for error in by_hand(*rows).errors] == ["DEPOT"]
    stated = by_hand("Depot,Ring 9,10000,Adorf,,,", *rows, depot="50.1, 10.1")
    assert stated.request is not None
    assert stated.request["depots"] == [{"id": "depot", "location": [10.1, 50.1]}]
    assert all("address" in customer["location"] for customer in stated.request["customers"])
    assert by_hand(*rows, not_found="error").request is None


def test_places_on_a_plane_are_not_looked_up() -> None:
    reply = read("Anna,Ring 1,1000,2000,5", "Ben,Ring 2,1000,,5", "Cleo,Ring 3,1500,100,5",
                 head="Name,Street,x,y,kg")
    assert [error.code for error in reply.errors] == ["NO_COORDINATES"]
    assert reply.looked_up is None


def test_command_looks_up_by_the_setting(
        helsinki: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:  # noqa: F811
    sheet, request = tmp_path / "sheet.csv", tmp_path / "request.json"
    sheet.write_text("Name;Address;kg\nAnna;Mikonkatu 18, Helsinki;2\nBen;Kaivokatu 1;3\n", "utf-8")
    command = ["import", str(sheet), "-o", str(request), "--depot", "Bulevardi, Helsinki"]
    refused = CliRunner().invoke(cli, command)
    assert (refused.exit_code, request.exists()) == (2, False)
    monkeypatch.setenv("TANDEM_GEOCODER", f"extract:{helsinki}")
    monkeypatch.setenv("TANDEM_DATA_DIR", str(tmp_path))
    done = CliRunner().invoke(cli, command)
    assert (done.exit_code, request.exists()) == (0, True), done.output
    assert "2 of 2 addresses are looked up" in done.output
    assert "street alone" in done.output
