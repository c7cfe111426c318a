"""What a body takes that is wrong all over: little memory, little time, and words for it."""

import json
import random
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import httpx
import msgspec
import pytest
from pydantic import BaseModel, ValidationError

from app.formats.vroom.schemas import VroomRequest
from app.records.jobs.schemas import CompareRequest, SweepRequest
from app.requests import refusal
from app.requests.refusal import require_readable
from app.requests.shapes import LONG, read_shape
from app.schemas.check import CheckRequest
from app.schemas.errors import InvalidRequestError
from app.schemas.explain import ExplainRequest
from app.schemas.fit import FitRequest
from app.schemas.flights import FlightsRequest
from app.schemas.request import PlanRequest
from app.schemas.times import read_body
from app.serving.settings import Settings
from tests.app.conftest import APP_DIR, FirstFitPlanner, ready
from tests.app.requests.wrong_bodies import SHAPES, body_of
from tests.conftest import PATIENCE
from tests.seeds import often

pytestmark = pytest.mark.slow

MULTIPLE, BESIDE = 32, 250 * 2**20
"""What reading a body may take: so many times its length, and so many bytes beside."""

MODELS: tuple[type[BaseModel], ...] = (
    PlanRequest, CheckRequest, VroomRequest, SweepRequest, CompareRequest)

Data = dict[str, Any]


@pytest.mark.thorough
def test_refused_bodies_take_a_bounded_multiple_of_their_length_and_little_time() -> None:
    # In a process of its own, whose memory nothing else has grown.
    told = subprocess.run([sys.executable, "-m", "tests.app.requests.wrong_bodies"],
                          cwd=Path(__file__).parents[3], check=True, stdout=subprocess.PIPE).stdout
    taken = [json.loads(line) for line in told.splitlines()]
    assert len(taken) == sum(map(len, SHAPES.values()))
    for endpoint, name, length, grown, seconds, outcome in taken:
        assert outcome != "read", (endpoint, name)
        assert grown <= MULTIPLE * length + BESIDE, (endpoint, name, grown / length)
        assert seconds < 1 + length / 2**22, (endpoint, name, outcome)
    assert sorted(seconds for *_, seconds, _ in taken)[len(taken) // 2] < 0.5


def _examples() -> Iterator[tuple[type[BaseModel], bytes]]:
    for path in sorted((APP_DIR / "schemas" / "examples").glob("*.json")):
        body = path.read_bytes()
        if path.name.startswith("vroom"):
            yield VroomRequest, body
        elif path.name.startswith("check"):
            yield CheckRequest, body
        elif path.name.startswith("explain"):
            yield ExplainRequest, body
        elif path.name.startswith("fit"):
            yield FitRequest, body
        elif path.name.startswith("flights"):
            yield FlightsRequest, body
        else:
            yield PlanRequest, body


def test_what_fits_the_schema_has_its_shape() -> None:
    seen = set()
    for model, body in _examples():
        read_body(model, body)
        read_shape(body, model)
        seen.add(model)
    assert len(seen) == 6


def _changes(value: Any, path: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """Yield the path of every value."""
    if path:
        yield path
    entries = (value.items() if isinstance(value, dict)
               else enumerate(value) if isinstance(value, list) else ())
    for key, inner in entries:
        yield from _changes(inner, (*path, key))


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("wrong", [None, True, "", "a" * 1000, "\u20ac" * 501, -1, 0.5, 1e300, [],
                                   {}, [[[0]]], {"a": {"b": 1}}, [None] * 5, ["x", "y"], [0.5, -1]])
def test_nothing_is_refused_by_its_shape_that_the_schema_takes(wrong: Any) -> None:
    for model, body in _examples():
        request = json.loads(body)
        paths = list(_changes(request))
        for path in random.Random(7).sample(paths, min(len(paths), often(50))):
            changed = json.loads(body)
            place = changed
            for key in path[:-1]:
                place = place[key]
            place[path[-1]] = wrong
            if isinstance(place, dict):
                place |= {"unknown": wrong}
            text = json.dumps(changed, ensure_ascii=False).encode()
            try:
                read_shape(text, model)
            except msgspec.ValidationError:
                with pytest.raises(ValidationError):
                    read_body(model, text)


def test_every_long_array_of_numbers_is_left_at_its_first_error() -> None:
    def arrays(schema: Any) -> Iterator[Data]:
        if isinstance(schema, dict):
            if schema.get("type") == "list":
                yield schema
            schema = list(schema.values())
        if isinstance(schema, list | tuple):
            for inner in schema:
                yield from arrays(inner)

    for model in MODELS:
        for array in arrays(model.__pydantic_core_schema__):
            if (array.get("items_schema", {}).get("type") in ("int", "float")
                    and (array.get("max_length") or LONG + 1) > LONG):
                assert array.get("fail_fast"), (model, array)
    with pytest.raises(ValidationError) as refused:
        PlanRequest.model_validate({
            "depots": [], "customers": [], "fleet": [],
            "matrices": {"a": {"durations": [["x"] * 5, ["y"]], "distances": None}},
            "replan": {"plan": {"routes": [{"vehicle": "a", "type": "a", "trips": [
                {"stops": [], "load": ["x"] * 5}]}]}}})
    assert refused.value.error_count() == 2


def test_refusal_says_where_and_why() -> None:
    def refused(endpoint: str, name: str) -> tuple[str, str, str]:
        model = {"plan": PlanRequest, "sweep": SweepRequest}[endpoint]
        with pytest.raises(InvalidRequestError) as error:
            require_readable(body_of(SHAPES[endpoint][name], 2**20), model)
        (found,) = error.value.errors
        return found.code, found.path, found.message

    assert refused("plan", "words for loads") == (
        "WRONG_TYPE", "$.replan.plan.routes[0].trips[0].load[0]",
        "The value must be a JSON number: state one, not a string. routes: One entry per vehicle "
        "used.")
    assert refused("plan", "skills without end") == (
        "WRONG_LENGTH", "$.customers[0].skills",
        "There are more than 100 entries: remove some.")
    code, path, message = refused("plan", "what isn't read, lists")
    assert (code, path) == ("TOO_MANY_PARTS", "$")
    assert "objects and arrays, more than any request needs" in message
    assert refused("plan", "unknown fields")[:2] == ("UNKNOWN_FIELD", "$.x")
    assert refused("plan", "rows of words")[:2] == (
        "MATRIX_VALUE", "$.matrices.truck.durations[0][0]")


@pytest.mark.parametrize("where", [
    b'"customers":[{"id":"1","demand":[1],"info":{%s}}]',
    b'"customers":[{"id":"1","demand":[1],"vehicle_costs":{%s}}]',
    b'"replan":{"plan":{"routes":[],"summary":{%s}}}',
    b'"replan":{"plan":{"routes":[],"legs":[{%s}]}}'])
def test_maps_are_bounded_by_their_keys_before_they_are_read(where: bytes) -> None:
    def code(size: int) -> tuple[str, str]:
        keys = b",".join(b'"%d":""' % index for index in range(size))
        with pytest.raises(InvalidRequestError) as refused:
            require_readable(b'{"depots":[],"fleet":[],' + where % keys + b"}", PlanRequest)
        (found,) = refused.value.errors
        return found.code, found.path

    assert code(refusal.MAX_COLONS) == ("TOO_MANY_PARTS", "$")
    fewer, path = code(refusal.MAX_COLONS // 2)
    assert fewer != "TOO_MANY_PARTS"
    assert path != "$"


def test_large_valid_requests_are_let_through() -> None:
    customers = [{"id": str(index), "location": [index, 0.5], "demand": [1, 2, 3],
                  "location_index": index, "skills": ["a", "b"],
                  "time_window": {"earliest": 0, "latest": 1e6}} for index in range(10_000)]
    customers[0]["info"] = {"notes": "\u20ac" * 500}
    row = b"[" + b",".join([b"1234.5"] * 2000) + b"]"
    body = (json.dumps({"depots": [{"id": "a"}], "fleet": [], "customers": customers},
                       ensure_ascii=False).encode()[:-1]
            + b',"matrices":{"truck":{"durations":[' + b",".join([row] * 2000) + b"]}}}")
    assert len(body) > 28 * 2**20
    require_readable(body, PlanRequest)


def test_long_bodies_tell_what_the_schema_tells_beside_their_legs() -> None:
    row = b"[" + b",".join([b"1.5"] * 1500) + b"]"
    legs = b"[" + b",".join([row] * 1500) + b"]"
    with pytest.raises(InvalidRequestError) as refused:
        require_readable(b'{"depots":[],"x":[1],"customers":[{"id":3,"demand":[1]}],"matrices":'
                         b'{"truck":{"durations":' + legs + b"}}}", PlanRequest)
    assert [(error.code, error.path) for error in refused.value.errors] == [
        ("WRONG_TYPE", "$.customers[0].id"), ("MISSING_FIELD", "$.fleet"),
        ("UNKNOWN_FIELD", "$.x")]
    assert refused.value.errors[0].message == (
        "The value must be a JSON string: write \"3\". id: Name of the customer, unique "
        "among customers.")


def test_short_bodies_keep_each_of_their_errors(client: httpx.Client, smallest: Data) -> None:
    smallest["customers"] = [{"id": str(index), "demand": index} for index in range(1800)]
    reply = client.post("/plan", json=smallest)
    assert len(reply.request.content) > refusal.LEAST_BYTES
    assert reply.json()["detail"] == "The request has 1800 errors; the first 1000 are listed."


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize(("path", "endpoint", "name"), [
    ("/plan", "plan", "numbers for routes"), ("/jobs", "plan", "unknown fields"),
    ("/vroom", "vroom", "unknown fields"), ("/sweep", "sweep", "keys"),
    ("/compare", "compare", "numbers for fleets"), ("/check", "check", "numbers for routes")])
def test_others_are_answered_while_wrong_bodies_are_refused(
        serve: Callable[..., httpx.Client], tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
        path: str, endpoint: str, name: str) -> None:
    begun, answered = threading.Event(), threading.Event()
    read = read_shape

    def read_once_others_are_answered(body: bytes, model: type[BaseModel]) -> None:
        begun.set()
        assert answered.wait(PATIENCE)
        read(body, model)

    monkeypatch.setattr(refusal, "read_shape", read_once_others_are_answered)
    client = serve(FirstFitPlanner(), Settings(data_dir=tmp_path))
    ready(client)
    body = body_of(SHAPES[endpoint][name], 3 * 2**20)
    with ThreadPoolExecutor() as threads:
        refused = threads.submit(client.post, path, content=body)
        assert begun.wait(PATIENCE)
        assert client.get("/health/live").is_success
        answered.set()
        assert refused.result().status_code in (400, 422)
