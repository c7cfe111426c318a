"""Jobs planned by threads, as a service has it that is given a planner."""

from functools import partial

from app.maps.roads.asked import KnownRoads, answers_of
from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.desk import PlanDesk
from app.plans.workplace import opened_with
from app.requests.bounds import Bounds
from app.serving.children.pool import Pool
from app.serving.children.starting import threads
from app.serving.observe.metrics import Metrics
from app.serving.settings import Settings
from model.planner import Planner

MOST = 8


def planned_by(planner: Planner, settings: Settings, roads: Roads = NO_ROADS) -> PlanDesk:
    """Return who has plans made by a planner."""
    start = threads(partial(opened_with, planner, settings, KnownRoads.of(roads)))
    return PlanDesk(Pool(start, MOST, answers_of(roads)), planner.policies,
                    Bounds.of_plans(settings), roads, Metrics("test"), lambda _: None)
