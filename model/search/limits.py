"""When a search ends, and the parts and rounds it is divided into."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

ROUNDS = 40
"""How often threads share their routes."""

SHORTEST_ROUND = 0.005
"""Seconds that threads search for at least before they share their routes."""

LONGEST_ROUND = 0.5
"""Seconds after which they share them at the latest, and the caller hears of the best."""


@dataclass(frozen=True)
class Cooling:
    """A part of the search in which it cools down once."""

    begin: float  # share of the search
    end: float
    heat: float  # of the first temperature

    def share(self, whole: float) -> float:
        """Return the share of it that is over when one of the whole search is."""
        return min(1.0, max(0.0, (whole - self.begin) / (self.end - self.begin)))


WHOLE = Cooling(0.0, 1.0, 1.0)


@dataclass
class SearchLimits:
    """When a search ends, for each thread; earlier, the more its plan takes to read."""

    began: float
    end: float  # when the plan must be read; infinite if only turns count
    turns: int | None
    should_stop: Callable[[], bool]
    reading: float = 0.0  # seconds before the end, by the best plan of the last round

    @property
    def deadline(self) -> float:
        """When the search ends; infinite if only turns count."""
        return self.end - self.reading

    def share(self, turns: int) -> float:
        """Return the share of the search that is over after `turns`, 0 to 1."""
        if self.turns is not None:
            return min(1.0, turns / max(1, self.turns))
        now = time.perf_counter()
        if now >= self.deadline:
            return 1.0
        return (now - self.began) / (self.deadline - self.began)

    def span_end(self, span: Cooling) -> tuple[float, float]:
        """Return after how many turns and when a span ends."""
        if self.turns is not None:
            return math.ceil(self.turns * span.end), self.deadline
        return math.inf, self.began + (self.deadline - self.began) * span.end

    def round_end(self, turns: int, span: Cooling) -> tuple[float, float]:
        """Return after how many turns and when the round ends that begins after `turns`."""
        most, end = self.span_end(span)
        if self.turns is not None:
            return min(most, turns + math.ceil(self.turns / ROUNDS)), end
        length = min(LONGEST_ROUND, max(SHORTEST_ROUND, (self.deadline - self.began) / ROUNDS))
        return most, min(end, time.perf_counter() + length)

    def over(self, turns: int, span: Cooling = WHOLE) -> bool:
        """Tell whether the search, or a span of it, ends after `turns`."""
        most, end = self.span_end(span)
        return (self.should_stop() or turns >= most
                or time.perf_counter() >= min(end, self.deadline))
