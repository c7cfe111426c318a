"""When everything in a route happens and what it costs, by VROOM's rules and in its integers.

Times are hundredths of a second, costs 360,000ths, as inside VROOM: a `speed_factor` is rounded
to hundredths once, and all else is exact.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
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
class Driver:
    """Times the routes of one vehicle."""

    request: Request
    places: Places
    vehicle: int

    def drive(self, jobs: Sequence[int]) -> TimedRoute | None:
        """Return the route through `jobs`, at least one; None if it misses a time window.

        It ends as early as possible, begins as late as that allows, and waits as late as possible.
        """
        times = self._leg_times(jobs)
        actions = self._actions(jobs)
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
        travel, rates = self._leg_cost(jobs), self.rates
        cost = rates.fixed_cost + travel + rates.task_cost * sum(map(sum, actions))
        return TimedRoute(self.vehicle, departure, tuple(halts), time + times[-1],
                          tuple(accumulate(times)), tuple(accumulate(self._leg_distances(jobs))),
                          travel, cost)

    @property
    def rates(self) -> Rates:
        """What the vehicle makes of its matrices."""
        return Rates.of(self._stated, self._legs.costs is not None)

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

    def _leg_times(self, jobs: Sequence[int]) -> list[int]:
        rate, durations = self.rates.time, self._legs.durations
        return [0 if NOWHERE in leg else rate * durations.item(*leg) for leg in self._pairs(jobs)]

    def _leg_distances(self, jobs: Sequence[int]) -> list[int]:
        distances = self._legs.distances
        return [0 if NOWHERE in leg else distances.item(*leg) for leg in self._pairs(jobs)]

    def _leg_cost(self, jobs: Sequence[int]) -> int:
        rates, legs = self.rates, self._legs
        base = legs.durations if legs.costs is None else legs.costs
        return sum(rates.time_cost * base.item(*leg)
                   + rates.distance_cost * legs.distances.item(*leg)
                   for leg in self._pairs(jobs) if NOWHERE not in leg)

    def _actions(self, jobs: Sequence[int]) -> list[tuple[int, int]]:
        """Return setup and service of each job."""
        kind = self._stated.type
        return [(0 if origin == site else TIME_SCALE * setup_of(self.request.jobs[job], kind),
                 TIME_SCALE * service_of(self.request.jobs[job], kind))
                for job, (origin, site) in zip(jobs, self._pairs(jobs), strict=False)]


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

