"""Which addresses webhooks may have, and how often they are called."""

import socket
import threading
import time
from typing import Any

import pytest
from pydantic import SecretStr, ValidationError

from app.records.jobs.addresses import is_public
from app.records.jobs.webhook import (
    MAX_FAILURES, Caller, UnreachableError, check_url, may_call_private, wait_after,
)
from app.schemas.errors import InvalidRequestError
from app.serving.settings import Settings
from tests.app.records.jobs.receiving import Receiver, drip
from tests.conftest import SOON, apart

pytestmark = pytest.mark.slow

SECRET = "whsec_MDEyMzQ1Njc4OTAxMjM0NTY3ODkwMTIzNDU2Nzg5MDE="


@pytest.mark.parametrize("address", [
    "93.184.216.34", "2606:2800:220:1::1", "2a00:1450:4001:800::200e", "::ffff:93.184.216.34",
    "64:ff9b::5db8:d822", "2002:5db8:d822::1"])
def test_public_addresses_are_known(address: str) -> None:
    assert is_public(address)


@pytest.mark.parametrize("address", [
    "127.0.0.1", "10.1.2.3", "172.16.0.1", "192.168.1.1", "169.254.169.254", "100.64.0.1",
    "0.0.0.0", "224.0.0.1", "240.0.0.1", "255.255.255.255", "192.0.2.1", "198.18.0.1",
    "192.88.99.1", "::1", "::", "fe80::1%eth0", "fec0::1", "fd00::1", "fc00::1", "ff02::1",
    "ff0e::1", "100::1", "5f00::1", "2001:db8::1", "3fff::1", "4000::1",
    "::127.0.0.1", "::10.0.0.1", "::93.184.216.34",  # the former way to write IPv4
    "::ffff:10.0.0.1", "::ffff:127.0.0.1", "::ffff:0:127.0.0.1",
    "64:ff9b::a00:1", "64:ff9b::7f00:1", "64:ff9b:1::a00:1", "64:ff9b:1::5db8:d822",
    "2002:a00:1::", "2002:7f00:1::1", "2002:c0a8:101::1",  # 6to4
    "2001:0:5db8:d822:8000:63bf:f5ff:fffe", "2001:0:a00:1::1",  # Teredo
])
def test_private_addresses_are_known(address: str) -> None:
    assert not is_public(address)


@pytest.mark.parametrize("address", ["10.0.0.1", "169.254.169.254", "::1"])
def test_name_of_a_private_address_is_not_called(
        monkeypatch: pytest.MonkeyPatch, address: str) -> None:
    found = [(socket.AF_INET, socket.SOCK_STREAM, 6, "", ("93.184.216.34", 80)),
             (socket.AF_INET, socket.SOCK_STREAM, 6, "", (address, 80))]
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_, **__: found)
    with pytest.raises(UnreachableError, match="private network"):
        apart(Caller(SecretStr(SECRET), may_call_private=False).call, "https://a.example", "m",
              "{}")


def test_host_that_is_not_there_is_unreachable() -> None:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    with pytest.raises(UnreachableError, match="ConnectError"):
        apart(Caller(SecretStr(SECRET), may_call_private=True).call, f"http://localhost:{port}",
              "m", "{}")


def redirect(connection: socket.socket, is_over: threading.Event) -> None:
    """Send the caller to its own machine."""
    connection.sendall(b"HTTP/1.1 302 Found\r\nLocation: /elsewhere\r\nContent-Length: 0\r\n\r\n")


def test_call_of_a_receiver_that_drips_ends_in_time() -> None:
    with Receiver(drip) as receiver:
        caller = Caller(SecretStr(SECRET), may_call_private=True, patience=0.5)
        began = time.monotonic()
        with pytest.raises(UnreachableError, match=r"more than 0\.5 s"):
            apart(caller.call, f"http://127.0.0.1:{receiver.port}", "m", "{}")
        assert time.monotonic() - began < SOON  # it drips for ever


def test_name_that_is_slow_to_be_found_ends_in_time(monkeypatch: pytest.MonkeyPatch) -> None:
    is_over = threading.Event()
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_, **__: is_over.wait(2 * SOON))
    caller = Caller(SecretStr(SECRET), may_call_private=True, patience=0.2)
    began = time.monotonic()
    with pytest.raises(UnreachableError, match="more than"):
        apart(caller.call, "http://a.example", "m", "{}")
    assert time.monotonic() - began < SOON
    is_over.set()


def test_redirect_is_not_followed() -> None:
    with Receiver(redirect) as receiver:
        with pytest.raises(UnreachableError, match="302"):
            apart(Caller(SecretStr(SECRET), may_call_private=True).call,
                  f"http://127.0.0.1:{receiver.port}", "m", "{}")
        assert receiver.num_calls == 1


def test_name_is_looked_up_once_and_what_was_checked_is_called(
        monkeypatch: pytest.MonkeyPatch) -> None:
    def answer(connection: socket.socket, _: threading.Event) -> None:
        connection.sendall(b"HTTP/1.1 204 No Content\r\n\r\n")

    with Receiver(answer) as receiver:
        look_up, asked = socket.getaddrinfo, []

        def turn(host: str, *rest: Any, **more: Any) -> Any:
            if host != "turning.example":
                return look_up(host, *rest, **more)
            asked.append(host)
            return look_up("127.0.0.1" if len(asked) == 1 else "127.0.0.2", *rest, **more)

        monkeypatch.setattr(socket, "getaddrinfo", turn)
        monkeypatch.setattr("app.records.jobs.webhook.is_public",
                            lambda address: address == "127.0.0.1")
        apart(Caller(SecretStr(SECRET), may_call_private=False).call,
              f"http://turning.example:{receiver.port}/hook", "m", "{}")
        assert (receiver.num_calls, len(asked)) == (1, 1)


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
