"""Planning for a client that may leave, in a process that may end."""

import asyncio
import threading
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass
from typing import Annotated, TypeVar

import anyio
from anyio import CapacityLimiter, to_thread
from fastapi import Depends, Request

from app.schemas.errors import RequestError
from app.serving.load.admission import Admission, OverloadedError
from app.serving.load.shutdown import Shutdown
from app.serving.observe.metrics import Metrics

Result = TypeVar("Result")

MAX_IN_FLIGHT = 2**16
"""Length in bytes up to which a body has arrived with its head."""

CLIENT_CLOSED = 499
"""Status for logs, as is usual: there is nobody to send it to."""


class AbandonedError(RequestError):
    """The client closed the connection before its reply was ready."""

    status = CLIENT_CLOSED
    name = "abandoned"
    title = "The client has left"


@dataclass(frozen=True)
class WaitingTurns:
    """Where requests wait for their turn, and the threads for those whose turn it is."""

    admission: Admission
    threads: CapacityLimiter
    shutdown: Shutdown
    metrics: Metrics
    shares_port: bool  # with other processes, which may be less busy

    @property
    def are_waited_for(self) -> bool:
        """Tell whether anybody waits for a plan."""
        return self.admission.running > 0

    async def run(self, request: Request,
                  work: Callable[[Callable[[], bool]], Result]) -> Result:
        """Do `work` in a thread when its turn comes.

        Parameters
        ----------
        request
            Whose body has been read, so that all there is to hear is that its client leaves.
        work
            Gets a function that tells whether to end early, with what there is by then.

        Raises
        ------
        OverloadedError
            If slots and queue are full, or no slot came free in time.
        AbandonedError
            If the client left meanwhile.
        """
        gone = threading.Event()
        waiting = anyio.CancelScope()
        watcher = asyncio.create_task(_watch(request, gone, waiting))
        try:
            with waiting:
                result = await self._in_turn(
                    lambda: work(lambda: gone.is_set() or self.shutdown.has_begun))
                if not gone.is_set():
                    return result
        finally:
            watcher.cancel()
        raise AbandonedError("The connection was closed before the reply was ready.")

    async def _in_turn(self, work: Callable[[], Result]) -> Result:
        with self.metrics.waiting():
            await self.admission.acquire()
        try:
            with self.metrics.running():
                # A running thread can't be cancelled: it ends early by itself.
                return await to_thread.run_sync(work, limiter=self.threads)
        finally:
            self.admission.release()


@asynccontextmanager
async def watching(request: Request) -> AsyncIterator[Callable[[], bool]]:
    """Yield what tells whether a client has left whose body has been read, or the process ends."""
    gone = threading.Event()
    turns: WaitingTurns = request.app.state.turns
    watcher = asyncio.create_task(_watch(request, gone, anyio.CancelScope()))
    try:
        yield lambda: gone.is_set() or turns.shutdown.has_begun
    finally:
        watcher.cancel()


async def _watch(request: Request, gone: threading.Event, waiting: anyio.CancelScope) -> None:
    """Wait until the client leaves, then end the computation, or the wait for it. In place."""
    while (await request.receive())["type"] != "http.disconnect":
        pass
    gone.set()
    waiting.cancel()


async def take_place(request: Request) -> WaitingTurns:
    """Refuse a request while nothing was spent on it, if its turn can't come."""
    turns: WaitingTurns = request.app.state.turns
    try:
        turns.admission.refuse_if_full()
    except OverloadedError as error:
        # Whoever connects anew may reach a free process. One that still sends would see its
        # connection break in place of the reply.
        length = int(request.headers.get("content-length", MAX_IN_FLIGHT + 1))
        if turns.shares_port and length <= MAX_IN_FLIGHT:
            error.headers = {**error.headers, "Connection": "close"}
        raise
    return turns


Planning = Annotated[WaitingTurns, Depends(take_place)]
"""For endpoints that compute plans: before the body, so that it isn't read in vain."""
