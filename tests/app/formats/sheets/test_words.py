"""Each word of `words.toml` is found by whoever looks for it."""

from collections.abc import Iterator, Mapping
from typing import Any

import pytest

from app.formats.sheets import words
from app.formats.sheets.clocks import Style, windows
from app.formats.sheets.headings import SURE, guesses, simple, unit_named
from app.formats.sheets.readers import read
from app.formats.sheets.sides import sides_of
from app.formats.sheets.words import Listed

LANGUAGES = {"en", "de", "fr", "es", "it", "nl", "pl", "pt"}

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
