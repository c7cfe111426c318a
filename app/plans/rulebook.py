"""The published rules that a request names, as a reply states them."""

from typing import Any

from app.schemas.request import PlanRequest
from app.schemas.rulebook import RULES


def rules_named(request: PlanRequest) -> list[dict[str, Any]]:
    """Return the numbers of each rule that a type of drones names, and by which it is planned."""
    return [{
        "vehicle_type": kind.id,
        **({} if drones.id is None else {"drone_type": drones.id}),
        "preset": drones.preset,
        **RULES[drones.preset]._asdict(),
        "planned": {"max_airborne": kind.max_airborne, "truck_waits": kind.truck_waits,
                    "max_range": drones.max_range, "altitude": drones.altitude},
    } for kind in request.fleet for drones in kind.drone_types if drones.preset is not None]
