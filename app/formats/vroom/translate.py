"""What VROOM's request says -> what the planner's dialect plans."""

from collections.abc import Mapping

from app.formats.vroom.schemas import (
    MAX_UINT, VroomBreakInput, VroomRequest, VroomStepInput, VroomVehicleInput, Windows,
)
from app.formats.vroom.tasks import VroomTask, tasks_of
from model.dialects.vroom.request import (
    Costs, GivenRoute, Job, Request, StartBounds, VroomBreak, VroomVehicle, Window,
)


def translate(stated: VroomRequest) -> Request:
    """Return the jobs and vehicles of a valid request."""
    tasks = tasks_of(stated)
    index_of: dict[tuple[str, int], int] = {(task.kind, task.id): index
                                            for index, task in enumerate(tasks)}
    return Request(tuple(map(_job, tasks)),
                   tuple(_vehicle(vehicle, index_of) for vehicle in stated.vehicles))


def given_routes(stated: VroomRequest) -> list[GivenRoute]:
    """Return the routes that are stated step by step, none that does nothing."""
    index_of: dict[tuple[str, int], int] = {(task.kind, task.id): index
                                            for index, task in enumerate(tasks_of(stated))}
    routes = [_given(number, vehicle, index_of) for number, vehicle in enumerate(stated.vehicles)]
    return [route for route in routes if route.jobs or route.rests]


def _given(number: int, vehicle: VroomVehicleInput,
           index_of: Mapping[tuple[str, int], int]) -> GivenRoute:
    number_of = {each.id: index for index, each in enumerate(breaks_of(vehicle))}
    jobs, rests = list[tuple[int, StartBounds]](), list[tuple[tuple[int, int], StartBounds]]()
    ends = {"start": StartBounds(), "end": StartBounds()}
    for step in vehicle.steps:
        bounds = _bounds(step)
        if step.type in ends or step.id is None:
            ends[step.type] = bounds
        elif step.type == "break":
            rests.append(((number_of[step.id], len(jobs)), bounds))
        else:
            jobs.append((index_of[step.type, step.id], bounds))
    return GivenRoute(
        number, tuple(job for job, _ in jobs), tuple(rest for rest, _ in rests), ends["start"],
        ends["end"], tuple(bounds for _, bounds in jobs), tuple(bounds for _, bounds in rests))


def _bounds(step: VroomStepInput) -> StartBounds:
    """Return when a step has to start: then, or between two times."""
    at = [] if step.service_at is None else [step.service_at]
    after = [time for time in (*at, step.service_after) if time is not None]
    before = [time for time in (*at, step.service_before) if time is not None]
    return StartBounds(max(after, default=None), min(before, default=None))


def _job(task: VroomTask) -> Job:
    stated = task.stated
    return Job(
        id=stated.id, setup=stated.setup, service=stated.service,
        setup_per_type=stated.setup_per_type, service_per_type=stated.service_per_type,
        delivery=task.delivery, pickup=task.pickup, skills=frozenset(task.skills),
        priority=task.priority, time_windows=_windows(stated.time_windows), kind=task.kind,
        mate=task.mate)


def _windows(stated: Windows | None) -> tuple[Window, ...] | None:
    return None if stated is None else tuple(sorted(stated))


def breaks_of(stated: VroomVehicleInput) -> list[VroomBreakInput]:
    """Return the breaks of a vehicle in the order in which they are taken."""
    return sorted(stated.breaks, key=lambda each: min(each.time_windows or [(0, MAX_UINT)]))


def _vehicle(stated: VroomVehicleInput, index_of: Mapping[tuple[str, int], int]) -> VroomVehicle:
    costs = stated.costs
    return VroomVehicle(
        id=stated.id, profile=stated.profile, capacity=tuple(stated.capacity or ()),
        costs=Costs(costs.fixed, costs.per_hour, costs.per_km, costs.per_task_hour),
        skills=frozenset(stated.skills), type=stated.type, time_window=stated.time_window,
        speed_factor=stated.speed_factor, max_tasks=stated.max_tasks,
        max_travel_time=stated.max_travel_time, max_distance=stated.max_distance,
        steps=tuple(index_of[step.type, step.id] for step in stated.steps
                    if step.id is not None and (step.type, step.id) in index_of),
        breaks=tuple(VroomBreak(each.id, each.service, _windows(each.time_windows),
                                None if each.max_load is None else tuple(each.max_load))
                     for each in breaks_of(stated)))
