"""How long somebody may be at the wheel, and at work, without a rest."""

from dataclasses import dataclass

from model.problem.quantities import UNLIMITED, Milliseconds, TimeLimit, require, require_units

REST = -1
"""Number of a break that is a rest by these rules, and none of those stated."""


@dataclass(frozen=True)
class DrivingRules:
    """What a driver's rests have to be. Driving is time on legs alone."""

    max_driving: TimeLimit  # at the wheel without a rest
    rest: Milliseconds  # length of a rest
    split: tuple[Milliseconds, ...] = ()  # two rests, in order, that are as good together
    max_driving_per_day: TimeLimit = UNLIMITED
    max_work: TimeLimit = UNLIMITED  # from the route's beginning, or a rest, to a rest, or its end
    driven_before: Milliseconds = 0  # since the last rest, and so that day, before the route begins
    worked_before: Milliseconds = 0  # since the last rest
    while_drones_fly: bool = True  # whether a rest may lie in a flight
    other_work_interrupts: bool = False  # that lasts as long as a rest: driving counts anew then
    half_rested_before: bool = False  # the first part of a split rest was taken since the last one

    def __post_init__(self) -> None:
        require_units(self, "driving_rules")
        require(self.max_driving >= 1, "driving_rules max_driving", self.max_driving)
        require(self.max_work >= 1, "driving_rules max_work", self.max_work)
        require(len(self.split) in (0, 2), "driving_rules split", self.split)
