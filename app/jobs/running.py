"""Plan jobs that a process works on, and how they leave it."""

from collections.abc import Callable
from dataclasses import dataclass

from app.jobs.rows import JobRow
from app.jobs.search import Find, Search
from app.plans.replies import Data


@dataclass(frozen=True)
class Returning:
    """How a job that a process took gets back to its queue.

    Parameters
    ----------
    put_back
        Has a job begun again by any process.
    put_off
        Has it wait in any process, without taking the place of one that can begin.
    """

    put_back: Callable[[str], None]
    put_off: Callable[[str], None]


@dataclass
class Running:
    """A search under way in this process."""

    row: JobRow
    search: Search
    validated: float  # seconds
    noted: Find | None = None
    best: Data | None = None  # reply to the best plan written down
    is_cancelled: bool = False
