"""Plans to draw, made by a planner without weights."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from pydantic_core import to_json

from app.plans.pictures.scene import DrawnPlan
from app.plans.service import PlanService
from app.requests.plan_reading import parse_plan
from app.requests.reading import read_request
from app.schemas.openapi import EXAMPLES_DIR
from tests.app.conftest import FirstFitPlanner

Request = dict[str, Any]
Drawn = Callable[..., DrawnPlan]


def planned(request: Request) -> Request:
    """Return the reply to a request."""
    service = PlanService(FirstFitPlanner())
    return dict(json.loads(service.reply_to(read_request(to_json(request), None), 0.0)))


def scene_of(request: Request, plan: Request | None = None) -> DrawnPlan:
    """Return what a picture shows of a plan, or of one made for it."""
    return DrawnPlan.judged(read_request(to_json(request), None),
                            parse_plan(to_json(planned(request) if plan is None else plan)))


@pytest.fixture
def rich() -> Request:
    """Return a request with two trips, a sortie, windows and a no-fly area, and one left out."""
    return {
        "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [
            {"id": "early", "location": [3, 4], "demand": [10], "service_duration": 300,
             "time_window": {"earliest": 3600, "latest": 7200}},
            {"id": "big", "location": [6, 0], "demand": [15], "service_duration": 300},
            {"id": "flown", "location": [2, -2], "demand": [1], "served_by": "drone"},
            {"id": "too-much", "location": [1, 5], "demand": [500]}],
        "fleet": [{"id": "truck", "count": 2, "capacity": [20], "max_trips": 2,
                   "reload_duration": 600,
                   "drones": {"count": 2, "capacity": [2], "launch_duration": 30,
                              "recovery_duration": 30}}],
        "airspace": {"no_fly": [[[1, 1], [2, 1], [2, 2]]]},
    }


@pytest.fixture
def two_trips(rich: Request) -> Request:
    """Return a plan of `rich` in which one truck drives twice and flies once."""
    def stop(name: str, arrival: float, service: float, departure: float) -> Request:
        kind = "depot" if name == "hub" else "customer"
        return {"kind": kind, "id": name, "arrival": arrival, "service_start": service,
                "departure": departure}

    flight = {"drone": "truck-1/drone-1", "launch_stop": 1, "recovery_stop": 2, "customers": [
        {"id": "flown", "arrival": 4300.0, "service_start": 4300.0, "departure": 4300.0}],
        "launch_time": 3930.0, "recovery_time": 4800.0}
    return {"routes": [{"vehicle": "truck-1", "type": "truck", "trips": [
        {"stops": [stop("hub", 0.0, 0.0, 3000.0), stop("early", 3450.0, 3600.0, 3930.0),
                   stop("hub", 4380.0, 4380.0, 4800.0)], "sorties": [flight]},
        {"stops": [stop("hub", 5400.0, 5400.0, 5400.0), stop("big", 5940.0, 5940.0, 6240.0),
                   stop("hub", 6780.0, 6780.0, 6780.0)], "sorties": []}]}],
        "unassigned": [{"id": "too-much"}]}


@pytest.fixture
def example() -> Callable[[str], Request]:
    """Return a function that reads an example."""
    return lambda name: dict(json.loads((EXAMPLES_DIR / f"{name}.json").read_text("utf-8")))
