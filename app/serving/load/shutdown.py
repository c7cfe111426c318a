"""A stop that loses nothing: plans end early, new requests are sent elsewhere."""

import asyncio
import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.schemas.errors import problem_response

SIGNALS = (signal.SIGTERM, signal.SIGINT)

STILL_ANSWERED = ("/health/", "/metrics")
"""Paths that tell operators what is going on, to the end."""

RETRY_SECONDS = 1


class Shutdown:
    """Whether this process is about to end."""

    def __init__(self) -> None:
        self.has_begun = False

    @contextmanager
    def listening(self, drain_seconds: float) -> Iterator[None]:
        """Notice signals before the server does, until the block ends.

        On SIGTERM the server hears of it `drain_seconds` later, so that the port stays open while
        load balancers notice; on a second one, or on SIGINT, at once. In place.
        """
        # Python allows handlers in the main thread alone; elsewhere nobody stops us by signals.
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        loop = asyncio.get_running_loop()
        servers = {number: signal.getsignal(number) for number in SIGNALS}

        def hear(number: int, frame: FrameType | None) -> None:
            is_first, self.has_begun = not self.has_begun, True
            stop = servers[signal.Signals(number)]
            if not callable(stop):
                return
            if is_first and number == signal.SIGTERM:
                loop.call_soon_threadsafe(loop.call_later, drain_seconds, stop, number, None)
            else:
                stop(number, frame)

        heard = [number for number in SIGNALS if callable(servers[number])]
        for number in heard:
            signal.signal(number, hear)
        _end_with_parent()
        try:
            yield
        finally:
            for number in heard:
                signal.signal(number, servers[number])


def _end_with_parent() -> None:
    """Have one of several processes end when the one that started it was killed.

    Else it would keep the port, and nobody could end it but by its process id.
    """
    parent = multiprocessing.parent_process()
    if parent is None:
        return

    def follow() -> None:
        parent.join()
        os.kill(os.getpid(), signal.SIGTERM)

    threading.Thread(target=follow, name="parent", daemon=True).start()


class ShutdownGate:
    """Middleware that sends requests elsewhere once the process is about to end."""

    def __init__(self, app: ASGIApp, shutdown: Shutdown) -> None:
        self._app = app
        self._shutdown = shutdown

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        async def send_last(message: Message) -> None:
            if message["type"] == "http.response.start" and self._shutdown.has_begun:
                MutableHeaders(scope=message)["Connection"] = "close"
            await send(message)

        if self._shutdown.has_begun and not scope["path"].startswith(STILL_ANSWERED):
            refusal = problem_response(
                503, "stopping", "The service is stopping", "This process is about to end: try "
                "again.", headers={"Retry-After": str(RETRY_SECONDS)})
            await refusal(scope, receive, send_last)
            return
        await self._app(scope, receive, send_last)
