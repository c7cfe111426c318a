"""Times of many drawn days at once, each a column; the first day is as planned. Times in ms."""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from model.problem import FULL_SPEED, Customer, SpeedProfile
from model.judge.clock import work_between

DAYS = 1000
"""How many days are drawn: a chance of a fifth is then told to within 2.5 points, mostly."""

FAR = 10.0 ** 10
"""Further from any change of speed than any day is long."""

ROUNDING = 2
"""By how much a time on the day as planned may differ from the plan's, as legs are rounded up."""

Times: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True)
class Spread:
    """Standard deviation of how long things last, by their planned length."""

    travel: float = 0.0
    service: float = 0.0


class DrawnDays:
    """Draws how long things last, each by itself, log-normally with the planned length as mean.

    What lies before `now` lasted as planned.
    """

    def __init__(self, seed: tuple[int, ...], now: int, profile: SpeedProfile | None) -> None:
        self._rng = np.random.default_rng(seed)
        self._now = now
        self._profile = profile
        self._hours = None if profile is None else _worked(profile)

    def at(self, time: int) -> Times:
        """Return a time that is the same on all days."""
        return np.full(DAYS + 1, float(time))

    def lasted(self, times: Times, begin: int, end: int, spread: float) -> Times:
        """Return when something ends that begins then, planned from `begin` to `end`."""
        known = min(max(begin, self._now), end)
        return times + (known - begin) + (end - known) * self._factors(spread)

    def driven(self, times: Times, begin: int, end: int, spread: float) -> Times:
        """Return when a way ends that begins then, planned from `begin` to `end`, by the hours."""
        if self._profile is None or self._hours is None:
            return self.lasted(times, begin, end, spread)
        known = min(max(begin, self._now), end)
        clock, done = self._hours
        work = work_between(known, end, self._profile) / FULL_SPEED * self._factors(spread)
        return np.interp(np.interp(times + (known - begin), clock, done) + work, done, clock)

    def _factors(self, spread: float) -> Times:
        factors = np.ones(DAYS + 1)
        if spread > 0:
            variance = np.log1p(spread * spread)
            normal = self._rng.standard_normal(DAYS)
            factors[1:] = np.exp(np.sqrt(variance) * normal - variance / 2)
        return factors


def _worked(profile: SpeedProfile) -> tuple[Times, Times]:
    """Return instants, and how much is driven until each, at full speed."""
    clock = np.array([profile.times[0] - FAR, *profile.times, profile.times[-1] + FAR])
    speeds = np.array(profile.factors) / FULL_SPEED
    return clock, np.concatenate([[0.0], np.cumsum(np.diff(clock) * speeds)])


def settled(times: Times, planned: int) -> Times:
    """Return times of what is planned for then, and is ready at `times`.

    What the plan holds back for a reason that isn't drawn is held back on all days.
    """
    gap = planned - times[0]
    return np.maximum(times, planned) if gap > ROUNDING else times + gap


def opened(customer: Customer, ready: Times) -> Times:
    """Return when service begins of who is ready to serve then."""
    opens: Times | int = customer.earliest
    for closes, reopens in customer.gaps:
        opens = np.where(ready > closes, reopens, opens)
    return np.maximum(ready, opens)
