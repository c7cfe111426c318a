"""Legs on roads that a search estimates, and that are asked for once a plan drives them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from app.maps.remote.asking import ShouldStop
from app.maps.roads.engine import Block, Driving, RoadsAnswerError, RoadTable
from model.problem import BoolArray, FloatArray, IntArray, Problem, Travel
from model.solution import Solution
from model.travel.matrices import matrix_legs

LEGS_AT_ONCE = 40
"""Legs of one question: from each of their places to each."""

DEAR_MS, DEAR_MM = 10**9, 10**9
"""What an unknown leg is given where it isn't to be driven: eleven days and a thousand kilometres.
"""

Ask = Callable[[FloatArray, Sequence[Block], float, ShouldStop, Driving], RoadTable]
"""From places, the legs wanted, an instant, what tells to stop and how one drives, to a table."""


@dataclass(frozen=True)
class FarLegs:
    """What is asked of the legs of one profile between so many places that most are estimated.

    Parameters
    ----------
    guessed
        (place, place) what is estimated so far. Changes as legs get known.
    to_hub, from_hub
        (place,) seconds and metres of the legs to and from the first place, which are known.
    """

    ask: Ask
    lon_lat: FloatArray
    driving: Driving
    snapped: FloatArray
    walks_s: FloatArray
    guessed: BoolArray
    to_hub: tuple[FloatArray, FloatArray]
    from_hub: tuple[FloatArray, FloatArray]

    def learn(self, legs: IntArray, until: float,
              should_stop: ShouldStop) -> tuple[FloatArray, FloatArray]:
        """Return the seconds and metres of (leg, 2) legs by place, which are known then. In place.

        Raises
        ------
        RoadsError
            If there is no answer.
        """
        # The first place, of the main net, has others put there, as when all were asked for.
        places, numbers = np.unique(np.concatenate(([0], legs.ravel())), return_inverse=True)
        pairs = numbers[1:].reshape(-1, 2)
        hub = int(numbers[0])
        wanted = [Block(np.unique(np.append(part[:, 0], hub)), np.unique(part[:, 1]))
                  for part in np.array_split(pairs, -(-len(pairs) // LEGS_AT_ONCE))]
        table = self.ask(self.lon_lat[places], wanted, until, should_stop,
                         self.driving.among(places))
        if not np.array_equal(table.snapped, self.snapped[places], equal_nan=True):
            raise RoadsAnswerError("The server of roads puts places elsewhere than before.")
        start, end = pairs.T
        here, there = legs.T
        found = []
        for answered, to_hub, from_hub in zip((table.durations_s, table.distances_m), self.to_hub,
                                              self.from_hub, strict=True):
            driven = answered[start, end]
            found.append(np.where(np.isnan(driven), to_hub[here] + from_hub[there], driven))
        self.guessed[here, there] = False
        return found[0] + self.walks_s[here] + self.walks_s[there], found[1]


@dataclass(frozen=True)
class FarTravel:
    """One pair of a problem's matrices that holds estimates."""

    legs: FarLegs
    speed: float  # a multiple of that on roads
    travel: Travel  # changes as legs get known


@dataclass(frozen=True)
class Estimates:
    """What is estimated of a problem's legs.

    Parameters
    ----------
    travels
        By the index of the matrices.
    nowhere
        The node that is no place, if there is one.
    """

    travels: dict[int, FarTravel]
    nowhere: int | None = None

    def learn(self, problem: Problem, plan: Solution, until: float,
              should_stop: ShouldStop = lambda: False) -> int:
        """Ask for all legs of a plan that are estimated, and return how many these were. In place.

        Raises
        ------
        RoadsError
            If there is no answer.
        """
        count = 0
        for legs in {id(far.legs): far.legs for far in self.travels.values()}.values():
            asked = self._estimated(problem, plan, legs)
            if not len(asked):
                continue
            seconds, metres = legs.learn(asked, until, should_stop)
            count += len(asked)
            nodes = self._nodes(asked)
            for far in self.travels.values():
                if far.legs is legs:
                    durations, distances = matrix_legs(seconds / far.speed, metres)
                    far.travel.write(nodes[:, 0], nodes[:, 1], durations, distances)
        return count

    def close(self) -> None:
        """Make all legs that are still estimated too dear to drive. In place."""
        for far in self.travels.values():
            unknown = far.legs.guessed
            if self.nowhere is not None:
                row = np.insert(unknown, self.nowhere, values=False, axis=0)
                unknown = np.insert(row, self.nowhere, values=False, axis=1)
            origin, to = np.nonzero(unknown)
            far.travel.write(origin, to, DEAR_MS, DEAR_MM)

    def _estimated(self, problem: Problem, plan: Solution, legs: FarLegs) -> IntArray:
        """Return the (leg, 2) legs of a plan, by place, that are estimated."""
        pairs = {(before.node, stop.node) for route in plan.routes
                 if self._are_those_of(problem, route.vehicle_type, legs)
                 for trip in route.trips
                 for before, stop in zip(trip.stops, trip.stops[1:], strict=False)
                 if self.nowhere not in (before.node, stop.node)}
        driven = self._places(np.array(sorted(pairs), np.int64).reshape(-1, 2))
        estimated: IntArray = driven[legs.guessed[driven[:, 0], driven[:, 1]]]
        return estimated

    def _are_those_of(self, problem: Problem, vehicle_type: int, legs: FarLegs) -> bool:
        far = self.travels.get(problem.vehicle_types[vehicle_type].travel)
        return far is not None and far.legs is legs

    def _places(self, nodes: IntArray) -> IntArray:
        return nodes if self.nowhere is None else nodes - (nodes > self.nowhere)

    def _nodes(self, places: IntArray) -> IntArray:
        return places if self.nowhere is None else places + (places >= self.nowhere)
