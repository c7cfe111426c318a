"""Slices of work on a job: what the engine repeats until the job is over."""

import threading
from collections.abc import Callable, MutableMapping
from dataclasses import dataclass
from typing import TypeVar

Work = TypeVar("Work")

SLICE = 1.0
"""Seconds after which what was found is written down."""

MAX_CRASHES = 5
"""Attempts in a row that may end without any progress before a job is given up."""

MAX_DEATHS = 10
"""Processes that may die while they plan a job, with progress or without, before it is given up."""

WITHHELD = "The plan found breaks a rule, so it is withheld."
NOT_COMPUTED = "The plan could not be computed."
POISONOUS = f"The process that planned ended unexpectedly, {MAX_CRASHES} times in a row."
DEADLY = f"The process that planned ended unexpectedly, {MAX_DEATHS} times in all."


class Stopping(BaseException):
    """This process ends, or leaves a job to others: what it works on stays open.

    No `Exception`, which DBOS would write down as the outcome of the workflow.
    """


def hold(held: MutableMapping[str, Work], job_id: str, stopping: threading.Event,
         begin: Callable[[str], Work | None]) -> Work | None:
    """Return the work on a job, begun if none is held; None: the job is over. In place.

    Raises
    ------
    Stopping
        If this process ends.
    """
    if job_id in held:
        return held[job_id]
    if stopping.is_set():
        raise Stopping
    work = begin(job_id)
    if work is not None:
        held[job_id] = work
    return work


@dataclass(frozen=True)
class Slice:
    """What a slice came to."""

    over: bool
    iterations: int = 0
    cost: float | None = None


OVER = Slice(True)
