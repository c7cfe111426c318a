"""What drivers told -> how each step stands."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from app.records.dispatches.rows import EventRow
from app.records.dispatches.schemas import BREAKDOWN, Outcome, StepReply, StepStanding


@dataclass(frozen=True)
class ToldStep:
    """What was told last of a step."""

    outcome: Outcome
    time: float  # seconds since plan start
    reason: str | None = None


Standing = Mapping[str, ToldStep]
"""Steps of which something holds, by id."""


def standing_of(events: Iterable[EventRow], plan_start: int) -> Standing:
    """Return how steps stand: of what was told of one, the latest counts.

    Two phones may open one link, and what one tells late be older than what the other told.
    """
    last: dict[str, EventRow] = {}
    for event in sorted(events, key=lambda event: (event.time, event.number)):
        last[event.step] = event
    return {step: ToldStep("done" if event.kind == "done" else "failed",
                           (event.time - plan_start) / 1000, event.reason)
            for step, event in last.items() if event.kind != "undone"}


def standing_reply(standing: Standing, steps: Sequence[StepReply]) -> list[StepStanding]:
    """Return how steps stand of which something holds, in the steps' order; a breakdown first."""
    broken = standing.get(BREAKDOWN)
    vehicle = [] if broken is None else [StepStanding(
        id=BREAKDOWN, kind=BREAKDOWN, place="", state=broken.outcome, time=broken.time,
        reason=broken.reason)]
    return vehicle + [
        StepStanding(id=step.id, kind=step.kind, place=_place(step), state=told.outcome,
                     time=told.time, reason=told.reason,
                     late=max(0.0, told.time - step.time - step.duration))
        for step in steps if (told := standing.get(step.id)) is not None]


def is_broken(standing: Standing) -> bool:
    """Tell whether a vehicle has broken down."""
    return BREAKDOWN in standing and standing[BREAKDOWN].outcome == "failed"


def of_steps(standing: Standing) -> Standing:
    """Return what was told of steps alone."""
    return {step: told for step, told in standing.items() if step != BREAKDOWN}


def _place(step: StepReply) -> str:
    return step.place if step.drone is None else ", ".join(each.id for each in step.customers)
