"""Drawn sheets are read as they are meant, and what is read wrongly is marked."""

from collections import Counter
from dataclasses import replace

from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportSettings
from benchmarks.fuzz.drawn_sheets import LAYOUTS, drawn, words
from benchmarks.fuzz.sheets import READINGS, reading_of
from tests.app.formats.sheets.told_texts import can_be_told, told

SEEDS = range(48)


def test_of_drawn_sheets_none_is_read_wrongly_unseen_and_most_need_no_question() -> None:
    counts = Counter(reading_of(drawn(seed))[0] for seed in SEEDS)
    assert counts[READINGS[3]] == 0
    assert counts[READINGS[0]] >= 0.85 * len(SEEDS)


def test_every_language_and_layout_is_drawn_alike_from_a_seed() -> None:
    sheets = [drawn(seed) for seed in range(120)]
    assert {sheet.language for sheet in sheets} == set(words())
    assert {sheet.layout for sheet in sheets} == set(LAYOUTS)
    assert drawn(7).truth == drawn(7).truth


def test_a_wrong_reading_is_found() -> None:
    sheet = next(sheet for seed in SEEDS if (sheet := drawn(seed)).layout == "orders")
    moved = [entry | {"place": (0.0, 0.0)} for entry in sheet.truth]
    reading, wrongs, _ = reading_of(replace(sheet, truth=moved))
    assert reading.startswith("wrong")
    assert wrongs[0].startswith("place")
    assert import_file(sheet.content, ImportSettings()).request is not None


def test_all_that_is_told_of_drawn_sheets_has_texts() -> None:
    entries = [entry for seed in range(40) for entry in told(drawn(seed).content)]
    assert len(entries) > 40
    assert [entry for entry in entries if not can_be_told(entry)] == []
