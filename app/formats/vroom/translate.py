"""What VROOM's request says -> what the planner's dialect plans."""

from collections.abc import Mapping

from app.formats.vroom.schemas import VroomJobInput, VroomRequest, VroomVehicleInput
from model.dialects.vroom.request import Costs, Job, Request, Vehicle


def translate(stated: VroomRequest) -> Request:
    """Return the jobs and vehicles of a valid request."""
    index_of = {job.id: index for index, job in enumerate(stated.jobs)}
    return Request(tuple(_job(job) for job in stated.jobs),
                   tuple(_vehicle(vehicle, index_of) for vehicle in stated.vehicles))


def amount_of(job: VroomJobInput, side: str) -> tuple[int, ...]:
    """Return what a job takes (`pickup`) or is brought (`delivery`); empty: nothing."""
    if side == "pickup":
        return tuple(job.pickup or ())
    if job.delivery is None and job.pickup is None:
        return tuple(job.amount or ())
    return tuple(job.delivery or ())


def _job(stated: VroomJobInput) -> Job:
    windows = stated.time_windows
    return Job(
        id=stated.id, setup=stated.setup, service=stated.service,
        setup_per_type=stated.setup_per_type, service_per_type=stated.service_per_type,
        delivery=amount_of(stated, "delivery"), pickup=amount_of(stated, "pickup"),
        skills=frozenset(stated.skills), priority=stated.priority,
        time_windows=None if windows is None else tuple(windows))


def _vehicle(stated: VroomVehicleInput, index_of: Mapping[int, int]) -> Vehicle:
    costs = stated.costs
    return Vehicle(
        id=stated.id, profile=stated.profile, capacity=tuple(stated.capacity or ()),
        costs=Costs(costs.fixed, costs.per_hour, costs.per_km, costs.per_task_hour),
        skills=frozenset(stated.skills), type=stated.type, time_window=stated.time_window,
        speed_factor=stated.speed_factor, max_tasks=stated.max_tasks,
        max_travel_time=stated.max_travel_time, max_distance=stated.max_distance,
        steps=tuple(index_of[step.id] for step in stated.steps if step.id is not None))
