"""Times, costs and shape of replies: byte for byte those of VROOM for the same routes."""

import json
import random
from collections.abc import Callable
from typing import Any

import polyline
import pytest

from app.formats.vroom.places import find_places
from app.formats.vroom.reply import ReplyWriter
from app.formats.vroom.schemas import VroomRequest
from app.formats.vroom.tasks import tasks_of
from app.formats.vroom.translate import translate
from model.dialects.vroom.checking import route_faults
from model.dialects.vroom.timing import RouteTimer
from tests.app.formats.vroom.judge import judge
from tests.app.formats.vroom.judge import tasks_of as judged_tasks
from tests.app.formats.vroom.reference import solve
from tests.app.formats.vroom.sampling import sample_request
from tests.growth import growth_of
from tests.seeds import seeds

Data = dict[str, Any]


def written_like(reply: Data, request: Data) -> Data:
    """Return our reply for the routes of another."""
    read = VroomRequest.model_validate_json(json.dumps(request))
    places, meant = find_places(read, {"car": 36.0}), translate(read)
    vehicle_of = {vehicle.id: index for index, vehicle in enumerate(read.vehicles)}
    job_of = {(task.kind, task.id): index for index, task in enumerate(tasks_of(read))}
    routes = []
    for route in reply["routes"]:
        vehicle = vehicle_of[route["vehicle"]]
        jobs = [job_of[step["type"], step["id"]] for step in route["steps"]
                if step["type"] not in ("start", "break", "end")]
        assert list(route_faults(meant, places, vehicle, jobs)) == []
        timed = RouteTimer(meant, places, vehicle).drive(jobs)
        assert timed is not None
        routes.append(timed)
    times = reply["summary"]["computing_times"]
    writer = ReplyWriter(read, places, meant.is_timed)
    return writer.reply(routes, times["loading"], times["solving"])


def test_long_routes_are_written_in_time_that_grows_as_they_do() -> None:
    def writing(size: int) -> Callable[[], object]:
        read = VroomRequest.model_validate_json(json.dumps({
            "vehicles": [{"id": 1, "start": [0, 0]}],
            "jobs": [{"id": job, "location": [job / 1000, 0]} for job in range(size)]}))
        places, meant = find_places(read, {"car": 36.0}), translate(read)
        route = RouteTimer(meant, places, 0).drive(range(size))
        assert route is not None
        return lambda: ReplyWriter(read, places, meant.is_timed).reply([route], 0, 0)

    assert growth_of(writing, 100) < 5


@pytest.mark.parametrize("seed", seeds(150))
def test_reply_is_vrooms_byte_for_byte(seed: int) -> None:
    draw = random.Random(seed)
    request = sample_request(draw)
    for vehicle in request["vehicles"]:
        # Where breaks are decides what is rounded then.
        if draw.random() < 0.3 and not vehicle.get("breaks"):
            vehicle["speed_factor"] = round(draw.uniform(0.5, 2), 2)
    theirs = solve(request)
    jobs_first = {name: number for number, name in enumerate(judged_tasks(request))}
    theirs["unassigned"].sort(key=lambda job: jobs_first[job["type"], job["id"]])
    ours = written_like(theirs, request)
    if order_of(ours) != order_of(theirs):
        # Breaks may be at other places, if the route ends no later then.
        for mine, other in zip(ours["routes"], theirs["routes"], strict=True):
            assert mine["steps"][-1]["arrival"] <= other["steps"][-1]["arrival"]
            for reply in (mine, other):
                del reply["steps"], reply["waiting_time"]
        for reply in (ours, theirs):
            del reply["summary"]["waiting_time"]
    assert json.dumps(ours) == json.dumps(theirs)


def order_of(reply: Data) -> list[list[str]]:
    """Return what is done on each route, in order."""
    return [[step["type"] for step in route["steps"]] for route in reply["routes"]]


@pytest.mark.parametrize("seed", seeds(20))
def test_judge_agrees_with_vroom(seed: int) -> None:
    request = sample_request(random.Random(seed))
    judge(request, solve(request))


@pytest.fixture
def street() -> Data:
    """Return two jobs and a vehicle on a street, 100 s from place to place."""
    durations = [[100 * abs(i - j) for j in range(4)] for i in range(4)]
    return {"vehicles": [{"id": 1, "start_index": 0, "end_index": 0}],
            "jobs": [{"id": 1, "location_index": 1}, {"id": 2, "location_index": 2}],
            "matrices": {"car": {"durations": durations}}}


def steps_by(street: Data, *jobs: int) -> list[Data]:
    read = VroomRequest.model_validate_json(json.dumps(street))
    places, meant = find_places(read, {}), translate(read)
    timed = RouteTimer(meant, places, 0).drive([job - 1 for job in jobs])
    assert timed is not None
    (route,) = ReplyWriter(read, places, meant.is_timed).reply([timed], 0, 0)["routes"]
    steps: list[Data] = route["steps"]
    return steps


def test_vehicle_leaves_as_late_as_its_end_allows(street: Data) -> None:
    street["jobs"][1]["time_windows"] = [[1000, 2000]]
    assert [step["arrival"] for step in steps_by(street, 1, 2)] == [800, 900, 1000, 1200]


def test_vehicle_waits_where_it_must(street: Data) -> None:
    street["jobs"][0]["time_windows"] = [[0, 300]]
    street["jobs"][1]["time_windows"] = [[1000, 2000]]
    steps = steps_by(street, 1, 2)
    assert [step["arrival"] for step in steps] == [200, 300, 400, 1200]
    assert [step["waiting_time"] for step in steps] == [0, 0, 600, 0]


def test_later_window_is_awaited_where_the_first_is_missed(street: Data) -> None:
    street["jobs"][0]["time_windows"] = [[0, 50], [400, 500]]
    steps = steps_by(street, 1)
    assert [step["arrival"] for step in steps] == [300, 400, 500]


def test_setup_is_left_out_where_the_task_before_is_at_the_same_place(street: Data) -> None:
    street["jobs"][1]["location_index"] = 1
    for job in street["jobs"]:
        job |= {"setup": 30, "service": 10}
    assert [step["setup"] for step in steps_by(street, 1, 2)] == [0, 30, 0, 0]
    street["vehicles"][0]["start_index"] = 1
    assert [step["setup"] for step in steps_by(street, 1, 2)] == [0, 0, 0, 0]


def test_geometry_is_straight_lines_between_the_steps(street: Data) -> None:
    for job in street["jobs"]:
        job["location"] = [job.pop("location_index") / 10, 48.0]
    del street["matrices"]
    street |= {"vehicles": [{"id": 1, "start": [0.0, 48.0]}], "options": {"g": True}}
    read = VroomRequest.model_validate_json(json.dumps(street))
    places, meant = find_places(read, {"car": 36.0}), translate(read)
    timed = RouteTimer(meant, places, 0).drive([0, 1])
    assert timed is not None
    (route,) = ReplyWriter(read, places, meant.is_timed).reply([timed], 0, 0)["routes"]
    assert polyline.decode(route["geometry"]) == [
        (48.0, 0.0), (48.0, 0.1), (48.0, 0.2), (48.0, 0.2)]
    metres = [step["distance"] for step in route["steps"]]
    seconds = [step["duration"] for step in route["steps"]]
    assert metres[0] == 0
    assert metres[1] == pytest.approx(7440, abs=10)  # a tenth of a degree at 48 degrees north
    assert seconds[1] == pytest.approx(metres[1] / 10, abs=1)
    assert metres[2] == metres[3] == 2 * metres[1]
