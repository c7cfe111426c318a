"""When everything in a route happens and what it costs, by VROOM's rules and in its integers.

Times are hundredths of a second, costs 360,000ths, as inside VROOM: a `speed_factor` is rounded
to hundredths once, and all else is exact.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate, pairwise

from model.dialects.vroom.places import NOWHERE, Legs, Places
from model.dialects.vroom.request import Job, Request, Vehicle

TIME_SCALE = 100
"""Hundredths of a second."""

COST_SCALE = 360_000
"""Parts of a unit of cost: an hour's seconds times `TIME_SCALE`."""

DISTANCE_COST_SCALE = COST_SCALE // 1000
"""Parts of a unit of cost that a metre costs at 1 a kilometre."""

ENDLESS = 2**62
"""Stands for no end of a time window."""

NO_WAY = 10**9
"""Seconds of a leg that isn't there: no other takes 31 years."""

MISSED = 2**63
"""Start at a job whose last window is over: later than any end."""


@dataclass(frozen=True)
class Rates:
    """What a vehicle makes of its profile's matrices."""

    time: int  # hundredths by a second of the matrix
    time_cost: int  # by a second of the matrix, or by a unit of the matrix of costs
    distance_cost: int  # by a metre
    task_cost: int  # by a hundredth of setup or service
    fixed_cost: int

    @classmethod
    def of(cls, vehicle: Vehicle, has_costs: bool) -> "Rates":
        """Return the rates of a vehicle; `has_costs` if its profile has a matrix of costs."""
        costs = vehicle.costs
        slowness = 1 / vehicle.speed_factor * TIME_SCALE
        return cls(
            time=_nearest(slowness),
            time_cost=COST_SCALE if has_costs else _nearest(slowness * costs.per_hour),
            distance_cost=0 if has_costs else DISTANCE_COST_SCALE * costs.per_km,
            task_cost=costs.per_task_hour,
            fixed_cost=costs.fixed * COST_SCALE,
        )


def _nearest(value: float) -> int:
    return math.floor(value + 0.5)


@dataclass(frozen=True)
class Halt:
    """A job as it is served."""

    job: int  # index into the request's jobs
    arrival: int
    start: int  # of setup, after waiting
    setup: int
    service: int


@dataclass(frozen=True)
class TimedRoute:
    """A vehicle's route; distances in metres."""

    vehicle: int  # index into the request's vehicles
    departure: int
    halts: tuple[Halt, ...]
    end: int
    travels: tuple[int, ...]  # (halt and end,) duration of the legs so far
    distances: tuple[int, ...]  # likewise
    travel_cost: int
    cost: int  # of travel, of setup and service, and for being used

    @property
    def jobs(self) -> tuple[int, ...]:
        """Indices of the jobs served, in order."""
        return tuple(halt.job for halt in self.halts)


@dataclass(frozen=True)
class Visit:
    """The earliest that a vehicle can be done with some jobs, and what it has used up by then."""

    site: int  # where it stands, perhaps NOWHERE
    end: int
    travel: int
    distance: int
    cost: int
    load: tuple[int, ...]  # taken in less brought so far, of each amount
    highest: tuple[int, ...]  # the most of that so far, not below 0
    brought: tuple[int, ...]

    @property
    def used(self) -> tuple[int, ...]:
        """What may keep it from more, or costs: the less, the better."""
        return (self.end, self.travel, self.distance, self.cost, *self.highest)


@dataclass(frozen=True)
class Driver:
    """Times the routes of one vehicle."""

    request: Request
    places: Places
    vehicle: int

    def drive(self, jobs: Sequence[int]) -> TimedRoute | None:
        """Return the route through `jobs`, at least one; None if it misses a time window or there
        is no way.

        It ends as early as possible, begins as late as that allows, and waits as late as possible.
        """
        pairs = self._pairs(jobs)
        legs = [self._leg(*pair) for pair in pairs]
        times = [travel for travel, _, _ in legs]
        if max(times) >= self._endless:
            return None
        actions = [self._action(*pair, job) for pair, job in zip(pairs, jobs, strict=False)]
        windows = [_windows(self.request.jobs[job]) for job in jobs]
        begin, end = _scaled(self._stated.time_window)
        earliest_end = _earliest_end(begin, times, actions, windows)
        if earliest_end > end:
            return None
        time = departure = _latest_start(earliest_end, times, actions, windows)
        halts = []
        for job, travel, (setup, service), slots in zip(jobs, times, actions, windows,
                                                        strict=False):
            arrival = time + travel
            start = _start(arrival, slots)
            halts.append(Halt(job, arrival, start, setup, service))
            time = start + setup + service
        travel, rates = sum([cost for _, _, cost in legs]), self.rates
        cost = rates.fixed_cost + travel + rates.task_cost * sum(map(sum, actions))
        return TimedRoute(self.vehicle, departure, tuple(halts), time + times[-1],
                          tuple(accumulate(times)),
                          tuple(accumulate([metres for _, metres, _ in legs])), travel, cost)

    def missing_leg(self, jobs: Sequence[int]) -> str | None:
        """Tell in words to where on a route through `jobs` there is no way; None if there is."""
        named = [*(f"to job {self.request.jobs[job].id}" for job in jobs), "to its end"]
        return next((name for name, pair in zip(named, self._pairs(jobs), strict=True)
                     if self._leg(*pair)[0] >= self._endless), None)

    def begin(self) -> Visit:
        """Return how the vehicle begins."""
        nothing = (0,) * len(self._stated.capacity)
        begin, _ = _scaled(self._stated.time_window)
        return Visit(int(self.places.starts[self.vehicle]), begin, 0, 0, 0, nothing, nothing,
                     nothing)

    def visit(self, before: Visit, job: int) -> Visit | None:
        """Return how the vehicle goes on to a job; None if that breaks a rule, whatever follows."""
        stated, site = self.request.jobs[job], int(self.places.jobs[job])
        travel, distance, cost = self._leg(before.site, site)
        setup, service = self._action(before.site, site, job)
        start = _start(before.end + travel, _windows(stated))
        nothing = (0,) * len(before.load)
        change = _added(stated.pickup or nothing, stated.delivery or nothing, -1)
        load = _added(before.load, change)
        visit = Visit(
            site, start + setup + service, before.travel + travel, before.distance + distance,
            before.cost + cost + self.rates.task_cost * (setup + service), load,
            tuple(map(max, before.highest, load)),
            _added(before.brought, stated.delivery or nothing))
        can = travel < self._endless and stated.skills <= self._stated.skills
        return visit if can and self._is_allowed(visit) else None

    def _is_allowed(self, visit: Visit) -> bool:
        """Tell whether a vehicle that comes from a visit can keep its limits."""
        stated = self._stated
        _, latest = _scaled(stated.time_window)
        fits = all(most <= capacity for most, capacity in zip(
            _added(visit.highest, visit.brought), stated.capacity, strict=True))
        return (fits and visit.end <= latest
                and (stated.max_distance is None or visit.distance <= stated.max_distance)
                and (stated.max_travel_time is None
                     or visit.travel <= stated.max_travel_time * TIME_SCALE))

    @cached_property
    def rates(self) -> Rates:
        """What the vehicle makes of its matrices."""
        return Rates.of(self._stated, self._legs.costs is not None)

    @cached_property
    def _endless(self) -> int:
        """From how long on a leg isn't there."""
        return NO_WAY * self.rates.time

    @property
    def _stated(self) -> Vehicle:
        return self.request.vehicles[self.vehicle]

    @property
    def _legs(self) -> Legs:
        return self.places.legs[self._stated.profile]

    def _pairs(self, jobs: Sequence[int]) -> list[tuple[int, int]]:
        """Return the sites of each leg, those to the first job and from the last included."""
        sites = [int(self.places.starts[self.vehicle]),
                 *(int(self.places.jobs[job]) for job in jobs),
                 int(self.places.ends[self.vehicle])]
        return list(pairwise(sites))

    def _leg(self, origin: int, to: int) -> tuple[int, int, int]:
        """Return duration, distance and cost of a leg between sites."""
        if NOWHERE in (origin, to):
            return 0, 0, 0
        rates, legs = self.rates, self._legs
        seconds, metres = legs.durations.item(origin, to), legs.distances.item(origin, to)
        base = seconds if legs.costs is None else legs.costs.item(origin, to)
        return (rates.time * seconds, metres,
                rates.time_cost * base + rates.distance_cost * metres)

    def _action(self, origin: int, site: int, job: int) -> tuple[int, int]:
        """Return setup and service of a job at a site."""
        stated, kind = self.request.jobs[job], self._stated.type
        return (0 if origin == site else TIME_SCALE * setup_of(stated, kind),
                TIME_SCALE * service_of(stated, kind))


def setup_of(job: Job, kind: str) -> int:
    """Return the seconds of setup by a vehicle of a type; none has the empty name."""
    return job.setup_per_type.get(kind, job.setup) if kind else job.setup


def service_of(job: Job, kind: str) -> int:
    """Return the seconds of service by a vehicle of a type."""
    return job.service_per_type.get(kind, job.service) if kind else job.service


def _scaled(window: tuple[int, int] | None) -> tuple[int, int]:
    return (0, ENDLESS) if window is None else (window[0] * TIME_SCALE, window[1] * TIME_SCALE)


def _windows(job: Job) -> list[tuple[int, int]]:
    if job.time_windows is None:
        return [(0, ENDLESS)]
    return [_scaled(window) for window in sorted(job.time_windows)]


def _added(amounts: Sequence[int], more: Sequence[int], times: int = 1) -> tuple[int, ...]:
    """Return amounts and others, taken so many times, together."""
    return tuple(amount + times * each for amount, each in zip(amounts, more, strict=True))


def _start(arrival: int, windows: list[tuple[int, int]]) -> int:
    """Return when setup starts, `MISSED` after the last window."""
    return next((max(arrival, begin) for begin, end in windows if arrival <= end), MISSED)


def _earliest_end(time: int, times: list[int], actions: list[tuple[int, int]],
                  windows: list[list[tuple[int, int]]]) -> int:
    for travel, action, slots in zip(times, actions, windows, strict=False):
        time = _start(time + travel, slots) + sum(action)
    return time + times[-1]


def _latest_start(time: int, times: list[int], actions: list[tuple[int, int]],
                  windows: list[list[tuple[int, int]]]) -> int:
    """Return the latest departure after which all can be done by `time`."""
    time -= times[-1]
    for travel, action, slots in zip(times[-2::-1], actions[::-1], windows[::-1], strict=True):
        latest = time - sum(action)
        time = max(min(latest, end) for begin, end in slots if begin <= latest) - travel
    return time

