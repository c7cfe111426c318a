"""What is refused before any endpoint is looked for, by a request's head alone."""

import re
from collections.abc import Callable, Collection
from urllib.parse import unquote_to_bytes

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from app.schemas.errors import Refusal, problem_response
from app.serving.access.hosts import TrustedHosts, is_same_host
from app.serving.access.tokens import PREFIX

KEY_IN_URL = "key_in_url"
"""Where the state of a request says that its address had a key."""

REMOVED = "/[removed]"
"""Path in place of one that had a key."""

_KEY_PARAMETER = re.compile(
    rb"(x-)?(api[-_]?key|key|access[-_]?token|token|authorization)", re.IGNORECASE)

_READING = frozenset({"GET", "HEAD", "OPTIONS"})

HEALTH = "/health/"
"""Begins the paths that tell nothing of anybody, so probes may ask under whatever name."""


class KeyScrubber:
    """Outermost middleware: drops keys from addresses, so that no log nor trace holds one."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http":
            if scope["query_string"] and _has_key(scope["query_string"]):
                scope["query_string"] = b""
                scope.setdefault("state", {})[KEY_IN_URL] = True
            if PREFIX in scope["path"]:
                scope["path"], scope["raw_path"] = REMOVED, REMOVED.encode()
                scope.setdefault("state", {})[KEY_IN_URL] = True
        await self._app(scope, receive, send)


class Gate:
    """Middleware that refuses requests by what their head says.

    Parameters
    ----------
    hosts
        Names by which the service may be called.
    origins
        Other origins whose pages may call the service.
    count_refusal
        Is told of each refusal.
    """

    def __init__(self, app: ASGIApp, hosts: TrustedHosts, origins: Collection[str],
                 count_refusal: Callable[[Refusal], None]) -> None:
        self._app = app
        self._hosts = hosts
        self._origins = frozenset(origins)
        self._count_refusal = count_refusal

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        refusal = self._refusal(scope) if scope["type"] == "http" else None
        if refusal is not None:
            self._count_refusal("access")
        await (refusal or self._app)(scope, receive, send)

    def _refusal(self, scope: Scope) -> ASGIApp | None:
        """Return what refuses a request; None: it may pass."""
        if scope.get("state", {}).get(KEY_IN_URL):
            return problem_response(
                400, "key-in-url", "A key must not be in the URL",
                "Addresses end up in logs and histories: send the key as 'Authorization: "
                "Bearer <key>' or as 'X-API-Key: <key>', and revoke this one if it is real.")
        headers = Headers(scope=scope)
        if not (scope["path"].startswith(HEALTH) or self._hosts.trusts(headers.get("host", ""))):
            return problem_response(
                421, "untrusted-host", "The service is not called by this name",
                "The header Host has a name that this service doesn't go by: list it in "
                "TANDEM_TRUSTED_HOSTS if it should be.")
        if scope["method"] not in _READING and self._is_foreign(headers):
            return problem_response(
                403, "foreign-page", "Pages of other origins may not do this",
                "A page of another origin sent this request: list its origin in "
                "TANDEM_CORS_ORIGINS if it should be allowed.")
        return None

    def _is_foreign(self, headers: Headers) -> bool:
        """Tell whether a browser sends this for a page that may not change anything here.

        Without it, any page could have plans computed by a service on its visitor's machine.
        Over plain HTTP browsers tell `Sec-Fetch-Site` to loopback names alone, so `Origin` counts.
        """
        origin = headers.get("origin")
        if origin in self._origins:
            return False
        site = headers.get("sec-fetch-site")
        if site is not None:
            return site not in ("none", "same-origin")
        return origin is not None and not is_same_host(origin, headers.get("host", ""))


def _has_key(query: bytes) -> bool:
    """Tell whether a query holds a key of ours, or a parameter that is named like one."""
    names = (part.partition(b"=")[0] for part in query.split(b"&"))
    return (PREFIX.encode() in unquote_to_bytes(query)
            or any(_KEY_PARAMETER.fullmatch(unquote_to_bytes(name)) for name in names))
