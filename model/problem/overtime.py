"""Work past what a shift, or a longest working duration, allows without it."""

from dataclasses import dataclass

from model.problem.quantities import UNLIMITED


@dataclass(frozen=True)
class Overtime:
    """Work past the end of the shift, or the longest working duration, whichever is longer past."""

    cost_per_hour: float  # beside that of working time
    max_duration: int = UNLIMITED

    def __post_init__(self) -> None:
        if not 0 <= self.cost_per_hour < float("inf"):
            raise ValueError(f"overtime cost_per_hour: {self.cost_per_hour!r} is not allowed")
        if not 0 <= self.max_duration <= UNLIMITED:
            raise ValueError(f"overtime max_duration: {self.max_duration!r} is not allowed")
