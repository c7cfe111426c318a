"""Plans by fewer vehicles that fly by themselves, where each costs something.

No move of a search empties a vehicle of many trips. So the trips of one type are packed on one
vehicle fewer, and whom that leaves out is inserted into others, by a search of vehicles no more
than there then are. It goes on from there once all cost less, else from where it was.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from model.problem import Problem
from model.search.beginning.packing import packed_in_fewer
from model.search.beginning.translate import left_out, make_searcher, read_routes
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.sharing import go_on_from_best, take_all
from model.solution import Route, Solution

FEWER_UNTIL = 0.85
"""Share of a search after which no fewer vehicles are tried."""

ATTEMPT = 0.08
"""Share of it that one attempt takes at most."""

MOST_LEFT_OUT, FEW_LEFT_OUT = 0.1, 10
"""Share of a type's customers whom the trips on fewer vehicles may leave out at first, and how many
of them however few there are: as many as a turn removes."""

MOST_COMPARED = 20_000
"""Trips of a type, by its vehicles, up to which they are soon packed."""


def fewer_may_pay(problem: Problem) -> bool:
    """Tell whether vehicles cost something whose trips are packed."""
    return bool(_kinds(problem))


@dataclass
class FewerFlown:
    """A search that tries to fly with fewer vehicles."""

    problem: Problem
    data: ProblemData
    whole: Searcher
    nodes: Sequence[int]  # the problem's, by the search's numbers
    share: Callable[[], float]  # of the search that is over
    settled: set[int] = field(default_factory=set)  # types of which no vehicle less will do

    def run(self, search: Callable[[], None]) -> None:
        """Search, a round at a time, with fewer vehicles as often as that costs less. In place."""
        count = self.data.type["count"]
        most = count.copy()
        go_on_from_best(self.data, self.whole)
        try:
            while self.share() < FEWER_UNTIL:
                kept = Solution(tuple(read_routes(self.data, self.whole)),
                                left_out(self.data, self.whole))
                k, routes = self._emptied(kept.routes)
                if not routes:
                    return
                self._attempt(k, kept, routes, search)
                count[:] = most
        finally:
            count[:] = most

    def _attempt(self, k: int, kept: Solution, routes: Sequence[Route],
                 search: Callable[[], None]) -> None:
        """Search from routes by fewer vehicles; go on from what was kept if that costs no less."""
        cost = float(self.whole.value.best)
        flown = _kinds(self.problem)
        used = np.bincount([route.vehicle_type for route in routes], minlength=max(flown) + 1)
        self.data.type["count"][flown] = used[flown]
        self._take(Solution(tuple(routes), ()))
        end = min(FEWER_UNTIL, self.share() + ATTEMPT)
        while float(self.whole.value.best) >= cost and self.share() < end:
            search()
        if float(self.whole.value.best) < cost:
            go_on_from_best(self.data, self.whole)
        else:
            self.settled.add(k)
            self._take(kept)

    def _take(self, plan: Solution) -> None:
        """Go on from a plan. In place."""
        made = make_searcher(self.problem, self.data, plan, np.random.SeedSequence(0))
        take_all(self.data, made, self.whole)
        self.whole.absences[:] = 0

    def _emptied(self, routes: Sequence[Route]) -> tuple[int, list[Route]]:
        """Return routes by one vehicle less, of the type of which that leaves the fewest out.

        No routes if too many would be of any.
        """
        fewest, best = math.inf, (0, list[Route]())
        for k in _kinds(self.problem):
            own = [route for route in routes if route.vehicle_type == k]
            trips = sum(len(route.trips) for route in own)
            if k in self.settled or len(own) < 2 or trips * len(own) > MOST_COMPARED:
                continue
            found = packed_in_fewer(self.problem, k, routes, self.nodes)
            left = _served(routes) - _served(found)
            if left <= max(FEW_LEFT_OUT, MOST_LEFT_OUT * _served(own)) and left < fewest:
                fewest, best = left, (k, found)
            if self.share() >= FEWER_UNTIL:
                break
        return best


def _served(routes: Sequence[Route]) -> int:
    return sum(len(trip.stops) - 2 for route in routes for trip in route.trips)


def _kinds(problem: Problem) -> list[int]:
    """Return the types whose trips are packed, and whose vehicles cost something."""
    return [k for k, kind in enumerate(problem.vehicle_types)
            if kind.flies and kind.max_trips > 1 and kind.fixed_cost > 0]
