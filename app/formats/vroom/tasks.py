"""What a request asks to be done: its jobs, then both ends of each of its shipments."""

from collections.abc import Iterator
from dataclasses import dataclass

from app.formats.vroom.schemas import Skills, VroomPlaceInput, VroomRequest
from model.dialects.vroom.request import JobKind


@dataclass(frozen=True, slots=True)
class VroomTask:
    """A job, or an end of a shipment."""

    kind: JobKind
    stated: VroomPlaceInput
    delivery: tuple[int, ...]  # brought there; empty: nothing
    pickup: tuple[int, ...]  # taken there
    skills: Skills
    priority: int
    mate: int | None = None  # index of the shipment's other end

    @property
    def id(self) -> int:
        """Its number, unique among those of its kind."""
        return self.stated.id


def tasks_of(request: VroomRequest) -> tuple[VroomTask, ...]:
    """Return the tasks of a request."""
    return (*_jobs(request), *_ends(request))


def _jobs(request: VroomRequest) -> Iterator[VroomTask]:
    for job in request.jobs:
        is_old = job.delivery is None and job.pickup is None
        delivery = job.amount if is_old else job.delivery
        yield VroomTask("job", job, tuple(delivery or ()), tuple(job.pickup or ()), job.skills,
                        job.priority)


def _ends(request: VroomRequest) -> Iterator[VroomTask]:
    first = len(request.jobs)
    for number, shipment in enumerate(request.shipments):
        amount = tuple(shipment.amount or ())
        pickup = first + 2 * number
        yield VroomTask("pickup", shipment.pickup, (), amount, shipment.skills,
                        shipment.priority, pickup + 1)
        yield VroomTask("delivery", shipment.delivery, amount, (), shipment.skills,
                        shipment.priority, pickup)
