"""Flights of jobs' plans over HTTP."""

import httpx
import pytest

from tests.app.records.jobs.stepping import ended, request_of, submit

pytestmark = pytest.mark.slow


def test_job_without_flights_and_unknown_formats_are_told(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(0.2))
    ended(jobs, job)
    reply = jobs.get(f"/jobs/{job}/flights?format=kml")
    assert (reply.status_code, reply.json()["errors"][0]["code"]) == (422, "FLIGHTS_ON_PLANE")
    assert jobs.get(f"/jobs/{job}/flights?format=gpx").status_code == 422
    assert jobs.get(f"/jobs/{job}/flights").status_code == 422
    operation = jobs.get("/openapi.json").json()["paths"]["/jobs/{job_id}/flights"]["get"]
    assert "application/zip" in operation["responses"]["200"]["content"]
