"""Why a job's plan serves customers where it does, over HTTP."""

import uuid

import httpx
import pytest

from app.schemas.explain import ExplainReply
from tests.app.records.jobs.stepping import RAISING_SEED, ended, read, request_of, submit

pytestmark = pytest.mark.slow


def test_plan_of_a_job_is_explained(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(0.2))
    ended(jobs, job)
    reply = jobs.get(f"/jobs/{job}/explain", params={"customer": "c1", "time_limit": 0.5})
    assert reply.status_code == 200, reply.text
    told = reply.json()
    ExplainReply.model_validate(told)
    assert told["customer"] == "c1"
    assert told["cost"] == read(jobs, job)["result"]["cost"]
    assert told["alternatives"]
    told = jobs.get(f"/jobs/{job}/explain", params={"drones": True}).json()
    assert told["drones"]["sorties"] == []


def test_wrong_parameters_are_refused(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(0.2))
    ended(jobs, job)
    for parameters, path in (({"customer": "nobody"}, "query.customer"),
                             ({"shipment": "none"}, "query.shipment"),
                             ({"time_limit": 0}, "query.time_limit"),
                             ({"time_limit": 80_000}, "query.time_limit"),
                             ({"drones": "maybe"}, "query.drones")):
        reply = jobs.get(f"/jobs/{job}/explain", params=parameters)
        assert reply.status_code == 422
        assert [error["path"] for error in reply.json()["errors"]] == [path]


def test_job_without_a_plan_is_not_explained(jobs: httpx.Client) -> None:
    failed = submit(jobs, request_of(0.2, RAISING_SEED))
    ended(jobs, failed)
    reply = jobs.get(f"/jobs/{failed}/explain", params={"customer": "c1"})
    assert (reply.status_code, reply.json()["type"]) == (409, "urn:tandem:error:no-plan")
    reply = jobs.get(f"/jobs/{uuid.uuid4()}/explain")
    assert (reply.status_code, reply.json()["type"]) == (404, "urn:tandem:error:unknown-job")


def test_it_is_documented(jobs: httpx.Client) -> None:
    operation = jobs.get("/openapi.json").json()["paths"]["/jobs/{job_id}/explain"]["get"]
    assert {"200", "404", "409", "422", "503"} <= set(operation["responses"])
