"""Bytes -> a valid `VroomRequest`, or the error that VROOM would report.

What one field tells is checked by the schema, what places and matrices tell in
`app.formats.vroom.places`, and what only the planner can't do in `model.dialects.vroom`.
"""

from collections import Counter
from collections.abc import Iterator
from itertools import pairwise

from pydantic import ValidationError
from pydantic_core import from_json

from app.formats.vroom.errors import INPUT, TOO_LARGE, VroomError, input_error
from app.formats.vroom.schemas import DEFAULT_COST_PER_HOUR, VroomRequest, VroomVehicleInput
from app.formats.vroom.translate import amount_of
from app.requests.refusal import MAX_COUNTED_ERRORS, require_readable
from app.schemas.errors import InvalidRequestError, schema_error

LEAST_SPEED_FACTOR, MAX_SPEED_FACTOR = 0.01, 5.0

MAX_ALL_WINDOWS = 100_000
"""Most time windows of all jobs together."""

Faults = Iterator[str]


def read_request(body: bytes, max_jobs: int, max_vehicles: int) -> VroomRequest:
    """Return the request that `body` holds.

    Raises
    ------
    VroomError
        If it is no valid request, is too large, or asks for what can't be planned here.
    """
    try:
        require_readable(body, VroomRequest)
        request = VroomRequest.model_validate_json(body)
    except ValidationError as error:
        raise _refusal(error, body) from error
    except InvalidRequestError as error:
        raise input_error([f"{fault.path}: {fault.message}" for fault in error.errors]) from error
    if len(request.jobs) > max_jobs:
        raise VroomError(TOO_LARGE, f"Too many locations ({len(request.jobs)}) in query, maximum "
                                    f"is set to {max_jobs}")
    if len(request.vehicles) > max_vehicles:
        raise VroomError(TOO_LARGE, f"Too many vehicles ({len(request.vehicles)}) in query, "
                                    f"maximum is set to {max_vehicles}")
    windows = sum(len(job.time_windows or ()) for job in request.jobs)
    if windows > MAX_ALL_WINDOWS:
        raise VroomError(TOO_LARGE, f"Too many time windows ({windows}) of all jobs, maximum is "
                                    f"{MAX_ALL_WINDOWS}")
    faults = [*_refused(request), *_faults(request)]
    if faults:
        raise input_error(faults)
    return request


def _refusal(error: ValidationError, body: bytes) -> VroomError:
    try:
        from_json(body)
    except ValueError as not_json:
        return VroomError(INPUT, f"The body is not JSON: {not_json}.")
    if error.error_count() > MAX_COUNTED_ERRORS:
        return VroomError(INPUT, f"The request has {error.error_count()} errors.")
    found = [schema_error(details) for details in error.errors(include_url=False)]
    return input_error([f"{fault.path}: {fault.message}" for fault in found])


def _refused(request: VroomRequest) -> Faults:
    """Name what VROOM does and the planner can't do."""
    if request.options.c:
        yield "options.c: ETAs for given routes aren't computed here: leave it out."
    if request.shipments:
        yield ("shipments: goods can't be taken from one place of a route to another here: state "
               "jobs with delivery or pickup.")
    for vehicle in request.vehicles:
        if vehicle.breaks:
            yield (f"breaks of vehicle {vehicle.id}: breaks can't be planned here: state a shorter "
                   "time_window, or two vehicles.")
        for step in vehicle.steps:
            for name in ("service_at", "service_after", "service_before"):
                if getattr(step, name) is not None:
                    yield (f"{name} in steps for vehicle {vehicle.id}: times can't be forced here: "
                           "state time_windows of the job.")


def _faults(request: VroomRequest) -> Faults:
    if not request.vehicles:
        yield "No vehicle defined."
        return
    if not request.jobs and not request.shipments:
        yield "No task defined."
    yield from _repeated("vehicle", [vehicle.id for vehicle in request.vehicles])
    yield from _repeated("job", [job.id for job in request.jobs])
    for vehicle in request.vehicles:
        yield from _vehicle_faults(request, vehicle)
    yield from _job_faults(request)
    yield from _step_faults(request)


def _repeated(kind: str, ids: list[int]) -> Faults:
    for number, count in Counter(ids).items():
        if count > 1:
            yield f"Duplicate {kind} id: {number}."


def _vehicle_faults(request: VroomRequest, vehicle: VroomVehicleInput) -> Faults:
    places = (vehicle.start, vehicle.start_index, vehicle.end, vehicle.end_index)
    if all(place is None for place in places):
        yield f"No start or end specified for vehicle {vehicle.id}."
    yield from _size_faults(request, f"capacity of vehicle {vehicle.id}",
                            len(vehicle.capacity or ()))
    if not LEAST_SPEED_FACTOR <= vehicle.speed_factor <= MAX_SPEED_FACTOR:
        yield f"Invalid speed factor: {vehicle.speed_factor:g}"
    if vehicle.time_window is not None and vehicle.time_window[0] > vehicle.time_window[1]:
        yield f"Invalid time window: [{vehicle.time_window[0]}, {vehicle.time_window[1]}]"
    matrices = (request.matrices or {}).get(vehicle.profile)
    if matrices is not None and matrices.costs is not None:
        if vehicle.costs.per_hour != DEFAULT_COST_PER_HOUR:
            yield "Custom costs are incompatible with using a per_hour value."
        if vehicle.costs.per_km:
            yield "Custom costs are incompatible with using a per_km value."


def _size_faults(request: VroomRequest, name: str, size: int) -> Faults:
    first = request.vehicles[0]
    wanted = len(first.capacity or ())
    if size == wanted:
        return
    holds = f"{wanted} by the capacity of vehicle {first.id}"
    if first.capacity is None:
        holds = f"none, since vehicle {first.id} has no capacity: state one, or leave amounts out"
    yield (f"Inconsistent delivery length: {size} instead of {wanted}. "
           f"The {name} states {size}, there are {holds}.")


def _job_faults(request: VroomRequest) -> Faults:
    for job in request.jobs:
        if job.location is None and job.location_index is None:
            yield f"Invalid location for job {job.id}."
        for side in ("delivery", "pickup"):
            if amount_of(job, side) or getattr(job, side) is not None:
                yield from _size_faults(request, f"{side} of job {job.id}",
                                        len(amount_of(job, side)))
        if job.amount is not None and (job.delivery is not None or job.pickup is not None):
            yield f"amount of job {job.id} is the old name of delivery: leave it out."
        if job.time_windows is not None:
            yield from _window_faults(job.id, sorted(job.time_windows))


def _window_faults(number: int, windows: list[tuple[int, int]]) -> Faults:
    if not windows:
        yield f"Empty time windows for job {number}."
    for begin, end in windows:
        if begin > end:
            yield f"Invalid time window: [{begin}, {end}]"
    if any(following <= end for (_, end), (following, _) in pairwise(windows)):
        yield f"Unsorted or overlapping time-windows for job {number}."


def _step_faults(request: VroomRequest) -> Faults:
    known = {job.id for job in request.jobs}
    planned: set[int] = set()
    for vehicle in request.vehicles:
        last = len(vehicle.steps) - 1
        for place, step in enumerate(vehicle.steps):
            if (step.type == "start" and place != 0) or (step.type == "end" and place != last):
                yield f"Unexpected {step.type} in input steps for vehicle {vehicle.id}."
            elif step.type in ("start", "end"):
                continue
            elif step.id is None:
                yield f"Invalid id in steps for vehicle {vehicle.id}."
            elif step.type in ("break", "pickup", "delivery"):
                yield f"Invalid {step.type} id {step.id} for vehicle {vehicle.id}."
            elif step.type != "job":
                yield f"Invalid type in steps for vehicle {vehicle.id}."
            elif step.id not in known:
                yield f"Invalid job id {step.id} for vehicle {vehicle.id}."
            elif step.id in planned:
                yield (f"Duplicate job id {step.id} in input steps for vehicle {vehicle.id}.")
            planned.add(step.id if step.id is not None else -1)
