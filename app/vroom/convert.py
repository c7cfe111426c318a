"""VROOM's jobs and vehicles -> the planner's `Problem`, and its plans back to routes of jobs."""

from collections.abc import Sequence
from math import isqrt

import numpy as np

from app.settings import MAX_LEGS
from app.vroom.alternatives import choose_windows
from app.vroom.drives import Drive, Drives
from app.vroom.errors import INPUT, TOO_LARGE, VroomError
from app.vroom.kinds import Loads, find_kinds, find_loads
from app.vroom.models import Model
from app.vroom.nodes import LONGEST, PARTS, Nodes, Slots
from app.vroom.places import NOWHERE, Places, on_globe
from app.vroom.reply import has_windows
from app.vroom.schemas import VroomRequest, Window
from app.vroom.timing import TIME_SCALE
from model.problem import (
    MAX_QUANTITY, MM_PER_KM, MS_PER_HOUR, UNLIMITED, Customer, Depot, FloatArray, IntArray, Problem,
    Travel, VehicleType,
)
from model.travel.matrices import local_coordinates

EARLIER = 2 * 10**8
"""How many seconds before all that is stated a vehicle without time window may leave."""


class Converter:
    """Makes problems of one request: of all its jobs, or some.

    Parameters
    ----------
    request, places
        What is asked for, and where.
    max_legs
        Most legs of all matrices together.

    Raises
    ------
    VroomError
        If the request asks for what the planner can't do, or for too much.
    """

    def __init__(self, request: VroomRequest, places: Places,
                 max_legs: int = MAX_LEGS) -> None:
        self._request = request
        self._max_legs = max_legs
        self._places = places
        self.kinds = find_kinds(request, places)
        self._is_timed = has_windows(request)
        self._origin = self._find_origin()

    def model(self, slots: Slots) -> Model:
        """Return the problem of serving jobs, at least one, each in one of its windows."""
        nodes = Nodes.of(self._places, self.kinds, slots)
        if len(nodes.origins) ** 2 > self._max_legs:
            raise VroomError(TOO_LARGE, "Too many starts and ends of vehicles and windows of jobs "
                                        f"({len(nodes.origins)}), maximum is "
                                        f"{isqrt(self._max_legs)} (TANDEM_MAX_LEGS)")
        problem, is_compromise = self._problem(nodes)
        relaxed: tuple[Problem, ...] = ()
        if is_compromise:
            relaxed = (choose_windows(self._problem(nodes, strict=problem)[0], nodes),)
        surplus = find_loads(self._request, self.kinds, relaxed=True).surplus
        return Model(choose_windows(problem, nodes), nodes, len(self.kinds), relaxed,
                     None if surplus is None else tuple(surplus[list(nodes.jobs)].tolist()),
                     has_longest=self._has_longest())

    def _problem(self, nodes: Nodes, strict: Problem | None = None) -> tuple[Problem, bool]:
        """Return the problem, and whether it is a compromise between rules and costs.

        With one that is, `strict`, return a relaxed one beside it.
        """
        relaxed = strict is not None
        loads = find_loads(self._request, self.kinds, relaxed)
        drives = Drives(self._request, self._places, self.kinds, nodes, self._is_timed, relaxed)
        beside = 0 if strict is None else len(strict.travel)
        driven = []
        for kind in self.kinds:
            driven.append(drives.drive(kind))
            if (beside + len(drives.travels)) * len(nodes.origins) ** 2 > self._max_legs:
                raise VroomError(TOO_LARGE, "Too many vehicles that drive unlike each other for so "
                                            "many jobs (TANDEM_MAX_LEGS).")
        depots = {depot: node for node, depot in enumerate(nodes.depots)}
        vehicle_types = tuple(
            self._vehicle_type(number, depots[kind.start, kind.end], drive, loads)
            for number, (kind, drive) in enumerate(zip(self.kinds, driven, strict=True)))
        services = drives.actions.common if self._is_timed else np.zeros(len(nodes.jobs), np.int64)
        customers = tuple(
            self._customer(job, int(service), window, loads)
            for job, service, window in zip(nodes.jobs, services, nodes.windows, strict=True))
        travels = tuple(drives.travels)
        problem = Problem(
            depots=tuple(Depot(str(node)) for node in range(len(depots))), customers=customers,
            vehicle_types=vehicle_types, travel=travels,
            coordinates=self._coordinates(nodes, travels),
            unassigned_cost=dearest_plan(vehicle_types, travels, len(depots)))
        return problem, drives.is_compromise or loads.surplus is not None

    def _has_longest(self) -> bool:
        """Tell whether some legs are longer than the planner can count."""
        return any(max(int(legs.durations.max()) * kind.rates.time // TIME_SCALE,
                       int(legs.distances.max())) > LONGEST
                   for kind in self.kinds for legs in [self._places.legs[kind.stated.profile]])

    def _find_origin(self) -> int:
        """Return the instant in seconds that the planner's time begins with."""
        windows = [kind.stated.time_window for kind in self.kinds]
        begins = [window[0] for window in windows if window is not None]
        if len(begins) < len(windows):
            begins += [window[0] for job in self._request.jobs
                       for window in job.time_windows or ()]
            return max(0, min(begins, default=0) - EARLIER)
        return min(begins)

    def _instant(self, seconds: int) -> int:
        """Return an instant on the planner's clock, not before its time begins."""
        instant = max(0, seconds - self._origin) * PARTS
        if instant > MAX_QUANTITY:
            raise VroomError(INPUT, "Time windows begin more than 31 years apart.")
        return instant

    def _last_instant(self, seconds: int) -> int:
        """Return the end of a window on the planner's clock."""
        return min(UNLIMITED, (seconds - self._origin) * PARTS)

    def _vehicle_type(self, number: int, depot: int, drive: Drive, loads: Loads) -> VehicleType:
        kind = self.kinds[number]
        window = kind.stated.time_window
        return VehicleType(
            id=str(kind.stated.id), count=len(kind.vehicles),
            capacity=tuple(loads.capacity[number].tolist()), travel=drive.travel, depot=depot,
            fixed_cost=float(kind.stated.costs.fixed), cost_per_km=drive.cost_per_km,
            cost_per_hour=drive.cost_per_hour,
            earliest=0 if window is None else self._instant(window[0]),
            latest=UNLIMITED if window is None else self._last_instant(window[1]),
            max_working_duration=drive.max_working, max_trip_distance=drive.max_distance,
            skills=frozenset(map(str, kind.stated.skills)))

    def _customer(self, job: int, service: int, window: Window | None,
                  loads: Loads) -> Customer:
        stated = self._request.jobs[job]
        demand = tuple(loads.demand[job].tolist())
        skills = frozenset(map(str, stated.skills))
        name = str(stated.id)
        if window is None:
            return Customer(name, demand, service * PARTS, skills=skills)
        if not self.may_start(window):
            return Customer(name, demand, service * PARTS, skills=frozenset({"nobody"}))
        return Customer(name, demand, service * PARTS, self._instant(window[0]),
                        self._last_instant(window[1]), skills=skills)

    def may_start(self, window: Window) -> bool:
        """Tell whether any vehicle works within a time window."""
        shifts = [kind.stated.time_window for kind in self.kinds]
        return any(shift is None or (shift[0] <= window[1] and window[0] <= shift[1])
                   for shift in shifts)

    def _coordinates(self, nodes: Nodes, travels: Sequence[Travel]) -> FloatArray:
        """Return where the policy sees the nodes: on the map, or as the legs place them."""
        points = self._places.coordinates
        known = [point for point in points if point is not None]
        if len(known) < len(points) or not on_globe(known):
            return _by_landmarks(travels[0].duration)
        placed = local_coordinates(np.array(known, np.float64))
        # A depot without a start is seen where its vehicles end.
        return placed[np.where(nodes.origins == NOWHERE, nodes.targets, nodes.origins)]


def _by_landmarks(duration: IntArray) -> FloatArray:
    """Place nodes by how far they are from the last one, and from the one farthest from it."""
    farthest = int(duration[-1].argmax())
    return duration[[-1, farthest]].T.astype(np.float64)


def dearest_plan(vehicle_types: Sequence[VehicleType], travels: Sequence[Travel],
                 num_depots: int) -> float:
    """Return more than any plan costs: serving one job more is always worth it."""
    fixed = max(kind.fixed_cost for kind in vehicle_types)
    tariffs = {(kind.travel, kind.cost_per_km, kind.cost_per_hour) for kind in vehicle_types}
    costs = [travels[travel].distance * (per_km / MM_PER_KM)
             + travels[travel].duration * (per_hour / MS_PER_HOUR)
             for travel, per_km, per_hour in tariffs]
    to_jobs = np.max([cost[:, num_depots:].max(axis=0) for cost in costs], axis=0)
    to_end = max(float(cost[:, :num_depots].max()) for cost in costs)
    return 1.0 + float(to_jobs.sum()) + len(to_jobs) * (to_end + fixed)
