"""Plan jobs that a process works on, and how they leave it."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from app.records.jobs.asked import JobTask
from app.records.jobs.rows import JobRow, Standing
from app.records.jobs.search import Plannable
from app.records.jobs.slices import SLICE
from app.records.jobs.store import JobStore
from app.serving.children.child import Call
from model.planner import PlanOptions
from model.problem import limits_chargers

FEWEST_TURNS = 3
"""Times that a region's seconds must be in a job's for it to be planned by regions."""


@dataclass(frozen=True)
class Returning:
    """How a job that a process took gets back to its queue.

    Parameters
    ----------
    put_back
        Has a job begun again by any process.
    put_off
        Has it wait in any process, without taking the place of one that can begin.
    share_out
        Has its regions planned by all, while some process watches over them.
    """

    put_back: Callable[[str], None]
    put_off: Callable[[str], None]
    share_out: Callable[[str], None]


@dataclass(frozen=True)
class RegionTerms:
    """Which jobs are planned by regions, and how large and long these are."""

    least_customers: int  # of such a job
    customers: int  # of a region, about
    seconds: float  # of its search

    def divides(self, asked: JobTask) -> bool:
        """Tell whether a job is planned by regions.

        Not one whose legs or places are only known by asking others, or that goes on from a plan,
        has a forecast, costs something as a whole, has orders across vehicles, shares chargers in
        time, or is to make so many iterations and no more.
        """
        task, options = asked.task, asked.options
        return (task.problem.num_customers >= self.least_customers
                and options.time_limit >= FEWEST_TURNS * self.seconds
                and options.search_iterations is None
                and not task.problem.fairness.is_stated and not task.problem.lags_across
                and not limits_chargers(task.problem)
                and task.replanning is None and task.far is None and task.waves is None
                and not (task.places is not None and task.places.found)
                and all(origin.by != "roads" for origin in task.legs))


@dataclass
class JobNews:
    """What was told of a job since somebody looked."""

    share: float | None = None  # of the job's time that is searched now; None: it isn't yet
    standing: Standing | None = None


@dataclass(frozen=True)
class RunningJob:
    """What is to be done for a job."""

    task: Plannable
    options: PlanOptions
    share: float = 1.0  # of the job's time that this takes; what remains is for regions


@dataclass
class Running:
    """A job that is planned for this process."""

    row: JobRow
    call: Call
    cancelled: threading.Event
    should_stop: Callable[[], bool]  # gives signs of life, too
    told: JobNews
    has_waited: bool  # for what it needed before it could begin
    cost: float | None  # of the best plan written down
    iterations: int

    @property
    def is_to_wait_its_turn(self) -> bool:
        """Tell whether it may begin, where only those are that can't yet."""
        return self.has_waited and self.told.share is not None

    @property
    def has_news(self) -> bool:
        """Tell whether something is to be done about what was told."""
        return self.told.standing is not None or self.is_to_wait_its_turn

    def take(self, standing: Standing) -> None:
        """Know how far it has come. In place."""
        self.iterations = standing.search_iterations
        if standing.cost is not None and (self.cost is None or standing.cost < self.cost):
            self.cost = standing.cost


def sign_of_life(store: JobStore, row: JobRow, cancelled: threading.Event,
                 stopping: threading.Event) -> Callable[[], bool]:
    """Return what tells whether a job that begins is to end, by this process or another.

    It gives signs of life, too.
    """
    looked_at = time.monotonic()

    def should_stop() -> bool:
        nonlocal looked_at
        if time.monotonic() - looked_at > SLICE:
            looked_at = time.monotonic()
            if store.keep_alive(row.id, row.attempt) is not False:
                cancelled.set()
        return cancelled.is_set() or stopping.is_set()

    return should_stop
