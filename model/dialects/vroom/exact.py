"""The best routes for a few jobs, by VROOM's own rules.

What a vehicle can do with each set of jobs is found by dynamic programming, and so is who gets
which set. The planner proves nothing: it misses who fits only beside others that aren't there yet,
and has no windows that setup begins in where there is any, else service.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from model.dialects.vroom.checking import route_faults
from model.dialects.vroom.kinds import VehicleKind
from model.dialects.vroom.models import Routes
from model.dialects.vroom.places import Sites
from model.dialects.vroom.request import Request
from model.dialects.vroom.timing import JobsDone, RouteTimer
from model.problem import MAX_BREAKS

Value = tuple[int, int, int]
"""Priorities served, jobs served, and minus the cost."""

NOTHING: Value = (0, 0, 0)

MOST_SETS = 4000
"""Sets of jobs, each with a last one and a kind of vehicle, that are looked at: some 0.1 s."""

MOST_BEGINNINGS = 8000
"""Beginnings that are gone on from, since none of them is the best in everything: some 0.3 s."""


def is_few(num_jobs: int, num_kinds: int, num_breaks: int) -> bool:
    """Tell whether so many jobs are few enough, for so many kinds of vehicles, of which one has so
    many breaks.

    By more breaks than the planner has each set takes longer, as their square.
    """
    # In whole numbers: those of a thousand jobs are beyond what a float holds.
    longer = max(MAX_BREAKS, num_breaks)**2
    return num_kinds * num_jobs * 2**num_jobs * longer <= MOST_SETS * MAX_BREAKS**2


@dataclass(frozen=True)
class Beginning:
    """A way to visit some jobs, and where the vehicle stands then."""

    jobs: tuple[int, ...]
    visit: JobsDone

    def is_beaten_by(self, other: "Beginning") -> bool:
        """Tell whether another through the same jobs is no worse in anything that counts."""
        return all(mine >= others for mine, others in zip(
            self.visit.used, other.visit.used, strict=True))


def best_routes(request: Request, places: Sites, kinds: Sequence[VehicleKind], jobs: Sequence[int],
                vehicles: Sequence[int], should_stop: Callable[[], bool]) -> Routes | None:
    """Return the best routes for jobs; None if there are too many ways to begin with, or if it
    `should_stop`.

    Parameters
    ----------
    jobs
        Indices into the request's jobs, few of them.
    vehicles
        The kind of each vehicle that may be used, an index into `kinds`.
    """
    tours = {}
    for kind in set(vehicles):
        found = _tours(request, RouteTimer(request, places, kinds[kind].vehicles[0]), jobs,
                       should_stop)
        if found is None:
            return None
        tours[kind] = found
    everyone = 2**len(jobs) - 1
    # By the set of jobs that is left to those behind: what those before make of the others.
    best: dict[int, tuple[Value, tuple[tuple[int, tuple[int, ...]], ...]]] = {
        everyone: (NOTHING, ())}
    for kind in vehicles:
        following = dict(best)
        for left, (value, routes) in best.items():
            for taken, (worth, route) in tours[kind].items():
                if taken & ~left:
                    continue
                total = (value[0] + worth[0], value[1] + worth[1], value[2] + worth[2])
                known = following.get(left & ~taken)
                if known is None or total > known[0]:
                    following[left & ~taken] = (total, (*routes, (kind, route)))
        best = following
    _, chosen = max(best.values(), key=lambda each: each[0])
    routes_of: dict[int, list[tuple[int, ...]]] = {}
    for kind, route in chosen:
        routes_of.setdefault(kind, []).append(route)
    return routes_of


def _tours(request: Request, driver: RouteTimer, jobs: Sequence[int],
           should_stop: Callable[[], bool],
           ) -> Mapping[int, tuple[Value, tuple[int, ...]]] | None:
    """Return the best route of a vehicle through each set of jobs that it can serve.

    Sets are numbers whose bits stand for `jobs`. None if beginnings are too many, or too slow.
    """
    best: dict[int, tuple[Value, tuple[int, ...]]] = {}
    begun, number = {(0, -1): [Beginning((), driver.begin())]}, 0
    while begun:
        number += sum(map(len, begun.values()))
        if number > MOST_BEGINNINGS:
            return None
        longer: dict[tuple[int, int], list[Beginning]] = {}
        for (taken, _), beginnings in begun.items():
            if should_stop():
                return None
            for index, job in enumerate(jobs):
                if not taken >> index & 1 and _may_come(request, jobs, taken, job):
                    known = longer.setdefault((taken | 1 << index, index), [])
                    for beginning in beginnings:
                        _go_on(driver, beginning, job, known)
        for (taken, _), beginnings in longer.items():
            if should_stop():
                return None
            for beginning in beginnings:
                value = _value(request, driver, beginning.jobs)
                if value is not None and (taken not in best or value > best[taken][0]):
                    best[taken] = (value, beginning.jobs)
        begun = longer
    return best


def _may_come(request: Request, jobs: Sequence[int], taken: int, job: int) -> bool:
    """Tell whether a job may come behind those taken, as deliveries do behind their pickups."""
    stated = request.jobs[job]
    return stated.kind != "delivery" or stated.mate is None or bool(
        taken >> jobs.index(stated.mate) & 1)


def _go_on(driver: RouteTimer, beginning: Beginning, job: int, known: list[Beginning]) -> None:
    """Add a beginning that goes on to a job, unless it can't or another is as good. In place."""
    visit = driver.visit(beginning.visit, job)
    if visit is None:
        return
    longer = Beginning((*beginning.jobs, job), visit)
    if driver.load_decides:
        known.append(longer)
    elif not any(longer.is_beaten_by(other) for other in known):
        known[:] = [other for other in known if not other.is_beaten_by(longer)]
        known.append(longer)


def _value(request: Request, driver: RouteTimer, jobs: tuple[int, ...]) -> Value | None:
    """Return what a route is worth, None if it breaks a rule."""
    if any(route_faults(request, driver.places, driver.vehicle, jobs)):
        return None
    route = driver.drive(jobs)
    return None if route is None else (
        sum([request.jobs[job].priority for job in jobs]), len(jobs), -route.cost)
