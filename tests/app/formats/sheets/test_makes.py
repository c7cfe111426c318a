"""Spreadsheets of twelve makes are read as they are meant."""

from collections.abc import Callable
from typing import Any

import pytest

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
from tests.app.formats.sheets import makes

pytestmark = pytest.mark.slow

Customer = dict[str, Any]

MAKES: dict[str, Callable[[], bytes]] = {
    "german": lambda: makes.GERMAN.encode("cp1252"),
    "french": makes.FRENCH.encode,
    "american": makes.AMERICAN.encode,
    "tabs": lambda: makes.TABS.encode("utf-16"),
    "italian": lambda: makes.ITALIAN.encode("cp1252"),
    "swapped": makes.SWAPPED.encode,
    "minutes": makes.MINUTES.encode,
    "windows": lambda: makes.WINDOWS.encode("cp1250"),
    "several rows": makes.SEVERAL_ROWS.encode,
    "merged headings": makes.merged_headings,
    "fractions": makes.fractions,
    "dates": makes.dates,
    "open document": makes.open_document,
    "long": lambda: makes.large(400),
}


def imported(content: bytes, **settings: Any) -> ImportReply:
    """Import a file that is complete but for its depot and fleet."""
    reply = import_file(content, ImportSettings.model_validate(settings))
    assert reply.errors == []
    assert reply.request is not None
    return reply


def customers(reply: ImportReply) -> list[Customer]:
    assert reply.request is not None
    return reply.request["customers"]  # type: ignore[no-any-return]


def times(reply: ImportReply) -> list[tuple[float, float]]:
    """Return the hours between which customers are served."""
    windows = [customer["time_window"] for customer in customers(reply)]
    return [(window["earliest"] / 3600, window["latest"] / 3600) for window in windows]


def services(reply: ImportReply) -> list[float]:
    """Return the minutes at each stop."""
    return [customer["service_duration"] / 60 for customer in customers(reply)]


def told(reply: ImportReply) -> set[str]:
    """Return the codes of all doubts."""
    return {doubt.code for doubt in [*reply.doubts, *(doubt for column in reply.columns
                                                      for doubt in column.doubts)]}


def test_german_commas_and_points_in_clocks() -> None:
    reply = imported(MAKES["german"](), **makes.GERMAN_SETTINGS)
    assert reply.encoding == "cp1252"
    assert reply.header_rows == [3]
    assert times(reply) == [(8.5, 12), (9, 17.5), (8, 11.25)]
    assert services(reply) == [10, 5, 15]
    assert [customer["demand"] for customer in customers(reply)] == [[1012.5], [3], [7.25]]
    assert customers(reply)[0]["location"] == [11.5754, 48.1371]
    assert customers(reply)[0]["info"] == {
        "address": "Königstr. 1, 80331 München", "order": "4711", "phone": "089 1234",
        "notes": "Hof"}
    assert reply.request is not None
    assert reply.request["depots"] == [{"id": "depot", "location": [11.56, 48.14]}]
    [kind] = reply.request["fleet"]
    assert (kind["count"], kind["capacity"]) == (3, [1500])
    assert kind["shift"] == {"earliest": 25200, "latest": 61200}
    assert told(reply) == {"ENCODING_GUESSED", "MIDNIGHT", "TRIPS_ASSUMED", "HOURS_ASSUMED",
                           "KILOMETRES_ASSUMED"}


def test_french_windows_in_one_cell() -> None:
    reply = imported(MAKES["french"]())
    first, second, third = customers(reply)
    assert first["time_window"] == {"earliest": 30600, "latest": 43200}
    assert second["time_window"] == {"earliest": 32400}
    assert third["time_windows"] == [{"earliest": 28800, "latest": 36000},
                                     {"earliest": 50400, "latest": 57600}]
    assert services(reply) == [10, 5, 65]
    assert first["demand"] == [12.5]
    assert third["info"]["address"] == "1 cours d'Herbouville, 69004 Lyon"


def test_american_halves_of_the_day_and_pounds() -> None:
    reply = imported(MAKES["american"]())
    assert times(reply) == [(8, 12.5), (9, 17), (0, 12)]
    assert services(reply) == [15, 10, 65]
    assert [customer["demand"] for customer in customers(reply)] == [[1250], [85], [40.5]]
    assert next(column.unit for column in reply.columns if column.meaning == "demand") == "lb"
    assert reply.day == "2026-11-23"
    assert customers(reply)[1]["id"] == "Corner Store, Inc."
    assert customers(reply)[0]["info"]["phone"] == "(217) 555-0101"


def test_tabs_in_utf_16_on_a_plane_in_seconds() -> None:
    reply = imported(MAKES["tabs"]())
    assert (reply.encoding, reply.delimiter) == ("utf-16", "\t")
    assert reply.request is not None
    assert reply.request["coordinate_system"] == "planar"
    assert [customer["location"] for customer in customers(reply)] == [[35, 20], [15, 30], [25, 30]]
    assert times(reply) == [(0, 10), (8, 12), (8.5, 11)]
    assert services(reply) == [1.5, 1.5, 2]
    assert "READY_IS_BEGIN" in told(reply)


def test_italian_hours_with_decimals() -> None:
    reply = imported(MAKES["italian"]())
    assert times(reply) == [(8, 12), (8.5, 17.75), (9.25, 11)]
    assert services(reply) == [10, 5, 15]
    assert customers(reply)[1]["info"] == {"address": "Corso Como 3, 20154 Milano",
                                           "notes": "suonare"}


def test_swapped_coordinates_are_found_and_told() -> None:
    reply = imported(MAKES["swapped"]())
    assert customers(reply)[0]["location"] == [4.8952, 52.3702]
    assert "SWAPPED" in told(reply)


@pytest.mark.parametrize(("depot", "is_swapped"), [("52.4, 4.9", True), ("4.9, 52.4", False)])
def test_a_depot_tells_whether_coordinates_are_swapped(depot: str, is_swapped: bool) -> None:
    reply = imported(makes.SWAPPED.replace("Naam", "Name").replace("Breedtegraad", "Lat").replace(
        "Lengtegraad", "Lon").encode(), depot=depot)
    assert customers(reply)[0]["location"] == ([4.8952, 52.3702] if is_swapped
                                               else [52.3702, 4.8952])
    assert ("SWAPPED" in told(reply)) == is_swapped


def test_minutes_after_midnight_are_told_apart_from_seconds() -> None:
    reply = imported(MAKES["minutes"]())
    assert times(reply) == [(8, 12), (8.25, 17), (9, 11)]
    assert services(reply) == [10, 5, 10]
    assert "UNIT_GUESSED" in told(reply)


def test_polish_windows_by_the_hour() -> None:
    reply = imported(MAKES["windows"]())
    windows = [customer.get("time_windows", [customer.get("time_window")])
               for customer in customers(reply)]
    assert windows == [
        [{"earliest": 28800, "latest": 36000}],
        [{"earliest": 30600, "latest": 43200}, {"earliest": 50400, "latest": 57600}],
        [{"earliest": 32400}], [{"earliest": 0, "latest": 41400}]]
    assert customers(reply)[1]["id"] == "Świat Książki"
    assert customers(reply)[1]["demand"] == [3]


def test_rows_of_one_name_and_place_make_one_stop() -> None:
    reply = imported(MAKES["several rows"]())
    stops = {customer["id"]: customer for customer in customers(reply)}
    assert list(stops) == ["Garage Novak", "Lekarna", "Garage Novak (2)", "Lekarna (2)"]
    assert stops["Garage Novak"]["demand"] == [3, 14.5]
    assert stops["Garage Novak"]["info"] == {
        "address": "Hlavni 1, Praha", "order": "1001; 1002", "contact": "Jan; Eva"}
    assert stops["Garage Novak (2)"]["location"] == [16.6068, 49.1951]
    assert stops["Lekarna (2)"]["time_window"]["earliest"] == 46800
    assert {"ROWS_JOINED", "NAMES_REPEAT"} <= told(reply)


def test_rows_of_one_name_and_place_may_be_stops_of_their_own() -> None:
    reply = imported(MAKES["several rows"](), mapping={"same_place": "apart"})
    assert [customer["id"] for customer in customers(reply)] == [
        "Garage Novak", "Garage Novak (2)", "Lekarna", "Garage Novak (3)", "Lekarna (2)"]


def test_merged_headings_of_the_sheet_with_customers() -> None:
    reply = imported(MAKES["merged headings"]())
    assert reply.sheet == "Touren KW 48"
    assert [sheet.name for sheet in reply.sheets] == ["Deckblatt", "Touren KW 48"]
    assert reply.header_rows == [3, 4]
    assert [column.heading for column in reply.columns][3:5] == ["Lieferfenster von",
                                                                 "Lieferfenster bis"]
    assert times(reply) == [(6.5, 9), (7, 12.25), (5, 8.75)]
    assert services(reply) == [20, 15, 10]
    assert [customer["demand"] for customer in customers(reply)] == [[320.5, 1], [80, 2], [12, 0]]
    assert "TOTAL_LEFT_OUT" in told(reply)


def test_clocks_without_format_are_shares_of_a_day() -> None:
    reply = imported(MAKES["fractions"]())
    assert times(reply) == [(8, 12), (8.5, 18), (9, 24)]
    assert services(reply) == [10, 5, 15]


def test_dates_with_times_count_from_the_day() -> None:
    reply = imported(MAKES["dates"]())
    assert reply.day == "2026-11-23"
    assert times(reply) == [(8, 10), (9.25, 17)]
    assert [customer["release_time"] for customer in customers(reply)] == [23400, 25200]
    assert [customer["info"]["order"] for customer in customers(reply)] == ["9001", "9002"]


def test_sheets_of_libreoffice() -> None:
    reply = imported(MAKES["open document"]())
    assert (reply.sheet, reply.header_rows) == ("Touren", [1, 2])
    assert times(reply) == [(6.5, 9), (8, 17.25)]
    assert [customer["demand"] for customer in customers(reply)] == [[12.5], [3]]
    assert customers(reply)[0]["location"] == [11.5754, 48.1371]


@pytest.mark.thorough
def test_twenty_thousand_rows_are_read() -> None:
    reply = imported(makes.large())
    assert reply.rows == 20_000
    assert reply.customers == 5000
    assert sum(customer["demand"][0] for customer in customers(reply)) == sum(
        number % 9 + 1 for number in range(20_000))


@pytest.mark.parametrize("make", MAKES)
def test_the_mapping_of_a_reply_reads_the_file_the_same_way(make: str) -> None:
    reply = imported(MAKES[make]())
    again = imported(MAKES[make](), mapping=reply.mapping.model_dump())
    assert again.request == reply.request
    assert [column.meaning for column in again.columns] == [
        column.meaning for column in reply.columns]
    assert all(column.confidence == 1 for column in again.columns if column.meaning != "ignored")


@pytest.mark.parametrize("make", MAKES)
def test_every_reading_stands_beside_its_cell(make: str) -> None:
    for column in imported(MAKES[make]()).columns:
        assert column.examples or column.heading == "notes"
        assert all(example.read is not None for example in column.examples)
        assert all(example.cell.startswith(column.column) for example in column.examples)
