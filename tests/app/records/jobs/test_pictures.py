"""Pictures of jobs' plans over HTTP."""

import uuid
import xml.etree.ElementTree as ElementTree

import httpx
import pytest

from tests.app.records.jobs.stepping import (
    NUM_CUSTOMERS, RAISING_SEED, ended, read, request_of, submit,
)
from tests.conftest import eventually

pytestmark = pytest.mark.slow


def test_plan_of_a_job_is_drawn(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(0.2))
    ended(jobs, job)
    reply = jobs.get(f"/jobs/{job}/plan.svg")
    assert reply.status_code == 200, reply.text
    assert reply.headers["content-type"] == "image/svg+xml"
    root = ElementTree.fromstring(reply.content)
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    texts = {"".join(node.itertext()) for node in root.iter("{http://www.w3.org/2000/svg}text")}
    assert {"hub", "truck", *(f"c{number}" for number in range(1, NUM_CUSTOMERS + 1))} <= texts


def test_plan_so_far_of_a_running_job_is_drawn(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(60))
    eventually(lambda: read(jobs, job)["result"])
    assert jobs.get(f"/jobs/{job}/plan.svg").status_code == 200
    jobs.delete(f"/jobs/{job}")


def test_job_without_a_plan_has_no_picture(jobs: httpx.Client) -> None:
    failed = submit(jobs, request_of(0.2, RAISING_SEED))
    ended(jobs, failed)
    compared = submit(jobs, {"base": request_of(0), "fleets": {
        "one": request_of(0)["fleet"]}}, "/compare")
    for job, reason in ((failed, "failed"), (compared, "compare")):
        reply = jobs.get(f"/jobs/{job}/plan.svg")
        assert reply.status_code == 409
        assert reply.headers["content-type"] == "application/problem+json"
        assert reply.json()["type"] == "urn:tandem:error:no-plan"
        assert reason in reply.json()["detail"]
    ended(jobs, compared)


def test_picture_of_an_unknown_job_is_not_found(jobs: httpx.Client) -> None:
    reply = jobs.get(f"/jobs/{uuid.uuid4()}/plan.svg")
    assert reply.status_code == 404
    assert reply.json()["type"] == "urn:tandem:error:unknown-job"


def test_picture_is_documented(jobs: httpx.Client) -> None:
    operation = jobs.get("/openapi.json").json()["paths"]["/jobs/{job_id}/plan.svg"]["get"]
    assert list(operation["responses"]["200"]["content"]) == ["image/svg+xml"]
    assert {"404", "409", "422", "503"} <= set(operation["responses"])
