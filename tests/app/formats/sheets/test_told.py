"""What an import takes for granted, told by its values in the languages of the console."""

import re
from pathlib import Path

import pytest

from app.formats import sheets
from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import DoubtReply, ImportSettings, SheetErrorReply
from benchmarks.fuzz.drawn_sheets import drawn

SOURCES = Path(sheets.__file__).parent
TEXTS = SOURCES.parents[1] / "console" / "static" / "texts" / "granted"
CODES = re.compile(r'(?:(?:Doubt|CellError|refuse|Incomplete)\(|return \(?)\s*"([A-Z_]{4,})",')
"""Names of what an import takes for granted, or can't use, in its sources."""

TEXT = re.compile(r"^  ([A-Z_]+[A-Z])((?:_[a-z]+)*):\s+'(.*)',$", re.MULTILINE)
PLACEHOLDER = re.compile(r"{{(\w+)}}")

DOUBTFUL = b"""Kunde;Adresse;x;y;Von;Bis;kg;Soll
Anna;;11,58;48,14;8:00;2:00;5;1
Anna;;11,60;48,15;8:00;10:00;;2
Ben;;11,62;48,13;12:00;9:00 Z;1,250;3
Emil;;11,61;48,12;zu;9:00;viel;3
Summe;;;;;;6,250;
Cleo;Tal 1;;;;;7;4
"""


def texts(language: str) -> list[tuple[str, str, str]]:
    """Return the code, its case and number, and the text of what may be told."""
    return TEXT.findall((TEXTS / f"{language}.js").read_text("utf-8"))


def told(content: bytes) -> list[DoubtReply | SheetErrorReply]:
    """Return what an import tells."""
    reply = import_file(content, ImportSettings())
    return [*reply.doubts, *reply.errors,
            *(doubt for column in reply.columns for doubt in column.doubts)]


@pytest.mark.parametrize("language", ["en", "de"])
def test_all_that_an_import_tells_has_a_text(language: str) -> None:
    sources = "".join(path.read_text("utf-8") for path in SOURCES.glob("*.py"))
    codes = set(CODES.findall(sources))
    assert {"SHIFT_ASSUMED", "ADDRESS_FAR", "NO_COORDINATES", "CAPACITY"} <= codes
    assert sorted(codes - {code for code, _, _ in texts(language)}) == []


def test_texts_are_made_of_the_values_that_are_told() -> None:
    entries = [entry for content in (DOUBTFUL, *(drawn(seed).content for seed in range(40)))
               for entry in told(content)]
    assert len({entry.code for entry in entries}) > 15
    for entry in entries:
        known = {name for name, value in entry if value is not None} | set(entry.values)
        case = f"_{entry.values['case']}" if "case" in entry.values else ""
        found = [(end, set(PLACEHOLDER.findall(text))) for code, end, text in texts("de")
                 if code == entry.code]
        chosen = [names for end, names in found if case and end.startswith(case)] or [
            names for end, names in found if end in ("", "_one", "_other")]
        assert chosen, entry
        assert all(names <= known for names in chosen), entry
