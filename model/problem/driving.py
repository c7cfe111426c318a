"""How long somebody may be at the wheel, and at work, without a rest."""

from dataclasses import dataclass

from model.problem.quantities import UNLIMITED, require, require_quantity

REST = -1
"""Number of a break that is a rest by these rules, and none of those stated."""


@dataclass(frozen=True)
class DrivingRules:
    """What a driver's rests have to be. Times in ms; driving is time on legs alone."""

    max_driving: int  # at the wheel without a rest
    rest: int  # length of a rest
    split: tuple[int, ...] = ()  # lengths of two rests, in order, that are as good together
    max_driving_per_day: int = UNLIMITED
    max_work: int = UNLIMITED  # from the route's beginning, or a rest, to the next one, or its end
    driven_before: int = 0  # since the last rest, and so that day, before the route begins
    worked_before: int = 0  # since the last rest
    while_drones_fly: bool = True  # whether a rest may lie in a flight
    half_rested_before: bool = False  # the first part of a split rest was taken since the last one

    def __post_init__(self) -> None:
        require(1 <= self.max_driving <= UNLIMITED, "driving_rules max_driving", self.max_driving)
        require(1 <= self.max_work <= UNLIMITED, "driving_rules max_work", self.max_work)
        require_quantity("driving_rules rest", self.rest)
        require(len(self.split) in (0, 2), "driving_rules split", self.split)
        for part in self.split:
            require_quantity("driving_rules split", part)
        require_quantity("driving_rules max_driving_per_day", self.max_driving_per_day, UNLIMITED)
        require_quantity("driving_rules driven_before", self.driven_before)
        require_quantity("driving_rules worked_before", self.worked_before)
