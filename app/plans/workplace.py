"""What plans are made with, in the process that makes them."""

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from pydantic_core import from_json, to_json

from app.maps.roads.asked import AskedRoads, KnownRoads
from app.plans.quoted_plans import QuotedPlans, quoted_plans
from app.plans.service import PlanService
from app.requests.bounds import Bounds
from app.requests.shapes import shape_of
from app.schemas.openapi import EXAMPLES_DIR
from app.schemas.request import PlanRequest
from app.serving.children.line import Line
from app.serving.load.received import ReceivedBody
from app.serving.observe.metrics import countable, countable_vroom
from app.serving.settings import Settings
from model.planner import Planner, load_planner

WARMING_SECONDS = 10.0
"""Time limit of a plan that otherwise takes milliseconds, for a machine that is busy."""


def warmed(planner: Planner) -> Planner:
    """Return a planner once it has planned by each of its policies.

    What plans need is loaded by the first, which takes longer than the shortest time limits, and
    the shape of long requests is made.
    """
    shape_of(PlanRequest)
    service = PlanService(planner)
    example = from_json((EXAMPLES_DIR / "drones.json").read_bytes())
    for policy in planner.policies:
        options = {"policy": policy, "time_limit": WARMING_SECONDS, "search_iterations": 1}
        service.plan(ReceivedBody(to_json(example | {"options": options}), time.perf_counter()))
    return planner


PLAN, VROOM_PLAN, REFUSED = "plan", "vroom plan", "refused"
"""What is told of plans found, as far as they are counted."""


@dataclass(frozen=True)
class Workplace:
    """A planner, and what else answers need."""

    service: PlanService
    settings: Settings
    line: Line
    quoted: QuotedPlans = field(default_factory=quoted_plans)

    @property
    def bounds(self) -> Bounds:
        """The bounds of `POST /plan`."""
        return Bounds.of_plans(self.settings)

    def count_plan(self, reply: Mapping[str, Any]) -> None:
        """Have a plan counted, told as its reply. In place."""
        self.line.tell(PLAN, countable(reply))

    def count_refused_plan(self) -> None:
        """Have a plan counted that was found and broke a rule. In place."""
        self.line.tell(REFUSED, None)

    def count_vroom_plan(self, reply: Mapping[str, Any]) -> None:
        """Have a plan of `POST /vroom` counted, told as its reply. In place."""
        self.line.tell(VROOM_PLAN, countable_vroom(reply))


def opened(settings: Settings, known: KnownRoads, line: Line) -> Workplace:
    """Return a workplace whose planner has planned already.

    Raises
    ------
    ValueError
        If a policy is missing or can't be read.
    """
    planner = load_planner(settings.weights_dir, settings.policies,
                           lambda: line.tell(REFUSED, None))
    return opened_with(warmed(planner), settings, known, line)


def opened_with(planner: Planner, settings: Settings, known: KnownRoads, line: Line) -> Workplace:
    """Return a workplace with a planner that is loaded."""
    service = PlanService(planner, settings.search_threads,
                          lambda reply: line.tell(PLAN, countable(reply)),
                          Bounds.of_plans(settings), AskedRoads(known, partial(line.ask)))
    return Workplace(service, settings, line)
