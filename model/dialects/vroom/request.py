"""What is planned, in VROOM's words: a valid request, whatever it was read from."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

Window = tuple[int, int]
"""The first second and the last."""


@dataclass(frozen=True, slots=True)
class Job:
    """A place to visit."""

    id: int
    setup: int  # s, unless the task before is at the same place
    service: int  # s
    setup_per_type: Mapping[str, int]  # s by `Vehicle.type`, instead of `setup`
    service_per_type: Mapping[str, int]
    delivery: tuple[int, ...]  # brought from the start; empty: nothing
    pickup: tuple[int, ...]  # taken to the end
    skills: frozenset[int]
    priority: int
    time_windows: tuple[Window, ...] | None  # when setup may start; None: at any time


@dataclass(frozen=True, slots=True)
class Costs:
    """What a vehicle costs."""

    fixed: int
    per_hour: int  # of travel
    per_km: int
    per_task_hour: int  # of setup and service


@dataclass(frozen=True, slots=True)
class Vehicle:
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


@dataclass(frozen=True)
class Request:
    """Jobs, and vehicles that serve them."""

    jobs: tuple[Job, ...]
    vehicles: tuple[Vehicle, ...]

    @cached_property
    def is_timed(self) -> bool:
        """Whether anything has a time window."""
        return (any(job.time_windows is not None for job in self.jobs)
                or any(vehicle.time_window is not None for vehicle in self.vehicles))
