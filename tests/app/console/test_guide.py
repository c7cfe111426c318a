"""Every link of the guide leads somewhere within it, and nothing is loaded from elsewhere."""

import re
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urljoin, urlsplit

import httpx
import pytest

from app.console import guide

HOME = "/guide/"
FEWEST_PAGES = 28


@dataclass
class Seen(HTMLParser):
    """A page's links and anchors, and the files that it loads."""

    text: str
    links: set[str] = field(default_factory=set)
    anchors: set[str] = field(default_factory=set)
    files: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        super().__init__()
        self.feed(self.text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        named = {name: value or "" for name, value in attrs}
        self.anchors |= {named[name] for name in ("id", "name") if name in named}
        if tag == "a" and "href" in named:
            self.links.add(named["href"])
        if tag == "link" and named.get("rel") in {"stylesheet", "icon"}:
            self.files.add(named["href"])
        if "src" in named:
            self.files.add(named["src"])


@pytest.fixture
def pages(client: httpx.Client) -> dict[str, Seen]:
    """Return all pages that links lead to, by their paths."""
    pages: dict[str, Seen] = {}
    left = [HOME]
    while left:
        path = left.pop()
        reply = client.get(path)
        assert reply.status_code == 200, path
        pages[path] = Seen(reply.text)
        for link in pages[path].links:
            target = urlsplit(urljoin(path, link)).path
            if is_within(link) and target.endswith("/") and target not in (*pages, *left):
                left.append(target)
    return pages


def is_within(link: str) -> bool:
    return not urlsplit(link).scheme


def test_every_link_and_file_is_there(client: httpx.Client, pages: dict[str, Seen]) -> None:
    assert len(pages) >= FEWEST_PAGES
    broken, files = set(), set()
    for path, page in pages.items():
        for link in filter(is_within, page.links):
            target = urlsplit(urljoin(path, link))
            if target.path not in pages:
                files.add(target.path)
            elif target.fragment and unquote(target.fragment) not in pages[target.path].anchors:
                broken.add((path, link))
        files |= {urljoin(path, file) for file in page.files}
    assert broken == set()
    assert {file for file in files if client.get(file).status_code != 200} == set()


def test_nothing_is_loaded_from_elsewhere(client: httpx.Client, pages: dict[str, Seen]) -> None:
    files = {urljoin(path, file) for path, page in pages.items() for file in page.files}
    assert all(file.startswith(HOME) for file in files)
    for sheet in (file for file in files if file.endswith(".css")):
        assert not re.findall(r"(?:@import|url\()\W*https?:", client.get(sheet).text)


def test_pages_of_the_folder_are_all_in_the_guide(pages: dict[str, Seen]) -> None:
    docs = Path(__file__).parents[3] / "docs"
    written = {path.relative_to(docs).with_suffix("").as_posix() for path in docs.rglob("*.md")}
    assert {f"{HOME}{name}/" for name in written - {"index"}} | {HOME} == set(pages)


def test_the_guide_is_asked_for_again_and_runs_scripts_of_its_pages(client: httpx.Client) -> None:
    reply = client.get("/guide", follow_redirects=True)
    assert reply.url.path == HOME
    assert reply.headers["cache-control"] == "no-cache"
    assert "script-src 'self' 'unsafe-inline'" in reply.headers["content-security-policy"]
    assert client.get("/guide/use/nothing/").status_code == 404


def test_a_guide_that_is_not_built_says_how(client: httpx.Client, tmp_path: Path,
                                            monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guide, "SITE_DIR", tmp_path / "none")
    reply = client.get(HOME)
    assert reply.status_code == 404
    assert "make guide" in reply.json()["detail"]
