"""What is refused, and in which words."""

import copy
import json
from collections.abc import Callable
from typing import Any

import pytest

from app.formats.vroom.errors import INPUT, TOO_LARGE, VroomError
from app.formats.vroom.places import find_places
from app.formats.vroom.reading import read_request
from tests.app.formats.vroom.reference import error

Data = dict[str, Any]
Change = Callable[[Data], None]

SQUARE = [[0, 10, 20], [10, 0, 15], [20, 15, 0]]


@pytest.fixture
def request_data() -> Data:
    """Return a small request by matrices."""
    return {
        "vehicles": [{"id": 1, "start_index": 0, "end_index": 0, "capacity": [4]},
                     {"id": 2, "start_index": 0, "capacity": [4]}],
        "jobs": [{"id": 1, "location_index": 1, "delivery": [1]},
                 {"id": 2, "location_index": 2, "delivery": [1]}],
        "matrices": {"car": {"durations": copy.deepcopy(SQUARE),
                             "distances": copy.deepcopy(SQUARE)}}}


def read(request: Data, max_jobs: int, max_vehicles: int, max_legs: int = 10**9) -> None:
    found = read_request(json.dumps(request).encode(), max_jobs, max_vehicles)
    find_places(found, {"car": 40.0, "bike": 15.0}, max_legs)


def refusal(request: Data, max_jobs: int = 100, max_vehicles: int = 100,
            max_legs: int = 10**9) -> VroomError:
    with pytest.raises(VroomError) as caught:
        read(request, max_jobs, max_vehicles, max_legs)
    return caught.value


def setting(*path: str | int, value: Any) -> Change:
    """Return a function that sets a value in a request."""
    def change(request: Data) -> None:
        place: Any = request
        for key in path[:-1]:
            place = place[key]
        place[path[-1]] = value

    change.__name__ = ".".join(map(str, path))
    return change


def by_coordinates(request: Data) -> None:
    """Give a job coordinates where others have rows of matrices."""
    request["jobs"][0] = {"id": 1, "location": [0.0, 0.0], "delivery": [1]}


def nowhere(request: Data) -> None:
    """Take the first vehicle's start and end."""
    request["vehicles"][0] = {"id": 1, "capacity": [4]}


def with_costs(request: Data) -> None:
    """State a matrix of costs and a cost by hour."""
    request["matrices"]["car"]["costs"] = SQUARE
    request["vehicles"][0]["costs"] = {"per_hour": 1}


AS_VROOM = (
    setting("vehicles", value=[]),
    setting("jobs", value=[]),
    setting("jobs", 0, "id", value=2),
    setting("jobs", 0, "delivery", value=[1, 2]),
    setting("jobs", 0, "pickup", value=[]),
    setting("vehicles", 1, "capacity", value=[1, 2]),
    setting("jobs", 0, "time_windows", value=[]),
    setting("jobs", 0, "time_windows", value=[[5, 1]]),
    setting("jobs", 0, "time_windows", value=[[5, 10], [1, 6]]),
    setting("vehicles", 0, "time_window", value=[5, 1]),
    setting("vehicles", 0, "speed_factor", value=6),
    setting("vehicles", 0, "speed_factor", value=0),
    setting("vehicles", 0, "profile", value="bike"),
    setting("vehicles", 0, "steps", value=[{"type": "job", "id": 7}]),
    setting("vehicles", 0, "steps", value=[{"type": "job", "id": 1}, {"type": "job", "id": 1}]),
    setting("vehicles", 0, "steps", value=[{"type": "break", "id": 3}]),
    setting("vehicles", 0, "steps", value=[{"type": "pickup", "id": 1}]),
    setting("vehicles", 0, "breaks", value=[{"id": 1}, {"id": 1}]),
    setting("vehicles", 0, "breaks", value=[{"id": 1, "time_windows": [[5, 1]]}]),
    setting("vehicles", 0, "breaks", value=[{"id": 1, "max_load": [1, 2]}]),
    setting("shipments", value=[{"pickup": {"id": 1}, "delivery": {"id": 1}}]),
    setting("shipments", value=2 * [{"pickup": {"id": 1, "location_index": 1},
                                     "delivery": {"id": 1, "location_index": 2}}]),
    setting("jobs", 0, "location_index", value=3),
    setting("matrices", "car", "durations", value=[[0, 1], [1]]),
    setting("matrices", "car", "durations", value=[]),
    setting("matrices", value={"car": {"distances": SQUARE}}),
    by_coordinates, nowhere, with_costs,
)


@pytest.mark.parametrize("change", AS_VROOM, ids=lambda change: change.__name__)
def test_errors_are_told_in_vrooms_words(request_data: Data, change: Change) -> None:
    change(request_data)
    ours = refusal(request_data)
    assert ours.code == INPUT
    assert str(ours).startswith(error(request_data))


REFUSED = {
    "$.vehicles[0].breaks": setting(
        "vehicles", 0, "breaks", value=[{"id": number} for number in range(33)]),
    "$.options.y": setting("options", value={"y": 1}),
    "$.options.x": setting("options", value={"x": 6}),
    "$.vehicle": setting("vehicle", value=[]),
    "$.jobs[0].prio": setting("jobs", 0, "prio", value=1),
    "$.jobs[0].priority": setting("jobs", 0, "priority", value=101),
    "$.jobs[0].service": setting("jobs", 0, "service", value=1.5),
    "$.jobs[1].id": setting("jobs", 1, "id", value="2"),
    "$.vehicles[0].costs.per_task": setting("vehicles", 0, "costs", value={"per_task": 1}),
    "$.vehicles[1].time_window": setting("vehicles", 1, "time_window", value=[1]),
    "$.matrices.car.durations[0][1]": setting(
        "matrices", "car", "durations", 0, 1, value=-1),
    "amount of job 1": setting("jobs", 0, "amount", value=[1]),
    "Duplicate vehicle id: 2.": setting("vehicles", 0, "id", value=2),
    "Invalid break id 3": setting("vehicles", 0, "steps", value=[{"type": "break", "id": 3}]),
    "Unexpected end": setting("vehicles", 0, "steps", value=[{"type": "end"}, {"type": "start"}]),
    "Unexpected start": setting(
        "vehicles", 0, "steps", value=[{"type": "job", "id": 1}, {"type": "start"}]),
}


@pytest.mark.parametrize("named", REFUSED)
def test_what_cant_be_planned_is_refused_by_name(request_data: Data, named: str) -> None:
    REFUSED[named](request_data)
    ours = refusal(request_data)
    assert ours.code == INPUT
    assert str(ours).startswith(named)


def test_lists_may_be_empty(request_data: Data) -> None:
    request_data["shipments"] = []
    request_data["vehicles"][0] |= {"breaks": [], "steps": []}
    read(request_data, 2, 2)


def test_several_faults_are_told_at_once(request_data: Data) -> None:
    request_data["jobs"][0]["delivery"] = []
    request_data["vehicles"][1]["breaks"] = [{"id": 1, "time_windows": []}]
    message = str(refusal(request_data))
    assert "Empty time windows for break 1." in message
    assert "Inconsistent delivery length: 0 instead of 1. The delivery of job" in message


def test_amounts_without_a_capacity_name_job_and_vehicle(request_data: Data) -> None:
    del request_data["vehicles"][0]["capacity"]
    request_data["jobs"][0]["delivery"] = [1]
    job, vehicle = request_data["jobs"][0]["id"], request_data["vehicles"][0]["id"]
    message = str(refusal(request_data))
    assert (f"The delivery of job {job} states 1, there are none, since vehicle {vehicle} has no "
            "capacity: state one, or leave amounts out.") in message


def test_no_more_than_five_faults_are_told(request_data: Data) -> None:
    request_data["jobs"] = [{"id": 7, "location_index": 1, "delivery": []} for _ in range(9)]
    assert str(refusal(request_data)).endswith("And 5 more.")


@pytest.mark.parametrize("body", [b"", b"{", b"[1", b"\xff", b'{"jobs": 1e999}'])
def test_what_is_not_json_is_refused(body: bytes) -> None:
    with pytest.raises(VroomError, match=r"JSON|jobs") as caught:
        read_request(body, 1, 1)
    assert caught.value.code == INPUT


def test_too_many_jobs_or_vehicles_are_too_large(request_data: Data) -> None:
    too_many = refusal(request_data, max_jobs=1)
    assert (too_many.code, str(too_many)) == (
        TOO_LARGE, "Too many locations (2) in query, maximum is set to 1")
    assert refusal(request_data, max_vehicles=1).code == TOO_LARGE


def test_too_many_legs_are_too_large_before_any_is_computed() -> None:
    request: Data = {"vehicles": [{"id": 1, "start": [2.0, 48.0]},
                                  {"id": 2, "start": [2.0, 48.0], "profile": "bike"}],
                     "jobs": [{"id": 1, "location": [2.1, 48.0]},
                              {"id": 2, "location": [2.1, 48.0]}]}
    read(request, 2, 2, max_legs=8)
    too_many = refusal(request, max_legs=7)
    assert (too_many.code, str(too_many)) == (
        TOO_LARGE, "Too many legs: 2 profiles and 2 places, maximum is 7 legs (TANDEM_MAX_LEGS)")


def test_places_without_matrices_need_coordinates_and_a_known_profile() -> None:
    request: Data = {"vehicles": [{"id": 1, "start": [2.0, 48.0]}],
                     "jobs": [{"id": 1, "location": [2.1, 48.0]}]}
    truck = copy.deepcopy(request)
    truck["vehicles"][0]["profile"] = "lorry"
    assert str(refusal(truck)).startswith("Invalid profile: lorry.")
    by_row = copy.deepcopy(request)
    by_row["jobs"][0]["location_index"] = 0
    assert str(refusal(by_row)) == "Missing location index."
    by_row["vehicles"][0]["start_index"] = 0
    assert str(refusal(by_row)) == (
        "Unexpected location index while no custom matrices provided.")
    off_globe = copy.deepcopy(request)
    off_globe["jobs"][0]["location"] = [48.0, 98.0]
    assert "degrees" in str(refusal(off_globe))


def test_geometry_needs_coordinates(request_data: Data) -> None:
    request_data["options"] = {"g": True}
    assert str(refusal(request_data)) == "Route geometry request with missing coordinates."
