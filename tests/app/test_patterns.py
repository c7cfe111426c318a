"""Every pattern that sees texts of others takes time in proportion to their length."""

import ast
import importlib
import pkgutil
import re
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache, partial
from itertools import islice, product, starmap
from pathlib import Path
from time import thread_time
from types import ModuleType
from typing import Any

import pytest

import app.formats.sheets
import app.maps.addresses
from app.formats.sheets.cells import LONGEST_READ, MisreadError
from app.formats.sheets.clocks import Style
from app.formats.sheets.importing import import_file
from app.formats.sheets.meanings import MEANINGS
from app.formats.sheets.readers import READERS
from app.formats.sheets.schemas import ImportSettings
from app.formats.sheets.table import NotASheetError
from tests.seeds import SHARE

PACKAGES = (app.formats.sheets, app.maps.addresses)

STARTS = ("", "8", "8:30", "8:30 am", "2026-01-01", "1.", "48.1", "a@b", "ab ", "pt1", "(",
          "between 8", "POINT(1", "$.customers[1", "https://maps.google.com/", "geo:1", "1\u00b0",
          "<row ", "<col a=\"", "!3d1.1")
PIECES = (" ", "\t", "\n", "\u00a0", "1", "0", "1 ", "a", "A", "\u00e9", "8 ", "-", "- ", ".", ",",
          ":", ";", "'", "1.", "1,", "1.1", "1,111", ".111", "a.", "a@", "am ", "N ", "1\u00b0",
          "1\u00b0 ", "and ", "between ", "ab ", "T,", "(", "((", "()", "[1]", "/", "//", "@", "%",
          "+", "=", "<", "a ", 'a="1" ', "<c>", "1E", "~")
ENDS = ("", "x", "\nx", "!", "1", "\u00e9", ")")

SIZE, LONGER = 500, 2000
QUICK = 0.0001
"""Seconds that a text of `SIZE` letters may always take: trying all splits takes more."""

MOST_PER_CELL = 0.1

LOOKS = 30
"""At a longer text, all of which take too long where all splits are tried."""

GROWTH = 9.0
"""Of the time for a text four times as long; 16 where all splits are tried."""


def modules() -> Iterator[ModuleType]:
    for package in PACKAGES:
        for found in pkgutil.iter_modules(package.__path__, f"{package.__name__}."):
            yield importlib.import_module(found.name)


def patterns_in(value: object) -> Iterator[re.Pattern[Any]]:
    if isinstance(value, re.Pattern):
        yield value
    elif isinstance(value, dict):
        for held in value.values():
            yield from patterns_in(held)
    elif isinstance(value, list | tuple | set | frozenset):
        for held in value:
            yield from patterns_in(held)


@cache
def patterns() -> dict[str, re.Pattern[Any]]:
    """Return the patterns of all modules, by where they are and what they are."""
    return {f"{module.__name__}.{name}: {pattern.pattern[:40]!r}": pattern
            for module in modules() for name, value in vars(module).items()
            for pattern in patterns_in(value)}


def text_of(size: int, start: str, piece: str, end: str) -> str:
    return start + piece * (size // len(piece)) + end


def parts_of_texts() -> Iterator[tuple[str, str, str]]:
    return islice(product(STARTS, PIECES, ENDS), 0, None, SHARE)


@cache
def texts_of(size: int, parts: tuple[tuple[str, str, str], ...]) -> tuple[str, ...]:
    return tuple(starmap(partial(text_of, size), parts))


def texts(size: int) -> tuple[str, ...]:
    return texts_of(size, tuple(parts_of_texts()))


def seconds_of(work: Callable[[], object], times: int = 1) -> float:
    least = float("inf")
    for _ in range(times):
        before = thread_time()
        work()
        least = min(least, thread_time() - before)
    return least


def slow_texts(work: Callable[[str], object]) -> list[str]:
    """Return starts of texts whose time grows faster than their length."""
    slow = []
    for text, parts in zip(texts(SIZE), parts_of_texts(), strict=True):
        first = seconds_of(partial(work, text))
        longer = text_of(LONGER, *parts)
        # Most is proportional, which a first look shows; a busy machine needs some more.
        if first > QUICK and seconds_of(partial(work, longer)) > GROWTH * first:
            short = seconds_of(partial(work, text), 3)
            if short > QUICK and all(seconds_of(partial(work, longer)) > GROWTH * short
                                     for _ in range(LOOKS)):
                slow.append(text[:60])
    return slow


def whole(pattern: re.Pattern[Any], text: str) -> object:
    return pattern.fullmatch(text if isinstance(pattern.pattern, str) else text.encode())


def find_all(pattern: re.Pattern[Any], text: str) -> None:
    found = pattern.finditer(text if isinstance(pattern.pattern, str) else text.encode())
    deque(found, maxlen=0)


@pytest.mark.thorough_after(6)
@pytest.mark.parametrize("name", patterns())
def test_no_pattern_tries_all_ways_to_split_a_text(name: str) -> None:
    pattern = patterns()[name]
    assert slow_texts(lambda text: whole(pattern, text)) == []
    assert slow_texts(lambda text: find_all(pattern, text)) == []


def test_all_patterns_have_names_by_which_they_are_found_here() -> None:
    used = [f"{path.name}:{node.lineno}"
            for package in PACKAGES for path in Path(package.__path__[0]).glob("*.py")
            for node in ast.walk(ast.parse(path.read_text("utf-8")))
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)
            and isinstance(node.func.value, ast.Name) and node.func.value.id == "re"
            and node.func.attr not in ("compile", "escape")]
    assert used == []
    assert len(patterns()) > 30


@pytest.mark.by_clock
def test_a_pattern_that_tries_all_splits_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, few in (("STARTS", ("8",)), ("PIECES", (" ", "1")), ("ENDS", ("x",))):
        monkeypatch.setitem(globals(), name, few)
    assert slow_texts(re.compile(r"\d+\s*\w?\s*y").fullmatch) == ["8" + " " * 59]


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize("kind", READERS)
def test_no_cell_takes_long_to_read(kind: str) -> None:
    for text in texts(LONGEST_READ):
        before = thread_time()
        with suppress(MisreadError):
            READERS[kind](text, None, Style())  # type: ignore[index]
        assert thread_time() - before < MOST_PER_CELL


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize("cell", ["8" + " " * 1000 + "x", "8" + "\t " * 500 + "x",
                                  "1." * 5000 + "x", "8 - " * 1000, "(" * 20_000,
                                  "48.1" + "\u00a0" * 9000 + "N"])
def test_a_small_sheet_is_read_at_once_whatever_its_cells_hold(cell: str) -> None:
    headings = ["name", "lat", "lon"]
    for meaning in MEANINGS:
        mapping = {"columns": [{"heading": "nasty", "meaning": meaning}]}
        content = (f"{','.join(headings)},nasty\n" + f'A,48.1,11.5,"{cell}"\n' * 3).encode()
        before = thread_time()
        import_file(content, ImportSettings.model_validate({"mapping": mapping}))
        assert thread_time() - before < 1


def test_headings_of_many_words_are_known_at_once() -> None:
    words = [" ".join("abcdefghij"[(row + place) % 10] for place in range(30))
             for row in range(400)]
    content = "\n".join(",".join(f"{text} {row}" for text in words) for row in range(20)).encode()
    assert seconds_of(lambda: import_file(content, ImportSettings())) < 5


def test_eight_million_cells_are_refused_as_they_are_read() -> None:
    content = (",".join(f"column {number}" for number in range(80)) + "\n"
               + ("1," * 79 + "1\n") * 99_990).encode()
    before = thread_time()
    with pytest.raises(NotASheetError, match="more than 2000000 cells"):
        import_file(content, ImportSettings())
    assert thread_time() - before < 5
