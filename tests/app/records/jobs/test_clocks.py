"""Times of day in jobs: as stated for the plans themselves, wherever the base tells the day."""

from typing import Any

import httpx
import pytest

from app.records.jobs.schemas import JobReply
from tests.app.records.jobs.stepping import ended, request_of, submit
from tests.app.records.jobs.test_routes import errors_of

pytestmark = pytest.mark.slow

Request = dict[str, Any]

DAY = {"plan_start": "2026-10-25T00:00", "time_zone": "Europe/Berlin"}


@pytest.mark.thorough
def test_plan_of_a_job_tells_times_and_is_explained(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(0.1) | DAY)
    done = ended(jobs, job)
    JobReply.model_validate(done)
    stop = done["result"]["routes"][0]["trips"][0]["stops"][1]
    assert stop["arrival"].startswith("2026-10-25T00:")
    told = jobs.get(f"/jobs/{job}/explain", params={"customer": stop["id"], "time_limit": 0.3})
    assert told.status_code == 200, told.text
    assert told.json()["here"]["service_start"] == stop["service_start"]
    picture = jobs.get(f"/jobs/{job}/plan.svg")
    assert picture.status_code == 200, picture.text


def test_fleets_are_compared_by_times_of_day(jobs: httpx.Client) -> None:
    fleets = {name: [{"id": "truck", "count": 1, "capacity": [100], "shift": {"latest": latest}}]
              for name, latest in (("long", "24:00"), ("short", "00:00:01"))}
    done = ended(jobs, submit(jobs, {"base": request_of(0.1) | DAY, "fleets": fleets}, "/compare"))
    JobReply.model_validate(done)
    assert done["result"]["fleets"]["long"]["unassigned"] == 0
    plan = done["result"]["fleets"]["long"]["plan"]
    assert plan["summary"]["makespan"].startswith("2026-10-25T")


def test_grid_may_hold_times_of_day_but_not_the_day(jobs: httpx.Client) -> None:
    base = request_of(0.1) | DAY | {"customers": [
        {"id": "A", "location": [0, 1], "demand": [1], "time_window": {"earliest": "07:30"}}]}
    grid = {"customers[*].time_window.latest": ["07:30", "07:00"]}
    wrong = errors_of(jobs.post("/sweep", json={"base": base, "grid": grid}))
    assert wrong == {("WINDOW_ENDS_BEFORE_START", "$.grid")}
    grid = {"plan_start": ["2026-10-26T00:00"]}
    wrong = errors_of(jobs.post("/sweep", json={"base": base, "grid": grid}))
    assert wrong == {("UNKNOWN_PATH", "$.grid.plan_start")}
