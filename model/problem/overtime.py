"""Work past what a shift, or a longest working duration, allows without it."""

from dataclasses import dataclass

from model.problem.quantities import UNLIMITED, MoneyPerHour, TimeLimit, require_units


@dataclass(frozen=True)
class Overtime:
    """Work past the end of the shift, or the longest working duration, whichever is longer past."""

    cost_per_hour: MoneyPerHour  # beside that of working time
    max_duration: TimeLimit = UNLIMITED

    def __post_init__(self) -> None:
        require_units(self, "overtime")
