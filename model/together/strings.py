"""Strings of customers for a truck that comes from one place and has to be at another in time.

Kept are the ways that serve the dearest customers soonest, for each number of them and each last
one (beam search): one leg after another, as far as the bounds of a `Network` let a truck get back.
"""

import heapq
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from model.judge.network import Network
from model.problem import FloatArray, IntArray

SUCCESSORS = 24
"""So many legs from a place are looked at, the shortest."""

SAME_PLACE = 3
"""So many ways with one last customer are kept."""


@dataclass(frozen=True)
class Gap:
    """Where a string is to be put."""

    begin: int  # place of the network, as all places here
    ready: int  # when a truck leaves there
    end: int
    latest: int  # when it has to be there
    rest: Sequence[int]  # (place,) how long it takes from there to the end, at least
    room: tuple[int, ...]  # most of demands, by dimension
    space: tuple[int, ...]  # most of pickups


class String(NamedTuple):
    """Customers in the order in which they are served."""

    value: float  # what leaving them out would cost
    leave: int  # when the last one is served
    places: tuple[int, ...]


class Breadth(NamedTuple):
    """How widely to look."""

    ways: int  # kept for each length
    strings: int  # returned


class _Way(NamedTuple):
    place: int
    leave: int
    rank: float  # smaller is better
    value: float
    served: int  # as bits
    room: tuple[int, ...]
    space: tuple[int, ...]
    before: "_Way | None"


class TruckNetwork:
    """A network as lists, with the legs that a truck can drive in time."""

    def __init__(self, net: Network) -> None:
        first = net.problem.num_depots
        self.net = net
        self.ride: list[list[int]] = net.ride.tolist()
        self.stay: list[int] = net.stay.tolist()
        self.opens: list[int] = net.opens.tolist()
        self.closes: list[int] = net.closes.tolist()
        self.rest: list[int] = net.rest.tolist()
        self.nodes: list[int] = net.nodes.tolist()
        self.place = {node: place for place, node in enumerate(self.nodes)}
        none = (0,) * net.problem.num_dimensions
        some = [None if node < first else net.problem.customers[node - first]
                for node in self.nodes]
        self.demand = [none if each is None else each.demand for each in some]
        self.taken = [none if each is None else each.taken_in for each in some]
        self.value = [0.0 if each is None else net.problem.cost_of_leaving_out(each)
                      for each in some]
        self.onward = self._onward()

    def _onward(self) -> list[list[int]]:
        """Return where a truck can go on to from each place, the nearest first."""
        net = self.net
        arrival = net.left_from[:, None] + net.ride
        leave = np.maximum(arrival, net.opens) + net.service
        there_is = (arrival <= net.closes) & (leave + net.rest <= net.latest_end)
        there_is[:, :net.num_depots] = False
        np.fill_diagonal(there_is, False)
        order = np.argsort(np.where(there_is, net.ride, 2**60), axis=1, kind="stable")
        return [[place for place in row[:SUCCESSORS].tolist() if there_is[origin, place]]
                for origin, row in enumerate(order)]

    def rest_to(self, end: int) -> Sequence[int]:
        """Return (place,) how long it takes from leaving each to being at one, at least."""
        if end == self.net.end:
            return self.rest
        inner = np.arange(len(self.nodes)) >= self.net.num_depots
        return _listed(self.net.rest_to(end, inner))


def _listed(values: IntArray) -> list[int]:
    found: list[int] = values.tolist()
    return found


def best_strings(streets: TruckNetwork, gap: Gap, allowed: set[int], breadth: Breadth,
                 should_stop: Callable[[], bool],
                 noise: FloatArray | None = None) -> list[String]:
    """Return some strings of allowed places for a gap, those whom leaving out costs most first.

    `noise` (place,) makes legs to some seem longer. If it is to stop, none are longer than those
    it knows.
    """
    longer = [1.0] * len(streets.nodes) if noise is None else noise.tolist()
    ways = [_Way(gap.begin, gap.ready, 0.0, 0.0, 0, gap.room, gap.space, None)]
    found: list[tuple[float, int, int, _Way]] = []
    number = 0
    while ways and not should_stop():
        for way in ways:
            back = way.leave + streets.ride[way.place][gap.end]
            if back <= gap.latest:
                number += 1
                heapq.heappush(found, (way.value, -back, -number, way))
                if len(found) > breadth.strings:
                    heapq.heappop(found)
        ways = _longer(streets, gap, ways, allowed, breadth.ways, longer)
    return [String(way.value, way.leave, _places(way))
            for *_, way in sorted(found, key=lambda each: (-each[0], -each[1], -each[2]))]


def _longer(streets: TruckNetwork, gap: Gap, ways: Sequence[_Way], allowed: set[int], width: int,
            longer: Sequence[float]) -> list[_Way]:
    """Return the best ways with one more customer."""
    by_place: dict[int, list[tuple[float, int, _Way]]] = {}
    number = 0
    for way in ways:
        ride, served, leave = streets.ride[way.place], way.served, way.leave
        for place in streets.onward[way.place]:
            if place not in allowed or served >> place & 1:
                continue
            arrival = leave + ride[place]
            if arrival > streets.closes[place]:
                continue
            gone = max(arrival, streets.opens[place]) + streets.stay[place]
            if gone + gap.rest[place] > gap.latest:
                continue
            room = tuple(map(int.__sub__, way.room, streets.demand[place]))
            space = tuple(map(int.__sub__, way.space, streets.taken[place]))
            if min(room) < 0 or min(space) < 0:
                continue
            value = way.value + streets.value[place]
            rank = way.rank + (gone - leave) * longer[place]
            number += 1
            kept = by_place.setdefault(place, [])
            heapq.heappush(kept, (value - rank * 1e-9, -number, _Way(
                place, gone, rank, value, served | 1 << place, room, space, way)))
            if len(kept) > SAME_PLACE:
                heapq.heappop(kept)
    every = [each for kept in by_place.values() for each in kept]
    return [way for *_, way in heapq.nlargest(width, every, key=lambda each: each[:2])]


def _places(way: _Way) -> tuple[int, ...]:
    places: list[int] = []
    at: _Way | None = way
    while at is not None and at.before is not None:
        places.append(at.place)
        at = at.before
    return tuple(reversed(places))
