"""A rest that a later trip brings to an earlier one doesn't keep a shipment there too long."""

from typing import Any

import httpx
import pytest

DRONES = {"count": 1, "capacity": [2], "speed_kmh": 60, "endurance": 2400, "recovery_duration": 30,
          "costs": {"per_km": 0.1}}
RULES = {"max_driving": 3000, "break_duration": 900, "max_work_before_break": 3600,
         "driven_before": 300, "while_drones_fly": True}
REQUEST: dict[str, Any] = {
    "coordinate_system": "planar", "planar_unit": 1000, "unassigned_cost": 1000,
    "depots": [{"id": "D", "location": [1.4, 5.6]}],
    "fleet": [{"id": "van", "count": 1, "capacity": [6], "depot": "D", "speed_kmh": 60,
               "costs": {"fixed": 5, "per_km": 1}, "drones": DRONES, "max_trips": 2,
               "reload_duration": 300, "driving_rules": RULES}],
    "customers": [
        {"id": "A", "location": [0.2, 7.0], "demand": [2], "service_duration": 333.333,
         "served_by": "either",
         "time_window": {"earliest": 0, "latest": 900, "late_cost_per_hour": 30, "late_cost": 10},
         "pickup": [1], "alternatives": [
             {"id": "other", "location": [6.2, 6.6], "cost": 1, "service_duration": 30}]},
        {"id": "B", "location": [-2.0, 0.8], "demand": [0], "service_duration": 333.333,
         "served_by": "either"},
        {"id": "C", "location": [6.1, -2.0], "demand": [2], "service_duration": 333.333,
         "served_by": "either"}],
    "shipments": [
        {"id": "far", "amount": [2], "pickup": {"location": [-2.5, -7.6]}, "max_detour": 1.5,
         "max_time_between": 900, "unassigned_cost": 500,
         "delivery": {"location": [0.7, 3.7], "service_duration": 60,
                      "time_window": {"earliest": 3600, "latest": 4500}}},
        {"id": "near", "amount": [0], "max_detour": 3,
         "pickup": {"location": [-1.4, 7.9], "service_duration": 300, "served_by": "either"},
         "delivery": {"location": [-1.6, 4.4], "served_by": "either"}}]}


@pytest.mark.parametrize("seed", [4, 9])
def test_no_plan_has_to_be_refused(service: httpx.Client, seed: int) -> None:
    options = {"time_limit": 30, "search_iterations": 20, "threads": 1, "seed": seed}
    reply = service.post("/plan", json={**REQUEST, "options": options})
    assert reply.status_code == 200, reply.text
    assert reply.json()["solver"]["plans_refused"] == 0
