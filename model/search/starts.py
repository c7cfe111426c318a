"""Several searches that begin anew, and the best of them."""

import numpy as np

from model.search.beginning.construct import begin_again
from model.search.linked.layout import Linked
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.sharing import keep_best_of, make_rooms, take_all


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
        take_all(data, whole, self._first)

    def begin(self, anew: bool) -> None:
        """Let all searches go on from the first routes, or plan `anew`, each by itself."""
        self._rooms = self._rooms or make_rooms(self._data, self._whole, self._seeds)
        for room in self._rooms:
            take_all(self._data, self._first, room)
            if anew:
                begin_again(self._data, room, self._linked)

    def spread(self) -> list[tuple[ProblemData, Searcher]]:
        """Return the searches as they are, and their problem."""
        return [(self._data, room) for room in self._rooms]

    def gather(self) -> None:
        """Keep the best of all in the whole."""
        keep_best_of(self._whole, [min(self._rooms, key=lambda room: float(room.value.best))])
