"""Routes shared between threads: a region for each, or the cheapest of all for everyone."""

import numpy as np

from model.engine.library import call
from model.problem import FloatArray, IntArray
from model.search.route.layout import ProblemData, are_kept
from model.search.route.state import Searcher

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
            return list(zip(self._problems(owner), self._rooms, strict=True))
        for part in self._rooms:
            take_all(self._data, whole, part)
        return [(self._data, part) for part in self._rooms]

    def _problems(self, owner: IntArray) -> list[ProblemData]:
        """Return the problem of each part, with a share of what routes leave of stocks."""
        threads = len(self._rooms)
        if len(self._data.hub) == 0:
            return [self._data] * threads
        return shared_out(self._data, self.whole, owner, threads)

    def _divide(self, owner: IntArray) -> None:
        """Give each part the routes of a region, and a share of vehicles and slots left over."""
        whole, threads = self.whole, len(self._rooms)
        missing = whole.missing[: whole.count.missing]
        beside = slots_of(whole)[self._data.near[missing]]
        nearest = np.take_along_axis(beside, (beside >= 0).argmax(axis=1)[:, None], axis=1)[:, 0]
        heir = np.where(nearest >= 0, owner[nearest], 0)
        count = self._data.type["count"][:self._data.num_types]
        routes = np.bincount(owner[whole.active[: whole.count.active]], minlength=threads)
        free = (len(whole.active) - routes.sum()) // threads
        for number, part in enumerate(self._rooms):
            call("tandem_take_part", self._data, whole, part, routes[number] + free, owner, number,
                 missing[heir == number], count - (count - whole.used + number) // threads)

    def gather(self) -> None:
        """Put together what the searches found since they were spread."""
        if len(self._rooms) == 1:
            return
        chosen = best = self._rooms
        if not self._divided:
            chosen = [min(self._rooms, key=lambda part: float(part.value.cost))]
            best = [min(self._rooms, key=lambda part: float(part.value.best))]
        self.whole.value.cost = sum(float(part.value.cost) for part in chosen)
        for number, part in enumerate(chosen):
            call("tandem_add_routes", self._data, self.whole, part, False, number == 0)
        keep_best_of(self._data, self.whole, best)


def make_rooms(data: ProblemData, whole: Searcher,
               seeds: list[np.random.SeedSequence]) -> list[Searcher]:
    """Return room for a search by each seed, as large as the whole."""
    rooms = [Searcher(data, whole.room, seed) for seed in seeds]
    for room in rooms:
        room.alone[:] = whole.alone
    return rooms


def take_all(data: ProblemData, whole: Searcher, part: Searcher) -> None:
    """Go on from all routes as they are. In place."""
    call("tandem_take_all", data, whole, part)


def keep_best_of(data: ProblemData, whole: Searcher, parts: list[Searcher]) -> None:
    """Let the best routes be those of all parts together if they cost less. In place."""
    cost = sum(float(part.value.best) for part in parts)
    if cost < float(whole.value.best) - ROUNDING:
        whole.value.best = cost
        for number, part in enumerate(parts):
            call("tandem_add_routes", data, whole, part, True, number == 0)


def go_on_from_best(data: ProblemData, whole: Searcher) -> None:
    """Let the routes be the best ones. In place."""
    call("tandem_take_best", data, whole)


def slots_of(searcher: Searcher) -> IntArray:
    """Return (node,) the slot of each node's route; below zero where there is none."""
    slots = np.empty(len(searcher.absences), np.int64)
    call("tandem_write_slots", searcher, slots)
    return slots


def regions(place: FloatArray, whole: Searcher, threads: int,
            rng: np.random.Generator) -> IntArray:
    """Return (slot,) the number of the thread whose region a route is in.

    Regions are sectors around the depot or stripes of about as many customers, drawn anew each
    time, so that no border stays.
    """
    slot = slots_of(whole)
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


def shared_out(data: ProblemData, searcher: Searcher, owner: IntArray,
               number: int) -> list[ProblemData]:
    """Return the problem for each of some parts of a plan: what it takes, and a share of the rest.

    `owner` (slot,) the number of the part that a route belongs to.
    """
    taken = np.zeros((len(owner), len(data.hub)), np.int64)
    call("tandem_write_taken", data, searcher, taken)
    by_part = np.zeros((number, len(data.hub)), np.int64)
    np.add.at(by_part, owner, taken)
    left = data.hub["batteries"] - by_part.sum(axis=0)
    found = []
    for part, needed in enumerate(by_part):
        hub = data.hub.copy()
        hub["batteries"] = needed + (left + part) // number
        found.append(data._replace(hub=hub))
    return found
