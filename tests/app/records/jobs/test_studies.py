"""Comparisons and sweeps over HTTP, worked on in this process."""

from typing import Any

import httpx
import pytest

from app.records.jobs.schemas import CompareReply, JobReply, SweepReply
from tests.app.records.jobs.stepping import (
    NUM_CUSTOMERS, RAISING_SEED, ended, read, request_of, submit,
)
from tests.app.records.jobs.test_routes import errors_of
from tests.conftest import eventually

pytestmark = pytest.mark.slow

Request = dict[str, Any]


def fleet(capacity: float, **more: Any) -> list[Request]:
    """Return a fleet of one truck."""
    return [{"id": "truck", "count": 1, "capacity": [capacity], **more}]


def test_fleets_are_compared(jobs: httpx.Client) -> None:
    fleets = {"small": fleet(4), "whole day": fleet(10, max_working_duration=7200)}
    job = submit(jobs, {"base": request_of(0.3), "fleets": fleets}, "/compare")
    done = ended(jobs, job)
    JobReply.model_validate(done)
    CompareReply.model_validate(done["result"])
    small, whole = done["result"]["fleets"].values()
    assert list(done["result"]["fleets"]) == ["small", "whole day"]
    assert (small["status"], small["unassigned"]) == ("partial", NUM_CUSTOMERS - 4)
    assert (whole["status"], whole["unassigned"]) == ("complete", 0)
    assert small["cost"]["unassigned"] == 100 * (NUM_CUSTOMERS - 4)
    assert small["load_rate"] == {"min": 1.0, "mean": 1.0, "max": 1.0}
    assert small["working_rate"] is None
    assert whole["working_rate"]["mean"] == whole["plan"]["routes"][0]["working_rate"]
    assert (whole["vehicles"], whole["trips"]) == (1, 1)
    assert done["cost"] == whole["cost"]["total"]
    assert read(jobs, whole["job"])["result"] == whole["plan"]


def test_grid_is_swept_the_last_axis_fastest(jobs: httpx.Client) -> None:
    grid = {"fleet[*].capacity[0]": [4, 10], "unassigned_cost": [50, 60, 70]}
    job = submit(jobs, {"base": request_of(0.1), "grid": grid}, "/sweep")
    done = ended(jobs, job)
    JobReply.model_validate(done)
    result = done["result"]
    SweepReply.model_validate(result)
    assert result["axes"] == [{"path": path, "values": values} for path, values in grid.items()]
    assert [cell["values"] for cell in result["cells"]] == [
        [4, 50], [4, 60], [4, 70], [10, 50], [10, 60], [10, 70]]
    assert [cell["cost"] for cell in result["cells"]] == [
        8 + 6 * 50, 8 + 6 * 60, 8 + 6 * 70, 20, 20, 20]
    assert [cell["unassigned"] for cell in result["cells"]] == [6, 6, 6, 0, 0, 0]
    assert (done["cost"], done["progress"]) == (20, 1)
    assert done["search_iterations"] == sum(
        read(jobs, cell["job"])["search_iterations"] for cell in result["cells"])


def test_scenarios_are_not_listed(jobs: httpx.Client) -> None:
    job = submit(jobs, {"base": request_of(0), "grid": {"unassigned_cost": [1]}}, "/sweep")
    cell = ended(jobs, job)["result"]["cells"][0]
    listed = {entry["id"] for entry in jobs.get("/jobs", params={"limit": 500}).json()["jobs"]}
    assert job in listed
    assert cell["job"] not in listed


def test_scenario_that_fails_leaves_the_others_be(jobs: httpx.Client) -> None:
    grid = {"options.seed": [0, RAISING_SEED]}
    job = submit(jobs, {"base": request_of(0.1), "grid": grid}, "/sweep")
    done = ended(jobs, job)
    JobReply.model_validate(done)
    good, bad = done["result"]["cells"]
    assert (done["state"], good["status"]) == ("done", "complete")
    assert (bad["status"], bad["cost"]) == ("failed", None)
    assert bad["error"] == "The plan could not be computed."


def test_stopped_sweep_keeps_what_its_scenarios_found(jobs: httpx.Client) -> None:
    grid = {"unassigned_cost": [50, 60, 70, 80, 90, 100, 110, 120]}
    job = submit(jobs, {"base": request_of(60), "grid": grid}, "/sweep")
    eventually(lambda: read(jobs, job)["cost"])
    stopped = jobs.delete(f"/jobs/{job}").json()
    JobReply.model_validate(stopped)
    assert stopped["state"] == "cancelled"
    cells = stopped["result"]["cells"]
    found = [cell["cost"] for cell in cells if cell["cost"] is not None]
    # Two run at once, or a few more: the queue counts those that have begun, and on a busy machine
    # looks again before that.
    assert 1 <= len(found) < len(cells)
    assert stopped["cost"] == min(found)
    assert [cell["status"] for cell in cells] == [
        "cancelled" if cell["cost"] is None else "partial" for cell in cells]


def test_errors_of_scenarios_name_them(jobs: httpx.Client) -> None:
    reply = jobs.post("/compare", json={"base": request_of(1), "fleets": {
        "good": fleet(5), "far": fleet(5, depot="moon"), "flat": fleet(5) + fleet(6)}})
    assert errors_of(reply) == {("UNKNOWN_DEPOT", "$.fleets.far[0].depot"),
                                ("DUPLICATE_ID", "$.fleets.flat[1].id")}
    assert "fleet 'far'" in reply.json()["errors"][0]["message"]
    reply = jobs.post("/sweep", json={"base": request_of(1), "grid": {
        "fleet[0].count": [1, 0], "options.seed": [1, 2]}})
    assert errors_of(reply) == {("OUT_OF_RANGE", "$.grid")}
    assert [error["message"] for error in reply.json()["errors"]] == [
        f"With fleet[0].count = 0, options.seed = {seed} at $.fleet[0].count: The number must be "
        "at least 1: raise it. count: Vehicles of this type." for seed in (1, 2)]


@pytest.mark.parametrize(("path", "body", "error"), [
    ("/compare", {"fleets": {}}, ("WRONG_LENGTH", "$.fleets")),
    ("/compare", {"fleets": {"a": []}}, ("EMPTY_FLEET", "$.fleets.a")),
    ("/compare", {"fleets": {"a": [{"id": "t", "count": 0, "capacity": [1]}]}},
     ("OUT_OF_RANGE", "$.fleets.a[0].count")),
    ("/compare", {}, ("MISSING_FIELD", "$.fleets")),
    ("/compare", {"fleets": {"a": fleet(1)}, "grid": {}}, ("UNKNOWN_FIELD", "$.grid")),
    ("/sweep", {"grid": {}}, ("WRONG_LENGTH", "$.grid")),
    ("/sweep", {"grid": {"unassigned_cost": []}}, ("WRONG_LENGTH", "$.grid.unassigned_cost")),
    ("/sweep", {"grid": {"fleet[*].speed": [1]}}, ("UNKNOWN_PATH", "$.grid['fleet[*].speed']")),
    ("/sweep", {"grid": {"options.seed": list(range(9))}}, ("TOO_MANY_SCENARIOS", "$.grid")),
    ("/sweep", {"grid": {"fleet[*].count": [1], "fleet[0].count": [2]}},
     ("PATHS_OVERLAP", "$.grid['fleet[0].count']")),
    ("/sweep", {"grid": {"fleet": [fleet(1)], "fleet[0].count": [2]}},
     ("PATHS_OVERLAP", "$.grid['fleet[0].count']")),
    ("/sweep", {"grid": {"options.time_limit": [4000]}}, ("OUT_OF_RANGE", "$.grid")),
])
def test_wrong_requests_are_refused(jobs: httpx.Client, path: str, body: Request,
                                    error: tuple[str, str]) -> None:
    assert error in errors_of(jobs.post(path, json={"base": request_of(1), **body}))


def test_errors_of_the_base_are_told_with_those_beside_it(jobs: httpx.Client) -> None:
    base = request_of(1) | {"planar_unit": 0, "y": 1}
    assert errors_of(jobs.post("/sweep", json={"base": base, "grid": {}, "x": 1})) == {
        ("OUT_OF_RANGE", "$.base.planar_unit"), ("UNKNOWN_FIELD", "$.base.y"),
        ("WRONG_LENGTH", "$.grid"), ("UNKNOWN_FIELD", "$.x")}


@pytest.mark.parametrize("body", [[], "x", 1, {}, {"base": 1}, {"base": {}, "grid": 3}])
def test_odd_bodies_are_refused(jobs: httpx.Client, body: Any) -> None:
    for path in ("/compare", "/sweep"):
        assert errors_of(jobs.post(path, json=body))
