"""What pages and comments name is there."""

import re
from collections.abc import Iterator
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
