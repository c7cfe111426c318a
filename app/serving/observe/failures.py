"""Turns a failure of ours into a reply, and writes down where it happened."""

import logging

from asgi_correlation_id import correlation_id
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.schemas.errors import problem_response

logger = logging.getLogger(__name__)


class FailureReply:
    """Innermost middleware: whatever is outside it sees an ordinary reply with status 500."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        started = False

        async def note(message: Message) -> None:
            nonlocal started
            started = started or message["type"] == "http.response.start"
            await send(message)

        try:
            await self._app(scope, receive, note)
        except Exception:
            # Nothing may get past this place without a line in the log and a reply.
            if scope["type"] != "http" or started:
                raise
            logger.exception("request failed")
            reply = problem_response(
                500, "internal-error", "Internal error",
                "The request could not be answered; the service's log says why, under request id "
                f"{correlation_id.get()}.")
            await reply(scope, receive, send)
