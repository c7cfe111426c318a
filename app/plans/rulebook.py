"""The published rules that a request names, as a reply states them."""

from typing import Any

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
