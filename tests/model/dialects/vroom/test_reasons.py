"""Why jobs are left out."""

from typing import Any

import pytest

from model.dialects.vroom.kinds import find_kinds
from model.dialects.vroom.reasons import FULL, reasons_of
from tests.model.dialects.vroom.drawn import read

Data = dict[str, Any]


@pytest.mark.parametrize(("vehicle", "job", "used", "reason"), [
    ({}, {"skills": [7]}, [], "Missing skill or step out of reach for vehicle 5 and job 1."),
    ({}, {"delivery": [3]}, [], "Route over capacity for vehicle 5."),
    ({}, {"time_windows": [[0, 5]]}, [], "Infeasible route for vehicle 5."),
    ({"max_travel_time": 19}, {}, [], "Route over max_travel_time for vehicle 5."),
    ({"time_window": [100, 500], "breaks": [
        {"id": 7, "time_windows": [[100, 200]]}, {"id": 8, "time_windows": [[0, 20], [40, 50]]}]},
     {}, [], "Break 8 of vehicle 5 starts by 50 at the latest, and the vehicle begins at 100."),
    ({"time_window": [100, 500], "breaks": [
        {"id": 7, "time_windows": [[480, 600]], "service": 30}]},
     {}, [], "Break 7 of vehicle 5 isn't over before 510, and the vehicle ends at 500."),
    ({"time_window": [100, 500], "breaks": [{"id": 7, "service": 390}]}, {}, [],
     "Breaks leave vehicle 5 no time for it."),
    ({"time_window": [0, 10], "breaks": [{"id": 7, "time_windows": [[20, 30]]}]}, {}, [],
     "Infeasible route for vehicle 5."),
    ({}, {}, [0], FULL),
    ({}, {}, [], "Vehicle 5 is free and could serve it: no such plan was found in time.")])
def test_reasons_are_told_in_words(vehicle: Data, job: Data, used: list[int], reason: str) -> None:
    request, places = read({
        "vehicles": [{"id": 5, "start_index": 0, "end_index": 0, "capacity": [2]} | vehicle],
        "jobs": [{"id": 1, "location_index": 1} | job],
        "matrices": {"car": {"durations": [[0, 10], [10, 0]]}}})
    kinds = find_kinds(request, places)
    assert reasons_of(request, places, kinds, used, [0]) == {0: [reason]}


def test_ends_of_a_shipment_are_left_out_for_the_same_reason() -> None:
    request, places = read({
        "vehicles": [{"id": 5, "start_index": 0, "capacity": [2], "max_tasks": 1}], "jobs": [],
        "shipments": [{"pickup": {"id": 1, "location_index": 1},
                       "delivery": {"id": 1, "location_index": 0}}],
        "matrices": {"car": {"durations": [[0, 10], [10, 0]]}}})
    found = reasons_of(request, places, find_kinds(request, places), [], [0, 1])
    assert found[0] == found[1] == ["Too many tasks for vehicle 5."]
