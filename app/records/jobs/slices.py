"""Slices of work on a job: what the engine repeats until the job is over."""

from dataclasses import dataclass

SLICE = 1.0
"""Seconds after which what was found is written down."""

MAX_CRASHES = 5
"""Attempts in a row that may end without any progress before a job is given up."""

WITHHELD = "The plan found breaks a rule, so it is withheld."
NOT_COMPUTED = "The plan could not be computed."
POISONOUS = f"The process that planned ended unexpectedly, {MAX_CRASHES} times in a row."


class Stopping(BaseException):
    """This process ends, or leaves a job to others: what it works on stays open.

    No `Exception`, which DBOS would write down as the outcome of the workflow.
    """


@dataclass(frozen=True)
class Slice:
    """What a slice came to."""

    over: bool
    iterations: int = 0
    cost: float | None = None


OVER = Slice(True)
