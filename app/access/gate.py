"""What is refused before any endpoint is looked for: keys in addresses, pages of other origins."""

import re
from collections.abc import Collection
from urllib.parse import unquote_to_bytes

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from app.access.keys import PREFIX
from app.errors import problem_response
from app.observe.metrics import Metrics

KEY_IN_URL = "key_in_url"
"""Where the state of a request says that its address had a key."""

REMOVED = "/[removed]"
"""Path in place of one that had a key."""

_KEY_PARAMETER = re.compile(
    rb"(x-)?(api[-_]?key|key|access[-_]?token|token|authorization)", re.IGNORECASE)

_READING = frozenset({"GET", "HEAD", "OPTIONS"})


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
    origins
        Other origins whose pages may call the service.
    metrics
        Where refusals are counted.
    """

    def __init__(self, app: ASGIApp, origins: Collection[str], metrics: Metrics) -> None:
        self._app = app
        self._origins = frozenset(origins)
        self._metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        app = self._app
        if scope["type"] == "http":
            if scope.get("state", {}).get(KEY_IN_URL):
                app = problem_response(
                    400, "key-in-url", "A key must not be in the URL",
                    "Addresses end up in logs and histories: send the key as 'Authorization: "
                    "Bearer <key>' or as 'X-API-Key: <key>', and revoke this one if it is real.")
            elif self._is_foreign(scope):
                app = problem_response(
                    403, "foreign-page", "Pages of other origins may not do this",
                    "A page of another origin sent this request: list its origin in "
                    "TANDEM_CORS_ORIGINS if it should be allowed.")
            if app is not self._app:
                self._metrics.count_refusal("access")
        await app(scope, receive, send)

    def _is_foreign(self, scope: Scope) -> bool:
        """Tell whether a browser sends this for a page that may not change anything here.

        Without it, any page could have plans computed by a service on its visitor's machine.
        """
        if scope["method"] in _READING:
            return False
        headers = Headers(scope=scope)
        return (headers.get("sec-fetch-site", "none") not in ("none", "same-origin")
                and headers.get("origin") not in self._origins)


def _has_key(query: bytes) -> bool:
    """Tell whether a query holds a key of ours, or a parameter that is named like one."""
    names = (part.partition(b"=")[0] for part in query.split(b"&"))
    return (PREFIX.encode() in unquote_to_bytes(query)
            or any(_KEY_PARAMETER.fullmatch(unquote_to_bytes(name)) for name in names))
