"""Work past what a shift, or a longest working duration, allows without it."""

from dataclasses import dataclass

NO_END = 2**42
"""Stands for any length, as `UNLIMITED` does in a problem."""


@dataclass(frozen=True)
class Overtime:
    """Work past the end of the shift, or the longest working duration, whichever is longer past."""

    cost_per_hour: float  # beside that of working time
    max_duration: int = NO_END

    def __post_init__(self) -> None:
        if not 0 <= self.cost_per_hour < float("inf"):
            raise ValueError(f"overtime cost_per_hour: {self.cost_per_hour!r} is not allowed")
        if not 0 <= self.max_duration <= NO_END:
            raise ValueError(f"overtime max_duration: {self.max_duration!r} is not allowed")
