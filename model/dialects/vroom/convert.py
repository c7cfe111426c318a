"""VROOM's jobs and vehicles -> the planner's `Problem`, and its plans back to routes of jobs."""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from math import isqrt

import numpy as np

from model.dialects.vroom.actions import Actions
from model.dialects.vroom.binding import windows_bind
from model.dialects.vroom.drives import Drive, Drives
from model.dialects.vroom.errors import RefusedError, TooLargeError
from model.dialects.vroom.kinds import VehicleKind, find_kinds, find_loads
from model.dialects.vroom.models import Model
from model.dialects.vroom.nodes import LONGEST, PARTS, Terminus, Nodes
from model.dialects.vroom.places import NOWHERE, Sites
from model.dialects.vroom.request import Job, Request, VroomVehicle, Window
from model.dialects.vroom.rests import Rests
from model.dialects.vroom.timing import NO_WAY, RouteTimer
from model.dialects.vroom.windows import TIME_SCALE
from model.dialects.vroom.work import (
    UNHURRIED, LegLimit, Pause, VroomWork, attempt_seconds, model_seconds,
)
from model.problem import (
    MAX_QUANTITY, MM_PER_KM, UNLIMITED, BoolArray, Break, Customer, Depot, FloatArray,
    IntArray, Problem, Shipment, Travel, VehicleType,
)

EARLIER = 2 * 10**8
"""How many seconds before all that is stated a vehicle without time window may leave."""


class Converter:
    """Makes problems of one request: of all its jobs, or some.

    Parameters
    ----------
    request, places, max_legs
        What is asked for, where, and how much is too much.

    Raises
    ------
    RefusedError
        If the request asks for what the planner can't do, or for too much.
    """

    def __init__(self, request: Request, places: Sites, max_legs: LegLimit) -> None:
        self._request = request
        self._max_legs = max_legs
        self._places = places
        self.kinds = find_kinds(request, places)
        self._is_timed = windows_bind(request, places, self.kinds)
        self._rests = Rests(self.kinds, self._is_timed)
        self._ends = [(Terminus(kind.start), Terminus(kind.end, self._rests.latest_begin(number)))
                       for number, kind in enumerate(self.kinds)]
        self._origin = self._find_origin()
        self._shifts = {self._shift(kind) for kind in self.kinds}
        self._windows = [self._reachable(self._stated(job)) for job in request.jobs]
        self._loads = find_loads(request, self.kinds)

    def model(self, jobs: Sequence[int], preparing: VroomWork = UNHURRIED) -> Model:
        """Return the problem of serving jobs, at least one.

        Raises
        ------
        RefusedError
            If it would be too large.
        Exception
            If the work on it is to end, what `preparing` raises.
        """
        nodes = Nodes.of(self._places, self._ends, jobs)
        number = len(nodes.sites)
        if number**2 > self._max_legs.legs:
            raise TooLargeError("Too many starts and ends of vehicles and jobs "
                                f"({number}), maximum is {isqrt(self._max_legs.legs)} "
                                f"({self._max_legs.setting})")
        drives = Drives(self._request, self._places, self.kinds, nodes, self._is_timed,
                        preparing.pause)
        ways = drives.count(self.kinds)
        self._require_room(drives, ways, number)
        preparing.expect(model_seconds(number, ways) + attempt_seconds(number, ways))
        return Model(self._problem(nodes, drives), nodes, self._gaps)

    def _require_room(self, drives: Drives, ways: int, nodes: int) -> None:
        """Refuse more matrices, and more tables of how jobs are served, than are held at a time."""
        services = drives.actions.num_services()
        rows = (services - 1) * max(map(len, self._windows), default=0) * nodes
        if ways * nodes**2 + rows > self._max_legs.legs:
            raise TooLargeError("Too many vehicles that drive or serve unlike each other for so "
                                f"many jobs: {ways} ways to travel between {nodes} places, "
                                f"{services} to serve there, maximum is {self._max_legs.legs} legs "
                                f"({self._max_legs.setting}).")

    def _problem(self, nodes: Nodes, drives: Drives) -> Problem:
        """Return the problem by given drives."""
        depots = {end: node for node, end in enumerate(nodes.depots)}
        actions = drives.actions
        unlike = {kind.type: self._unlike(nodes.jobs, actions, kind.type) for kind in self.kinds}
        vehicle_types = tuple(
            self._vehicle_type(number, depots[start], depots[end], drives.drive(kind),
                               unlike[kind.type], self._breaks(number))
            for number, (kind, (start, end)) in enumerate(
                zip(self.kinds, self._ends, strict=True)))
        customers = tuple(
            self._customer(job, int(site), service, setup, later)
            for job, site, service, setup, later in zip(
                nodes.jobs, nodes.sites[len(depots):], actions.service(self.kinds[0].type).tolist(),
                actions.setup.tolist(), actions.opens_later.tolist(), strict=True))
        travels = tuple(drives.travels)
        return Problem(
            depots=tuple(Depot(
                str(node), "nowhere" if end.site == NOWHERE else "depot",
                site=None if end.site == NOWHERE else end.site,
                earliest=0 if end.opens is None else self._instant(end.opens) + 1)
                for node, end in enumerate(nodes.depots)),
            customers=customers,
            vehicle_types=vehicle_types, travel=travels,
            coordinates=self._coordinates(nodes, travels),
            unassigned_cost=dearest_plan(vehicle_types, travels, len(depots), drives.pause),
            may_serve=self._startable(nodes.jobs),
            shipments=tuple(self._shipments(nodes)))

    def _shipments(self, nodes: Nodes) -> Iterator[Shipment]:
        """Yield the shipments whose ends are among the nodes."""
        node_of = nodes.of_job()
        for job, node in node_of.items():
            stated = self._request.jobs[job]
            if stated.kind == "pickup" and stated.mate in node_of:
                yield Shipment(str(stated.id), node, node_of[stated.mate],
                               tuple(self._loads.moved[job].tolist()))

    def _gaps(self, kind: int, jobs: Sequence[int]) -> Sequence[tuple[int, int]]:
        """Return the breaks of a route, each with the gap in which it is taken."""
        stated = self.kinds[kind]
        if not stated.stated.breaks or not self._is_timed:
            return ()
        route = RouteTimer(self._request, self._places, stated.vehicles[0]).drive(jobs)
        if route is None:
            return ()
        gaps: dict[int, int] = {}
        for rest in route.rests:
            gaps.setdefault(self._rests.number_of(kind, rest.number), rest.gap)
        return [*gaps.items()]

    def _breaks(self, kind: int) -> tuple[Break, ...]:
        """Return the breaks of a kind on the planner's clock."""
        return tuple([
            Break(str(number), seconds * PARTS, self._instant(begin), self._last_instant(end),
                  anywhere=True, max_load=None if most is None or not self._loads.kept
                  else tuple([most[index] for index in self._loads.kept]))
            for number, ((seconds, (begin, end)), most)
            in enumerate(self._rests.of(kind))])

    def _unlike(self, jobs: Sequence[int], actions: Actions, name: str) -> dict[str, int]:
        """Return how long vehicles of a type serve jobs, by id, where the first ones don't."""
        service = actions.service(name)
        differs = service != actions.service(self.kinds[0].type)
        return {name_of(self._request.jobs[job]): seconds * PARTS
                for job, seconds, is_own in zip(jobs, service.tolist(), differs.tolist(),
                                                strict=True) if is_own}

    @cached_property
    def _has_longest(self) -> bool:
        """Tell whether some legs are longer than the planner can count, or aren't there."""
        longest = {profile: (int(legs.durations.max()), int(legs.distances.max()))
                   for profile, legs in self._places.legs.items()}
        return any(seconds >= NO_WAY
                   or max(seconds * kind.rates.time // TIME_SCALE, metres) > LONGEST
                   for kind in self.kinds for seconds, metres in [longest[kind.stated.profile]])

    def _shift(self, kind: VehicleKind) -> Window | None:
        """Return when vehicles of a kind work, None if that makes no difference."""
        return kind.stated.time_window if self._is_timed else None

    def _stated(self, job: Job) -> Sequence[Window]:
        """Return the windows of a job that make a difference, in any order."""
        return (job.time_windows or ()) if self._is_timed else ()

    def _find_origin(self) -> int:
        """Return the instant in seconds that the planner's time begins with."""
        windows = [self._shift(kind) for kind in self.kinds]
        begins = [window[0] for window in windows if window is not None]
        if len(begins) < len(windows):
            begins += [window[0] for job in self._request.jobs for window in self._stated(job)]
            begins += self._rests.begins()
            return max(0, min(begins, default=0) - EARLIER)
        return min(begins)

    def _instant(self, seconds: int) -> int:
        """Return an instant on the planner's clock, not before its time begins."""
        instant = max(0, seconds - self._origin) * PARTS
        if instant > MAX_QUANTITY:
            raise RefusedError("Time windows begin more than 31 years apart.")
        return instant

    def _last_instant(self, seconds: int) -> int:
        """Return the end of a window on the planner's clock."""
        return min(UNLIMITED, (seconds - self._origin) * PARTS)

    def _vehicle_type(self, number: int, start: int, end: int, drive: Drive,
                      service_durations: Mapping[str, int],
                      breaks: tuple[Break, ...]) -> VehicleType:
        kind = self.kinds[number]
        window, most = self._shift(kind), kind.stated.max_tasks
        return VehicleType(
            id=str(kind.stated.id), count=len(kind.vehicles),
            capacity=tuple(self._loads.capacity[number].tolist()), travel=drive.travel, depot=start,
            end=end,
            fixed_cost=fixed_cost_of(kind.stated), cost_per_km=drive.cost_per_km,
            earliest=0 if window is None else self._instant(window[0]),
            latest=self._latest(window),
            max_trip_distance=drive.max_trip_distance,
            max_travel_duration=drive.max_travel_duration, max_distance=drive.max_distance,
            limited=drive.limited,
            max_stops=None if most is None else min(most, len(self._request.jobs)),
            skills=frozenset(map(str, kind.stated.skills)), service_durations=service_durations,
            breaks=breaks, works_since=None if self._ends[number][1].opens is None else 0)

    def _latest(self, window: Window | None) -> int:
        """Return when a vehicle's work has to end: before the end of any leg that isn't there."""
        latest = UNLIMITED if window is None else self._last_instant(window[1])
        return min(latest, MAX_QUANTITY - 1) if self._has_longest else latest

    def _customer(self, job: int, site: int, service: int, setup: int, later: int) -> Customer:
        """Return a job as the planner sees it; windows open so many seconds `later`."""
        stated, windows = self._request.jobs[job], self._windows[job]
        begins = [self._instant(begin + later) for begin, _ in windows] or [0]
        ends = [self._last_instant(end) for _, end in windows] or [UNLIMITED]
        pickup = tuple(self._loads.pickup[job].tolist())
        return Customer(
            name_of(stated), tuple(self._loads.delivery[job].tolist()), service * PARTS, begins[0],
            ends[-1], skills=frozenset(map(str, stated.skills)), setup_duration=setup * PARTS,
            site=site, gaps=tuple(zip(ends[:-1], begins[1:], strict=True)),
            pickup=pickup if any(pickup) else ())

    def _startable(self, jobs: Sequence[int]) -> BoolArray:
        """Return (kind, node) that nobody serves a job in whose windows nobody works, nor who can't
        take breaks.
        """
        startable = [not self._stated(self._request.jobs[job]) or bool(self._windows[job])
                     for job in jobs]
        return np.array(startable, np.bool_) & np.array(
            [[self._rests.can_be_taken(kind)] for kind in range(len(self.kinds))], np.bool_)

    def _reachable(self, windows: Sequence[Window]) -> list[Window]:
        """Return those windows in which any vehicle works, in order."""
        return [window for window in sorted(windows) if self._may_start(window)]

    def _may_start(self, window: Window) -> bool:
        """Tell whether any vehicle works within a time window."""
        return any(shift is None or (shift[0] <= window[1] and window[0] <= shift[1])
                   for shift in self._shifts)

    def _coordinates(self, nodes: Nodes, travels: Sequence[Travel]) -> FloatArray:
        """Return where the policy sees the nodes: on the map, or as the legs place them."""
        placed = self._places.map
        # Vehicles that start or end anywhere are seen to do so amid all places.
        if placed is None:
            points, is_nowhere = _by_landmarks(travels[0].duration[:]), nodes.sites == NOWHERE
            points[is_nowhere] = points[~is_nowhere].mean(axis=0)
            return points
        return np.vstack([placed, placed.mean(axis=0)])[nodes.sites]


def name_of(job: Job) -> str:
    """Return the name of a job, or of a shipment's end, among the planner's customers."""
    return str(job.id) if job.kind == "job" else f"{job.kind} {job.id}"


def fixed_cost_of(vehicle: VroomVehicle) -> float:
    """Return what using a vehicle costs: breaks count as tasks do."""
    rests = sum([each.service for each in vehicle.breaks])
    return vehicle.costs.fixed + vehicle.costs.per_task_hour * rests / 3600


def _by_landmarks(duration: IntArray) -> FloatArray:
    """Place nodes by how far they are from the last one, and from the one farthest from it."""
    farthest = int(duration[-1].argmax())
    return duration[[-1, farthest]].T.astype(np.float64)


def dearest_plan(vehicle_types: Sequence[VehicleType], travels: Sequence[Travel],
                 num_depots: int, pause: Pause = UNHURRIED.pause) -> float:
    """Return more than any plan costs: serving one job more is always worth it."""
    fixed = max(kind.fixed_cost for kind in vehicle_types)
    to_nodes = np.zeros(len(travels[0].distance))
    rates: dict[int, float] = {}
    for kind in vehicle_types:
        rates[kind.travel] = max(kind.cost_per_km, rates.get(kind.travel, 0.0))
    for travel, per_km in rates.items():
        pause()
        cost = travels[travel].distance[:] * (per_km / MM_PER_KM)
        to_nodes = np.maximum(to_nodes, cost.max(axis=0))
    to_jobs, to_end = to_nodes[num_depots:], float(to_nodes[:num_depots].max())
    return 1.0 + float(to_jobs.sum()) + len(to_jobs) * (to_end + fixed)
