"""How vehicles drive: VROOM's legs, costs and limits as the planner's matrices.

The planner's costs by distance and by working time, and its limits of both, are all there is to
say what VROOM's vehicles cost and how far they go. So the planner's "distance" is what VROOM
charges for: travel time, metres, or the cost itself. Where nothing has a time window, the planner's
time is free to stand for another quantity that is limited.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from model.dialects.vroom.actions import Actions
from model.dialects.vroom.errors import RefusedError
from model.dialects.vroom.kinds import VehicleKind
from model.dialects.vroom.nodes import LONGEST, PARTS, Nodes, at_most_longest
from model.dialects.vroom.places import ProfileLegs, Sites
from model.dialects.vroom.request import Request
from model.dialects.vroom.timing import COST_SCALE, NO_WAY
from model.dialects.vroom.windows import TIME_SCALE
from model.dialects.vroom.work import UNHURRIED, Pause
from model.problem import MAX_QUANTITY, IntArray, Travel

Key = tuple[object, ...]
"""Tells a pair of matrices from others."""

WHOLE, NARROW_WHOLE = 10**11, 10**9
"""Limits of which legs use up shares; twice the second fits 32 bits."""


@dataclass(frozen=True)
class Drive:
    """How the vehicles of a kind drive, in the planner's terms."""

    travel: int  # index into `Drives.travels`
    cost_per_km: float
    cost_per_hour: float = 0.0
    max_distance: int | None = None
    max_working: int | None = None


class Drives:
    """Collects the matrices for a request; equal ones are built once."""

    def __init__(self, request: Request, places: Sites, kinds: tuple[VehicleKind, ...],
                 nodes: Nodes, is_timed: bool, relaxed: bool,
                 pause: Pause = UNHURRIED.pause) -> None:
        """Begin with no matrices.

        Parameters
        ----------
        is_timed
            Whether anything has a time window.
        relaxed
            Where limits and costs can't both be planned, plan the costs; else the limits.
        pause
            Called before each pair of matrices.
        """
        self.travels: list[Travel] = []
        self._request = request
        self._places = places
        self._nodes = nodes
        self._is_timed = is_timed
        self.relaxed = relaxed
        self.pause = pause
        self._index: dict[Key, int] = {}
        self._limits_kept: dict[Key, Drive] = {}
        self._longest: dict[int, int] = {}  # by the matrix, which the places hold
        self._ratios: dict[str, Fraction | None] = {}  # by profile
        self.actions = Actions(request, places, kinds, nodes, is_timed, relaxed)
        self.is_compromise = self.actions.is_compromise  # whether there was such a case

    def count(self, kinds: Iterable[VehicleKind]) -> int:
        """Return how many pairs of matrices the vehicles of some kinds need; builds none.

        Raises
        ------
        RefusedError
            If they are limited in what isn't known.
        """
        return len({self._choose(kind)[0] for kind in kinds})

    def drive(self, kind: VehicleKind) -> Drive:
        """Return how the vehicles of a kind drive; raises as `count` does."""
        return self._choose(kind)[1]()

    def _choose(self, kind: VehicleKind) -> tuple[Key, Callable[[], Drive]]:
        """Return what tells the matrices of a kind from others, and what builds them."""
        legs = self._places.legs[kind.stated.profile]
        tariff = Tariff.of(kind, legs, self._ratio(kind) if _is_mixed(kind) else None)
        seconds, metres = self._limits(kind, legs, tariff)
        if tariff.ratio is not None and metres is not None:
            as_seconds = min(LONGEST, int(metres / tariff.ratio))
            seconds, metres = min(as_seconds, as_seconds if seconds is None else seconds), None
        if metres is None and (seconds is None or tariff.basis == "durations"):
            return self._by(kind, tariff.basis, tariff.rate, seconds)
        if seconds is None and tariff.basis == "distances":
            return self._by(kind, "distances", tariff.rate, metres)
        if not self._is_timed and (tariff.is_metric or seconds is None or metres is None):
            return self._untimed(kind, tariff, seconds, metres)
        self.is_compromise = True
        if self.relaxed:
            return self._by(kind, tariff.basis, tariff.rate, None)
        key = ("limited", *self._key(kind, "costs", "durations"), tariff, seconds, metres)
        return key, lambda: self._limited(kind, tariff, seconds, metres, key)

    def _limits(self, kind: VehicleKind, legs: ProfileLegs,
                tariff: "Tariff") -> tuple[int | None, int | None]:
        """Return the most seconds of the matrix and metres of a route, None if it can't exceed."""
        stated = kind.stated
        seconds, metres = None, None
        if stated.max_travel_time is not None:
            seconds = min(LONGEST, stated.max_travel_time * TIME_SCALE // kind.rates.time)
            if self._longest_route(legs.durations) <= seconds:
                seconds = None
        if stated.max_distance is not None:
            if not legs.distances_known:
                raise RefusedError(f"max_distance of vehicle {stated.id} needs "
                                   f"matrices.{stated.profile}.distances, or coordinates of all "
                                   "places: add them.")
            metres = min(LONGEST, stated.max_distance)
            if self._longest_route(legs.distances) <= metres:
                metres = None
        return seconds, metres

    def _ratio(self, kind: VehicleKind) -> Fraction | None:
        """Return metres by second if that is the same for all legs of a kind's profile."""
        profile = kind.stated.profile
        if profile not in self._ratios:
            self._ratios[profile] = _ratio(self._places.legs[profile])
        return self._ratios[profile]

    def _longest_route(self, matrix: IntArray) -> int:
        """Return what no route exceeds: the longest leg to each job and to an end."""
        if id(matrix) not in self._longest:
            spread, depots = self._nodes.spread(matrix), len(self._nodes.depots)
            to_jobs = spread[:, depots:].max(axis=0)
            self._longest[id(matrix)] = int(to_jobs.sum() + spread[:, :depots].max())
        return self._longest[id(matrix)]

    def _by(self, kind: VehicleKind, basis: str, rate: float,
            limit: int | None) -> tuple[Key, Callable[[], Drive]]:
        """Choose a drive that costs `rate` per 1,000 of what the basis measures."""
        return self._key(kind, basis, "durations"), lambda: Drive(
            self._travel(kind, basis, "durations"), rate,
            max_distance=None if limit is None else limit * PARTS)

    def _untimed(self, kind: VehicleKind, tariff: "Tariff", seconds: int | None,
                 metres: int | None) -> tuple[Key, Callable[[], Drive]]:
        """Choose a drive whose working time stands for one of the limited quantities."""
        rates = kind.rates
        if tariff.is_metric and metres is not None:
            return self._key(kind, "distances", "durations"), lambda: Drive(
                self._travel(kind, "distances", "durations"),
                rates.distance_cost * 1000 / COST_SCALE,
                rates.time_cost * 3600 / COST_SCALE,
                metres * PARTS, None if seconds is None else seconds * PARTS)
        clock, limit = ("durations", seconds) if seconds is not None else ("distances", metres)
        return self._key(kind, tariff.basis, clock), lambda: Drive(
            self._travel(kind, tariff.basis, clock), tariff.rate,
            max_working=None if limit is None else limit * PARTS)

    def _limited(self, kind: VehicleKind, tariff: "Tariff", seconds: int | None,
                 metres: int | None, key: Key) -> Drive:
        """Return a drive that keeps its limits and costs about what it should."""
        if key in self._limits_kept:
            return self._limits_kept[key]
        cost = float(self._measure(kind, tariff.basis).sum()) * tariff.rate
        if seconds is not None and metres is not None:
            limited, limit = self._share(kind, seconds, metres)
        else:
            limited = self._measure(kind, "distances" if seconds is None else "durations")
            limit = (metres or seconds or 0) * PARTS
        self.travels.append(Travel(self._durations(kind, "durations"), limited))
        total = float(limited.sum())
        drive = Drive(len(self.travels) - 1, cost / total if total else 0.0, max_distance=limit)
        self._limits_kept[key] = drive
        return drive

    def _share(self, kind: VehicleKind, seconds: int, metres: int) -> tuple[IntArray, int]:
        """Return which share a leg uses up of the limit of which it uses up more, and the whole."""
        legs = self._places.legs[kind.stated.profile]
        shares = np.maximum(self._nodes.spread(legs.durations) / max(seconds, 0.5),
                            self._nodes.spread(legs.distances) / max(metres, 0.5))
        # What is lost by rounding down is less than the least excess, unless limits are huge.
        finest = max(seconds, metres) * (len(self._nodes.jobs) + 1)
        whole = NARROW_WHOLE if finest < NARROW_WHOLE and shares.max() <= 2.0 else WHOLE
        rounded = np.floor(shares * whole) if finest < whole else np.ceil(shares * whole)
        return np.minimum(rounded, MAX_QUANTITY).astype(np.int64), whole

    def _key(self, kind: VehicleKind, basis: str, clock: str) -> Key:
        """Return what tells matrices that measure `basis`, with times by `clock`, from others."""
        rates = kind.rates
        key: Key = (kind.stated.profile, basis, clock)
        if basis == "costs":
            key = (*key, kind.type, rates.time_cost, rates.distance_cost, rates.task_cost)
        if self._is_timed:
            key = (*key, rates.time, kind.type if self.actions.delays(kind) else "")
        return key

    def _travel(self, kind: VehicleKind, basis: str, clock: str) -> int:
        """Return the index of matrices that measure `basis`, with times by `clock`."""
        key = self._key(kind, basis, clock)
        if key not in self._index:
            self.pause()
            self._index[key] = len(self.travels)
            self.travels.append(Travel(self._durations(kind, clock), self._measure(kind, basis)))
        return self._index[key]

    def _durations(self, kind: VehicleKind, clock: str) -> IntArray:
        """Return milliseconds of legs; without windows, thousandths of what the clock measures.

        No vehicle works as long as a leg that isn't there takes.
        """
        legs = self._places.legs[kind.stated.profile]
        seconds = self._nodes.spread(legs.durations)
        if not self._is_timed:
            travel = PARTS * (seconds if clock == "durations"
                              else self._nodes.spread(legs.distances))
        else:
            travel = seconds * (kind.rates.time * PARTS // TIME_SCALE)
            if self.actions.delays(kind):
                travel += self.actions.beside_travel(kind) * PARTS
        return np.where(seconds >= NO_WAY, MAX_QUANTITY, np.minimum(travel, MAX_QUANTITY))

    def _measure(self, kind: VehicleKind, basis: str) -> IntArray:
        legs, rates = self._places.legs[kind.stated.profile], kind.rates
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


@dataclass(frozen=True)
class Tariff:
    """What a vehicle's cost is proportional to."""

    basis: str  # "durations" and "distances" of the matrix, or "costs" for all together
    rate: float  # cost per 1,000 of that
    is_metric: bool  # the cost is one of durations and distances alone
    ratio: Fraction | None  # metres by second, where all legs have the same

    @classmethod
    def of(cls, kind: VehicleKind, legs: ProfileLegs, ratio: Fraction | None) -> "Tariff":
        """Find what the cost of a kind is proportional to; `ratio` if all legs have the same."""
        rates = kind.rates
        if legs.costs is not None or rates.task_cost:
            return cls("costs", PARTS, False, None)
        if ratio is not None:
            cost = rates.time_cost + rates.distance_cost * ratio
            return cls("durations", float(cost * 1000 / COST_SCALE), True, ratio)
        if not rates.distance_cost:
            return cls("durations", rates.time_cost * 1000 / COST_SCALE, True, None)
        if not rates.time_cost:
            return cls("distances", rates.distance_cost * 1000 / COST_SCALE, True, None)
        return cls("costs", PARTS, True, None)


def _is_mixed(kind: VehicleKind) -> bool:
    """Tell whether both durations and distances count, be it as costs or as limits."""
    stated, rates = kind.stated, kind.rates
    return (bool(rates.distance_cost or stated.max_distance is not None)
            and bool(rates.time_cost or stated.max_travel_time is not None))


def _ratio(legs: ProfileLegs) -> Fraction | None:
    """Return metres by second if that is the same for all legs."""
    seconds = at_most_longest(legs.durations)
    metres = at_most_longest(legs.distances)
    longest = np.unravel_index(int(seconds.argmax()), seconds.shape)
    time, way = int(seconds[longest]), int(metres[longest])
    if not time or not way or not (metres * time == seconds * way).all():
        return None
    return Fraction(way, time)
