"""Solutions by the real planner: judged from the request alone, and beside VROOM's own."""

import json
import math
import random
import statistics
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import pytest

from app.formats.vroom.answering import answer
from app.formats.vroom.errors import VroomError
from app.requests.conversion.preparing import StoppedError
from app.schemas.limits import DEFAULT_POLICY
from app.serving.load.received import ReceivedBody
from app.serving.settings import Settings
from model.dialects.vroom.timing import COST_SCALE
from model.planner import Planner, load_planner
from tests.app.formats.vroom.by_turns import ENOUGH, ByTurns
from tests.app.formats.vroom.judge import judge
from tests.app.formats.vroom.reference import solve
from tests.app.formats.vroom.sampling import sample_request
from tests.conftest import SOON
from tests.model.dialects.vroom.drawn import best_value, drawn_request
from tests.seeds import seeds

Data = dict[str, Any]
Solve = Callable[..., Data]

pytestmark = [pytest.mark.by_clock, pytest.mark.slow]


@pytest.fixture(scope="session")
def planner() -> Planner:
    """Return the planner that the service has by default."""
    return load_planner(Settings().weights_dir, (DEFAULT_POLICY,))


@pytest.fixture(scope="session")
def ours(planner: Planner) -> Solve:
    """Return a function that answers a request by searches of some turns."""
    def solve_ours(request: Data, turns: int = 1000) -> Data:
        settings = Settings(vroom_seconds=ENOUGH)
        body = ReceivedBody(json.dumps(request).encode(), time.perf_counter())
        reply: Data = json.loads(answer(ByTurns(planner, turns), body, settings, lambda: False))
        return reply

    return solve_ours


def value(reply: Data) -> tuple[int, int]:
    """Return what VROOM maximises before it looks at cost."""
    return reply["summary"]["priority"], -reply["summary"]["unassigned"]


@pytest.mark.parametrize("seed", seeds(60))
def test_random_requests_get_sound_replies(ours: Solve, seed: int) -> None:
    request = sample_request(random.Random(1000 + seed))
    judge(request, ours(request, 100))


@pytest.mark.thorough
def test_small_requests_are_solved_about_as_well_as_by_vroom(ours: Solve) -> None:
    ratios, worse = [], 0
    for seed in seeds(40):
        request = sample_request(random.Random(seed), most_jobs=7)
        theirs, reply = solve(request, exploration=5), ours(request, 1000)
        judge(request, reply)
        if value(reply) == value(theirs) and theirs["summary"]["cost"]:
            ratios.append(reply["summary"]["cost"] / theirs["summary"]["cost"])
        worse += value(reply) < value(theirs)
    assert worse <= 1
    assert statistics.geometric_mean(ratios) < 1.02


@pytest.fixture
def street() -> Data:
    """Return four jobs and a vehicle on a street, 100 s and 1,000 m from place to place."""
    seconds = [[100 * abs(i - j) for j in range(5)] for i in range(5)]
    metres = [[10 * second for second in row] for row in seconds]
    return {"vehicles": [{"id": 1, "start_index": 0, "end_index": 0}],
            "jobs": [{"id": number, "location_index": number} for number in range(1, 5)],
            "matrices": {"car": {"durations": seconds, "distances": metres}}}


def served(reply: Data) -> list[int]:
    return [step["id"] for route in reply["routes"] for step in route["steps"] if "id" in step]


def test_max_tasks_keeps_the_important_jobs(ours: Solve, street: Data) -> None:
    street["vehicles"][0]["max_tasks"] = 2
    for job in street["jobs"]:
        job["priority"] = 10 * job["id"]
    assert sorted(served(ours(street))) == [3, 4]


@pytest.mark.parametrize("limit", [{"max_distance": 6000}, {"max_travel_time": 600},
                                   {"max_distance": 6000, "max_travel_time": 700}])
@pytest.mark.parametrize("extra", [{}, {"time_window": [0, 5000]}, {"costs": {"per_km": 700}},
                                   {"time_window": [0, 5000], "costs": {"per_task_hour": 100}}])
def test_limits_are_kept_to_the_unit(ours: Solve, street: Data, limit: Data, extra: Data) -> None:
    # One leg is a metre longer than the others, so that metres and seconds aren't proportional.
    street["matrices"]["car"]["distances"][4][0] += 1
    street["vehicles"][0] |= limit | extra
    reply = ours(street)
    judge(street, reply)
    assert sorted(served(reply)) == [1, 2, 3]


@pytest.mark.parametrize("seed", seeds(20))
@pytest.mark.parametrize("by_search", [False, True])
def test_few_jobs_with_windows_and_a_limit_are_planned_at_least_cost(
        monkeypatch: pytest.MonkeyPatch, ours: Solve, by_search: bool, seed: int) -> None:
    if by_search:
        monkeypatch.setattr("model.dialects.vroom.planning.is_few", lambda *_: False)
    request = drawn_request(random.Random(seed), 4, binds=seed % 2 == 1)
    reply = ours(request)
    judge(request, reply)
    _, served, minus_cost = best_value(request)
    assert len(request["jobs"]) - reply["summary"]["unassigned"] == served
    assert reply["summary"]["cost"] == pytest.approx(-minus_cost / COST_SCALE, abs=1)


def with_breaks(seed: int, number: int, most: int | None, wide: int) -> Data:
    """Return sixteen jobs for two vehicles with breaks all day, each within a window."""
    draw, day = random.Random(seed), 40_000
    places = [(draw.uniform(0, 3000), draw.uniform(0, 3000)) for _ in range(17)]
    breaks: list[Data] = []
    for index in range(number):
        middle = day * (2 * index + 1) // (2 * number)
        breaks.append({"id": index, "service": 120,
                       "time_windows": [[middle - wide, middle + wide]],
                       **({} if most is None else {"max_load": [most]})})
    return {
        "vehicles": [{"id": vehicle, "start_index": 0, "end_index": 0, "time_window": [0, day],
                      "capacity": [60], "breaks": breaks} for vehicle in range(2)],
        "jobs": [{"id": job, "location_index": job, "service": 600,
                  "delivery": [draw.randint(1, 4)]} for job in range(1, 17)],
        "matrices": {"car": {"durations": [[int(math.dist(one, other)) for other in places]
                                           for one in places]}}}


@pytest.mark.parametrize(("number", "wide"), [(9, 900), (12, 30), (20, 400)])
def test_more_breaks_are_planned_than_the_planner_has(ours: Solve, number: int,
                                                      wide: int) -> None:
    request = with_breaks(1, number, None, wide)
    reply = ours(request)
    judge(request, reply)
    assert reply["summary"]["unassigned"] == 0


@pytest.mark.parametrize("seed", [1, 3, 6])
def test_routes_that_are_too_heavy_for_breaks_are_mended(ours: Solve, seed: int) -> None:
    request = with_breaks(seed, 4, 18, 900)
    reply = ours(request)
    judge(request, reply)
    assert reply["summary"]["unassigned"] == 0
    assert reply["summary"]["cost"] <= 1.4 * solve(request)["summary"]["cost"]


def test_one_window_of_several_is_kept(ours: Solve, street: Data) -> None:
    street["jobs"][0]["time_windows"] = [[0, 50], [5000, 5100]]
    street["jobs"][3]["time_windows"] = [[100, 200], [4600, 4700], [9000, 9100]]
    street["vehicles"][0]["time_window"] = [200, 5500]
    reply = ours(street)
    judge(street, reply)
    assert reply["summary"]["unassigned"] == 0


def test_windows_far_shorter_than_service_leave_a_choice(ours: Solve, street: Data) -> None:
    street["jobs"][0] |= {"service": 1000, "time_windows": [[0, 10], [90, 110], [300, 310]]}
    reply = ours(street)
    judge(street, reply)
    assert reply["summary"]["unassigned"] == 0


def test_setup_is_planned_once_at_a_place_with_time_windows(ours: Solve, street: Data) -> None:
    for job in street["jobs"]:
        job |= {"location_index": 1, "setup": 100, "service": 10, "time_windows": [[100, 240]]}
    street["vehicles"][0]["time_window"] = [0, 1000]
    reply = ours(street)
    judge(street, reply)
    assert reply["summary"]["unassigned"] == 0


def test_legs_beyond_any_horizon_are_not_driven_within_a_shift(ours: Solve, street: Data) -> None:
    street["matrices"]["car"]["durations"][4] = [2**32 - 1] * 5
    street["vehicles"][0] |= {"time_window": [0, 2**32 - 1], "max_distance": 2**32 - 1}
    judge(street, ours(street))


@pytest.mark.parametrize("length", [2**31 - 1, 10**9])
@pytest.mark.parametrize("extra", [{}, {"time_window": [0, 2**32 - 1]}, {"speed_factor": 2.0}])
@pytest.mark.parametrize("most_sets", [0, 4000])
def test_nobody_is_served_to_whom_there_is_no_way(
        monkeypatch: pytest.MonkeyPatch, ours: Solve, street: Data, length: int, extra: Data,
        most_sets: int) -> None:
    monkeypatch.setattr("model.dialects.vroom.exact.MOST_SETS", most_sets)
    street["vehicles"][0] |= extra
    for row in street["matrices"]["car"]["durations"]:
        row[4] = length
    reply = ours(street)
    assert sorted(served(reply)) == [1, 2, 3]
    assert [job["id"] for job in reply["unassigned"]] == [4]


def test_given_steps_where_there_is_no_way_are_refused_by_name(ours: Solve, street: Data) -> None:
    street["matrices"]["car"]["durations"][1][4] = 2**31 - 1
    street["vehicles"][0]["steps"] = [{"type": "job", "id": 1}, {"type": "job", "id": 4}]
    with pytest.raises(VroomError, match="No way for vehicle 1 to job 4"):
        ours(street)


def test_nobody_is_served_where_priorities_differ_and_nothing_fits(
        ours: Solve, street: Data) -> None:
    street["vehicles"][0]["max_distance"] = 10
    street["jobs"][0]["priority"] = 5
    assert ours(street)["summary"]["unassigned"] == 4


def test_steps_are_a_start(ours: Solve, street: Data) -> None:
    street["vehicles"].append({"id": 2, "start_index": 0, "end_index": 0})
    street["vehicles"][1]["steps"] = [
        {"type": "start"}, *({"type": "job", "id": number} for number in (3, 1, 4, 2)),
        {"type": "end"}]
    reply = ours(street)
    judge(street, reply)
    assert reply["summary"]["cost"] == 800
    assert [route["vehicle"] for route in reply["routes"]] == [2]


@pytest.mark.parametrize(("vehicle", "message"), [
    ({"max_tasks": 1}, "Too many tasks for vehicle 1."),
    ({"max_distance": 100}, "Route over max_distance for vehicle 1."),
    ({"max_travel_time": 100}, "Route over max_travel_time for vehicle 1."),
    ({"time_window": [0, 100]}, "Infeasible route for vehicle 1."),
    ({"capacity": [1]}, "Route over capacity for vehicle 1."),
])
def test_steps_that_break_a_rule_are_refused_in_vrooms_words(
        ours: Solve, street: Data, vehicle: Data, message: str) -> None:
    street["vehicles"][0] |= vehicle
    street["vehicles"][0]["steps"] = [{"type": "job", "id": 1}, {"type": "job", "id": 2}]
    if "capacity" in vehicle:
        for job in street["jobs"]:
            job["delivery"] = [1]
    with pytest.raises(VroomError) as caught:
        ours(street)
    assert message in str(caught.value)


def test_nobody_can_be_served(ours: Solve, street: Data) -> None:
    for job in street["jobs"]:
        job["skills"] = [1]
    reply = ours(street)
    assert (reply["routes"], reply["summary"]["unassigned"]) == ([], 4)


def test_abandoned_request_ends_early(planner: Planner, street: Data) -> None:
    body = ReceivedBody(json.dumps(street).encode(), time.perf_counter())
    # A machine that stalls has no plan yet when the client is found gone.
    with suppress(StoppedError):
        answer(planner, body, Settings(vroom_seconds=10 * SOON), lambda: True)
    assert time.perf_counter() - body.received_at < SOON


def test_both_ways_share_a_vehicle(ours: Solve, street: Data) -> None:
    street["vehicles"][0]["capacity"] = [2]
    for job, side in zip(street["jobs"], ("delivery", "pickup", "delivery", "pickup"),
                         strict=True):
        job[side] = [1]
    reply = ours(street)
    judge(street, reply)
    assert reply["summary"]["unassigned"] == 0
    assert math.isclose(reply["summary"]["cost"], 800)
