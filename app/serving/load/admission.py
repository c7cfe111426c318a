"""A bounded number of plans at once, a bounded queue, and refusal of all beyond."""

import asyncio
from collections import deque

from app.schemas.errors import RequestError

RETRY_SECONDS = 1
"""When to try again after a refusal: the queue is short, so a slot is soon free."""


class OverloadedError(RequestError, status=503, name="overloaded", refusal="overload"):
    """All slots are taken and the queue is full, or the wait in it was too long."""

    title = "The service is busy"

    def __init__(self, detail: str) -> None:
        super().__init__(detail)
        self.headers = {"Retry-After": str(RETRY_SECONDS)}


class Admission:
    """Slots for work that takes a core, and a first-come queue for them, on one event loop.

    Parameters
    ----------
    slots
        How many may work at once.
    queue
        How many may wait meanwhile.
    longest_wait
        Seconds after which whoever waits is refused.
    work
        What is going on in taken slots, in words.
    """

    def __init__(self, slots: int, queue: int, longest_wait: float,
                 work: str = "plans are being computed") -> None:
        self.slots = slots
        self.queue = queue
        self.longest_wait = longest_wait
        self.work = work
        self._free = slots
        self._waiting: deque[asyncio.Future[None]] = deque()

    @property
    def running(self) -> int:
        """Slots taken."""
        return self.slots - self._free

    @property
    def waiting(self) -> int:
        """Places taken in the queue."""
        return len(self._waiting)

    def refuse_if_full(self) -> None:
        """Refuse a request before anything is spent on it.

        Raises
        ------
        OverloadedError
            If slots and queue are full.
        """
        if self._free == 0 and self.waiting >= self.queue:
            raise OverloadedError(f"{self.slots} {self.work} and {self.queue} are waiting: "
                                  "try again soon.")

    async def acquire(self) -> None:
        """Take a slot; waits for one, in order. In place.

        Whoever is cancelled meanwhile leaves the queue.

        Raises
        ------
        OverloadedError
            If slots and queue are full, or no slot came free in time.
        """
        self.refuse_if_full()
        if self._free > 0:
            self._free -= 1
            return
        turn = asyncio.get_running_loop().create_future()
        self._waiting.append(turn)
        try:
            async with asyncio.timeout(self.longest_wait):
                await turn
        except TimeoutError:
            if not self._has_come(turn):
                raise OverloadedError(f"No slot came free within {self.longest_wait:g} s: try "
                                      "again soon.") from None
        except asyncio.CancelledError:
            if self._has_come(turn):
                self.release()
            raise

    def release(self) -> None:
        """Hand a slot to the first in the queue. In place."""
        while self._waiting:
            turn = self._waiting.popleft()
            if not turn.done():
                turn.set_result(None)
                return
        self._free += 1

    def _has_come(self, turn: asyncio.Future[None]) -> bool:
        """Tell whether a turn came before its wait ended; if not, leave the queue. In place."""
        if turn.done() and not turn.cancelled():
            return True
        # Whoever hands on a slot drops turns that were given up, too.
        if turn in self._waiting:
            self._waiting.remove(turn)
        return False
