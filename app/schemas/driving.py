"""How long drivers may be at the wheel, and at work: rules as stated, and as published."""

from typing import Annotated, Literal, NamedTuple, Self

from pydantic import Field, model_validator

from app.schemas.fields import Duration, Input

HOUR = 3600.0

REST_ID = "rest"
"""Id of rests in plans."""

LawName = Literal["eu-561", "eu-561+2002-15", "us-hos"]

Positive = Annotated[Duration, Field(gt=0)]


class Law(NamedTuple):
    """The numbers of a published rule, in seconds; None where it has none."""

    max_driving: float
    break_duration: float
    split: tuple[float, ...] | None
    max_driving_per_day: float | None
    max_work_before_break: float | None
    max_working_duration: float | None
    other_work_interrupts: bool
    source: str


_EU = ("Regulation (EC) No 561/2006: nine hours of driving a day (6(1)), after four and a half "
       "hours a break of 45 minutes, or 15 and then 30 within them (7)")

LAWS: dict[LawName, Law] = {
    "eu-561": Law(4.5 * HOUR, 2700.0, (900.0, 1800.0), 9 * HOUR, None, None, False, _EU),
    "eu-561+2002-15": Law(
        4.5 * HOUR, 2700.0, (900.0, 1800.0), 9 * HOUR, 6 * HOUR, None, False,
        f"{_EU}; Directive 2002/15/EC: no more than six hours of work in a row, breaks of 30 "
        "minutes in all where more than six hours are worked, of 45 beyond nine (5); each break is "
        "taken as the regulation's, which is longer"),
    "us-hos": Law(
        8 * HOUR, 1800.0, None, 11 * HOUR, None, 14 * HOUR, True,
        "49 CFR 395.3(a): eleven hours of driving (3)(i) within fourteen hours on duty (2), after "
        "eight hours of driving 30 consecutive minutes not driving, at work or not (3)(ii)"),
}


class DrivingRulesInput(Input):
    """How long a driver may be at the wheel, or at work, before a rest."""

    preset: LawName | None = Field(
        None, description="A published rule, whose numbers hold where none are stated."
    )
    max_driving: Positive | None = Field(
        None, description="Longest time at the wheel without a rest in seconds. Null: no limit."
    )
    break_duration: Positive | None = Field(
        None, description="Length of a rest in seconds. Needed without `preset`."
    )
    split: Annotated[list[Positive], Field(min_length=2, max_length=2)] | None = Field(
        None, description="Two shorter rests in seconds that are as good as one, in this order. "
        "Null: a rest isn't divided."
    )
    max_driving_per_day: Positive | None = Field(
        None, description="Longest time at the wheel of one vehicle in seconds. Null: no limit."
    )
    max_work_before_break: Positive | None = Field(
        None, description="Longest time in seconds from the vehicle's first departure, or a rest, "
        "to the next rest, or the end. Null: no limit."
    )
    driven_before: Duration = Field(
        0.0, description="Seconds at the wheel since the last rest, before the vehicle begins. "
        "They count in the day's, too."
    )
    worked_before: Duration = Field(
        0.0, description="Seconds of work since the last rest, before the vehicle begins."
    )
    while_drones_fly: bool = Field(
        True, description="Whether a driver may rest while drones are out. With false not between "
        "the stops where one is launched and recovered."
    )

    other_work_interrupts: bool = Field(
        False, description="Whether `break_duration` without a break not at the wheel, at work or "
        "waiting, interrupts driving as a rest does. It is no rest for `max_work_before_break`."
    )

    @model_validator(mode="after")
    def _fill_in(self) -> Self:
        """Fill in what the rule named has and the request doesn't state."""
        if self.preset is not None:
            law = LAWS[self.preset]
            for name in ("max_driving", "break_duration", "max_driving_per_day",
                         "max_work_before_break", "other_work_interrupts"):
                if name not in self.model_fields_set:
                    object.__setattr__(self, name, getattr(law, name))
            if "split" not in self.model_fields_set and law.split is not None:
                object.__setattr__(self, "split", list(law.split))
        return self
