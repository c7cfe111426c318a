"""What is planned, in VROOM's words: a valid request, whatever it was read from."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

Window = tuple[int, int]
"""The first second and the last."""

JobKind = Literal["job", "pickup", "delivery"]
"""A job of its own, or an end of a shipment."""


@dataclass(frozen=True, slots=True)
class Job:
    """A place to visit: a job, or an end of a shipment."""

    id: int  # unique among those of its kind
    setup: int  # s, unless the task before is at the same place
    service: int  # s
    setup_per_type: Mapping[str, int]  # s by `VroomVehicle.type`, instead of `setup`
    service_per_type: Mapping[str, int]
    delivery: tuple[int, ...]  # brought: from the start, or from the mate; empty: nothing
    pickup: tuple[int, ...]  # taken: to the end, or to the mate
    skills: frozenset[int]
    priority: int
    time_windows: tuple[Window, ...] | None  # when setup may start; None: at any time
    kind: JobKind = "job"
    mate: int | None = None  # index of the shipment's other end


@dataclass(frozen=True, slots=True)
class Costs:
    """What a vehicle costs."""

    fixed: int
    per_hour: int  # of travel
    per_km: int
    per_task_hour: int  # of setup and service


@dataclass(frozen=True, slots=True)
class VroomBreak:
    """A break of a vehicle, which each of its routes has."""

    id: int
    service: int  # s
    time_windows: tuple[Window, ...] | None  # when it may start, ascending; None: at any time
    max_load: tuple[int, ...] | None  # what may be aboard at most; None: anything


@dataclass(frozen=True, slots=True)
class VroomVehicle:
    """A vehicle."""

    id: int
    profile: str  # whose legs it drives
    capacity: tuple[int, ...]  # as many amounts as other vehicles have
    costs: Costs
    skills: frozenset[int]
    type: str
    time_window: Window | None
    speed_factor: float
    max_tasks: int | None
    max_travel_time: int | None  # s
    max_distance: int | None  # m
    steps: tuple[int, ...]  # indices of the jobs of a route to start from; empty: none
    breaks: tuple[VroomBreak, ...] = ()  # in the order in which they are taken


@dataclass(frozen=True, slots=True)
class StartBounds:
    """From and until when a step has to start, in seconds; None: any time."""

    after: int | None = None
    before: int | None = None


@dataclass(frozen=True, slots=True)
class GivenRoute:
    """A route that is stated step by step."""

    vehicle: int  # index into the request's vehicles
    jobs: tuple[int, ...]
    rests: tuple[tuple[int, int], ...]  # index into the vehicle's breaks, and jobs before it
    start: StartBounds
    end: StartBounds
    job_bounds: tuple[StartBounds, ...]
    rest_bounds: tuple[StartBounds, ...]


@dataclass(frozen=True)
class Request:
    """Jobs, and vehicles that serve them."""

    jobs: tuple[Job, ...]
    vehicles: tuple[VroomVehicle, ...]

    @cached_property
    def is_timed(self) -> bool:
        """Whether anything has a time window, as breaks do."""
        return (any(job.time_windows is not None for job in self.jobs)
                or any(vehicle.time_window is not None or vehicle.breaks
                       for vehicle in self.vehicles))
