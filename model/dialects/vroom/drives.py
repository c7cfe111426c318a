"""How vehicles drive: VROOM's legs, costs and limits as the planner's matrices.

The planner's "distance" is what VROOM charges for: travel time, metres, or the cost itself. Where
metres are limited that cost nothing, or not alone, they count by another matrix.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from model.dialects.vroom.actions import Actions
from model.dialects.vroom.errors import RefusedError
from model.dialects.vroom.kinds import VehicleKind
from model.dialects.vroom.nodes import LONGEST, PARTS, Nodes
from model.dialects.vroom.places import ProfileLegs, Sites
from model.dialects.vroom.request import Request
from model.dialects.vroom.timing import COST_SCALE, NO_WAY
from model.dialects.vroom.windows import TIME_SCALE
from model.dialects.vroom.work import UNHURRIED, Pause
from model.problem import MAX_QUANTITY, IntArray, Travel

Key = tuple[object, ...]
"""Tells a pair of matrices from others; the first says what their distances measure."""


@dataclass(frozen=True)
class Drive:
    """How the vehicles of a kind drive, in the planner's terms."""

    travel: int  # index into `Drives.travels`
    cost_per_km: float
    max_trip_distance: int | None = None
    max_travel_duration: int | None = None
    limited: int | None = None  # index into `Drives.travels`, of metres
    max_distance: int | None = None


class Drives:
    """Collects the matrices for a request; equal ones are built once."""

    def __init__(self, request: Request, places: Sites, kinds: tuple[VehicleKind, ...],
                 nodes: Nodes, is_timed: bool, pause: Pause = UNHURRIED.pause) -> None:
        """Begin with no matrices.

        Parameters
        ----------
        is_timed
            Whether anything has a time window.
        pause
            Called before each pair of matrices.
        """
        self.travels: list[Travel] = []
        self._places = places
        self._nodes = nodes
        self._is_timed = is_timed
        self.pause = pause
        self._index: dict[Key, int] = {}
        self._longest: dict[int, int] = {}  # by the matrix, which the places hold
        self.actions = Actions(request, places, kinds, nodes, is_timed)

    def count(self, kinds: Iterable[VehicleKind]) -> int:
        """Return how many pairs of matrices the vehicles of some kinds need; builds none.

        Raises
        ------
        RefusedError
            If they are limited in what isn't known.
        """
        keys = set[Key]()
        for kind in kinds:
            basis, metres = self._tariff(kind)[0], self._limits(kind).get("distances")
            keys |= {self._key(kind, each) for each in
                     (basis, *(["distances"] if metres is not None else []))}
        return len(keys)

    def drive(self, kind: VehicleKind) -> Drive:
        """Return how the vehicles of a kind drive; raises as `count` does."""
        (basis, rate), limits = self._tariff(kind), self._limits(kind)
        drive = Drive(self._travel(kind, basis), rate)
        if basis in limits:
            drive = replace(drive, max_trip_distance=limits.pop(basis) * PARTS)
        if "durations" in limits:
            once = kind.rates.time * PARTS // TIME_SCALE if self._is_timed else PARTS
            drive = replace(drive, max_travel_duration=min(MAX_QUANTITY,
                                                                limits["durations"] * once))
        if "distances" in limits:
            drive = replace(drive, limited=self._travel(kind, "distances"),
                            max_distance=limits["distances"] * PARTS)
        return drive

    def _tariff(self, kind: VehicleKind) -> tuple[str, float]:
        """Return what a vehicle's cost is proportional to, and the cost of 1,000 of that.

        It is "durations" or "distances" of the matrix, or "costs" for all together.
        """
        rates = kind.rates
        if self._legs(kind).costs is None and not rates.task_cost:
            if not rates.distance_cost:
                return "durations", rates.time_cost * 1000 / COST_SCALE
            if not rates.time_cost:
                return "distances", rates.distance_cost * 1000 / COST_SCALE
        return "costs", PARTS

    def _limits(self, kind: VehicleKind) -> dict[str, int]:
        """Return the most seconds of the matrix and metres of a route, where it can exceed them."""
        stated, legs, limits = kind.stated, self._legs(kind), dict[str, int]()
        if stated.max_travel_time is not None:
            seconds = min(LONGEST, stated.max_travel_time * TIME_SCALE // kind.rates.time)
            if self._longest_route(legs.durations) > seconds:
                limits["durations"] = seconds
        if stated.max_distance is not None:
            if not legs.distances_known:
                raise RefusedError(f"max_distance of vehicle {stated.id} needs "
                                   f"matrices.{stated.profile}.distances, or coordinates of all "
                                   "places: add them.")
            if self._longest_route(legs.distances) > stated.max_distance:
                limits["distances"] = min(LONGEST, stated.max_distance)
        return limits

    def _longest_route(self, matrix: IntArray) -> int:
        """Return what no route exceeds: the longest leg to each job and to an end."""
        if id(matrix) not in self._longest:
            spread, depots = self._nodes.spread(matrix), len(self._nodes.depots)
            to_jobs = spread[:, depots:].max(axis=0)
            self._longest[id(matrix)] = int(to_jobs.sum() + spread[:, :depots].max())
        return self._longest[id(matrix)]

    def _legs(self, kind: VehicleKind) -> ProfileLegs:
        return self._places.legs[kind.stated.profile]

    def _key(self, kind: VehicleKind, basis: str) -> Key:
        """Return what tells matrices that measure `basis` from others."""
        rates = kind.rates
        key: Key = (basis, kind.stated.profile)
        if basis == "costs":
            key = (*key, kind.type, rates.time_cost, rates.distance_cost, rates.task_cost)
        if self._is_timed:
            key = (*key, rates.time, kind.type if self.actions.delays(kind) else "")
        return key

    def _travel(self, kind: VehicleKind, basis: str) -> int:
        """Return the index of matrices that measure `basis`."""
        key = self._key(kind, basis)
        if key not in self._index:
            self.pause()
            self._index[key] = len(self.travels)
            self.travels.append(Travel(self._durations(kind), self._measure(kind, basis)))
        return self._index[key]

    def _durations(self, kind: VehicleKind) -> IntArray:
        """Return milliseconds of legs; without windows, thousandths of the matrix's seconds.

        No vehicle works as long as a leg that isn't there takes.
        """
        seconds = self._nodes.spread(self._legs(kind).durations)
        travel = seconds * (kind.rates.time * PARTS // TIME_SCALE if self._is_timed else PARTS)
        if self._is_timed and self.actions.delays(kind):
            travel += self.actions.beside_travel(kind) * PARTS
        return np.where(seconds >= NO_WAY, MAX_QUANTITY, np.minimum(travel, MAX_QUANTITY))

    def _measure(self, kind: VehicleKind, basis: str) -> IntArray:
        legs, rates = self._legs(kind), kind.rates
        if basis != "costs":
            measured = legs.durations if basis == "durations" else legs.distances
            return self._nodes.spread(measured) * PARTS
        base = legs.durations if legs.costs is None else legs.costs
        # Floats, since products of unreasonable entries would overflow.
        cost = (float(rates.time_cost) * self._nodes.spread(base)
                + float(rates.distance_cost) * self._nodes.spread(legs.distances)
                + float(rates.task_cost * TIME_SCALE) * self.actions.spent(kind))
        whole: IntArray = np.rint(np.minimum(cost * (PARTS / COST_SCALE), MAX_QUANTITY)).astype(
            np.int64)
        return whole
