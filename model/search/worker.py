"""One thread's search."""

import math
import time
from contextlib import suppress
from dataclasses import dataclass, field

from model.engine.packing import Packed, packed
from model.engine.pausing import EndedError
from model.search.limits import ROUNDS, WHOLE, Cooling, SearchLimits
from model.search.linked.engine import anneal_linked, tie, write_back
from model.search.linked.layout import Linked
from model.search.route.engine import ANY, LONGEST_STRING, anneal, take_better_parts
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.temperature import Heat

SLICE = 0.003
"""Seconds between two looks at the clock."""

FIRST_SLICE = 8
"""Turns before the first look at the clock."""

LOOKED_FROM = 0.5
"""Share of a cooling from which on the better parts of plans are put together: while it is hot,
plans have none in common."""

TURNS_A_LOOK, MOST_LOOKS = 1000, 400
"""Turns between two such looks, and one for each customer more, so that they take some two percent
of the time; and how many there are at most in a search."""

LINKED_LOOKS = 8
"""How many times as many turns, where stops are linked: they take as much less time."""

MOST_STRING, FOR_STRINGS = 20.0, 2000
"""How long strings on long routes grow at most, and from how many turns for each customer on, by
the root of these. That brings far more there than as many turns by short ones, which with few turns
come further. Where drones fly they stay short."""

MOST_DROPPED, DROPPED_UNTIL = 2, 0.5
"""How many more than in the best plan may be left out so that who fits nowhere is served, and the
share of a cooling after which none may: where not all can be served, that makes routes longer."""

LOOK = 5e-6
"""Seconds for each node that one may take."""


@dataclass
class SearchThread:
    """One thread's search."""

    data: ProblemData
    searcher: Searcher
    limits: SearchLimits
    heat: Heat
    linked: Linked | None = None  # where its routes can be linked
    span: Cooling = WHOLE
    cooling: Cooling | None = None  # whose first temperature was set
    turns: int = 0
    pace: float = 0.0  # seconds a turn takes
    cooled: float = 0.0  # share of the cooling that is left out
    looked: int = 0  # turns after which better parts were last looked for
    given: tuple[Packed, Searcher] = field(init=False)  # data, packed, and search

    def __post_init__(self) -> None:
        """Pack for the first rounds."""
        self.given = packed(self.data), self.searcher

    def set_out(self, data: ProblemData, searcher: Searcher, span: Cooling) -> None:
        """Have the next round go on from a search, often that of the last one. In place."""
        if data is not self.data or searcher is not self.searcher:
            self.given = packed(data), searcher
        self.data, self.searcher, self.span = data, searcher, span

    def run(self) -> None:
        """Search for one round."""
        most, end = self.limits.round_end(self.turns, self.span)
        if self.linked is None:
            self._search(most, end)
            return
        # Where there is no time to tie routes, they are written.
        with suppress(EndedError):
            tie(*self.given, self.linked)
            self._search(most, end)
            write_back(*self.given, self.linked)

    def _search(self, most: float, end: float) -> None:
        """Search for so many turns in all, until some time at most."""
        while self.turns < most and not self.limits.should_stop():
            now = time.perf_counter()
            if now >= end:
                return
            due = self.looked + self._turns_to_look()
            self._anneal(int(min(most - self.turns, due - self.turns, self._slice(end - now))))
            if self.turns >= due:
                self._look(end)

    def expected(self) -> float:
        """Return how many turns for each customer the search has in all, as far as is known."""
        turns: float = self.limits.turns or 0
        if self.limits.turns is None and self.pace > 0.0:
            turns = (self.limits.deadline - self.limits.began) / self.pace
        return turns / max(1, int(self.searcher.count.customers))

    def _turns_to_look(self) -> int:
        """Return after how many turns better parts are looked for again."""
        customers = int(self.searcher.count.customers)
        least = (TURNS_A_LOOK + customers) * (1 if self.linked is None else LINKED_LOOKS)
        return math.ceil(max(least, self.expected() * customers / MOST_LOOKS))

    def _look(self, end: float) -> None:
        """Let the best plan take over better parts, if it is cool and there is time. In place."""
        self.looked = self.turns
        spare = end - time.perf_counter()
        if (self.span.share(self.limits.share(self.turns)) >= LOOKED_FROM
                and spare > LOOK * self.data.num_nodes and not self.limits.should_stop()):
            if self.linked is None:
                take_better_parts(*self.given)
                return
            write_back(*self.given, self.linked)
            take_better_parts(*self.given)
            tie(*self.given, self.linked)

    def _longest_string(self) -> float:
        """Return how many customers a string has at most where routes are long."""
        if self.heat.drones:
            return LONGEST_STRING
        growth = math.sqrt(self.expected() / FOR_STRINGS)
        return min(MOST_STRING, LONGEST_STRING * max(1.0, growth))

    def _slice(self, seconds: float) -> float:
        if self.limits.turns is not None and self.limits.deadline == math.inf:
            return math.ceil(self.limits.turns / (4 * ROUNDS))
        if self.pace == 0.0:
            return FIRST_SLICE
        return max(1.0, min(SLICE, seconds) / self.pace)

    def _anneal(self, turns: int) -> None:
        value, span = self.searcher.value, self.span
        hot, cold = self.heat.ends(self.expected() * (span.end - span.begin), span.heat)
        hot *= (cold / hot) ** self.cooled
        if self.limits.turns is None:
            value.temperature = hot * (cold / hot) ** span.share(self.limits.share(self.turns))
            value.cooling = 1.0
        elif span is not self.cooling:
            # By turns alone, so that the clock changes nothing.
            value.temperature = hot
            value.cooling = (cold / hot) ** (1 / (self.limits.turns * (span.end - span.begin)))
            self.cooling = span
        value.longest = self._longest_string()
        dropped = span.share(self.limits.share(self.turns)) < DROPPED_UNTIL
        self.searcher.count.to_drop = MOST_DROPPED if dropped else 0
        began, before = time.perf_counter(), int(self.searcher.count.turn)
        if self.linked is None:
            anneal(*self.given, turns, ANY)
        else:
            anneal_linked(*self.given, self.linked, turns)
        made = int(self.searcher.count.turn) - before
        self.turns += made
        self.pace = (time.perf_counter() - began) / max(1, made)
