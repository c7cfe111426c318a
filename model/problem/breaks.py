"""Breaks of those who drive."""

from dataclasses import dataclass

from model.problem.quantities import UNLIMITED, require, require_quantity

MAX_BREAKS = 8
"""Breaks of one vehicle."""


@dataclass(frozen=True)
class Break:
    """A break of a vehicle's driver, which begins within a window. Times in ms."""

    id: str
    duration: int
    earliest: int = 0  # begin, since plan start, or since the vehicle's begin
    latest: int = UNLIMITED
    after_departure: bool = False  # the window is since the vehicle's begin
    anywhere: bool = False  # on the way, too, else at stops alone
    paid: bool = True  # counts in the working duration
    max_load: tuple[int, ...] | None = None  # parts of each dimension aboard; None: any

    def __post_init__(self) -> None:
        require_quantity(f"break {self.id} duration", self.duration)
        require_quantity(f"break {self.id} earliest", self.earliest, UNLIMITED)
        for amount in self.max_load or ():
            require_quantity(f"break {self.id} max_load", amount)
        require(self.earliest <= self.latest <= UNLIMITED, f"break {self.id} latest", self.latest)
