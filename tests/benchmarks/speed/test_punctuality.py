"""Requests of the study of punctuality are valid, and replies are told as they are.

The study is `python -m benchmarks.speed.punctuality`.
"""

import json

import httpx
import pytest

from app.requests.reading import read_request
from benchmarks.speed.punctuality import ask, requests, told

pytestmark = pytest.mark.slow

REQUESTS = requests()


@pytest.mark.parametrize("name", REQUESTS)
def test_requests_are_valid_and_small(name: str) -> None:
    body = json.dumps(REQUESTS[name]).encode()
    read_request(body, None)
    assert len(body) < 600_000


def test_replies_are_told() -> None:
    plan = {"solver": {"elapsed": {"validate": 0.123}}, "unassigned": [{}, {}],
            "cost": {"total": 12.4}}
    assert told(httpx.Response(200, json=plan)) == ("0.12", "2", "12")
    refusal = {"title": "no", "errors": [{"code": "TOO_MUCH_WORK"}]}
    assert told(httpx.Response(422, json=refusal)) == ("422 TOO_MUCH_WORK", "", "")
    assert told(httpx.Response(503, json={"title": "busy"})) == ("503 busy", "", "")


def test_the_whole_request_is_sent() -> None:
    sent: list[bytes] = []

    def answer(request: httpx.Request) -> httpx.Response:
        sent.append(request.content)
        return httpx.Response(200, json={})

    with httpx.Client(transport=httpx.MockTransport(answer), base_url="http://service") as client:
        elapsed, _ = ask(client, {"customers": [1]})
    assert sent == [b'{"customers":[1]}']
    assert elapsed > 0
