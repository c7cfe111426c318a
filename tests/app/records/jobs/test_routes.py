"""Jobs over HTTP, worked on in this process."""

import json
import threading
import uuid
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import pairwise
from typing import Any

import httpx
import pytest
from standardwebhooks import Webhook

from app.maps.streets.gallery import Gallery
from app.records.jobs.schemas import JobListReply, JobReply, ProgressEvent
from tests.app.records.jobs.receiving import FailingReceiver
from tests.app.records.jobs.stepping import (
    BROKEN_SEED, NUM_CUSTOMERS, RAISING_SEED, ended, read, request_of, submit,
)
from tests.conftest import PATIENCE, eventually

pytestmark = pytest.mark.slow

Job = dict[str, Any]

FULL_COST = 2.0 * NUM_CUSTOMERS
EMPTY_COST = 100.0 * NUM_CUSTOMERS

OF_ALL = 40
"""Threads that AnyIO has for all endpoints that are plain functions."""

SECRET = "whsec_MDEyMzQ1Njc4OTAxMjM0NTY3ODkwMTIzNDU2Nzg5MDE="


def running(client: httpx.Client, job: str) -> Job:
    """Wait until a job has a plan and return it."""
    return dict(eventually(lambda: (seen := read(client, job))["cost"] is not None and seen))


def errors_of(reply: httpx.Response) -> set[tuple[str, str]]:
    """Return the codes and paths of a refusal."""
    assert reply.status_code == 422, reply.text
    assert reply.headers["content-type"] == "application/problem+json"
    return {(error["code"], error["path"]) for error in reply.json()["errors"]}


def events_of(client: httpx.Client, job: str,
              last: int | None = None) -> list[tuple[int, str, Job]]:
    """Follow a job to its end; return number, name and data of each event."""
    headers = {} if last is None else {"Last-Event-ID": str(last)}
    found = []
    with client.stream("GET", f"/jobs/{job}/events", headers=headers) as stream:
        assert stream.status_code == 200
        assert stream.headers["content-type"].startswith("text/event-stream")
        event: dict[str, str] = {}
        for line in stream.iter_lines():
            name, _, value = line.partition(": ")
            if name:
                event[name] = value
            elif "event" in event:
                found.append((int(event["id"]), event["event"], json.loads(event["data"])))
                event = {}
    return found


def test_job_is_accepted_planned_and_kept(jobs: httpx.Client) -> None:
    reply = jobs.post("/jobs", json=request_of(0.5))
    assert reply.status_code == 202
    accepted = reply.json()
    JobReply.model_validate(accepted)
    assert accepted["state"] == "queued"
    assert accepted["result"] is None
    assert reply.headers["location"] == f"/jobs/{accepted['id']}"
    job = ended(jobs, accepted["id"])
    JobReply.model_validate(job)
    assert (job["state"], job["progress"], job["error"]) == ("done", 1.0, None)
    assert job["cost"] == job["result"]["cost"]["total"] == FULL_COST
    assert job["created_at"] <= job["started_at"] <= job["finished_at"] < job["expires_at"]
    solver = job["result"]["solver"]
    assert (solver["decoded_cost"], solver["final_cost"]) == (EMPTY_COST, FULL_COST)
    assert solver["search_iterations"] == job["search_iterations"] > 0
    assert solver["elapsed"]["total"] >= solver["elapsed"]["search"] > 0.4


def test_running_job_tells_its_best_plan_so_far(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(30))
    first = running(jobs, job)
    JobReply.model_validate(first)
    assert first["state"] == "running"
    assert first["cost"] == first["result"]["cost"]["total"] > FULL_COST
    later = eventually(lambda: (seen := read(jobs, job))["cost"] < first["cost"] and seen)
    assert later["progress"] > first["progress"] >= 0
    jobs.delete(f"/jobs/{job}")


def test_stopped_job_keeps_its_best_plan(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(60))
    before = running(jobs, job)
    reply = jobs.delete(f"/jobs/{job}")
    assert reply.status_code == 200
    stopped = reply.json()
    JobReply.model_validate(stopped)
    assert stopped["state"] == "cancelled"
    assert stopped["cost"] == stopped["result"]["cost"]["total"] <= before["cost"]
    assert stopped["progress"] < 1
    assert jobs.delete(f"/jobs/{job}").json() == stopped


def test_job_that_waits_is_stopped_at_once(jobs: httpx.Client) -> None:
    ids = [submit(jobs, request_of(60)) for _ in range(3)]
    waiting = ids[-1]
    stopped = jobs.delete(f"/jobs/{waiting}").json()
    assert (stopped["state"], stopped["result"], stopped["started_at"]) == ("cancelled", None, None)
    for job in ids[:-1]:
        jobs.delete(f"/jobs/{job}")


def test_same_key_and_body_make_one_job(jobs: httpx.Client) -> None:
    key = {"Idempotency-Key": str(uuid.uuid4())}
    first = jobs.post("/jobs", json=request_of(0.2), headers=key)
    ended(jobs, first.json()["id"])
    second = jobs.post("/jobs", json=request_of(0.2), headers=key)
    assert (first.status_code, second.status_code) == (202, 200)
    assert second.headers["location"] == first.headers["location"]
    assert second.json()["state"] == "done"


def test_key_with_another_request_is_refused(jobs: httpx.Client) -> None:
    key = {"Idempotency-Key": str(uuid.uuid4())}
    submit(jobs, request_of(0), headers=key)
    refused = [jobs.post("/jobs", json=request_of(0, seed=1), headers=key),
               jobs.post("/sweep", json=request_of(0), headers=key)]
    for reply in refused:
        assert errors_of(reply) == {("IDEMPOTENCY_KEY_REUSED", "header.Idempotency-Key")}
        assert reply.json()["type"] == "urn:tandem:error:idempotency-key-reused"


@pytest.mark.parametrize("key", ["", 256 * "x"])
def test_key_of_no_use_is_refused(jobs: httpx.Client, key: str) -> None:
    reply = jobs.post("/jobs", json=request_of(0), headers={"Idempotency-Key": key})
    assert errors_of(reply) == {("WRONG_LENGTH", "header.Idempotency-Key")}


def test_request_is_validated_when_it_comes(jobs: httpx.Client) -> None:
    request = request_of(1)
    request["fleet"][0]["depot"] = "elsewhere"
    request["x"] = 1
    assert errors_of(jobs.post("/jobs", json=request)) == {
        ("UNKNOWN_FIELD", "$.x"), ("UNKNOWN_DEPOT", "$.fleet[0].depot")}
    assert jobs.post("/jobs", content=b"{").status_code == 400


def test_job_without_customers_has_an_empty_plan(jobs: httpx.Client) -> None:
    job = ended(jobs, submit(jobs, request_of(1) | {"customers": []}))
    JobReply.model_validate(job)
    assert (job["state"], job["cost"], job["result"]["routes"]) == ("done", 0, [])


@pytest.mark.parametrize(("seed", "error"), [
    (BROKEN_SEED, "The plan found breaks a rule, so it is withheld."),
    (RAISING_SEED, "The plan could not be computed."),
])
def test_job_whose_plan_is_none_fails(jobs: httpx.Client, seed: int, error: str) -> None:
    job = ended(jobs, submit(jobs, request_of(0.2, seed)))
    JobReply.model_validate(job)
    assert (job["state"], job["error"], job["result"]) == ("failed", error, None)


def test_unknown_job_is_not_found(jobs: httpx.Client) -> None:
    for reply in (jobs.get(f"/jobs/{uuid.uuid4()}"), jobs.delete("/jobs/x"),
                  jobs.get("/jobs/x/events")):
        assert reply.status_code == 404
        assert reply.json()["type"] == "urn:tandem:error:unknown-job"


def test_pages_list_each_job_once_the_youngest_first(jobs: httpx.Client) -> None:
    ids = [submit(jobs, request_of(0)) for _ in range(5)]
    listed: list[str] = []
    cursor: dict[str, str] = {}
    while True:
        page = jobs.get("/jobs", params={"limit": 2, **cursor}).json()
        JobListReply.model_validate(page)
        listed += [job["id"] for job in page["jobs"]]
        if page["next"] is None:
            break
        cursor = {"cursor": page["next"]}
    assert listed[:5] == ids[::-1]
    assert len(set(listed)) == len(listed)


def test_list_needs_no_thread_that_others_wait_in(
        jobs: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    arrived = threading.Semaphore(0)
    go_on = threading.Event()

    def find(gallery: Gallery, name: str) -> None:
        arrived.release()
        go_on.wait()

    monkeypatch.setattr(Gallery, "find", find)
    with ThreadPoolExecutor(OF_ALL) as pool:
        tiles = [pool.submit(jobs.get, "/map/city/0/0/0") for _ in range(OF_ALL)]
        try:
            for _ in tiles:
                assert arrived.acquire(timeout=PATIENCE)
            assert jobs.get("/jobs").status_code == 200
        finally:
            go_on.set()
        assert {tile.result().status_code for tile in tiles} == {404}


def test_list_is_filtered_by_state(jobs: httpx.Client) -> None:
    ended(jobs, submit(jobs, request_of(0.1, BROKEN_SEED)))
    page = jobs.get("/jobs", params={"state": "failed"}).json()
    assert {job["state"] for job in page["jobs"]} == {"failed"}


@pytest.mark.parametrize(("query", "error"), [
    ("limit=0", ("OUT_OF_RANGE", "query.limit")),
    ("limit=many", ("WRONG_TYPE", "query.limit")),
    ("state=odd", ("UNKNOWN_VALUE", "query.state")),
    ("cursor=odd", ("WRONG_PARAMETER", "query.cursor")),
])
def test_wrong_parameters_are_named(jobs: httpx.Client, query: str, error: tuple[str, str]) -> None:
    assert errors_of(jobs.get(f"/jobs?{query}")) == {error}


@pytest.mark.by_clock
def test_events_tell_of_progress_and_the_end(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(2.5))
    events = events_of(jobs, job)
    numbers, names, data = zip(*events, strict=True)
    assert list(names) == ["progress"] * (len(names) - 1) + ["end"]
    assert list(numbers) == sorted(numbers)
    assert len(names) > 4
    for told in data[:-1]:
        ProgressEvent.model_validate(told)
    costs = [told["cost"] for told in data[:-1] if told["cost"] is not None]
    assert costs == sorted(costs, reverse=True)
    fell = [True, *(later < sooner for sooner, later in pairwise(costs))]
    assert [told["improved"] for told in data[:-1] if told["cost"] is not None] == fell
    assert data[-1] == {key: value for key, value in read(jobs, job).items() if key != "result"}


def test_events_go_on_after_the_last_one_received(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(0.2))
    ended(jobs, job)
    ((number, name, _), end) = events_of(jobs, job)
    assert (name, end[1]) == ("progress", "end")
    assert events_of(jobs, job, last=number) == [end]
    assert len(events_of(jobs, job, last=number - 1)) == 2


def test_clients_that_leave_are_forgotten(jobs: httpx.Client) -> None:
    job = submit(jobs, request_of(60))
    for _ in range(3):
        with jobs.stream("GET", f"/jobs/{job}/events") as stream:
            next(stream.iter_lines())
    jobs.delete(f"/jobs/{job}")
    assert events_of(jobs, job)[-1][2]["state"] == "cancelled"


def test_metrics_count_jobs(jobs: httpx.Client) -> None:
    ended(jobs, submit(jobs, request_of(0.1)))

    def counted(name: str) -> list[float]:
        return [float(line.split()[-1]) for line in jobs.get("/metrics").text.splitlines()
                if line.startswith(name)]

    for name in ('tandem_jobs_submitted_total{kind="plan"}',
                 'tandem_jobs_finished_total{kind="plan",state="done"}',
                 'tandem_jobs{kind="plan",state="done"}'):
        # A job is over a moment before it is counted.
        (count,) = eventually(partial(counted, name))
        assert count >= 1


@pytest.fixture
def receiver() -> Iterator[FailingReceiver]:
    """Return a receiver that fails at first."""
    receiver = FailingReceiver(failures=1)
    yield receiver
    receiver.close()


def test_webhook_is_signed_and_called_again_after_a_failure(
        jobs: httpx.Client, receiver: FailingReceiver) -> None:
    job = ended(jobs, submit(jobs, request_of(0.1), params={"webhook": receiver.url}))
    eventually(lambda: len(receiver.calls) == 2)
    (first, second) = [Webhook(SECRET).verify(body, headers) for headers, body in receiver.calls]
    assert first == second
    assert first["type"] == "job.done"
    assert first["data"] == {key: value for key, value in job.items() if key != "result"}
    assert len({headers["webhook-id"] for headers, _ in receiver.calls}) == 1


@pytest.mark.parametrize("url", [
    "", "ftp://example.org", "example.org", "https://", "https://u:p@a.org/", "http://[::1",
    "https://a.org/" + 2000 * "x"])
def test_what_is_no_webhook_is_refused(jobs: httpx.Client, url: str) -> None:
    reply = jobs.post("/jobs", json=request_of(0), params={"webhook": url})
    assert errors_of(reply) == {("WEBHOOK", "query.webhook")}
