"""Whether a route keeps VROOM's rules, told in VROOM's words, whatever the planner says."""

from collections.abc import Iterator, Sequence
from itertools import accumulate

from model.dialects.vroom.places import Places
from model.dialects.vroom.request import Job, Request
from model.dialects.vroom.timing import NO_WAY, TIME_SCALE, Driver, TimedRoute
from model.planner import PlanCheckError


def route_faults(request: Request, places: Places, vehicle: int,
                 jobs: Sequence[int]) -> Iterator[str]:
    """Yield what is wrong with the route of a vehicle through `jobs`, at least one.

    Parameters
    ----------
    vehicle
        Index into the request's vehicles.
    jobs
        Indices into the request's jobs.
    """
    stated = request.vehicles[vehicle]
    visited = [request.jobs[job] for job in jobs]
    for job in visited:
        if not job.skills <= stated.skills:
            yield f"Missing skill or step out of reach for vehicle {stated.id} and job {job.id}."
    if not _fits(visited, stated.capacity):
        yield f"Route over capacity for vehicle {stated.id}."
    if stated.max_tasks is not None and len(jobs) > stated.max_tasks:
        yield f"Too many tasks for vehicle {stated.id}."
    driver = Driver(request, places, vehicle)
    route = driver.drive(jobs)
    if route is None:
        missing = driver.missing_leg(jobs)
        yield (f"Infeasible route for vehicle {stated.id}." if missing is None else
               f"No way for vehicle {stated.id} {missing}: matrices state {NO_WAY} s or more.")
        return
    if (stated.max_travel_time is not None
            and route.travels[-1] > stated.max_travel_time * TIME_SCALE):
        yield f"Route over max_travel_time for vehicle {stated.id}."
    if stated.max_distance is not None and route.distances[-1] > stated.max_distance:
        yield f"Route over max_distance for vehicle {stated.id}."


def drive(request: Request, places: Places, vehicle: int, jobs: Sequence[int]) -> TimedRoute:
    """Return the times of a route.

    Raises
    ------
    PlanCheckError
        If it breaks a rule.
    """
    faults = list(route_faults(request, places, vehicle, jobs))
    route = Driver(request, places, vehicle).drive(jobs)
    if faults or route is None:
        raise PlanCheckError(" ".join(faults))
    return route


def _fits(jobs: Sequence[Job], capacity: Sequence[int]) -> bool:
    """Tell whether the load stays within the capacity all the way."""
    for index, most in enumerate(capacity):
        brought = [job.delivery[index] if job.delivery else 0 for job in jobs]
        taken = [job.pickup[index] if job.pickup else 0 for job in jobs]
        changes = (more - less for more, less in zip(taken, brought, strict=True))
        if max(accumulate(changes, initial=sum(brought))) > most:
            return False
    return True
