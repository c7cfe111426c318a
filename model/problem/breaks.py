"""Breaks of those who drive."""

from dataclasses import dataclass

from model.problem.quantities import (
    UNLIMITED, Milliseconds, Parts, TimeLimit, require, require_units,
)

MAX_BREAKS = 8
"""Breaks of one vehicle."""


@dataclass(frozen=True)
class Break:
    """A break of a vehicle's driver, which begins within a window."""

    id: str
    duration: Milliseconds
    earliest: TimeLimit = 0  # begin, since plan start, or since the vehicle's begin
    latest: TimeLimit = UNLIMITED
    after_departure: bool = False  # the window is since the vehicle's begin
    anywhere: bool = False  # on the way, too, else at stops alone
    paid: bool = True  # counts in the working duration
    max_load: tuple[Parts, ...] | None = None  # (dimension,) aboard; None: any

    def __post_init__(self) -> None:
        require_units(self, f"break {self.id}")
        require(self.earliest <= self.latest, f"break {self.id} latest", self.latest)
