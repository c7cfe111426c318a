"""Cells are read as people mean them, or refused."""

from datetime import date, datetime, time, timedelta
from typing import Any

import pytest

from app.formats.sheets.cells import MisreadError, Raw, letters
from app.formats.sheets.clocks import Style, clock, duration, windows
from app.formats.sheets.headings import guesses
from app.formats.sheets.numbers import amount_of, number, uses_comma
from app.formats.sheets.readers import read
from app.formats.sheets.units import clock_unit, duration_unit

pytestmark = pytest.mark.slow

DAY = Style(day=date(2026, 11, 23))


def hours(raw: Raw, unit: str = "clock", style: Style = DAY) -> float:
    return clock(raw, unit, style) / 3600


@pytest.mark.parametrize(("raw", "expected"), [
    ("8:30", 8.5), ("08:30", 8.5), ("8:30:00", 8.5), ("8.30", 8.5), ("8,30", 8.5), ("0830", 8.5),
    ("830", 8.5), ("8h30", 8.5), ("8 h 30", 8.5), ("8.30 Uhr", 8.5), ("8", 8), ("8 Uhr", 8),
    ("8h", 8), ("8 heures", 8), ("um 8 Uhr", 8), ("ore 8:30", 8.5),
    ("8:30 AM", 8.5), ("8:30pm", 20.5), ("8.30 p.m.", 20.5), ("12 am", 0), ("12 pm", 12),
    ("24:00", 24), ("26:00", 26), ("2026-11-23 08:30", 8.5), ("2026-11-23T08:30:00Z", 8.5),
    ("23.11.2026 8:30", 8.5), ("24.11.2026 8:30", 32.5), ("23/11/2026 8:30 PM", 20.5),
    (time(8, 30), 8.5), (datetime(2026, 11, 23, 8, 30), 8.5), (datetime(1899, 12, 30, 8, 30), 8.5),
    (timedelta(hours=25), 25), (time(8, 29, 59, 999_999), 8.5),
])
def test_times_of_day_are_read(raw: Raw, expected: float) -> None:
    assert hours(raw) == expected


@pytest.mark.parametrize(("raw", "unit", "expected"), [
    (8.5, "hours", 8.5), (8.3, "h.mm", 8.5), (830.0, "hhmm", 8.5), (510.0, "minutes", 8.5),
    (30600.0, "seconds", 8.5), (8.5 / 24, "days", 8.5), ("8,5", "hours", 8.5),
    ("8:30", "minutes", 8.5), (time(8, 30), "seconds", 8.5),
])
def test_bare_numbers_are_read_by_the_unit_of_their_column(raw: Raw, unit: str,
                                                           expected: float) -> None:
    assert hours(raw, unit) == expected


@pytest.mark.parametrize("raw", [
    "noon", "8:70", "25", "13:00 pm", "99:00", "", "8:30-9", "22.11.2026 8:00", "31.02.2026 8:00",
    8.75, True, 46_000.0, "8.75", "-8:00", "1e9",
])
def test_what_is_no_time_of_day_is_refused(raw: Raw) -> None:
    with pytest.raises(MisreadError):
        hours(raw)


@pytest.mark.parametrize(("text", "expected"), [
    ("8-10", [(8, 10)]), ("8:00\u201310:00", [(8, 10)]), ("8:30 - 12", [(8.5, 12)]),
    ("0800-1000", [(8, 10)]), ("8-10 Uhr", [(8, 10)]), ("von 8 bis 10", [(8, 10)]),
    ("from 8 to 10", [(8, 10)]), ("de 8h à 10h", [(8, 10)]), ("dalle 8 alle 10", [(8, 10)]),
    ("between 8 and 10", [(8, 10)]), ("zwischen 8 und 10 Uhr", [(8, 10)]), ("8-10 AM", [(8, 10)]),
    ("9-1 pm", [(9, 13)]), ("1-3 pm", [(13, 15)]), ("8 a.m. - 10 a.m.", [(8, 10)]),
    ("8-10; 14-16", [(8, 10), (14, 16)]), ("8-10, 14-16", [(8, 10), (14, 16)]),
    ("8-10 und 14-16", [(8, 10), (14, 16)]), ("8-10/14-16", [(8, 10), (14, 16)]),
    ("ab 9", [(9, None)]), ("after 9:00", [(9, None)]), ("9:00+", [(9, None)]),
    ("bis 12", [(None, 12)]), ("before 12:00", [(None, 12)]), ("ganztägig", [(None, None)]),
    ("2026-11-23 08:00 - 2026-11-23 10:00", [(8, 10)]),
])
def test_windows_in_one_cell_are_read(text: str, expected: list[Any]) -> None:
    read_as = [tuple(side if side is None else side / 3600 for side in window)
               for window in windows(text, "clock", DAY)]
    assert read_as == expected


@pytest.mark.parametrize("raw", [date(2026, 10, 8), datetime(2026, 10, 8), "8", "8-10-12", "soon",
                                 "8 to noon", "-"])
def test_what_is_no_window_is_refused(raw: Raw) -> None:
    with pytest.raises(MisreadError):
        windows(raw, "clock", DAY)


@pytest.mark.parametrize(("raw", "unit", "minutes"), [
    (10.0, "minutes", 10), (90.0, "seconds", 1.5), (0.5, "hours", 30), (10 / 1440, "days", 10),
    ("10", "minutes", 10), ("10 min", "seconds", 10), ("10'", "seconds", 10),
    ("90s", "minutes", 1.5),
    ("1h", "minutes", 60), ("1h30", "minutes", 90), ("1 h 5 min", "minutes", 65),
    ("0:10", "minutes", 10), ("1:05", "minutes", 65), ("0:10:00", "minutes", 10),
    ("7,5", "minutes", 7.5), (time(0, 10), "minutes", 10), (timedelta(minutes=10), "hours", 10),
])
def test_lengths_of_time_are_read(raw: Raw, unit: str, minutes: float) -> None:
    assert duration(raw, unit, Style(comma=True)) / 60 == minutes


@pytest.mark.parametrize("raw", ["ten", "10:00", "-5", "5 kg", True, datetime(2026, 1, 1), "", 1e9])
def test_what_is_no_length_of_time_is_refused(raw: Raw) -> None:
    with pytest.raises(MisreadError):
        duration(raw, "minutes", Style())


@pytest.mark.parametrize(("text", "comma", "expected"), [
    ("1.234,5", True, 1234.5), ("1,234.5", False, 1234.5), ("12,5", True, 12.5),
    ("12.5", False, 12.5),
    ("1.234", True, 1234), ("1,234", False, 1234), ("1.234", False, 1.234), ("1,234", True, 1.234),
    ("12,5", False, 12.5), ("12.5", True, 12.5), ("1 234,5", True, 1234.5),
    ("1'234.5", False, 1234.5),
    ("1\u202f234", False, 1234), ("-3", False, -3), (",5", True, 0.5),
])
def test_numbers_are_read_with_either_sign_before_decimals(text: str, comma: bool,
                                                           expected: float) -> None:
    assert number(text, comma) == expected


@pytest.mark.parametrize("text", ["", "x", "1,2,3,4", "1e3", "nan", "inf", "0x1", "1..2", "9" * 20])
def test_what_is_no_number_is_refused(text: str) -> None:
    with pytest.raises(MisreadError):
        number(text, False)


def test_a_file_tells_what_stands_before_decimals() -> None:
    assert uses_comma(["1.234", "12,5", "Main St 3"]) is True
    assert uses_comma(["1,234", "12.5"]) is False
    assert uses_comma(["1.234", "17", ""]) is None
    assert uses_comma(["1.234.567"]) is True


@pytest.mark.parametrize(("raw", "unit", "expected"), [
    ("12 kg", "kg", 12), ("500 g", "kg", 0.5), ("2 t", "kg", 2000), ("12,5kg", "kg", 12.5),
    ("1 l", "m³", 0.001), (3.0, "kg", 3), ("4 pallets", None, 4), ("3 Stk.", None, 3),
])
def test_amounts_are_read_in_the_unit_of_their_column(raw: Raw, unit: str | None,
                                                      expected: float) -> None:
    assert amount_of(raw, True, unit) == pytest.approx(expected)


@pytest.mark.parametrize(("raw", "unit"), [("5 l", "kg"), ("5 miles", "kg"), (-1.0, None),
                                           ("many", None), (True, None)])
def test_what_is_no_amount_is_refused(raw: Raw, unit: str | None) -> None:
    with pytest.raises(MisreadError):
        amount_of(raw, False, unit)


@pytest.mark.parametrize(("text", "expected"), [
    ("48.137", 48.137), ("48,137", 48.137), ("48.137° N", 48.137), ("33.5 S", -33.5),
    ("48°08'13.2\"N", 48.137), ("W 0°30'0\"", -0.5), ("-3.7", -3.7),
])
def test_degrees_are_read(text: str, expected: float) -> None:
    assert read(text, "degrees", None, Style()) == pytest.approx(expected)


def test_degrees_without_their_point_are_refused() -> None:
    with pytest.raises(MisreadError, match="decimal point"):
        read("48.137.154", "degrees", None, Style())


@pytest.mark.parametrize(("text", "expected"), [
    ("48.137, 11.575", (48.137, 11.575)), ("48.137,11.575", (48.137, 11.575)),
    ("48,137; 11,575", (48.137, 11.575)), ("48.137 11.575", (48.137, 11.575)),
    ("(48.137, -11.575)", (48.137, -11.575)), ("48,137, 11,575", (48.137, 11.575)),
    ("48°07'30\"N 11°34'30\"E", (48.125, 11.575)), ("48.5°S 11.5°W", (-48.5, -11.5)),
    ("48.5° N, 11.5° E", (48.5, 11.5)),
])
def test_places_in_one_cell_are_read(text: str, expected: tuple[float, float]) -> None:
    assert read(text, "point", None, Style()) == expected


@pytest.mark.parametrize(("cells", "unit", "is_doubtful"), [
    (["8:00", time(9)], "clock", False), (["0800", "1730"], "hhmm", False),
    ([8.0, 17.0], "hours", False), ([800.0, 900.0, 1130.0, 1200.0], "hhmm", False),
    ([800.0, 1700.0], "hhmm", False), ([600.0, 900.0], "hhmm", True),
    ([480.0, 1020.0], "minutes", True),
    ([28800.0, 61200.0], "seconds", False), ([8 / 24, 0.5, 1.0], "days", False),
    (["8.30", "9.00"], "h.mm", False), (["8,5", "9,25"], "hours", True),
    ([8.75, 9.5], "hours", False),
    ([8.3, 9.0], "h.mm", True), (["8.30", "0900"], "clock", True), ([], "clock", False),
])
def test_the_unit_of_times_is_guessed_from_their_looks(cells: list[Raw], unit: str,
                                                       is_doubtful: bool) -> None:
    guess = clock_unit(cells, None)
    assert (guess.unit, guess.doubt is not None) == (unit, is_doubtful)


@pytest.mark.parametrize(("cells", "stated", "unit", "is_doubtful"), [
    ([10.0, 5.0], "minutes", "minutes", False), ([10.0, 5.0], None, "minutes", True),
    ([300.0, 600.0], None, "seconds", True), ([0.5, 1.5], None, "hours", True),
    ([10 / 1440], None, "days", False), (["10 min"], None, "minutes", False),
])
def test_the_unit_of_lengths_is_as_stated_or_doubtful(cells: list[Raw], stated: str | None,
                                                      unit: str, is_doubtful: bool) -> None:
    guess = duration_unit(cells, stated)
    assert (guess.unit, guess.doubt is not None) == (unit, is_doubtful)


@pytest.mark.parametrize(("heading", "meaning", "unit"), [
    ("Service time (min)", "service", "minutes"), ("duration", "service", None),
    ("Open time", "earliest", None), ("notes", "notes", None), ("Zeitfenster bis", "latest", None),
    ("TW_START", "earliest", None), ("Lieferadresse", "address", None),
    ("Gew. [kg]", "demand", "kg"),
    ("weight_lbs", "demand", "lb"), ("Straße/Nr.", "street", None), ("PLZ", "postcode", None),
    ("N° commande", "order", None), ("deliveryWindowEnd", "latest", None), ("kg", "demand", "kg"),
    ("Dirección", "address", None), ("Telefoonnummer", "phone", None), ("Uwagi", "notes", None),
    ("Drone allowed?", "served_by", None), ("Liczba paczek", "demand", None),
    ("Tempo scarico (min)", "service", "minutes"), ("Stop minutes", "service", "minutes"),
    ("Kunde (Min)", "service", "minutes"), ("Menge (Kisten)", "demand", "Kisten"),
])
def test_headings_are_known_in_many_languages(heading: str, meaning: str, unit: str | None) -> None:
    best = guesses(heading)[0]
    assert (best.meaning, best.unit) == (meaning, unit)


def test_columns_have_the_letters_that_spreadsheets_give_them() -> None:
    assert [letters(column) for column in (0, 25, 26, 51, 52, 701, 702)] == [
        "A", "Z", "AA", "AZ", "BA", "ZZ", "AAA"]
