"""Which addresses webhooks may have, and how often they are called."""

import socket

import pytest
from pydantic import SecretStr, ValidationError

from app.errors import InvalidRequestError
from app.jobs.webhook import (
    MAX_FAILURES, Caller, UnreachableError, check_url, is_public, may_call_private, wait_after,
)
from app.settings import Settings

SECRET = "whsec_MDEyMzQ1Njc4OTAxMjM0NTY3ODkwMTIzNDU2Nzg5MDE="


@pytest.mark.parametrize(("address", "public"), [
    ("93.184.216.34", True), ("2606:2800:220:1::1", True),
    ("127.0.0.1", False), ("10.1.2.3", False), ("172.16.0.1", False), ("192.168.1.1", False),
    ("169.254.169.254", False), ("100.64.0.1", False), ("0.0.0.0", False), ("224.0.0.1", False),
    ("255.255.255.255", False), ("::1", False), ("::", False), ("fe80::1%eth0", False),
    ("fd00::1", False), ("::ffff:10.0.0.1", False), ("64:ff9b::a00:1", False),
    ("2002:a00:1::", False), ("ff02::1", False),
])
def test_private_addresses_are_known(address: str, public: bool) -> None:
    assert is_public(address) is public


@pytest.mark.parametrize("address", ["10.0.0.1", "169.254.169.254", "::1"])
def test_name_of_a_private_address_is_not_called(
        monkeypatch: pytest.MonkeyPatch, address: str) -> None:
    found = [(socket.AF_INET, socket.SOCK_STREAM, 6, "", ("93.184.216.34", 80)),
             (socket.AF_INET, socket.SOCK_STREAM, 6, "", (address, 80))]
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_, **__: found)
    with pytest.raises(UnreachableError, match="private network"):
        Caller(SecretStr(SECRET), may_call_private=False).call("https://a.example", "m", "{}")


def test_host_that_is_not_there_is_unreachable() -> None:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    with pytest.raises(UnreachableError, match="ConnectError"):
        Caller(SecretStr(SECRET), may_call_private=True).call(f"http://localhost:{port}", "m", "{}")


@pytest.mark.parametrize("url", ["http://127.0.0.1/x", "http://localhost", "https://[::1]:8000",
                                 "http://10.0.0.1", "http://a.localhost/"])
def test_private_host_is_refused_when_the_job_comes(url: str) -> None:
    with pytest.raises(InvalidRequestError):
        check_url(url, Settings(webhook_secret=SECRET, access="keys"))
    check_url(url, Settings(webhook_secret=SECRET))
    check_url(url, Settings(webhook_secret=SECRET, access="keys", webhook_private=True))
    check_url("https://example.org", Settings(webhook_secret=SECRET, access="keys"))


def test_service_without_secret_calls_no_webhooks() -> None:
    with pytest.raises(InvalidRequestError) as refusal:
        check_url("https://example.org", Settings())
    assert "TANDEM_WEBHOOK_SECRET" in refusal.value.errors[0].message


@pytest.mark.parametrize("secret", ["hunter2", "whsec_short", "whsec_" + 40 * "?"])
def test_weak_secret_is_refused_and_not_repeated(secret: str) -> None:
    with pytest.raises(ValidationError) as refusal:
        Settings(webhook_secret=secret)
    assert "whsec_" in str(refusal.value)
    assert secret not in str(refusal.value)


def test_private_hosts_are_called_by_a_private_service_alone() -> None:
    assert may_call_private(Settings())
    assert not may_call_private(Settings(access="open"))
    assert not may_call_private(Settings(webhook_private=False))


def test_waits_grow_until_calls_are_given_up() -> None:
    waits = [wait_after(failures) for failures in range(1, MAX_FAILURES + 1)]
    assert waits[:3] == [2, 6, 18]
    assert waits[-1] is None
    assert 5 < sum(wait for wait in waits if wait is not None) / 3600 < 6
