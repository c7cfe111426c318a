"""Whether a route keeps VROOM's rules, told in VROOM's words, whatever the planner says."""

from collections.abc import Iterator, Sequence

from model.dialects.vroom.places import Sites
from model.dialects.vroom.request import Job, Request
from model.dialects.vroom.timing import NO_WAY, RouteTimer, TimedVroomRoute, loads_on
from model.dialects.vroom.windows import TIME_SCALE
from model.planner import PlanCheckError


def route_faults(request: Request, places: Sites, vehicle: int,
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
            yield (f"Missing skill or step out of reach for vehicle {stated.id} and "
                   f"{job.kind} {job.id}.")
    for end in _unpaired(request, jobs):
        yield f"Shipment out of order for vehicle {stated.id} and {end.kind} {end.id}."
    if not _fits(visited, stated.capacity):
        yield f"Route over capacity for vehicle {stated.id}."
    if stated.max_tasks is not None and len(jobs) > stated.max_tasks:
        yield f"Too many tasks for vehicle {stated.id}."
    driver = RouteTimer(request, places, vehicle)
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


def drive(request: Request, places: Sites, vehicle: int, jobs: Sequence[int]) -> TimedVroomRoute:
    """Return the times of a route.

    Raises
    ------
    PlanCheckError
        If it breaks a rule.
    """
    faults = list(route_faults(request, places, vehicle, jobs))
    route = RouteTimer(request, places, vehicle).drive(jobs)
    if faults or route is None:
        raise PlanCheckError(" ".join(faults))
    return route


def _fits(jobs: Sequence[Job], capacity: Sequence[int]) -> bool:
    """Tell whether the load stays within the capacity all the way."""
    return all(load <= most for loads in loads_on(jobs, len(capacity))
               for load, most in zip(loads, capacity, strict=True))


def _unpaired(request: Request, jobs: Sequence[int]) -> Iterator[Job]:
    """Yield the ends of shipments whose other end isn't on the route, in its order."""
    place = {job: index for index, job in enumerate(jobs)}
    for job, index in place.items():
        mate, kind = request.jobs[job].mate, request.jobs[job].kind
        if mate is not None and (mate not in place or (index < place[mate]) != (kind == "pickup")):
            yield request.jobs[job]
