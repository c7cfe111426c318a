"""What ends the work on a request before its search: its client, this process's end, its time."""

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from app.schemas.errors import InputError, InvalidRequestError, RequestError

SHARE = 0.9
"""Most of the time limit that may be spent before the search, so that some is left for it."""

PATIENCE = 0.05
"""Seconds in which work is done even if nobody waits for it: what is nearly ready is answered."""

LEAST_WORK = 0.1
"""Seconds of work that are always allowed, as replies may be so late."""

LEAST_TIME = 0.5
"""Seconds of work on the way that are always allowed: beside neighbours everything takes longer,
and what is small is answered late, not refused."""

ROOM = 0.5
"""Seconds that a time limit which is advised leaves for the search, beside its share."""

PATIENCE_WITH_OTHERS = 20.0
"""Seconds on top of a time limit that nobody stated, in which roads and geocoders may answer."""


class StoppedError(RequestError, status=503, name="stopping"):
    """This process ends, or nobody waits for the reply any more, before there is any plan."""

    title = "The service is stopping"


@dataclass(frozen=True)
class Preparing:
    """The work on a request before its search, in parts between which it may end.

    What it takes is counted in seconds of the processor of the thread that made this, so that no
    neighbour on the machine has it refused; waiting for others alone is timed by the clock.

    Parameters
    ----------
    should_stop
        Whether to end.
    seconds
        How long it may take, with the search; infinite: as long as it will.
    limit
        Where `seconds` come from, in words.
    work, advice
        What takes the time, and what would take less, in words.
    most
        How many seconds a request may ask for instead; 0: it can't.
    most_setting
        Where `most` comes from.
    began
        On `time.thread_time`.
    least_time
        Seconds that are allowed in any case; more than work that is estimated may take.
    patience
        Seconds that roads and geocoders may take on top of it all.
    """

    should_stop: Callable[[], bool] = lambda: False
    seconds: float = float("inf")
    limit: str = ""
    work: str = "Legs and flights"
    advice: str = ("send fewer customers, fewer ways to travel, or no-fly areas with fewer "
                   "corners")
    most: float = 0.0
    most_setting: str = ""
    began: float = field(default_factory=time.thread_time)
    least_time: float = LEAST_TIME
    patience: float = 0.0
    _waits: list[list[float]] = field(default_factory=list)  # from when, and until when

    def pause(self) -> None:
        """Go on, if neither the client nor the time is gone.

        Raises
        ------
        StoppedError
            If the work is to end.
        InvalidRequestError
            If it takes too long.
        """
        spent = self._spent
        if spent > PATIENCE and self.should_stop():
            raise StoppedError("The work was stopped before there was a plan: try again.")
        if spent > self._latest:
            raise self._refusal(f"took {spent:.1f} s so far", 2 * spent, self._latest)

    def expect(self, seconds: float) -> None:
        """Go on, if there is time enough for what comes next; raises as `pause` does."""
        self.pause()
        if seconds > self._most_work:
            raise self._refusal(f"take about {seconds:.1f} s", seconds, self._most_work)
        total = self._spent + seconds
        if total > self._latest:
            raise self._refusal(f"take about {total:.1f} s", total, self._latest)

    def allows(self, seconds: float) -> bool:
        """Tell whether there is time enough for what may come next."""
        return self._spent + seconds <= self._most_work + self.waited

    def beside_search(self, seconds: float, search: str) -> "Preparing":
        """Return the same work where it takes nothing off the search's time.

        Parameters
        ----------
        seconds
            How long it may take at least.
        search
            What follows, in words.
        """
        return replace(self, seconds=max(seconds, self.seconds), least_time=seconds, most=0.0,
                       limit=f"the {seconds:g} s that may pass before {search}"
                       if seconds > self.seconds else self.limit)

    @contextmanager
    def waiting(self) -> Iterator[float]:
        """Wait for what others tell; give until when at most, on `time.perf_counter`. In place."""
        now = time.perf_counter()
        latest = now + self._latest - self._spent + self.patience - self.waited
        self._waits.append([now, math.inf])
        try:
            yield latest
        finally:
            self._waits[-1][1] = time.perf_counter()

    @property
    def waited(self) -> float:
        """Seconds that others took so far, on top of the time for all."""
        return min(self._away, self.patience)

    @property
    def _away(self) -> float:
        """Seconds by the clock in which others were waited for so far."""
        now = time.perf_counter()
        return sum(min(end, now) - begin for begin, end in self._waits)

    @property
    def _spent(self) -> float:
        return time.thread_time() - self.began + self._away

    @property
    def _most_work(self) -> float:
        return max(LEAST_WORK, SHARE * self.seconds)

    @property
    def _latest(self) -> float:
        return max(self.least_time, SHARE * self.seconds) + self.waited

    def _refusal(self, found: str, needed: float, allowed: float) -> InvalidRequestError:
        advice, path = f"allow more time, or {self.advice}", "$"
        if self.most:
            advice, path = self._other_ways(needed), "$.options.time_limit"
        message = (f"{self.work} {found} on one core, and {allowed:.1f} s may be spent "
                   f"on them by {self.limit}: {advice}.")
        return InvalidRequestError([InputError(code="TOO_MUCH_WORK", path=path, message=message)])

    def _other_ways(self, needed: float) -> str:
        """Return what to ask for instead, where the work takes so many seconds."""
        enough = math.ceil(needed / SHARE + ROOM)
        job = "submit a job (POST /jobs), whose time begins when they are done"
        if enough > self.most:
            return (f"{job}, or {self.advice}; no more than {self.most:g} s can be asked for here "
                    f"({self.most_setting})")
        return (f"state options.time_limit of {enough} s or more, up to {self.most:g} s "
                f"({self.most_setting}), {job}, or {self.advice}")


def patience(most: float) -> float:
    """Return the seconds that others may take where no time limit is stated, and at most so many.
    """
    return min(PATIENCE_WITH_OTHERS, most)


UNHURRIED = Preparing()
