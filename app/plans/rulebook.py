"""The published rules that a request names, as a reply states them."""

from typing import Any

from app.schemas.driving import LAWS
from app.schemas.drones import DronesInput
from app.schemas.request import PlanRequest
from app.schemas.rulebook import RULES


def rules_named(request: PlanRequest) -> list[dict[str, Any]]:
    """Return the numbers of each rule that what flies names, and by which it is planned."""
    return [{
        "vehicle_type": kind.id,
        **({"drone_type": flyer.id} if isinstance(flyer, DronesInput) and flyer.id else {}),
        "preset": flyer.preset,
        **RULES[flyer.preset]._asdict(),
        "planned": {"max_airborne": kind.max_airborne, "truck_waits": kind.truck_waits,
                    "max_range": flyer.max_range, "altitude": flyer.altitude},
    } for kind in request.fleet for flyer in kind.flyers if flyer.preset is not None]


def laws_named(request: PlanRequest) -> list[dict[str, Any]]:
    """Return the numbers of all driving rules that are named, and by which it is planned."""
    return [{
        "vehicle_type": kind.id,
        "preset": kind.driving_rules.preset,
        **LAWS[kind.driving_rules.preset]._asdict(),
        "planned": {**kind.driving_rules.model_dump(include=set(PLANNED)),
                    "max_working_duration": kind.max_working_duration},
    } for kind in request.fleet
        if kind.driving_rules is not None and kind.driving_rules.preset is not None]


PLANNED = ("max_driving", "break_duration", "split", "max_driving_per_day",
           "max_work_before_break", "other_work_interrupts")
