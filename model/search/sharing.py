"""Routes shared between threads: a region for each, or the cheapest of all for everyone."""

import numpy as np

from model.engine.library import call
from model.problem import FloatArray, IntArray
from model.search.beginning.room import Room
from model.search.hubs import shared_out, taken_by
from model.search.route.layout import NOWHERE, OTHERS, ProblemData, are_kept
from model.search.route.state import ALL, Searcher

DIVIDED_FROM = 200
"""Number of customers from which on each thread has a region of its own."""

FEWEST_ROUTES = 3
"""Routes for each thread without which there are no regions."""

ROUNDING = 1e-9
"""Costs that differ by less are the same."""


class Crew:
    """Searches of several threads, and the routes of all together."""

    def __init__(self, data: ProblemData, place: FloatArray, whole: Searcher,
                 seeds: list[np.random.SeedSequence]) -> None:
        """Make room for a search by each seed; `place` (node, 2) in any unit.

        One search alone goes on from the whole.
        """
        self.whole = whole
        self._data = data
        self._place = place
        self._rooms = [whole] if len(seeds) == 1 else make_rooms(data, whole, seeds)
        self._parts = self._rooms
        self._divided = False
        self._rng = np.random.default_rng(seeds[0])

    def spread(self) -> list[tuple[ProblemData, Searcher]]:
        """Return searches that go on from the routes of all, a region each if there are enough.

        And their problem each, in which a region has stocks of its own.
        """
        whole, threads = self.whole, len(self._rooms)
        if threads == 1:
            return [(self._data, whole)]
        routes = int(whole.count.active)
        self._divided = (whole.count.customers >= DIVIDED_FROM
                         and routes >= FEWEST_ROUTES * threads
                         and not are_kept(self._data).any())
        if self._divided:
            owner = regions(self._place, whole, threads, self._rng)
            self._divide(owner)
            return list(zip(self._problems(owner), self._parts, strict=True))
        self._parts = self._rooms
        for part in self._parts:
            take_all(self._data, whole, part)
        return [(self._data, part) for part in self._parts]

    def _problems(self, owner: IntArray) -> list[ProblemData]:
        """Return the problem of each part, with a share of what routes leave of stocks."""
        threads = len(self._rooms)
        if len(self._data.hub) == 0:
            return [self._data] * threads
        return shared_out(self._data, taken_by(self._data, self.whole.now, len(owner)), owner,
                          threads)

    def _divide(self, owner: IntArray) -> None:
        """Give each part the routes of a region, and a share of vehicles and slots left over."""
        whole, threads = self.whole, len(self._rooms)
        missing = whole.missing[: whole.count.missing]
        beside = whole.now.where["slot"][self._data.near[missing]]
        nearest = np.take_along_axis(beside, (beside >= 0).argmax(axis=1)[:, None], axis=1)[:, 0]
        heir = np.where(nearest >= 0, owner[nearest], 0)
        spare = self._data.type["count"][:self._data.num_types] - whole.now.used
        routes = np.bincount(owner[whole.active[: whole.count.active]], minlength=threads)
        free = (len(whole.active) - routes.sum()) // threads
        self._parts = [room._replace(active=room.active[: routes[number] + free])
                       for number, room in enumerate(self._rooms)]
        for number, part in enumerate(self._parts):
            call("tandem_take_part", self._data, whole, part, owner, number,
                 missing[heir == number], (spare + number) // threads)

    def gather(self) -> None:
        """Put together what the searches found since they were spread."""
        if len(self._rooms) == 1:
            return
        whole = self.whole
        chosen = self._parts
        best = self._parts
        if not self._divided:
            chosen = [min(self._parts, key=lambda part: float(part.value.cost))]
            best = [min(self._parts, key=lambda part: float(part.value.best))]
        whole.now.route["length"] = 0
        whole.now.where["slot"] = NOWHERE
        whole.now.used[:] = 0
        whole.count.missing = filled = 0
        whole.value.cost = sum(float(part.value.cost) for part in chosen)
        for part in chosen:
            filled = call("tandem_add_routes", self._data, whole, part, filled)
        keep_best_of(whole, best)


def make_rooms(data: ProblemData, whole: Searcher,
               seeds: list[np.random.SeedSequence]) -> list[Searcher]:
    """Return room for a search by each seed, as large as the whole."""
    stops, trips, sorties = (table.shape[1] for table in (
        whole.now.stop, whole.now.trip, whole.now.sortie))
    room = Room(len(whole.active), stops, trips, sorties)
    return [Searcher.opened(data, room, whole.alone, seed) for seed in seeds]


def take_all(data: ProblemData, whole: Searcher, part: Searcher) -> None:
    """Go on from all routes as they are. In place."""
    call("tandem_take_part", data, whole, part, np.zeros(len(whole.active), np.int64), 0,
         whole.missing[: whole.count.missing],
         data.type["count"][:data.num_types] - whole.now.used)


def keep_best_of(whole: Searcher, parts: list[Searcher]) -> None:
    """Let the best routes be those of all parts together if they cost less. In place."""
    cost = sum(float(part.value.best) for part in parts)
    if cost < float(whole.value.best) - ROUNDING:
        whole.best.route["length"] = 0
        whole.count.best_missing = filled = 0
        whole.value.best = cost
        for part in parts:
            filled = call("tandem_add_best", whole, part, filled)
        whole.best.route["stamp"] = OTHERS
        whole.count.changed = ALL


def go_on_from_best(data: ProblemData, whole: Searcher) -> None:
    """Let the routes be the best ones. In place."""
    best, count = whole.best, whole.count.copy()
    slots = np.flatnonzero(best.route[: len(whole.active)]["length"] > 0)
    best.used[:] = np.bincount(best.route["type"][slots], minlength=data.num_types)
    count.active, count.missing = len(slots), count.best_missing
    active = whole.active.copy()
    active[: len(slots)] = slots
    take_all(data, whole._replace(now=best, active=active, missing=whole.best_missing.copy(),
                                   count=count), whole)


def regions(place: FloatArray, whole: Searcher, threads: int,
            rng: np.random.Generator) -> IntArray:
    """Return (slot,) the number of the thread whose region a route is in.

    Regions are sectors around the depot or stripes of about as many customers, drawn anew each
    time, so that no border stays.
    """
    slot = whole.now.where["slot"]
    served = np.flatnonzero(slot >= 0)
    slots = len(whole.active)
    customers = np.bincount(slot[served], minlength=slots)
    centre = np.stack([np.bincount(slot[served], weights=place[served, axis], minlength=slots)
                       for axis in range(2)], axis=1) / np.maximum(customers, 1)[:, None]
    angle = rng.uniform(0, 2 * np.pi)
    if rng.random() < 0.5:
        east, north = (centre - place[0]).T
        key = (np.arctan2(north, east) - angle) % (2 * np.pi)
    else:
        key = centre @ np.array([np.cos(angle), np.sin(angle)])
    order = np.argsort(key, kind="stable")
    middle = np.cumsum(customers[order]) - customers[order] / 2
    owner = np.empty(slots, np.int64)
    owner[order] = np.minimum(middle * threads // max(1, len(served)), threads - 1)
    return owner
