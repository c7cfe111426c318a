"""Columns that no heading tells apart, by how their cells look; each guess is doubted."""

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

from app.formats.sheets.cells import Doubt, MisreadError, Raw, letters, shown
from app.formats.sheets.clocks import Style
from app.formats.sheets.columns import BY_CONTENT, Column
from app.formats.sheets.headings import guesses, is_known
from app.formats.sheets.layout import Table
from app.formats.sheets.meanings import MEANINGS, PLACES
from app.formats.sheets.readers import read

_FINE = re.compile(r"-?\d{1,3}[.,]\d{3,}")
_CLOCK = re.compile(r"\d{1,2}[:h]\d{2}.*+")
_TIMES = re.compile(r"\d{1,2}([:h]\d{2}|\s*+([ap]m|uhr)|[:.]?\d{0,2}\s*+[-\u2013]\s*+\d{1,2}).*+",
                    re.IGNORECASE)

SOME = 0.3
"""Share of cells with times from which a column is worth a word."""


def with_looks(table: Table, columns: Sequence[Column]) -> list[Column]:
    """Return columns with meanings for those without, where a meaning that matters lacks."""
    found = list(columns)
    meanings = {column.meaning for column in columns}
    if not any(place <= meanings for place in PLACES):
        found = _named_places(found) or _fine_numbers(table, found)
    found = _by_cells(table, found)
    return [_with_unused_times(table, column) for column in found]


def _named_places(columns: Sequence[Column]) -> list[Column]:
    """Return columns of which two are places by their headings, whatever they hold; else none."""
    pairs = {guess.meaning: column for column in columns if column.meaning == "ignored"
             for guess in guesses(column.heading)[:2]
             if guess.score == 1 and guess.meaning in ("latitude", "longitude")}
    if len(pairs) < 2:
        return []
    meant = {column.index: meaning for meaning, column in pairs.items()}
    return [replace(column, meaning=meant[column.index], confidence=BY_CONTENT, doubts=())
            if column.index in meant else column for column in columns]


def _fine_numbers(table: Table, columns: Sequence[Column]) -> list[Column]:
    """Return columns of which two neighbours are places, if their numbers look like degrees."""
    left = [column for column in columns if column.meaning == "ignored"]
    for first, second in pairwise(left):
        if second.index == first.index + 1 and all(
                _are_degrees(raw for _, raw in table.column(column.index))
                for column in (first, second)):
            meant = {first.index: "latitude", second.index: "longitude"}
            return [_taken(column, meant[column.index]) if column.index in meant else column
                    for column in columns]
    return list(columns)


def _are_degrees(cells: Iterable[Raw]) -> bool:
    texts = [shown(raw) for raw in cells]
    try:
        values = [read(text, "degrees", None, Style()) for text in texts]
    except MisreadError:
        return False
    fine = sum(_FINE.fullmatch(text) is not None for text in texts)
    return bool(texts) and fine > len(texts) / 2 and all(abs(value) <= 180 for value in values)


def _by_cells(table: Table, columns: Sequence[Column]) -> list[Column]:
    """Return columns of which the first with words is the name, and two with clocks a window.

    Those whose headings say something else are not among them, nor is any if another column is
    known to be that.
    """
    known = {column.meaning for column in columns}
    wanted: dict[str, Callable[[Sequence[str]], bool]] = {}
    if not table.header_rows or not known & {"name", "order"}:
        wanted["name"] = _are_words
    wanted |= dict.fromkeys(_lacking_ends(table, columns), _are_clocks)
    found = []
    for column in columns:
        cells = _texts(table, column)
        meaning = next((meaning for meaning, fits in wanted.items()
                        if _is_unknown(column) and fits(cells)), None)
        if meaning is not None:
            del wanted[meaning]
        found.append(column if meaning is None else _taken(column, meaning))
    return found


def _lacking_ends(table: Table, columns: Sequence[Column]) -> list[str]:
    """Return which ends of windows columns with unknown headings are to be taken for."""
    known = {column.meaning: column.index for column in columns}
    clocks = [column.index for column in columns
              if _is_unknown(column) and _are_clocks(_texts(table, column))]
    if "window" in known or {"earliest", "latest"} <= known.keys():
        return []
    if "latest" in known:
        return ["earliest"] if clocks == [known["latest"] - 1] else []
    if "earliest" in known:
        return ["latest"] if clocks == [known["earliest"] + 1] else []
    return ["earliest", "latest"] if len(clocks) == 2 or not table.header_rows else []


def _is_unknown(column: Column) -> bool:
    return (column.meaning == "ignored" and column.confidence < 1
            and not is_known(column.heading))


def _texts(table: Table, column: Column) -> list[str]:
    return [shown(raw) for _, raw in table.column(column.index)]


def _with_unused_times(table: Table, column: Column) -> Column:
    """Return a column; if it holds times that nothing uses, that is doubted."""
    if not _is_unknown(column) or column.doubts:
        return column
    cells = _texts(table, column)
    times = [text for text in cells if _TIMES.fullmatch(text)]
    if len(times) < max(len(cells), 1) * SOME:
        return column
    letter = letters(column.index)
    return replace(column, doubts=(Doubt(
        "NOT_USED", f"Column {column.name} holds times such as {times[0]!r}, and is not used: say "
        "what it means.", letter, values={"case": "times", "value": times[0]}),))


def _are_words(cells: Sequence[str]) -> bool:
    return bool(cells) and all(any(map(str.isalpha, text)) for text in cells)


def _are_clocks(cells: Sequence[str]) -> bool:
    return bool(cells) and all(_CLOCK.fullmatch(text) for text in cells)


def _taken(column: Column, meaning: str) -> Column:
    letter = letters(column.index)
    title = MEANINGS[meaning].title.lower()
    unit = "clock" if MEANINGS[meaning].kind == "clock" else None
    return replace(column, meaning=meaning, unit=unit, confidence=BY_CONTENT, doubts=(
        *column.doubts, Doubt("MEANING_BY_CONTENT", f"Column {letter} is taken for {title} by its "
                              "cells alone.", letter, values={"meaning": meaning})))
