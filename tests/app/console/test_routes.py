"""The console's files, as browsers keep them."""

import re

import httpx

from app.console.bundle import BUNDLE, LATER

FILE = "js/main.js"


def test_files_are_kept_below_the_edition_that_the_page_names(client: httpx.Client) -> None:
    page = client.get("/")
    assert page.headers["cache-control"] == "no-cache"
    stated = re.findall('"console/([^/]*)/', page.text)
    assert len(set(stated)) == 1
    assert f"/{BUNDLE}" in page.text
    for name in (FILE, BUNDLE, LATER):
        file = client.get(f"/console/{stated[0]}/{name}")
        assert "immutable" in file.headers["cache-control"]
        assert file.headers["content-type"].startswith("text/javascript")
    for path in re.findall('"(console/[^"]*)"', page.text):
        assert client.get(f"/{path}").status_code == 200, path


def test_other_editions_get_the_files_of_now_and_keep_none(client: httpx.Client) -> None:
    for path in (FILE, f"{16 * '0'}/{FILE}", BUNDLE, f"{16 * '0'}/{LATER}"):
        file = client.get(f"/console/{path}")
        assert file.headers["cache-control"] == "no-cache"
        assert "import" in file.text
    for path in (f"{15 * '0'}/{FILE}", f"{16 * '0'}/{16 * '0'}/{FILE}", f"{16 * '0'}", ""):
        assert client.get(f"/console/{path}").status_code == 404, path
