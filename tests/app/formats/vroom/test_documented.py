"""What VROOM's documentation shows by examples: requests of the same shapes, over HTTP."""

from typing import Any

import httpx
import polyline
import pytest

from app.formats.vroom.schemas_response import VroomReply
from tests.app.formats.vroom.reference import solve

Data = dict[str, Any]

pytestmark = pytest.mark.by_clock

HUB = [13.40, 52.52]
SUMMARY = ["cost", "routes", "unassigned", "delivery", "amount", "pickup", "setup", "service",
           "duration", "waiting_time", "priority", "violations", "computing_times"]
ROUTE = ["vehicle", "cost", "delivery", "amount", "pickup", "setup", "service", "duration",
         "waiting_time", "priority", "steps", "violations"]
END = ["type", "location", "setup", "service", "waiting_time", "load", "arrival", "duration",
       "violations"]
BREAK = ["type", "id", "setup", "service", "waiting_time", "load", "arrival", "duration",
         "violations"]
JOB = ["type", "location", "id", "setup", "service", "waiting_time", "job", "load", "arrival",
       "duration", "violations"]


@pytest.fixture
def two_shifts() -> Data:
    """Two vehicles with skills, a shift and a break each; four jobs and a shipment."""
    return {
        "vehicles": [
            {"id": number, "start": HUB, "end": HUB, "capacity": [4], "skills": [number, 9],
             "time_window": [25200, 39600],
             "breaks": [{"id": number, "service": 600, "time_windows": [[32400, 34200]]}]}
            for number in (1, 2)],
        "jobs": [
            {"id": 1, "service": 240, "delivery": [1], "location": [13.33, 52.50], "skills": [1],
             "time_windows": [[28800, 32400]]},
            {"id": 2, "service": 240, "delivery": [1], "location": [13.30, 52.53], "skills": [1]},
            {"id": 5, "service": 240, "pickup": [1], "location": [13.45, 52.49], "skills": [9]},
            {"id": 6, "service": 240, "delivery": [1], "location": [13.50, 52.55], "skills": [2]}],
        "shipments": [
            {"amount": [1], "skills": [2],
             "pickup": {"id": 4, "service": 240, "location": [13.42, 52.57]},
             "delivery": {"id": 3, "service": 240, "location": [13.39, 52.55]}}]}


@pytest.fixture
def with_steps() -> Data:
    """Two vehicles by the clock of the world, with the routes they would drive."""
    morning = 1_790_000_000
    routes = {1: [1, 2, 5], 2: [6, 4, 3]}
    return {
        "vehicles": [
            {"id": number, "start": HUB, "end": HUB, "capacity": [9],
             "time_window": [morning, morning + 14400],
             "steps": [{"type": "start"}, *({"type": "job", "id": job} for job in jobs),
                       {"type": "end"}]}
            for number, jobs in routes.items()],
        "jobs": [
            {"id": number, "service": 240, "delivery": [1 + number % 2],
             "location": [13.3 + 0.03 * number, 52.5 + 0.02 * (number % 3)],
             **({"time_windows": [[morning, morning + 9000]]} if number in (3, 4, 6) else {})}
            for number in range(1, 7)]}


def solved(client: httpx.Client, request: Data) -> Data:
    """Return the solution of a request, which fits the description and keeps all rules."""
    reply = client.post("/vroom", json=request)
    assert reply.status_code == 200, reply.text
    VroomReply.model_validate_json(reply.content)
    return dict(reply.json())


def refused(client: httpx.Client, request: Data) -> str:
    """Return why a request is refused."""
    reply = client.post("/vroom", json=request)
    assert reply.status_code == 400, reply.text
    assert list(reply.json()) == ["code", "error"]
    assert reply.json()["code"] == 2
    return str(reply.json()["error"])


@pytest.mark.parametrize("geometry", [False, True])
def test_jobs_by_coordinates_are_served_in_vrooms_shape(
        searching: httpx.Client, two_shifts: Data, geometry: bool) -> None:
    reply = solved(searching, two_shifts | {"options": {"g": geometry}})
    way = ["distance"] if geometry else []
    assert list(reply) == ["code", "summary", "unassigned", "routes"]
    assert list(reply["summary"]) == SUMMARY[:-2] + way + SUMMARY[-2:]
    assert list(reply["summary"]["computing_times"]) == ["loading", "solving", "routing"]
    assert (reply["summary"]["unassigned"], reply["unassigned"]) == (0, [])
    assert reply["summary"]["delivery"] == reply["summary"]["amount"] == [4]
    assert reply["summary"]["pickup"] == [2]
    for route in reply["routes"]:
        assert list(route) == (ROUTE[:-2] + way + ROUTE[-2:]
                               + (["geometry"] if geometry else []))
        first, *others, last = route["steps"]
        jobs = [step for step in others if step["type"] != "break"]
        (rest,) = (step for step in others if step["type"] == "break")
        assert list(rest) == BREAK + way
        assert 32400 <= rest["arrival"] + rest["waiting_time"] <= 34200
        assert (first["type"], last["type"]) == ("start", "end")
        assert list(first) == list(last) == END + way
        assert all(list(step) == JOB + way for step in jobs)
        assert all(step["id"] == step["job"] for step in jobs)
        if geometry:
            assert [[x, y] for y, x in polyline.decode(route["geometry"])] == [
                step["location"] for step in [first, *jobs, last]]
    (arrival,) = (step["arrival"] + step["waiting_time"] for route in reply["routes"]
                  for step in route["steps"] if (step["type"], step.get("id")) == ("job", 1))
    assert 28800 <= arrival <= 32400
    vehicle_of = {(step["type"], step["id"]): route["vehicle"] for route in reply["routes"]
                  for step in route["steps"] if "id" in step}
    assert vehicle_of == {("job", 1): 1, ("job", 2): 1, ("job", 5): vehicle_of["job", 5],
                          ("job", 6): 2, ("pickup", 4): 2, ("delivery", 3): 2,
                          ("break", 1): 1, ("break", 2): 2}


@pytest.mark.parametrize(("metres", "served"), [(5000, 1), (9000, 2)])
def test_the_longest_way_is_measured_between_coordinates_where_no_distances_are_stated(
        searching: httpx.Client, metres: int, served: int) -> None:
    start = {"start": [2.35, 48.86], "start_index": 0, "end": [2.35, 48.86], "end_index": 0}
    reply = solved(searching, {
        "vehicles": [{"id": 1, **start, "max_distance": metres}],
        # About 1.5 km and 3.2 km away, in opposite directions.
        "jobs": [{"id": 1, "location": [2.37, 48.86], "location_index": 1},
                 {"id": 2, "location": [2.34, 48.832], "location_index": 2}],
        "matrices": {"car": {"durations": [[0, 60, 60], [60, 0, 60], [60, 60, 0]]}}})
    assert 2 - reply["summary"]["unassigned"] == served
    assert "distance" not in reply["summary"]


@pytest.mark.parametrize("matrix", ["matrix", "matrices"])
def test_matrix_from_one_place_to_another_is_solved_as_by_vroom(
        searching: httpx.Client, matrix: str) -> None:
    table = [[0, 900, 250, 700], [910, 0, 1100, 1500], [240, 1120, 0, 600], [720, 1490, 610, 0]]
    request: Data = {
        "vehicles": [{"id": 0, "start_index": 0, "end_index": 3}],
        "jobs": [{"id": 501, "location_index": 1}, {"id": 502, "location_index": 2}],
        "matrices": {"car": {"durations": table}}}
    theirs = solve(request)
    if matrix == "matrix":
        request["matrix"] = request.pop("matrices")["car"]["durations"]
    ours = solved(searching, request)
    for reply in (ours, theirs):
        del reply["summary"]["computing_times"]
    assert list(ours) == list(theirs)
    assert ours == theirs


def test_routes_by_steps_are_where_the_search_begins(searching: httpx.Client,
                                                     with_steps: Data) -> None:
    reply = solved(searching, with_steps | {"options": {"l": 0.01}})
    assert reply["summary"]["unassigned"] == 0
    begin, end = with_steps["jobs"][2]["time_windows"][0]
    assert all(begin <= step["arrival"] + step["waiting_time"] <= end
               for route in reply["routes"] for step in route["steps"]
               if step.get("id") in (3, 4, 6))
    with_steps["vehicles"][0]["capacity"] = [1]
    assert refused(searching, with_steps) == "Route over capacity for vehicle 1."


def test_times_forced_in_steps_are_left_out_of_a_search_as_by_vroom(
        searching: httpx.Client, with_steps: Data) -> None:
    plain = solved(searching, with_steps)
    for step, forced in enumerate(("service_at", "service_after", "service_before")):
        with_steps["vehicles"][1]["steps"][step][forced] = 1_790_000_600
    assert solved(searching, with_steps)["routes"] == plain["routes"]


def test_routes_that_are_given_are_timed_alone(searching: httpx.Client, with_steps: Data) -> None:
    reply = solved(searching, with_steps | {"options": {"c": True}})
    assert [[step["id"] for step in route["steps"][1:-1]] for route in reply["routes"]] == [
        [1, 2, 5], [6, 4, 3]]
    assert reply["summary"]["violations"] == []


def test_job_that_nobody_can_serve_is_told_in_vrooms_shape(searching: httpx.Client,
                                                           with_steps: Data) -> None:
    for vehicle in with_steps["vehicles"]:
        del vehicle["steps"]
    with_steps["jobs"][0] |= {"skills": [7], "description": "a crane"}
    (left,) = solved(searching, with_steps)["unassigned"]
    assert list(left.items()) == [("id", 1), ("location", with_steps["jobs"][0]["location"]),
                                  ("type", "job"), ("description", "a crane"), ("reasons", [
        f"Missing skill or step out of reach for vehicle {number} and job 1." for number in (1,)])]
