"""Rate limits: who is counted, and what replies tell."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi import Request

from app.serving.access.keys import KeyStore
from app.serving.access.limits import (
    RateLimits, RequestCounter, TooManyRequestsError, client_address,
)
from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner, opened, ready
from tests.conftest import PATIENCE

pytestmark = pytest.mark.slow

Serve = Callable[..., httpx.Client]

PLAN = frozenset({"plan"})


def request_from(host: str | None) -> Request:
    """Return a request that came from an address."""
    return Request({"type": "http", "method": "POST", "headers": [],
                    "client": None if host is None else (host, 1)})


def headers_of(limits: RequestCounter, host: str, key: str | None = None) -> dict[str, str]:
    """Return what the reply to one more request tells of its limit."""
    request = request_from(host)
    limits.take(request, key or client_address(request), PLAN)
    headers: dict[str, str] = getattr(request.state, "rate_limit_headers", {})
    return headers


@pytest.mark.usefixtures("same_minute")
def test_plans_beyond_the_rate_are_refused_and_replies_count_down(
        serve: Serve, smallest: dict[str, Any]) -> None:
    client = ready(serve(FirstFitPlanner(), Settings(plans_per_minute=3)))
    replies = [client.post("/plan", json=smallest) for _ in range(4)]
    assert [reply.status_code for reply in replies] == [200, 200, 200, 429]
    assert [reply.headers["ratelimit-remaining"] for reply in replies] == ["2", "1", "0", "0"]
    assert {reply.headers["ratelimit-limit"] for reply in replies} == {"3"}
    assert all(1 <= int(reply.headers["ratelimit-reset"]) <= 60 for reply in replies)
    refusal = replies[-1]
    assert refusal.headers["content-type"] == "application/problem+json"
    assert 1 <= int(refusal.headers["retry-after"]) <= 80
    assert refusal.headers["retry-after"] in refusal.json()["detail"]
    assert client.get("/health/live").status_code == 200


def test_without_a_rate_nothing_is_counted(client: httpx.Client, smallest: dict[str, Any]) -> None:
    assert "ratelimit-limit" not in client.post("/plan", json=smallest).headers


@pytest.mark.usefixtures("same_minute")
def test_each_key_has_its_own_rate(
        serve: Serve, smallest: dict[str, Any], tmp_path: Path) -> None:
    settings = Settings(access="keys", data_dir=tmp_path, plans_per_minute=1)
    with opened(settings) as engine:
        keys = [KeyStore(engine).create(name, ["plan"]) for name in "ab"]
    client = ready(serve(FirstFitPlanner(), settings))
    statuses = [client.post("/plan", json=smallest, headers={"X-API-Key": key}).status_code
                for key in keys * 2]
    assert statuses == [200, 200, 429, 429]


@pytest.mark.usefixtures("same_minute")
def test_wrong_keys_are_slowed_down_and_the_right_one_is_let_in_all_the_same(
        serve: Serve, smallest: dict[str, Any], tmp_path: Path) -> None:
    settings = Settings(access="keys", data_dir=tmp_path, wrong_keys_per_minute=5)
    with opened(settings) as engine:
        key = KeyStore(engine).create("ann", ["plan"])
    client = ready(serve(FirstFitPlanner(), settings))
    wrong = [client.post("/plan", json=smallest, headers={"X-API-Key": f"wrong-{number}"})
             for number in range(8)]
    assert [reply.status_code for reply in wrong] == [401] * 5 + [429] * 3
    assert int(wrong[-1].headers["retry-after"]) > 0
    assert client.post("/plan", json=smallest, headers={"X-API-Key": key}).status_code == 200


@pytest.mark.usefixtures("same_minute")
def test_addresses_are_counted_apart_and_ipv6_networks_together() -> None:
    limits = RequestCounter(RateLimits(plans=1))
    for host in ("10.0.0.1", "10.0.0.2", "2001:db8::1", "2001:db8:0:1::1"):
        assert headers_of(limits, host)["RateLimit-Remaining"] == "0"
    with pytest.raises(TooManyRequestsError):
        headers_of(limits, "2001:db8::ffff")


@pytest.mark.parametrize(("host", "address"), [
    ("10.0.0.1", "10.0.0.1"), ("::ffff:10.0.0.1", "10.0.0.1"),
    ("2001:db8::1", "2001:db8::/64"), ("fe80::1%eth0", "fe80::/64"), ("testclient", "testclient"),
    (None, "")])
def test_addresses_stand_for_whom_they_belong_to(host: str | None, address: str) -> None:
    assert client_address(request_from(host)) == address


def test_whoever_waits_as_told_is_let_in(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = [1_800_000_007.0]
    monkeypatch.setattr(time, "time", lambda: clock[0])
    limits = RequestCounter(RateLimits(plans=5))
    refused = 0
    for _ in range(400):
        clock[0] += 1.3
        try:
            headers_of(limits, "10.0.0.1")
        except TooManyRequestsError as error:
            refused += 1
            clock[0] += int(error.headers["Retry-After"])
            headers_of(limits, "10.0.0.1")
    assert refused > 50


def test_counts_take_no_memory_for_good(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = [1_800_000_007.0]
    monkeypatch.setattr(time, "time", lambda: clock[0])
    limits = RequestCounter(RateLimits(failures=1))
    for number in range(2000):
        limits.count_failure(f"10.0.{number // 256}.{number % 256}")
    storage: Any = limits._limiter.storage
    assert len(storage.storage) == 2000
    clock[0] += 200
    deadline = time.monotonic() + PATIENCE
    while len(storage.storage) > 10:
        limits.count_failure("10.1.0.0")
        clock[0] += 60
        assert time.monotonic() < deadline
