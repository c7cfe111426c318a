"""Each word of `words.toml` is found by whoever looks for it."""

from collections.abc import Iterator, Mapping
from typing import Any

import pytest

from app.formats.sheets import words
from app.formats.sheets.clocks import Style, windows
from app.formats.sheets.importing import import_file
from app.formats.sheets.headings import SURE, guesses, simple, unit_named
from app.formats.sheets.readers import read
from app.formats.sheets.schemas import ImportSettings
from app.formats.sheets.sides import sides_of
from app.formats.sheets.words import Listed

LANGUAGES = {"en", "de", "fr", "es", "it", "nl", "pl", "pt", "tr", "cs", "hu"}

HEADED: list[tuple[str, Listed]] = [*words.COLUMNS.items(), ("window", words.WINDOW)]

ALONE = ("VAN_HEADINGS", "PLAN_NAMES", "MEASURES", "SIDE_WORDS", "SIDE_STEMS", "END_WORDS",
         "BARE_END_WORDS", "KIND_STEMS", "STATE_WORDS", "WINDOW_WORDS", "CELL_WORDS", "UNIT_WORDS")


def phrases(listed: Mapping[str, Any]) -> Iterator[str]:
    """Yield all phrases of tables in tables."""
    for value in listed.values():
        yield from phrases(value) if isinstance(value, dict) else value


def is_sure(heading: str, meaning: str) -> bool:
    return any((guess.meaning, guess.score) == (meaning, SURE) for guess in guesses(heading))


@pytest.mark.parametrize(("meaning", "by_language"), HEADED)
def test_headings_are_found_in_each_language(meaning: str, by_language: Listed) -> None:
    assert set(by_language) <= LANGUAGES
    assert [phrase for phrase in phrases(by_language) if not is_sure(phrase, meaning)] == []


@pytest.mark.parametrize(("meaning", "by_language"), [("earliest", words.BEGIN),
                                                      ("latest", words.END)])
def test_ends_of_windows_are_found_before_and_behind_them(meaning: str,
                                                          by_language: Listed) -> None:
    assert set(by_language) == set(words.WINDOW) == LANGUAGES
    headings = [heading for language, ends in by_language.items() for end in ends
                for window in words.WINDOW[language]
                for heading in (f"{window} {end}", f"{end} {window}")]
    assert [heading for heading in headings if not is_sure(heading, meaning)] == []


def test_phrases_are_as_cells_are_once_they_are_simple() -> None:
    listed = [words.WINDOW, words.BEGIN, words.END, words.COLUMNS,
              *(getattr(words, name) for name in ALONE if name != "UNIT_WORDS")]
    assert [phrase for table in listed for phrase in phrases(table)
            if simple(phrase) != phrase] == []


@pytest.mark.parametrize("name", ALONE)
def test_phrases_stand_once_where_one_meaning_counts(name: str) -> None:
    listed = getattr(words, name)
    assert len(words.meant(listed)) == len(list(phrases(listed)))


def test_units_are_found() -> None:
    for unit, listed in words.UNIT_WORDS.items():
        assert [word for word in listed if unit_named(word) != unit] == []


def test_kinds_of_order_are_found() -> None:
    for kind, stems in words.KIND_STEMS.items():
        assert [stem for stem in stems if read(stem, "kind", None, Style()) != kind] == []


@pytest.mark.parametrize(("name", "earliest", "latest"), [
    ("all_day", None, None), ("morning", None, 12 * 3600), ("afternoon", 12 * 3600, None)])
def test_windows_in_words_are_read(name: str, earliest: int | None, latest: int | None) -> None:
    for phrase in words.WINDOW_WORDS[name]:
        assert windows(phrase, "clock", Style()) == [(earliest, latest)], phrase


@pytest.mark.parametrize(("side", "other"), [
    ("pickup", "dropoff town"), ("delivery", "pickup town"), ("alternative", "town")])
def test_words_of_other_places_are_found(side: str, other: str) -> None:
    for word in words.SIDE_WORDS[side]:
        found = sides_of([f"{word} town", other], [False, False])[0]
        assert (found.name, found.found[0].meaning) == (side, "town"), word


TURKISH = ("Müşteri;Enlem;Boylam;Ağ\u0131rl\u0131k (kg);"
           "Teslimat Başlang\u0131ç;Teslimat Bitiş;Süre (dk)")
CZECH = "Název;Zeměpisná šířka;Zeměpisná délka;Hmotnost (kg);Od;Do;Doba vykládky (min)"
HUNGARIAN = "Név;Szélesség;Hosszúság;Súly (kg);Kezdés;Befejezés;Lerakodási idő (perc)"
BRAZILIAN = "Razão social;Latitude;Longitude;Peso bruto (kg);Início;Fim;Tempo de parada (min)"


@pytest.mark.parametrize(("headings", "name", "encoding"), [
    (TURKISH, "İşçi Ağaoğlu", "cp1254"), (TURKISH, "İşçi Ağaoğlu", "utf-16-le"),
    (CZECH, "Šesták Žofie", "cp1250"), (HUNGARIAN, "Tűzoltó Őrs", "cp1250"),
    (BRAZILIAN, "Padaria São João", "mac_roman"), (BRAZILIAN, "Padaria São João", "cp1252"),
    (HUNGARIAN, "Tűzoltó Őrs", "utf-16-be")])
def test_sheets_are_read_in_their_languages_and_encodings(headings: str, name: str,
                                                          encoding: str) -> None:
    content = f"{headings}\n{name};40,9;28,9;75,1;9:00;12:00;5\nB;41,1;28,8;43;9:00;13:00;10\n"
    reply = import_file(content.encode(encoding), ImportSettings())
    assert reply.request is not None, reply.errors
    first = reply.request["customers"][0]
    assert (first["id"], first["location"], first["demand"]) == (name, [28.9, 40.9], [75.1])
    assert (first["time_window"], first["service_duration"]) == (
        {"earliest": 32400, "latest": 43200}, 300)


@pytest.mark.parametrize(("name", "encoding"), [
    ("Булочная на Невском проспекте", "cp1251"), ("Bäckerei Größ", "cp1252")])
def test_names_of_other_languages_than_the_headings_leave_the_encoding(name: str,
                                                                       encoding: str) -> None:
    content = "Name;Adresse;Lat;Lon\n" + f"{name};{name};40.9;28.9\n" * 30
    assert import_file(content.encode(encoding), ImportSettings()).encoding == encoding
