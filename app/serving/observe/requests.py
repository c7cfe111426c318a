"""Counts requests and writes one log line for each."""

import logging
import re
import time

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.serving.observe.metrics import Metrics

access_log = logging.getLogger("tandem.access")

METHODS = frozenset({"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"})

OTHER = "other"
"""Stands for any method or path that the service doesn't know: labels must stay few."""

CLIENT_CLOSED = 499
"""Status noted, as is usual, for a request whose client left before a reply began."""

REQUEST_ID_HEADER = "X-Request-ID"

_REQUEST_ID = re.compile(r"[A-Za-z0-9._:-]{1,128}")


def is_request_id(text: str) -> bool:
    """Tell whether a client's request id may stand in logs as it is."""
    return _REQUEST_ID.fullmatch(text) is not None


def route_of(scope: Scope) -> str:
    """Return the template of the path that answered, such as `/jobs/{id}`."""
    route = scope.get("route")
    if route is not None:
        return str(route.path)
    if "endpoint" in scope:
        return f"{scope.get('root_path', '')}/*"
    return OTHER


class RequestObserver:
    """Middleware that counts and logs what passes through it."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self._app = app
        self._metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        began = time.perf_counter()
        status = CLIENT_CLOSED
        size = 0

        async def count(message: Message) -> None:
            nonlocal status, size
            if message["type"] == "http.response.start":
                status = message["status"]
            elif message["type"] == "http.response.body":
                size += len(message.get("body", b""))
            await send(message)

        try:
            await self._app(scope, receive, count)
        except Exception:
            status = 500
            raise
        finally:
            self._note(scope, status, size, time.perf_counter() - began)

    def _note(self, scope: Scope, status: int, size: int, seconds: float) -> None:
        method = scope["method"] if scope["method"] in METHODS else OTHER
        route = route_of(scope)
        self._metrics.count_request(method, route, status, seconds)
        access_log.info("request", extra={
            "method": method,
            "route": route,
            # Without the query, which may hold what isn't ours to write down.
            "path": scope.get("raw_path", b"")[:200].decode("ascii", "replace"),
            "status": status,
            "duration": round(seconds, 6),
            "bytes": size,
            "key": scope.get("state", {}).get("key_id"),
        })
