"""Calls of a client's address when its job has ended: signed, tried again, to public hosts only."""

import ipaddress
import logging
import socket
from datetime import UTC, datetime
from urllib.parse import urlsplit

import httpx
from pydantic import SecretStr
from standardwebhooks import Webhook

from app.errors import InputError, InvalidRequestError
from app.settings import Settings

logger = logging.getLogger(__name__)

TIMEOUT = 10.0
"""Seconds that a receiver may take for each part of an exchange."""

FIRST_WAIT, WAIT_FACTOR, MAX_FAILURES = 2.0, 3.0, 10
"""Seconds until the second call, by how much more until each further one, and when to give up:
after five hours and a half."""

MAX_URL_LENGTH = 2_000


class UnreachableError(Exception):
    """A webhook's host is not to be called, or its answer was no success."""


def wait_after(failures: int) -> float | None:
    """Return the seconds to wait after so many failures; None: give up."""
    return None if failures >= MAX_FAILURES else FIRST_WAIT * WAIT_FACTOR ** (failures - 1)


def check_url(url: str, settings: Settings) -> None:
    """Refuse a webhook that could never be called.

    Raises
    ------
    InvalidRequestError
        If it is no absolute http or https URL, its host is to be no webhook's, or the service has
        no secret to sign with.
    """
    problem = None
    if settings.webhook_secret is None:
        problem = "This service calls no webhooks: leave it out, or have TANDEM_WEBHOOK_SECRET set."
    elif len(url) > MAX_URL_LENGTH:
        problem = f"The URL has more than {MAX_URL_LENGTH} characters: shorten it."
    elif not _is_callable(url):
        problem = "This is no URL to call: state one such as 'https://example.org/hook', without " \
                  "user and password."
    elif not may_call_private(settings) and _is_private(urlsplit(url).hostname or ""):
        problem = "The host is in a private network, which this service doesn't call " \
                  "(TANDEM_WEBHOOK_PRIVATE): state a public one."
    if problem is not None:
        raise InvalidRequestError([InputError(code="WEBHOOK", path="query.webhook",
                                              message=problem)])


def _is_callable(url: str) -> bool:
    try:
        parts = urlsplit(url)
        httpx.URL(url)
        # A name that can't be looked up: with a part that is empty or too long.
        (parts.hostname or "").encode("idna")
        return (parts.scheme in ("http", "https") and bool(parts.hostname)
                and parts.username is None and parts.password is None and parts.port != 0)
    except (ValueError, httpx.InvalidURL):
        return False


def _is_private(host: str) -> bool:
    """Tell whether a host, by its looks alone, is private; its name is looked up at each call."""
    try:
        return not is_public(host)
    except ValueError:
        return host == "localhost" or host.endswith(".localhost")


def may_call_private(settings: Settings) -> bool:
    """Tell whether webhooks may be on this machine or in private networks."""
    if settings.webhook_private is not None:
        return settings.webhook_private
    # Nobody but this machine can reach the service either.
    return settings.access is None


class Caller:
    """Calls webhooks.

    Parameters
    ----------
    secret
        What calls are signed with, `whsec_` and base64 as Standard Webhooks has it.
    may_call_private
        Whether hosts of this machine and of private networks may be called.
    """

    def __init__(self, secret: SecretStr, may_call_private: bool) -> None:
        self._webhook = Webhook(secret.get_secret_value())
        self._may_call_private = may_call_private

    def call(self, url: str, message_id: str, body: str) -> None:
        """Send a message.

        Raises
        ------
        UnreachableError
            If it was not received.
        """
        now = datetime.now(UTC)
        headers = {
            "Content-Type": "application/json",
            "User-Agent": "tandem",
            "webhook-id": message_id,
            "webhook-timestamp": str(int(now.timestamp())),
            "webhook-signature": self._webhook.sign(message_id, now, body),
        }
        target = httpx.URL(url)
        address = self._resolved(target)
        # The address that was checked is the one that is called, whatever the name means next.
        try:
            with (httpx.Client(timeout=TIMEOUT, trust_env=False) as client,
                  client.stream("POST", target.copy_with(host=address), content=body,
                                headers={**headers, "Host": target.netloc.decode()},
                                extensions={"sni_hostname": target.host}) as response):
                status = response.status_code  # its body, however long, is not read
        except httpx.HTTPError as error:
            raise UnreachableError(f"{type(error).__name__}: {error}") from error
        if not 200 <= status < 300:
            raise UnreachableError(f"the answer was {status}")

    def _resolved(self, target: httpx.URL) -> str:
        """Return an address of a host that may be called."""
        try:
            found = socket.getaddrinfo(target.host, target.port, type=socket.SOCK_STREAM)
        except OSError as error:
            raise UnreachableError(f"the host is not known: {error}") from error
        addresses = [str(info[4][0]) for info in found]
        if not self._may_call_private and not all(map(is_public, addresses)):
            raise UnreachableError("the host is in a private network, which is not called")
        return addresses[0]


def is_public(address: str) -> bool:
    """Tell whether an address belongs to the public internet."""
    parsed = ipaddress.ip_address(address.partition("%")[0])
    embedded = getattr(parsed, "ipv4_mapped", None) or getattr(parsed, "sixtofour", None)
    if embedded is not None:
        return is_public(str(embedded))
    # Translated to any IPv4 address by some networks' gateways.
    if parsed in _NAT64:
        return False
    return parsed.is_global and not parsed.is_multicast


_NAT64 = ipaddress.ip_network("64:ff9b::/96")
