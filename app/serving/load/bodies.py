"""Bodies of requests: bounded in length, in the time they take, and in what all of them hold."""

import asyncio
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Annotated

from fastapi import Depends, Request

from app.schemas.errors import BodyTooLargeError, RequestError
from app.serving.load.admission import OverloadedError
from app.serving.load.received import ReceivedBody


class SlowBodyError(RequestError, status=408, name="slow-body"):
    """The body took too long to arrive."""

    title = "The body took too long"

    def __init__(self, seconds: float) -> None:
        super().__init__(f"The body was not here after {seconds:g} s: send it faster.")
        # What may still come is no further request.
        self.headers = {"Connection": "close"}


class Bodies:
    """Reads bodies.

    Parameters
    ----------
    max_bytes
        Of one body.
    max_seconds
        From a request's head to the end of its body.
    max_buffered
        Bytes of all bodies that are held at a time.
    """

    def __init__(self, max_bytes: int, max_seconds: float, max_buffered: int) -> None:
        self.max_bytes = max_bytes
        self.max_seconds = max_seconds
        self.max_buffered = max_buffered
        self._buffered = 0

    @property
    def buffered(self) -> int:
        """Bytes held now."""
        return self._buffered

    @asynccontextmanager
    async def read(self, request: Request) -> AsyncIterator[ReceivedBody]:
        """Read a body, which counts as held until the block ends.

        Raises
        ------
        BodyTooLargeError
            If it is too long.
        SlowBodyError
            If it takes too long.
        OverloadedError
            If all bodies together would be too long.
        """
        stated = request.headers.get("content-length", "0")
        if stated.isdigit() and int(stated) > self.max_bytes:
            raise self._too_large()
        content = bytearray()
        try:
            try:
                async with asyncio.timeout(self.max_seconds):
                    async for chunk in request.stream():
                        self._hold(content, chunk)
            except TimeoutError:
                raise SlowBodyError(self.max_seconds) from None
            yield ReceivedBody(bytes(content), time.perf_counter())
        finally:
            self._buffered -= len(content)

    def _hold(self, content: bytearray, chunk: bytes) -> None:
        """Add to a body, if that is allowed. In place."""
        if len(content) + len(chunk) > self.max_bytes:
            raise self._too_large()
        if self._buffered + len(chunk) > self.max_buffered:
            raise OverloadedError("Bodies of other requests take up the memory there is: "
                                  "try again soon.")
        content += chunk
        self._buffered += len(chunk)

    def _too_large(self) -> BodyTooLargeError:
        return BodyTooLargeError(f"The body has more than {self.max_bytes} bytes: send less at a "
                                 "time.")


async def read_body(request: Request) -> AsyncIterator[ReceivedBody]:
    """Read the body, as far as it stays within the limits."""
    bodies: Bodies = request.app.state.bodies
    async with bodies.read(request) as body:
        yield body


Body = Annotated[ReceivedBody, Depends(read_body)]
