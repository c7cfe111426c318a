"""What is planned is what VROOM's request says."""

import json
from typing import Any

import pytest

from app.formats.vroom.errors import INPUT, TOO_LARGE, refused
from app.formats.vroom.schemas import VroomRequest
from app.formats.vroom.translate import translate
from model.dialects.vroom.errors import RefusedError, TooLargeError
from model.dialects.vroom.request import Job, Request, VroomVehicle


def translated(**stated: Any) -> Request:
    return translate(VroomRequest.model_validate_json(json.dumps(
        {"vehicles": [{"id": 1}], **stated})))


def job(**stated: Any) -> Job:
    return translated(jobs=[{"id": 1, **stated}]).jobs[0]


def vehicle(**stated: Any) -> VroomVehicle:
    return translated(vehicles=[{"id": 1, **stated}]).vehicles[0]


def test_names_that_are_the_same_mean_the_same() -> None:
    stated = VroomRequest.model_validate_json(json.dumps({
        "jobs": [{"id": 7, "setup": 1, "service": 2, "setup_per_type": {"van": 3},
                  "service_per_type": {"van": 4}, "priority": 5}],
        "vehicles": [{"id": 8, "profile": "bike", "type": "van", "time_window": [1, 2],
                      "speed_factor": 1.5, "max_tasks": 3, "max_travel_time": 4,
                      "max_distance": 5, "costs": {"fixed": 1, "per_hour": 2, "per_km": 3,
                                                   "per_task_hour": 4}}]}))
    meant = translate(stated)
    for before, after, names in (
            (stated.jobs[0], meant.jobs[0], "id setup service setup_per_type service_per_type "
                                            "priority"),
            (stated.vehicles[0], meant.vehicles[0], "id profile type time_window speed_factor "
                                                    "max_tasks max_travel_time max_distance"),
            (stated.vehicles[0].costs, meant.vehicles[0].costs,
             "fixed per_hour per_km per_task_hour")):
        for name in names.split():
            assert getattr(after, name) == getattr(before, name), name


def test_amount_is_a_delivery_where_nothing_else_is_stated() -> None:
    assert job(amount=[2, 3]).delivery == (2, 3)
    assert (job(delivery=[1], pickup=[4]).delivery, job(pickup=[4]).pickup) == ((1,), (4,))
    assert (job().delivery, job().pickup) == ((), ())


def test_skills_have_no_order() -> None:
    assert job(skills=[2, 1]).skills == vehicle(skills=[1, 2, 2]).skills


def test_capacity_that_is_not_stated_is_empty() -> None:
    assert (vehicle().capacity, vehicle(capacity=[3]).capacity) == ((), (3,))


def test_steps_name_jobs_by_their_place_in_the_request() -> None:
    request = translated(
        jobs=[{"id": 30}, {"id": 10}],
        vehicles=[{"id": 1, "steps": [{"type": "start"}, {"type": "job", "id": 10},
                                      {"type": "job", "id": 30}, {"type": "end"}]}])
    assert request.vehicles[0].steps == (1, 0)


@pytest.mark.parametrize(("stated", "is_timed"), [
    ({"jobs": [{"id": 1}], "vehicles": [{"id": 1}]}, False),
    ({"jobs": [{"id": 1, "time_windows": [[0, 9]]}]}, True),
    ({"vehicles": [{"id": 1, "time_window": [0, 9]}]}, True),
])
def test_one_window_makes_a_request_timed(stated: dict[str, Any], is_timed: bool) -> None:
    assert translated(**stated).is_timed == is_timed


def test_what_the_planner_refuses_has_vrooms_codes() -> None:
    errors = [refused(RefusedError("This can't be.")), refused(TooLargeError("Too much."))]
    assert [(error.code, str(error)) for error in errors] == [
        (INPUT, "This can't be."), (TOO_LARGE, "Too much.")]
