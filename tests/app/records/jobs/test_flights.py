"""Flights of jobs' plans over HTTP."""

import json
from pathlib import Path

import httpx
import pytest

from tests.app.records.jobs.stepping import ended, request_of, submit

pytestmark = pytest.mark.slow

EXAMPLE = Path(__file__).parents[4] / "app" / "schemas" / "examples" / "flights.json"


@pytest.mark.thorough
def test_job_without_flights_and_unknown_formats_are_told(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(0.2))
    ended(jobs, job)
    reply = jobs.get(f"/jobs/{job}/flights?format=kml")
    assert (reply.status_code, reply.json()["errors"][0]["code"]) == (422, "FLIGHTS_ON_PLANE")
    assert jobs.get(f"/jobs/{job}/flights?format=gpx").status_code == 422
    assert jobs.get(f"/jobs/{job}/flights").status_code == 422
    operation = jobs.get("/openapi.json").json()["paths"]["/jobs/{job_id}/flights"]["get"]
    assert "application/zip" in operation["responses"]["200"]["content"]


def test_plan_in_which_nobody_flies_has_no_flights(jobs: httpx.Client) -> None:
    problem = json.loads(EXAMPLE.read_text("utf-8"))["problem"] | {
        "options": {"time_limit": 60, "search_iterations": 5}}
    job = ended(jobs, submit(jobs, problem))
    assert job["state"] == "done", job
    reply = jobs.get(f"/jobs/{job['id']}/flights?format=qgc-wpl")
    # Whoever plans here flies nobody.
    assert (reply.status_code, reply.json()["errors"][0]["code"]) == (422, "NO_FLIGHTS")
