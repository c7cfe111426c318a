"""Texts that stay as they are, and replies that are compressed."""

import gzip
from collections.abc import Callable

import brotli
import httpx
import pytest
from starlette.datastructures import Headers

from app.serving.texts import Text

LONG = b"word " * 400


@pytest.mark.parametrize(("taken", "encoding", "read"), [
    ("gzip, deflate, br", "br", brotli.decompress), ("gzip, deflate", "gzip", gzip.decompress)])
def test_a_text_is_compressed_for_who_takes_it(
        taken: str, encoding: str, read: Callable[[bytes], bytes]) -> None:
    text = Text(LONG, "text/css")
    reply = text.reply(Headers({"accept-encoding": taken}), {"Cache-Control": "no-cache"})
    assert read(bytes(reply.body)) == LONG
    assert (reply.headers["content-encoding"], reply.headers["vary"]) == (
        encoding, "Accept-Encoding")
    assert text.reply(Headers({}), {}).body == LONG


@pytest.mark.parametrize(("content", "kind"), [(b"few", "text/css"), (LONG, "font/woff2")])
def test_what_compressing_saves_nothing_of_is_sent_as_it_is(content: bytes, kind: str) -> None:
    reply = Text(content, kind).reply(Headers({"accept-encoding": "br, gzip"}), {})
    assert reply.body == content
    assert "content-encoding" not in reply.headers


def test_who_has_a_text_is_told_that_it_is_unchanged() -> None:
    text = Text(LONG, "text/css")
    assert text.etag != Text(LONG + b"!", "text/css").etag
    reply = text.reply(Headers({"if-none-match": text.etag}), {})
    assert (reply.status_code, reply.body) == (304, b"")


@pytest.mark.parametrize("path", ["/openapi.json", "/console/css/base.css"])
def test_description_and_files_are_asked_for_once(client: httpx.Client, path: str) -> None:
    reply = client.get(path)
    assert reply.headers["content-encoding"] == "br"
    assert reply.headers["cache-control"] == "no-cache"
    again = client.get(path, headers={"If-None-Match": reply.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")


def test_plans_are_compressed(client: httpx.Client) -> None:
    customers = [{"id": f"c{number}", "location": [number, 1], "demand": [1]}
                 for number in range(20)]
    request = {"depots": [{"id": "hub", "location": [0, 0]}], "customers": customers,
               "fleet": [{"id": "van", "count": 1, "capacity": [20]}],
               "options": {"time_limit": 0}}
    reply = client.post("/plan", json=request)
    assert reply.headers["content-encoding"] == "gzip"
    assert reply.json()["summary"]["served"] == 20
    assert "content-encoding" not in client.get("/health/live").headers
