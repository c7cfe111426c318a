"""Turns of requests whose files are read: their own, so that no plan under way delays them."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, TypeVar

from anyio import CapacityLimiter, to_thread
from fastapi import Depends, Request

from app.serving.load.admission import Admission

Result = TypeVar("Result")

SLOTS, QUEUE, LONGEST_WAIT = 2, 8, 10.0
"""Files read at once, files that may wait meanwhile, and for how many seconds."""


@dataclass(frozen=True)
class Readings:
    """Where files wait for their turn, and the threads for those whose turn it is."""

    admission: Admission
    threads: CapacityLimiter

    async def run(self, work: Callable[[], Result]) -> Result:
        """Do `work` in a thread when its turn comes.

        Raises
        ------
        OverloadedError
            If slots and queue are full, or no slot came free in time.
        """
        await self.admission.acquire()
        try:
            return await to_thread.run_sync(work, limiter=self.threads)
        finally:
            self.admission.release()


def new_readings() -> Readings:
    """Return turns of one application."""
    return Readings(Admission(SLOTS, QUEUE, LONGEST_WAIT, "files are being read"),
                    CapacityLimiter(SLOTS))


async def take_place(request: Request) -> Readings:
    """Refuse a request before its body is read, if its turn can't come."""
    readings: Readings = request.app.state.readings
    readings.admission.refuse_if_full()
    return readings


Reading = Annotated[Readings, Depends(take_place)]
"""For endpoints that read files: before the body, so that it isn't read in vain."""
