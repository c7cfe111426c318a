"""Several searches that begin anew, and the best of them."""

from dataclasses import dataclass

import numpy as np

from model.search.beginning.construct import begin_again
from model.search.linked.layout import Linked
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.sharing import keep_best_of, make_rooms, take_all
from model.search.temperature import Heat


@dataclass(frozen=True)
class Starting:
    """How often each thread begins, before the search goes on from the best of all."""

    share: float  # of the search that these starts take
    turns: int  # for each customer that one has at least
    most: int
    anew: bool  # from a plan of its own, but for the first


BY_ONE_TYPE = Starting(0.4, 100, 5, True)

BY_TYPES = Starting(0.4, 12, 24, True)
"""Which of several types drive is settled soon, and rarely well."""

WITH_ONE_DRONE = Starting(1.0, 100, 5, False)
"""Where trips are split between truck and drone: who flies is settled while it is hot, and the way
of the truck, with which all begin, is not."""


def starting_of(data: ProblemData, heat: Heat) -> Starting | None:
    """Return how a search begins several times; None if one long search comes further."""
    if not data.strategy.scan_all:
        return None
    if heat.drones:
        return WITH_ONE_DRONE if heat.single_drones or heat.small_moves else None
    return BY_ONE_TYPE if heat.types == 1 else BY_TYPES


class Starts:
    """Searches of several threads that share nothing but where they begin."""

    def __init__(self, data: ProblemData, whole: Searcher,
                 seeds: list[np.random.SeedSequence], linked: Linked | None = None) -> None:
        """Keep the routes of the whole for searches by each seed to begin with, by linked stops if
        there are.
        """
        self._data = data
        self._whole = whole
        self._seeds = seeds
        self._linked = linked
        self._first, = make_rooms(data, whole, seeds[:1])
        self._rooms: list[Searcher] = []
        self._now = data
        take_all(data, whole, self._first)

    def begin(self, anew: bool, fewer: bool = False) -> None:
        """Let all searches go on from the first routes, or plan `anew`, each by itself.

        Then by one truck less than the best plan so far has, if `fewer`.
        """
        self._rooms = self._rooms or make_rooms(self._data, self._whole, self._seeds)
        self._now = self._with_fewer() if anew and fewer else self._data
        for room in self._rooms:
            take_all(self._data, self._first, room)
            if anew:
                begin_again(self._now, room, self._linked)

    def _with_fewer(self) -> ProblemData:
        """Return the problem with a truck less than the best plan has, if all trucks are alike."""
        driven = np.flatnonzero(~self._data.type["flies"][:self._data.num_types].astype(bool))
        used = self._whole.best_used[driven]
        if len(driven) != 1 or used[0] < 2:
            return self._data
        types = self._data.type.copy()
        types["count"][driven] = used - 1
        return self._data._replace(type=types)

    def spread(self) -> list[tuple[ProblemData, Searcher]]:
        """Return the searches as they are, and their problem."""
        return [(self._now, room) for room in self._rooms]

    def gather(self) -> None:
        """Keep the best of all in the whole."""
        best = min(self._rooms, key=lambda room: float(room.value.best))
        keep_best_of(self._data, self._whole, [best])
