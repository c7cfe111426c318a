"""Spreadsheets as dispatchers have them, each with what it takes to have it planned as meant."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime, time
from typing import Any

import xlsxwriter

from tests.app.formats.sheets.makes import workbook

Data = dict[str, Any]


@dataclass(frozen=True)
class Spreadsheet:
    """A file, what is clicked before it is planned, and what is meant by it.

    Parameters
    ----------
    name, content
        Of the file.
    served
        Customers that are meant.
    answers
        What is clicked: a part of the question, and the answer; the question may go by without one.
    columns
        What columns are said to mean, by their headings.
    holds
        Tells whether a request is what was meant.
    """

    name: str
    content: bytes
    served: int
    answers: tuple[tuple[str, str], ...] = ()
    columns: tuple[tuple[str, str], ...] = ()
    holds: Callable[[Data], bool] = lambda request: True


def text(*lines: str) -> bytes:
    return "\n".join(lines).encode()


def book(*sheets: tuple[str, list[tuple[Any, ...]]], hide: tuple[int, ...] = (),
         filtered: bool = False) -> bytes:
    """Return a workbook; rows of the first sheet may be hidden, by a filter or not."""
    def fill(made: xlsxwriter.Workbook) -> None:
        clock = made.add_format({"num_format": "hh:mm"})
        for number, (name, rows) in enumerate(sheets):
            sheet = made.add_worksheet(name)
            for row, cells in enumerate(rows):
                for column, cell in enumerate(cells):
                    if isinstance(cell, time | datetime):
                        sheet.write_datetime(row, column, cell, clock)
                    else:
                        sheet.write(row, column, cell)
            if number == 0:
                if filtered:
                    sheet.autofilter(0, 0, len(rows) - 1, len(rows[0]) - 1)
                for row in hide:
                    sheet.set_row(row, None, None, {"hidden": True})
    return workbook(fill)


HEAD = ("Kunde", "Breite", "Länge", "kg")
MUNICH: list[tuple[Any, ...]] = [
    ("Anna", 48.137, 11.575, 5), ("Ben", 48.147, 11.565, 3), ("Cleo", 48.110, 11.545, 7)]
WITH = [HEAD, *MUNICH]
ROWS = ("Anna,48.137,11.575,5", "Ben,48.147,11.565,3", "Cleo,48.110,11.545,7")


def rows(*more: str) -> list[str]:
    """Return three rows of a text with another cell each."""
    return [f"{row},{cell}" for row, cell in zip(ROWS, more, strict=True)]


def window(number: int, earliest: float, latest: float) -> Callable[[Data], bool]:
    """Return what holds where a customer has a window, in seconds since midnight."""
    def holds(request: Data) -> bool:
        stated = request["customers"][number].get("time_window")
        return bool(stated == {"earliest": earliest, "latest": latest})
    return holds


def each(field: str, *values: Any) -> Callable[[Data], bool]:
    """Return what holds where the customers have these values of a field."""
    return lambda request: [customer.get(field) for customer in request["customers"]
                            ] == list(values)


def informed(name: str, *values: str) -> Callable[[Data], bool]:
    """Return what holds where drivers are told these texts."""
    return lambda request: [customer.get("info", {}).get(name)
                            for customer in request["customers"]] == list(values)


KML = """<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2"><Document>
<Placemark><name>Anna</name><Point><coordinates>11.575,48.137,0</coordinates></Point></Placemark>
<Placemark><name>Ben</name><Point><coordinates>11.565,48.147,0</coordinates></Point></Placemark>
</Document></kml>"""

GEOJSON = """{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"name": "Anna", "kg": 5},
 "geometry": {"type": "Point", "coordinates": [11.575, 48.137]}},
{"type": "Feature", "properties": {"name": "Ben", "kg": 3},
 "geometry": {"type": "Point", "coordinates": [11.565, 48.147]}}]}"""

HTML = """<html><body><table><tr><th>Kunde</th><th>Breite</th><th>Länge</th><th>kg</th></tr>
<tr><td>Anna</td><td>48.137</td><td>11.575</td><td>5</td></tr>
<tr><td>Ben</td><td>48.147</td><td>11.565</td><td>3</td></tr></table></body></html>"""

COMMAS = "name,lat,lon,kg"
"""Above rows whose decimals have commas, too."""


def fleet_of(*counts: int) -> Callable[[Data], bool]:
    """Return what holds where the fleet has so many vehicles by type, in any order."""
    return lambda request: sorted(kind["count"] for kind in request["fleet"]) == sorted(counts)


CSV = "Kunde,Breite,Länge,kg"

SPREADSHEETS = (
    Spreadsheet("pickups.csv", text(f"{CSV},Art", *rows("Lieferung", "Abholung", "Lieferung")), 3,
                holds=lambda request: "pickup" in request["customers"][1]),
    Spreadsheet("kinds.csv", text(f"{CSV},Art", *rows("Lieferung", "Sonderfahrt", "Lieferung")), 3,
                (("Sonderfahrt", "Pickups"),),
                holds=lambda request: "pickup" in request["customers"][1]),
    Spreadsheet("filtered.xlsx", book(("Touren", WITH), hide=(2,), filtered=True), 2,
                (("hidden", ""),)),
    Spreadsheet("hidden.xlsx", book(("Touren", WITH), hide=(2,)), 3, (("hidden", "Planned"),)),
    Spreadsheet("cancelled.csv", text(f"{CSV},Status", *rows("offen", "storniert", "offen")), 2,
                (("storniert", ""),)),
    Spreadsheet("planned-all-the-same.csv",
                text(f"{CSV},Status", *rows("offen", "storniert", "offen")), 3,
                (("storniert", "Planned"),)),
    Spreadsheet("weekdays.xlsx", book(("Montag", WITH), ("Dienstag", [HEAD, *MUNICH[:2]])), 3,
                (("Dienstag", ""),)),
    Spreadsheet("tuesday.xlsx", book(("Montag", WITH), ("Dienstag", [HEAD, *MUNICH[:2]])), 2,
                (("Dienstag", "Its rows instead"),)),
    Spreadsheet("vans.xlsx", book(("Kunden", WITH), ("Fahrzeuge", [
        ("Fahrzeug", "Anzahl", "Kapazität kg"), ("Sprinter", 2, 900), ("Caddy", 1, 400)])), 3,
                (("Fahrzeuge", ""),), holds=fleet_of(2, 1)),
    Spreadsheet("handling.csv", text(f"{CSV},handling_s", *rows("120", "300", "60")), 3,
                holds=each("service_duration", 120, 300, 60)),
    Spreadsheet("unloading.csv", text(f"{CSV},Abladen", *rows("10", "5", "15")), 3,
                holds=each("service_duration", 600, 300, 900)),
    Spreadsheet("minutes.csv", text(f"{CSV},Minuten", *rows("10", "5", "15")), 3,
                holds=each("service_duration", 600, 300, 900)),
    Spreadsheet("packages.csv", text("Name,Lat,Lon,Pkgs", *ROWS), 3,
                holds=each("demand", [5], [3], [7])),
    Spreadsheet("unknown.csv", text(f"{CSV},Zauber", *rows("rot", "blau", "gelb")), 3,
                columns=(("Zauber", "For the driver, as it is"),),
                holds=informed("Zauber", "rot", "blau", "gelb")),
    Spreadsheet("serials.xlsx", book(("Export", [(*HEAD, "von", "bis")] + [
        (*cells, 46349 + 8 / 24, 46349 + 12 / 24) for cells in MUNICH])), 3),
    Spreadsheet("night.csv", text(f"{CSV},von,bis", "Anna,48.137,11.575,5,22:00,02:00",
                                  "Ben,48.147,11.565,3,20:00,23:00"), 2,
                holds=window(0, 79200, 93600)),
    Spreadsheet("two-windows.csv", text(
        "Name,Lat,Lon,Window", "Anna,48.137,11.575,8-10 AM / 2-4 PM",
        "Ben,48.147,11.565,9 AM-12 PM"), 2,
                holds=lambda request: [list(one.values()) for one in
                                       request["customers"][0]["time_windows"]]
                == [[28800, 36000], [50400, 57600]]),
    Spreadsheet("links.csv", text("Name,Ort,kg",
                                  "Anna,https://maps.google.com/?q=48.137%2C11.575,5",
                                  'Ben,"https://www.google.com/maps/@48.147,11.565,17z",3'), 2,
                holds=lambda request: request["customers"][1]["location"] == [11.565, 48.147]),
    Spreadsheet("table.xls", HTML.encode(), 2),
    Spreadsheet("places.kml", KML.encode(), 2),
    Spreadsheet("places.geojson", GEOJSON.encode(), 2, holds=each("demand", [5], [3])),
    Spreadsheet("commas.csv", text(COMMAS, "Anna,48,137,11,575,5,5", "Ben,48,147,11,565,3,0"), 2,
                holds=each("demand", [5.5], [3])),
    Spreadsheet("totals.csv", text(CSV, *ROWS, "Summe,,,15"), 3),
    Spreadsheet("days.csv", text(f"{CSV},Liefertag", *rows("26.11.2026", "27.11.2026",
                                                          "26.11.2026")), 2,
                (("days", "2026-11-26"),)),
    Spreadsheet("states.csv", text(
        "Name,Lat,Lon,lbs,City,State", "Joe,39.80,-89.64,5,Springfield,IL",
        "Sue,39.82,-89.65,7,Springfield,IL"), 2,
                holds=informed("address", "Springfield, IL", "Springfield, IL")),
)
