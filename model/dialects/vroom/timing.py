"""When everything in a route happens and what it costs, by VROOM's rules and in its integers.

Times are hundredths of a second, costs 360,000ths, as inside VROOM: a `speed_factor` is rounded
to hundredths once, and all else is exact.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, pairwise

from model.dialects.vroom.breaks import GapsForBreaks, Pause, VroomRest, after_job, arrivals
from model.dialects.vroom.given import GivenWay, Times, best_times
from model.dialects.vroom.places import NOWHERE, ProfileLegs, Sites
from model.dialects.vroom.request import GivenRoute, Job, Request, VroomVehicle
from model.dialects.vroom.windows import ENDLESS, MISSED, TIME_SCALE, scaled, slots_of, start_in

COST_SCALE = 360_000
"""Parts of a unit of cost: an hour's seconds times `TIME_SCALE`."""

DISTANCE_COST_SCALE = COST_SCALE // 1000
"""Parts of a unit of cost that a metre costs at 1 a kilometre."""

NO_WAY = 10**9
"""Seconds of a leg that isn't there: no other takes 31 years."""


@dataclass(frozen=True)
class ProfileRates:
    """What a vehicle makes of its profile's matrices."""

    time: int  # hundredths by a second of the matrix
    time_cost: int  # by a second of the matrix, or by a unit of the matrix of costs
    distance_cost: int  # by a metre
    task_cost: int  # by a hundredth of setup or service
    fixed_cost: int

    @classmethod
    def of(cls, vehicle: VroomVehicle, has_costs: bool) -> "ProfileRates":
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
class JobStep:
    """A job as it is served."""

    job: int  # index into the request's jobs
    arrival: int
    start: int  # of setup, after waiting
    setup: int
    service: int


@dataclass(frozen=True)
class TimedVroomRoute:
    """A vehicle's route; distances in metres."""

    vehicle: int  # index into the request's vehicles
    departure: int
    steps: tuple[JobStep, ...]
    end: int
    travels: tuple[int, ...]  # (step and end,) duration of the legs so far
    distances: tuple[int, ...]  # likewise
    travel_cost: int
    cost: int  # of travel, of setup and service, and for being used
    rests: tuple[VroomRest, ...] = ()

    @property
    def jobs(self) -> tuple[int, ...]:
        """Indices of the jobs served, in order."""
        return tuple(step.job for step in self.steps)


@dataclass(frozen=True)
class JobsDone:
    """The earliest that a vehicle can be done with some jobs, and what it has used up by then."""

    site: int  # where it stands, perhaps NOWHERE
    ends: tuple[int, ...]  # by the number of breaks that are over
    travel: int
    distance: int
    cost: int
    load: tuple[int, ...]  # taken in less brought so far, of each amount
    highest: tuple[int, ...]  # the most of that so far, not below 0
    brought: tuple[int, ...]

    @property
    def used(self) -> tuple[int, ...]:
        """What may keep it from more, or costs: the less, the better."""
        return (*self.ends, self.travel, self.distance, self.cost, *self.highest)


@dataclass(frozen=True)
class _Path:
    """What is driven and done on a route."""

    jobs: Sequence[int]
    way: GapsForBreaks
    actions: Sequence[tuple[int, int]]  # (job,) setup and service
    metres: Sequence[int]  # (gap,)
    travel_cost: int


@dataclass(frozen=True)
class RouteTimer:
    """Times the routes of one vehicle."""

    request: Request
    places: Sites
    vehicle: int

    def drive(self, jobs: Sequence[int]) -> TimedVroomRoute | None:
        """Return the route through `jobs`, at least one; None if it misses a time window or there
        is no way.

        It ends as early as possible, begins as late as that allows, and waits as late as possible.
        """
        path = self._path(jobs, self._pauses)
        if max(path.way.times) >= self._endless:
            return None
        begin, end = scaled(self._stated.time_window)
        earliest = path.way.earliest_end(begin)
        if earliest > end:
            return None
        departure, counts = path.way.latest_departure(earliest)
        return self._timed(path, counts, departure)

    def drive_given(self, given: GivenRoute) -> TimedVroomRoute | None:
        """Return a route that is given with the times that break the least of its windows; None if
        there is no way, or not at the times that are forced.

        Raises
        ------
        TooLargeError
            If there are too many times to look at.
        """
        pauses = [self._pauses[number] for number, _ in given.rests]
        path = self._path(given.jobs, pauses)
        if max(path.way.times) >= self._endless:
            return None
        counts = [sum(before <= gap for _, before in given.rests)
                  for gap in range(len(path.way.times))]
        begin, end = scaled(self._stated.time_window)
        times = best_times(GivenWay(
            path.way, counts, ([(begin, ENDLESS)], [(0, end)]),
            [given.start, *given.job_bounds, given.end], given.rest_bounds))
        if times is None:
            return None
        route = self._timed(path, counts, times.nodes[0], times)
        rests = [replace(rest, number=given.rests[rest.number][0]) for rest in route.rests]
        return replace(route, rests=tuple(rests))

    def _path(self, jobs: Sequence[int], pauses: Sequence[Pause]) -> "_Path":
        """Return what is driven and done on a route."""
        pairs = self._pairs(jobs)
        legs = [self._leg(*pair) for pair in pairs]
        actions = [self._action(*pair, job) for pair, job in zip(pairs, jobs, strict=False)]
        slots = [slots_of(self.request.jobs[job].time_windows) for job in jobs]
        way = GapsForBreaks([travel for travel, _, _ in legs], [sum(action) for action in actions],
                            slots, pauses, self._allowing(jobs))
        return _Path(jobs, way, actions, [metres for _, metres, _ in legs],
                     sum([cost for _, _, cost in legs]))

    def _timed(self, path: "_Path", counts: Sequence[int], departure: int,
               times: Times | None = None) -> TimedVroomRoute:
        """Return a route that leaves then, with so many breaks over behind each gap.

        All starts as soon as it may, or by `times`.
        """
        way = path.way
        time, over, steps, rests = departure, 0, list[JobStep](), list[VroomRest]()
        for gap, count in enumerate(counts):
            arrival, taken = way.drive(gap, time, range(over, count),
                                       () if times is None else times.rests)
            over, time = count, arrival
            rests += taken
            if gap < len(path.jobs):
                start = (start_in(arrival, way.slots[gap]) if times is None
                         else times.nodes[gap + 1])
                steps.append(JobStep(path.jobs[gap], arrival, start, *path.actions[gap]))
                time = start + way.actions[gap]
        tasks = sum(way.actions) + sum([pause.duration for pause in way.pauses])
        cost = self.rates.fixed_cost + path.travel_cost + self.rates.task_cost * tasks
        return TimedVroomRoute(self.vehicle, departure, tuple(steps), time,
                               tuple(accumulate(way.times)), tuple(accumulate(path.metres)),
                               path.travel_cost, cost, tuple(rests))

    def missing_leg(self, jobs: Sequence[int]) -> str | None:
        """Tell in words to where on a route through `jobs` there is no way; None if there is."""
        named = [*(f"to job {self.request.jobs[job].id}" for job in jobs), "to its end"]
        return next((name for name, pair in zip(named, self._pairs(jobs), strict=True)
                     if self._leg(*pair)[0] >= self._endless), None)

    def begin(self) -> JobsDone:
        """Return how the vehicle begins."""
        nothing = (0,) * len(self._stated.capacity)
        begin, _ = scaled(self._stated.time_window)
        ends = (begin, *[MISSED] * len(self._pauses))
        return JobsDone(int(self.places.starts[self.vehicle]), ends, 0, 0, 0, nothing, nothing,
                        nothing)

    def visit(self, before: JobsDone, job: int) -> JobsDone | None:
        """Return how the vehicle goes on to a job; None if that breaks a rule, whatever follows.

        What breaks say of loads, and shipments of who is first, is not looked at.
        """
        stated, site = self.request.jobs[job], int(self.places.jobs[job])
        travel, distance, cost = self._leg(before.site, site)
        setup, service = self._action(before.site, site, job)
        reached = arrivals(before.ends, travel, self._pauses, lambda _: True)
        nothing = (0,) * len(before.load)
        change = _added(stated.pickup or nothing, stated.delivery or nothing, -1)
        load = _added(before.load, change)
        visit = JobsDone(
            site, after_job(reached, setup + service, slots_of(stated.time_windows)),
            before.travel + travel, before.distance + distance,
            before.cost + cost + self.rates.task_cost * (setup + service), load,
            tuple(map(max, before.highest, load)),
            _added(before.brought, loaded_for(stated) or nothing))
        can = travel < self._endless and stated.skills <= self._stated.skills
        return visit if can and self._is_allowed(visit) else None

    def _is_allowed(self, visit: JobsDone) -> bool:
        """Tell whether a vehicle that comes from a visit can keep its limits."""
        stated = self._stated
        _, latest = scaled(stated.time_window)
        fits = all(most <= capacity for most, capacity in zip(
            _added(visit.highest, visit.brought), stated.capacity, strict=True))
        return (fits and min(visit.ends) <= latest
                and (stated.max_distance is None or visit.distance <= stated.max_distance)
                and (stated.max_travel_time is None
                     or visit.travel <= stated.max_travel_time * TIME_SCALE))

    @cached_property
    def rates(self) -> ProfileRates:
        """What the vehicle makes of its matrices."""
        return ProfileRates.of(self._stated, self._legs.costs is not None)

    @cached_property
    def _pauses(self) -> Sequence[Pause]:
        return [Pause(each.service * TIME_SCALE, slots_of(each.time_windows))
                for each in self._stated.breaks]

    @property
    def load_decides(self) -> bool:
        """Whether where breaks may be taken hangs on what is aboard."""
        return any(each.max_load is not None for each in self._stated.breaks)

    def _allowing(self, jobs: Sequence[int]) -> Callable[[int, int], bool]:
        """Return what tells whether the load in a gap of a route allows a break."""
        if not self.load_decides:
            return lambda _gap, _number: True
        most = [each.max_load for each in self._stated.breaks]
        loads = loads_on([self.request.jobs[job] for job in jobs], len(self._stated.capacity))
        return lambda gap, number: all(
            load <= limit for load, limit in zip(loads[gap], most[number] or (), strict=False))

    @cached_property
    def _endless(self) -> int:
        """From how long on a leg isn't there."""
        return NO_WAY * self.rates.time

    @property
    def _stated(self) -> VroomVehicle:
        return self.request.vehicles[self.vehicle]

    @property
    def _legs(self) -> ProfileLegs:
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


def loaded_for(job: Job) -> tuple[int, ...]:
    """Return what is brought to a job from the start of its route; empty: nothing."""
    return job.delivery if job.kind == "job" else ()


def loads_on(jobs: Sequence[Job], dimensions: int) -> list[tuple[int, ...]]:
    """Return what is aboard in each gap of a route: before its first job, and behind each."""
    nothing = (0,) * dimensions
    load = tuple(map(sum, zip(nothing, *(loaded_for(job) or nothing for job in jobs),
                              strict=True)))
    loads = [load]
    for job in jobs:
        loads.append(_added(_added(loads[-1], job.pickup or nothing), job.delivery or nothing, -1))
    return loads


def _added(amounts: Sequence[int], more: Sequence[int], times: int = 1) -> tuple[int, ...]:
    """Return amounts and others, taken so many times, together."""
    return tuple(amount + times * each for amount, each in zip(amounts, more, strict=True))
