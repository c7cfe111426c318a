"""Log lines of a real process: one per request, each with the request's id, no secrets."""

import json
import logging
import sys
from collections.abc import Iterator
from typing import Any

import pytest

from app.serving.observe.logs import log_config, make_formatter
from tests.app.serving.observe.server import CRASHING_SEED, Server, running
from tests.conftest import eventually

pytestmark = pytest.mark.slow

SECRET = "tdm_not_for_logs"


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    """Return a server that logs JSON."""
    with running(TANDEM_LOG_FORMAT="json") as server:
        yield server


def lines_of(server: Server, request_id: str) -> list[dict[str, Any]]:
    """Return the lines of one request; waits for its last, the access line."""
    def mine() -> list[dict[str, Any]]:
        assert server.process.poll() is None
        lines = [json.loads(line) for line in list(server.lines)]
        lines = [line for line in lines if line.get("request_id") == request_id]
        return lines if any(line["logger"] == "tandem.access" for line in lines) else []

    return list(eventually(mine))


def test_every_line_is_json_and_every_request_has_one(
        server: Server, smallest: dict[str, Any]) -> None:
    reply = server.client.post("/plan", json=smallest, headers={
        "X-Request-ID": "order-77", "Authorization": f"Bearer {SECRET}", "X-API-Key": SECRET})
    assert reply.headers["x-request-id"] == "order-77"
    (line,) = lines_of(server, "order-77")
    assert line["event"] == "request"
    assert (line["method"], line["route"], line["status"]) == ("POST", "/plan", 200)
    assert line["bytes"] == int(reply.headers["content-length"])
    assert 0 < line["duration"] < 10
    assert not any(SECRET in line for line in server.lines)


def test_requests_without_an_id_or_with_a_wild_one_get_one(server: Server) -> None:
    given = {server.client.get("/health/live", headers=headers).headers["x-request-id"]
             for headers in ({}, {"X-Request-ID": "a b\tc"}, {"X-Request-ID": "x" * 500})}
    assert len(given) == 3
    assert all(len(request_id) == 32 for request_id in given)


def test_queries_are_not_logged(server: Server) -> None:
    server.client.get("/health/live?note=hush", headers={"X-Request-ID": "query"})
    assert lines_of(server, "query")[0]["path"] == "/health/live"
    assert not any("hush" in line for line in server.lines)


def test_line_breaks_in_paths_stay_encoded(server: Server) -> None:
    server.client.get("/a%0Ab", headers={"X-Request-ID": "breaks"})
    assert lines_of(server, "breaks")[0]["path"] == "/a%0Ab"


def test_failures_are_logged_once_with_their_traceback_and_answered_with_the_id(
        server: Server, smallest: dict[str, Any]) -> None:
    smallest["options"] = {"seed": CRASHING_SEED}
    reply = server.client.post("/plan", json=smallest, headers={"X-Request-ID": "crash"})
    assert reply.status_code == 500
    assert reply.headers["content-type"] == "application/problem+json"
    assert reply.headers["x-request-id"] == "crash"
    assert "request id crash" in reply.json()["detail"]
    # The first comes from the thread that plans.
    warning, failure, access = lines_of(server, "crash")
    assert warning["event"] == "about to crash"
    assert failure["level"] == "error"
    assert "RuntimeError: crashed as asked" in failure["exception"]
    assert access["status"] == 500
    assert sum("crashed as asked" in line for line in server.lines) == 1


def test_people_get_plain_lines() -> None:
    record = logging.LogRecord("app.x", logging.WARNING, "x.py", 1, "%s left", ("nobody",), None)
    line = make_formatter("console", traced=False).format(record)
    assert "nobody left" in line
    assert "app.x" in line
    assert not line.startswith("{")


def test_format_follows_the_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    def chosen() -> str:
        return log_config("auto", "info")["formatters"]["lines"]["log_format"]

    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    assert chosen() == "console"
    monkeypatch.setattr(sys.stderr, "isatty", lambda: False, raising=False)
    assert chosen() == "json"
