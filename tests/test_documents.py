"""What pages and comments name is there."""

import re
import statistics
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("app", "benchmarks", "deploy", "docs", "engine", "examples", "model", "tests",
           "training")
SUFFIXES = (".md", ".py", ".h", ".cpp", ".sh", ".yaml", ".toml", ".js", ".txt", "Makefile",
            "Dockerfile")
PAST = ("CHANGELOG.md",)
"""Tell what there was, too."""

NAMED = re.compile(rf"`((?:{'|'.join(FOLDERS)})/[^`\s]*)`")
LINK = re.compile(r"\]\(([^)\s]+)\)")
ENDINGS = ("", ".py", ".h", ".cpp")
"""Which may be left out."""


def texts() -> Iterator[tuple[str, str]]:
    """Yield the names and the contents of the project's files that name others."""
    for path in (*ROOT.glob("*"), *(path for name in FOLDERS for path in (ROOT / name).rglob("*"))):
        name = path.relative_to(ROOT).as_posix()
        if name.endswith(SUFFIXES) and name not in PAST and "/vendor/" not in name:
            yield name, path.read_text("utf-8")


def is_there(named: str) -> bool:
    """Tell whether a path leads to a file or folder, `*` and `<name>` to any."""
    pattern = re.sub(r"<[^>]*>", "*", named).rstrip("/")
    return any(any(ROOT.glob(pattern + ending)) for ending in ENDINGS)


def missing(text: str) -> list[str]:
    """Return the paths in backticks that lead nowhere."""
    return [named for named in NAMED.findall(text) if not is_there(named)]


def headings(page: Path) -> set[str]:
    """Return the headings of a page as links name them."""
    titles = re.findall(r"^#+ +(.+)$", page.read_text("utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}


def broken_links(page: Path) -> list[str]:
    """Return the links of a page that lead to no file or heading of the project."""
    broken = []
    for link in LINK.findall(page.read_text("utf-8")):
        name, _, heading = link.partition("#")
        target = page.parent / name if name else page
        if not link.startswith(("http:", "https:")) and not (
                target.exists() and (not heading or heading in headings(target))):
            broken.append(link)
    return broken


def test_links_of_pages_lead_somewhere() -> None:
    pages = (*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"))
    assert {page.name: broken for page in pages if (broken := broken_links(page))} == {}


def test_pages_show_each_picture_and_table_beside_them() -> None:
    """Commands make the rest again, and leave it in `runs/`."""
    docs = ROOT / "docs"
    shown = {(page.parent / link).resolve() for page in (*ROOT.glob("*.md"), *docs.rglob("*.md"))
             for link in LINK.findall(page.read_text("utf-8"))}
    beside = {path.resolve() for path in docs.rglob("*.*") if path.suffix not in (".md", ".css")}
    assert sorted(path.name for path in beside - shown) == []


def test_links_that_lead_nowhere_are_found(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("# What it's for\n[a](page.md#what-its-for) [b](#what) [c](other.md)")
    assert broken_links(page) == ["#what", "other.md"]


def test_files_that_pages_and_comments_name_are_there() -> None:
    gone = {name: paths for name, text in texts() if (paths := missing(text))}
    assert gone == {}


@pytest.mark.parametrize(("text", "paths"), [
    ("`model/planner.py` and `engine/rules/leg`", []),
    ("`model/weights/*/card.json`, `docs/`", []),
    ("`model/ker" + "nel/plain.py` or `engine/ru" + "les/stop.h`",
     ["model/ker" + "nel/plain.py", "engine/ru" + "les/stop.h"]),
])
def test_paths_that_lead_nowhere_are_found(text: str, paths: list[str]) -> None:
    assert missing(text) == paths


MOST_WORDS = 40_000
"""Of all pages, but what the service prints itself."""

MOST_WORDS_OF_A_PAGE = 2_500
MEDIAN_SENTENCE, MEDIAN_SENTENCE_OF_A_PAGE = 13, 16
SENTENCE_END = re.compile(r"(?:(?<=[.?!:])|(?<=[.?!:]\*\*)) (?=[A-Z`\[*(])")
"""Within a line of prose. A colon may end a sentence that goes on in a list or a table."""

LINE_END = re.compile(r"(?:(?<=[.?!:])|(?<=[.?!:]\*\*))\n")


def pages_to_read() -> dict[str, str]:
    """Return the guide's pages by name, but what the service prints itself."""
    docs = ROOT / "docs"
    pages = {path.relative_to(docs).as_posix(): path.read_text("utf-8")
             for path in docs.rglob("*.md")}
    return {name: text for name, text in pages.items() if name != "operate/settings.md"}


def paragraphs(page: str) -> list[str]:
    """Return the paragraphs and items of lists, each with its lines."""
    prose = re.sub(r"^```.*?^```$", "", page, flags=re.MULTILINE | re.DOTALL)
    parts = re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )", prose)
    return [part.strip() for part in parts if part.strip() and part.strip()[0] not in "|#<!"]


def sentences(page: str) -> list[str]:
    """Return the sentences of a page's paragraphs, without the marks of lists."""
    marked = (re.sub(r"^(?:[-*]|\d+\.) ", "", part) for part in paragraphs(page))
    return [sentence for part in marked for line in LINE_END.split(part)
            for sentence in SENTENCE_END.split(" ".join(line.split()))]


def test_pages_are_short() -> None:
    lengths = {name: len(text.split()) for name, text in pages_to_read().items()}
    assert sum(lengths.values()) <= MOST_WORDS
    assert {name for name, length in lengths.items() if length > MOST_WORDS_OF_A_PAGE} == set()


def test_sentences_are_short() -> None:
    lengths = {name: [len(sentence.split()) for sentence in sentences(text)]
               for name, text in pages_to_read().items()}
    medians = {name: statistics.median(found) for name, found in lengths.items()}
    assert statistics.median(chain.from_iterable(lengths.values())) <= MEDIAN_SENTENCE
    assert {name: median for name, median in medians.items()
            if median > MEDIAN_SENTENCE_OF_A_PAGE} == {}


def test_a_line_of_prose_holds_one_sentence() -> None:
    lines = {name: [line for part in paragraphs(text) for line in part.splitlines()
                    if re.search(r"[^\d][.?!] (?=[A-Z`])", line)]
             for name, text in pages_to_read().items()}
    assert {name: found for name, found in lines.items() if found} == {}


def test_sentences_of_paragraphs_and_lists_are_found() -> None:
    page = ("# T\n\nOne here. Two\ngoes on.\n\n- Three.\n  Four.\n- Five\n\n"
            "- **Six.** Seven.\n  **Eight.**\n  9 is nine.\n\n```\nA. B.\n```\n| A. B |\n")
    assert sentences(page) == ["One here.", "Two goes on.", "Three.", "Four.", "Five", "**Six.**",
                               "Seven.", "**Eight.**", "9 is nine."]
