"""Flights of a job's plan, over HTTP."""

import json
from pathlib import Path

import pytest

from app.serving.settings import Settings
from tests.app.records.jobs.conftest import serving
from tests.app.records.jobs.stepping import ended, submit

pytestmark = pytest.mark.slow

EXAMPLE = Path(__file__).parents[4] / "app" / "schemas" / "examples" / "flights.json"


def test_flights_of_a_job_are_asked_of_its_plan(settings: Settings) -> None:
    problem = json.loads(EXAMPLE.read_text("utf-8"))["problem"] | {
        "options": {"search_iterations": 500}}
    with serving(settings) as client:
        job = ended(client, submit(client, problem))
        assert job["state"] == "done", job
        asked = client.get(f"/jobs/{job['id']}/flights", params={"format": "qgc-wpl"})
        unknown = client.get(f"/jobs/{job['id']}/flights", params={"format": "gpx"})
    # Whoever plans here flies nobody.
    assert (asked.status_code, asked.json()["errors"][0]["code"]) == (422, "NO_FLIGHTS")
    assert unknown.status_code == 422
