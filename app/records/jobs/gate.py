"""What a process answers that only works on jobs."""

from starlette.types import ASGIApp, Receive, Scope, Send

from app.schemas.errors import problem_response

OPEN = ("/health/live", "/health/ready", "/metrics")


class WorkerGate:
    """Lets through questions for health and metrics alone."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or have the application do so."""
        if scope["type"] != "http" or scope["path"] in OPEN:
            await self._app(scope, receive, send)
            return
        response = problem_response(404, "worker", "This process works on jobs",
                                    "Ask one whose TANDEM_ROLE is 'api' or 'all'.")
        await response(scope, receive, send)
