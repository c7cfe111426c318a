"""The API's own description is what it says it is."""

from collections.abc import Iterator
from typing import Any

import jsonschema
import pytest
from openapi_spec_validator import OpenAPIV31SpecValidator
from pydantic_core import from_json, to_json

from app.main import create_app
from app.schemas.openapi import SCHEMA_REF
from app.serving.settings import Settings

Data = dict[str, Any]


@pytest.fixture(scope="module")
def described() -> Data:
    """Return the description as a client reads it."""
    document: Data = from_json(to_json(create_app(Settings()).openapi()))
    return document


def references(part: Any) -> Iterator[str]:
    """Yield all references of a description, those of its extensions too."""
    if isinstance(part, dict):
        if isinstance(part.get("$ref"), str):
            yield part["$ref"]
        for value in part.values():
            yield from references(value)
    elif isinstance(part, list):
        for value in part:
            yield from references(value)


def test_it_is_valid_in_the_version_that_it_states(described: Data) -> None:
    assert described["openapi"].startswith("3.1.")
    assert [error.message for error in OpenAPIV31SpecValidator(described).iter_errors()] == []


def test_all_that_it_refers_to_is_there(described: Data) -> None:
    known = {SCHEMA_REF.format(model=name) for name in described["components"]["schemas"]}
    assert set(references(described)) <= known


def test_its_examples_fit_its_schemas(described: Data) -> None:
    looked_at = 0
    for operations in described["paths"].values():
        for operation in operations.values():
            for content in operation.get("requestBody", {}).get("content", {}).values():
                for example in content.get("examples", {}).values():
                    schema = content["schema"] | {"components": described["components"]}
                    jsonschema.Draft202012Validator(schema).validate(example["value"])
                    looked_at += 1
    assert looked_at > 20


def test_events_are_described(described: Data) -> None:
    answers = described["paths"]["/jobs/{job_id}/events"]["get"]["responses"]["200"]["content"]
    item = answers["text/event-stream"]["schema"]
    assert item["properties"]["event"]["enum"] == ["progress", "end"]
    named = {each["$ref"].rpartition("/")[2]
             for each in item["properties"]["data"]["contentSchema"]["anyOf"]}
    assert named == {"ProgressEvent", "JobSummaryReply"}
