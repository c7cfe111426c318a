"""Bytes -> a valid `VroomRequest`, or the error that VROOM would report.

What one field tells is checked by the schema, what places and matrices tell in
`app.formats.vroom.places`, and what only the planner can't do in `model.dialects.vroom`.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import pairwise

from pydantic import ValidationError
from pydantic_core import from_json

from app.formats.vroom.errors import INPUT, TOO_LARGE, VroomError, input_error
from app.formats.vroom.schemas import DEFAULT_COST_PER_HOUR, VroomRequest, VroomVehicleInput
from app.formats.vroom.tasks import VroomTask, tasks_of
from app.requests.refusal import MAX_COUNTED_ERRORS, require_readable
from app.schemas.errors import InvalidRequestError, schema_error

LEAST_SPEED_FACTOR, MAX_SPEED_FACTOR = 0.01, 5.0

MAX_ALL_WINDOWS = 100_000
"""Most time windows of all jobs together."""

STEP_TYPES = ("job", "pickup", "delivery", "break")

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
    tasks = tasks_of(request)
    if len(tasks) > max_jobs:
        raise VroomError(TOO_LARGE, f"Too many locations ({len(tasks)}) in query, maximum is set "
                                    f"to {max_jobs}")
    if len(request.vehicles) > max_vehicles:
        raise VroomError(TOO_LARGE, f"Too many vehicles ({len(request.vehicles)}) in query, "
                                    f"maximum is set to {max_vehicles}")
    windows = sum(len(task.stated.time_windows or ()) for task in tasks)
    if windows > MAX_ALL_WINDOWS:
        raise VroomError(TOO_LARGE, f"Too many time windows ({windows}) of all jobs, maximum is "
                                    f"{MAX_ALL_WINDOWS}")
    faults = [*_faults(request, tasks)]
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


def _faults(request: VroomRequest, tasks: Sequence[VroomTask]) -> Faults:
    if not request.vehicles:
        yield "No vehicle defined."
        return
    if not tasks:
        yield "No task defined."
    yield from _repeated("vehicle", [vehicle.id for vehicle in request.vehicles])
    for kind in ("job", "pickup", "delivery"):
        yield from _repeated(kind, [task.id for task in tasks if task.kind == kind])
    for vehicle in request.vehicles:
        yield from _vehicle_faults(request, vehicle)
        yield from _break_faults(request, vehicle)
    yield from _job_faults(request)
    yield from _shipment_faults(request)
    yield from _place_faults(tasks)
    yield from _step_faults(request, tasks)


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


def _break_faults(request: VroomRequest, vehicle: VroomVehicleInput) -> Faults:
    yield from _repeated("break", [each.id for each in vehicle.breaks])
    for each in vehicle.breaks:
        if each.max_load is not None and len(each.max_load) != len(vehicle.capacity or ()):
            yield f"Inconsistent break max_load size for break {each.id}."
        if each.time_windows is not None:
            yield from _window_faults("break", each.id, sorted(each.time_windows))


def _job_faults(request: VroomRequest) -> Faults:
    for job in request.jobs:
        for side in ("delivery", "pickup"):
            amounts = getattr(job, side)
            if amounts is not None:
                yield from _size_faults(request, f"{side} of job {job.id}", len(amounts))
        if job.amount is not None and (job.delivery is not None or job.pickup is not None):
            yield f"amount of job {job.id} is the old name of delivery: leave it out."
        elif job.amount:
            yield from _size_faults(request, f"delivery of job {job.id}", len(job.amount))


def _shipment_faults(request: VroomRequest) -> Faults:
    for shipment in request.shipments:
        if shipment.amount is not None:
            yield from _size_faults(request, f"amount of shipment {shipment.pickup.id}",
                                    len(shipment.amount))


def _place_faults(tasks: Sequence[VroomTask]) -> Faults:
    for task in tasks:
        stated = task.stated
        if stated.location is None and stated.location_index is None:
            yield f"Invalid location for {task.kind} {task.id}."
        if stated.time_windows is not None:
            yield from _window_faults(task.kind, task.id, sorted(stated.time_windows))


def _window_faults(kind: str, number: int, windows: list[tuple[int, int]]) -> Faults:
    if not windows:
        yield f"Empty time windows for {kind} {number}."
    for begin, end in windows:
        if begin > end:
            yield f"Invalid time window: [{begin}, {end}]"
    if any(following <= end for (_, end), (following, _) in pairwise(windows)):
        yield f"Unsorted or overlapping time-windows for {kind} {number}."


def _step_faults(request: VroomRequest, tasks: Sequence[VroomTask]) -> Faults:
    known = {(task.kind, task.id) for task in tasks}
    planned: set[tuple[str, int]] = set()
    for vehicle in request.vehicles:
        rests = {("break", each.id) for each in vehicle.breaks}
        last = len(vehicle.steps) - 1
        taken: set[tuple[str, int]] = set()
        for place, step in enumerate(vehicle.steps):
            if (step.type == "start" and place != 0) or (step.type == "end" and place != last):
                yield f"Unexpected {step.type} in input steps for vehicle {vehicle.id}."
            elif step.type in ("start", "end"):
                continue
            elif step.id is None:
                yield f"Invalid id in steps for vehicle {vehicle.id}."
            elif step.type not in STEP_TYPES:
                yield f"Invalid type in steps for vehicle {vehicle.id}."
            elif (step.type, step.id) not in known | rests:
                yield f"Invalid {step.type} id {step.id} for vehicle {vehicle.id}."
            elif (step.type, step.id) in planned | taken:
                yield (f"Duplicate {step.type} id {step.id} in input steps for vehicle "
                       f"{vehicle.id}.")
            else:
                (taken if step.type == "break" else planned).add((step.type, step.id))
