"""Calls of a client's address, as when its job has ended: signed, tried again, to public hosts.
"""

import logging
import socket
import ssl
from datetime import UTC, datetime
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import urlsplit

import anyio
from anyio import to_thread
from pydantic import SecretStr
from standardwebhooks import Webhook

from app.records.jobs.addresses import is_public
from app.schemas.errors import InputError, InvalidRequestError
from app.serving.settings import Settings

if TYPE_CHECKING:
    import httpx

logger = logging.getLogger(__name__)

TIMEOUT = 10.0
"""Seconds for a call as a whole: its name, its connection, the request, and the answer's head."""

FIRST_WAIT, WAIT_FACTOR, MAX_FAILURES = 2.0, 3.0, 10
"""Seconds until the second call, by how much more until each further one, and when to give up:
after five hours and a half."""

MAX_URL_LENGTH = 2_000


ELSEWHERE = "day:"
"""Begins the names of messages that aren't about a job."""


class Message(NamedTuple):
    """What is sent to a webhook."""

    url: str
    id: str
    body: str


class UnreachableError(Exception):
    """A webhook's host is not to be called, or its answer was no success."""


def wait_after(failures: int) -> float | None:
    """Return the seconds to wait after so many failures; None: give up."""
    return None if failures >= MAX_FAILURES else FIRST_WAIT * WAIT_FACTOR ** (failures - 1)


def check_url(url: str, settings: Settings, path: str = "query.webhook") -> None:
    """Refuse a webhook that could never be called; `path` is where it is stated.

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
    elif not may_call_private(settings) and _is_private(host_of(url)):
        problem = "The host is in a private network, which this service doesn't call " \
                  "(TANDEM_WEBHOOK_PRIVATE): state a public one."
    if problem is not None:
        raise InvalidRequestError([InputError(code="WEBHOOK", path=path, message=problem)])


def host_of(url: str) -> str:
    """Return the host that a webhook calls."""
    return urlsplit(url).hostname or ""


def _is_callable(url: str) -> bool:
    # Not before it is needed: it takes 8 MB, and most services call nobody.
    import httpx

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
    patience
        Seconds for a call as a whole.
    """

    def __init__(self, secret: SecretStr, may_call_private: bool,
                 patience: float = TIMEOUT) -> None:
        self._webhook = Webhook(secret.get_secret_value())
        self._may_call_private = may_call_private
        self._patience = patience

    @cached_property
    def _tls(self) -> ssl.SSLContext:
        import httpx

        return httpx.create_ssl_context(trust_env=False)

    def call(self, url: str, message_id: str, body: str) -> None:
        """Send a message.

        Raises
        ------
        UnreachableError
            If it was not received.
        """
        import httpx

        now = datetime.now(UTC)
        headers = {
            "Content-Type": "application/json",
            "User-Agent": "tandem",
            "webhook-id": message_id,
            "webhook-timestamp": str(int(now.timestamp())),
            "webhook-signature": self._webhook.sign(message_id, now, body),
        }
        # What httpx calls a timeout begins anew with each byte that comes.
        try:
            status = anyio.run(self._post, httpx.URL(url), headers, body)
        except TimeoutError as error:
            raise UnreachableError(f"the call took more than {self._patience:g} s") from error
        except httpx.HTTPError as error:
            raise UnreachableError(f"{type(error).__name__}: {error}") from error
        if not 200 <= status < 300:
            raise UnreachableError(f"the answer was {status}")

    async def _post(self, target: "httpx.URL", headers: dict[str, str], body: str) -> int:
        """Return the status of the answer, whose body, however long, is not read."""
        import httpx

        with anyio.fail_after(self._patience):
            address = await self._resolved(target)
            # What was checked is what is called, whatever the name means next.
            async with (
                httpx.AsyncClient(timeout=None, trust_env=False, verify=self._tls,
                                  follow_redirects=False) as client,
                client.stream("POST", target.copy_with(host=address), content=body,
                              headers={**headers, "Host": target.netloc.decode()},
                              extensions={"sni_hostname": target.host}) as response,
            ):
                return response.status_code

    async def _resolved(self, target: "httpx.URL") -> str:
        """Return an address of a host that may be called."""
        try:
            found = await to_thread.run_sync(_look_up, target, abandon_on_cancel=True)
        except OSError as error:
            raise UnreachableError(f"the host is not known: {error}") from error
        if not self._may_call_private and not all(map(is_public, found)):
            raise UnreachableError("the host is in a private network, which is not called")
        return found[0]


def _look_up(target: "httpx.URL") -> list[str]:
    found = socket.getaddrinfo(target.host, target.port, type=socket.SOCK_STREAM)
    return [str(info[4][0]) for info in found]
