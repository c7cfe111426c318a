"""Ids, cursors, headers and names that can't be: refused in words, on either database."""

from base64 import urlsafe_b64encode
from collections.abc import Iterator

import httpx
import pytest
from pydantic import SecretStr

from tests.app.postgres import settings_of
from tests.app.records.jobs.conftest import serving
from tests.app.records.jobs.stepping import ended, request_of, submit

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

SECRET = SecretStr("whsec_MDEyMzQ1Njc4OTAxMjM0NTY3ODkwMTIzNDU2Nzg5MDE=")
NOBODY = "00000000-0000-4000-8000-000000000000"

IDS = ("%00", "a%00b", NOBODY[:-1] + "%00", "%FF", "%ED%A0%80", "%F0%9F%9A%9A", "x" * 36,
       "x" * 300, "9" * 30, "%27%20OR%201", "..%00", NOBODY.upper(), "%E2%80%AE", "%0A")

CURSORS = (f"{10**30} {NOBODY}", f"{2**63} {NOBODY}", f"-{10**30} {NOBODY}", f"1 {NOBODY}\0",
           "1 \0", "1 x", f"1_0 {NOBODY}", f"\u0663 {NOBODY}", f"nan {NOBODY}", f"{'9' * 5000} x",
           "1", "", " ", f"1 {NOBODY} 2", f" 1 {NOBODY}")

QUERIES = ("limit=0", "limit=-1", "limit=501", f"limit={'9' * 40}", f"limit={'9' * 5000}",
           "limit=nan", "limit=1e3", "limit=%00", "limit=", "state=%00", "state=Done", "cursor=%00",
           "cursor=%FF", "cursor=", "cursor=====", f"cursor={'a' * 201}", "cursor=%F0%9F%9A%9A")

WEBHOOKS = ("http://example.org/\0", "http://exa\0mple.org/", "http://example.org/\n",
            "http://[::1", "http://example.org:99999/", "http://example.org:\u0663/", "\0", "http:",
            "http://" + "a" * 300 + ".org/", "http://\ud7ff\ufffe.org/", "http://..org/")


@pytest.fixture(scope="module", params=["sqlite", "postgresql"])
def service(request: pytest.FixtureRequest,
            tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """Return a client of a service on either database, with webhooks."""
    settings = settings_of(request, tmp_path_factory.mktemp("odd"))
    with serving(settings.model_copy(update={"webhook_secret": SECRET})) as client:
        yield client


def test_whatever_is_no_id_cursor_or_parameter_is_refused(service: httpx.Client) -> None:
    for name in IDS:
        for method, suffix in (("GET", ""), ("DELETE", ""), ("GET", "/events"),
                               ("GET", "/plan.svg")):
            reply = service.request(method, f"/jobs/{name}{suffix}")
            assert reply.status_code in (404, 422), (method, name, suffix, reply.text)
            assert reply.headers["content-type"] == "application/problem+json", name
    for text in CURSORS:
        cursor = urlsafe_b64encode(text.encode()).decode()
        reply = service.get("/jobs", params={"cursor": cursor})
        assert reply.status_code == 422, (text, reply.text)
    for query in QUERIES:
        reply = service.get(f"/jobs?{query}")
        assert reply.status_code == 422, (query, reply.text)
    # What nobody has is nobody's, and what comes after it an ordinary page.
    assert service.get(f"/jobs/{NOBODY}").status_code == 404
    cursor = urlsafe_b64encode(f"{2**63 - 1} {NOBODY}".encode()).decode()
    assert service.get("/jobs", params={"cursor": cursor}).json() == {"jobs": [], "next": None}


def test_odd_headers_and_webhooks_make_no_failure(service: httpx.Client) -> None:
    body = request_of(0.1)
    for url in WEBHOOKS:
        reply = service.post("/jobs", json=body, params={"webhook": url})
        assert reply.status_code == 422, (url, reply.text)
    job = submit(service, body)
    for number in (b"9" * 40, b"-1", b"nan", b"\xb2", b"\xff", b"1e9"):
        with service.stream("GET", f"/jobs/{job}/events",
                            headers={b"Last-Event-ID": number}) as stream:
            assert stream.status_code == 200
    for key in (b"\xff\xfe", b"a b", b"%00", b"x" * 255):
        first, again = (service.post("/jobs", json=body, headers={b"Idempotency-Key": key})
                        for _ in range(2))
        assert (first.status_code, again.status_code) == (202, 200), key
        assert first.json()["id"] == again.json()["id"]
    for key in (b"", b"x" * 256):
        reply = service.post("/jobs", json=body, headers={b"Idempotency-Key": key})
        assert reply.status_code == 422, key


def test_odd_names_in_a_job_are_planned_and_told(service: httpx.Client) -> None:
    names = ["\0", "a\0b", "\u202e", "\uffff", "\x1b[31m", "$", "<b>&", "\U0001f69a"]
    body = request_of(0.1)
    first = body["customers"][0]
    body["customers"] = [first | {"id": name} for name in names]
    job = ended(service, submit(service, body))
    assert job["state"] == "done", job
    plan = job["result"]
    told = [stop["id"] for route in plan["routes"] for trip in route["trips"]
            for stop in trip["stops"] if stop["kind"] == "customer"]
    assert sorted(told + [left["id"] for left in plan["unassigned"]]) == sorted(names)
    assert service.get(f"/jobs/{job['id']}/plan.svg").status_code == 200
    study = service.post("/compare", json={
        "base": body, "fleets": dict.fromkeys(names[:2], body["fleet"])})
    assert study.status_code == 202, study.text
    assert list(ended(service, study.json()["id"])["result"]["fleets"]) == names[:2]


def test_half_a_character_is_no_json(service: httpx.Client) -> None:
    for path in ("/jobs", "/compare", "/sweep", "/plan", "/check", "/explain", "/fit",
                 "/vroom"):
        reply = service.post(path, content=rb'{"depots": [{"id": "\ud800"}], "customers": []}')
        assert reply.status_code == 400, (path, reply.text)


def test_odd_paths_are_not_found(service: httpx.Client) -> None:
    for path in ("/console/%00", "/console/..%00", "/console/%FF", "/console/" + "x" * 5000,
                 "/%00", "/openapi.json%00", "/metrics%00", "/static-offline-docs/%00",
                 "/static-offline-docs/" + "y" * 300):
        assert service.get(path).status_code in (404, 405), path
