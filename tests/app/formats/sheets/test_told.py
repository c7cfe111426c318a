"""What an import takes for granted, told by its values in the languages of the console."""

import re

import pytest

from tests.app.formats.sheets.told_texts import SOURCES, can_be_told, texts, told

CODES = re.compile(r'(?:(?:Doubt|CellError|refuse|Incomplete)\(|return \(?)\s*"([A-Z_]{4,})",')
"""Names of what an import takes for granted, or can't use, in its sources."""

DOUBTFUL = b"""Kunde;Adresse;x;y;Von;Bis;kg;Soll
Anna;;11,58;48,14;8:00;2:00;5;1
Anna;;11,60;48,15;8:00;10:00;;2
Ben;;11,62;48,13;12:00;9:00 Z;1,250;3
Emil;;11,61;48,12;zu;9:00;viel;3
Summe;;;;;;6,250;
Cleo;Tal 1;;;;;7;4
"""


@pytest.mark.parametrize("language", ["en", "de"])
def test_all_that_an_import_tells_has_a_text(language: str) -> None:
    sources = "".join(path.read_text("utf-8") for path in SOURCES.glob("*.py"))
    codes = set(CODES.findall(sources))
    assert {"SHIFT_ASSUMED", "ADDRESS_FAR", "NO_COORDINATES", "CAPACITY"} <= codes
    assert sorted(codes - {code for code, _, _ in texts(language)}) == []


def test_texts_are_made_of_the_values_that_are_told() -> None:
    entries = told(DOUBTFUL)
    assert len({entry.code for entry in entries}) > 12
    assert [entry for entry in entries if not can_be_told(entry)] == []
