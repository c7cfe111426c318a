"""The first plans of a process, made before anybody waits for them."""

import time

from pydantic_core import from_json, to_json

from app.plans.service import PlanService
from app.schemas.openapi import EXAMPLES_DIR
from app.serving.load.received import ReceivedBody
from model.planner import Planner

SECONDS = 10.0
"""Time limit of a plan that otherwise takes milliseconds, for a machine that is busy."""


def warmed(planner: Planner) -> Planner:
    """Return a planner once it has planned by each of its policies.

    What plans need is loaded by the first, which takes longer than the shortest time limits.
    """
    service = PlanService(planner)
    example = from_json((EXAMPLES_DIR / "drones.json").read_bytes())
    for policy in planner.policies:
        options = {"policy": policy, "time_limit": SECONDS, "search_iterations": 1}
        service.plan(ReceivedBody(to_json(example | {"options": options}), time.perf_counter()))
    return planner
