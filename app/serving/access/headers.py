"""Headers on every reply: what browsers may do with it, and what is left of a rate limit."""

import re
from collections.abc import Mapping

from starlette.types import ASGIApp, Message, Receive, Scope, Send

RATE_LIMIT_HEADERS = "rate_limit_headers"
"""Where the state of a request holds the headers that tell what is left of a rate limit."""

DOCUMENTATION = re.compile("/(docs|redoc|guide/.*)")
"""Pages whose scripts stand in the page itself, as FastAPI and the guide's generator make them."""

YEAR = 31_536_000

Header = tuple[bytes, bytes]


def content_security_policy(scripts: str, images: str) -> str:
    """Return the policy of a page of our own: nothing is loaded from elsewhere but `images`."""
    return "; ".join((
        "default-src 'self'",
        f"script-src {scripts}",
        "style-src 'self' 'unsafe-inline'",
        f"img-src 'self' data: blob:{images}",
        "worker-src 'self' blob:",
        "object-src 'none'",
        "base-uri 'none'",
        "form-action 'self'",
        "frame-ancestors 'none'",
    ))


class SecurityHeaders:
    """Middleware that adds headers which a reply doesn't have yet.

    Parameters
    ----------
    image_origin
        Origin of map tiles, such as `https://tiles.example.org`; empty: none.
    """

    def __init__(self, app: ASGIApp, image_origin: str = "") -> None:
        self._app = app
        images = f" {image_origin}" if image_origin else ""
        self._usual = _encoded({
            "X-Content-Type-Options": "nosniff",
            "X-Frame-Options": "DENY",
            "Referrer-Policy": "no-referrer",
            "Cross-Origin-Opener-Policy": "same-origin",
            "Cross-Origin-Resource-Policy": "same-origin",
            # Plans are not for caches; static files say for themselves how long they hold.
            "Cache-Control": "no-store",
            "Content-Security-Policy": content_security_policy("'self'", images),
        })
        self._of_documentation = _encoded({
            "Content-Security-Policy": content_security_policy("'self' 'unsafe-inline'", images)})
        self._of_https = _encoded({"Strict-Transport-Security": f"max-age={YEAR}"})

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = dict(self._headers(scope))
                for name, _ in message.get("headers", ()):
                    headers.pop(name.lower(), None)
                message["headers"] = [*message.get("headers", ()), *headers.items()]
            await send(message)

        await self._app(scope, receive, send_with_headers)

    def _headers(self, scope: Scope) -> list[Header]:
        """Return the headers for one request; of the same name, the last counts."""
        headers = list(self._usual)
        if DOCUMENTATION.fullmatch(scope["path"]):
            headers += self._of_documentation
        if scope["scheme"] == "https":
            headers += self._of_https
        limits: Mapping[str, str] | None = scope.get("state", {}).get(RATE_LIMIT_HEADERS)
        return headers + _encoded(limits) if limits else headers


def _encoded(headers: Mapping[str, str]) -> list[Header]:
    return [(name.lower().encode("latin-1"), value.encode("latin-1"))
            for name, value in headers.items()]
