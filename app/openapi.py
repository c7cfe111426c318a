"""The API's own description, with examples that run as they stand."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from fastapi import FastAPI

from app.errors import MEDIA_TYPE, ProblemDocument
from app.schemas_request import PlanRequest

SCHEMA_REF = "#/components/schemas/{model}"

EXAMPLES_DIR = Path(__file__).parent / "examples"

EXAMPLES = {
    "smallest": "Two customers, one truck, all else by default",
    "drones": "Trucks with a drone each, time windows and a shift",
    "table1": "The paper's hundred customers, four trucks with a drone each",
    "hetero_day": "A heterogeneous fleet on several trips within working hours",
    "city_day": "A city: geographic, rush hours, a no-fly area, wind",
}
ERROR_RESPONSES: dict[int | str, dict[str, Any]] = {
    status: {
        "description": description,
        "content": {MEDIA_TYPE: {"schema": {"$ref": SCHEMA_REF.format(model="ProblemDocument")}}},
    }
    for status, description in (
        (400, "The body is not JSON."),
        (413, "The body is too large."),
        (422, "The request is not valid; every error is listed."),
        (500, "The plan found broke a rule, so it is withheld."),
        (503, "The service is starting."),
    )
}


def describe(app: FastAPI) -> Callable[[], dict[str, Any]]:
    """Return the function that makes `app`'s description, the request of `POST /plan` included.

    Endpoints read the body themselves, for speed and for all errors at once, so FastAPI doesn't
    know its schema; nor that of error replies, which aren't plain JSON.
    """
    describe_endpoints = app.openapi

    def openapi() -> dict[str, Any]:
        description = describe_endpoints()
        for model in (PlanRequest, ProblemDocument):
            schema = model.model_json_schema(ref_template=SCHEMA_REF)
            description["components"]["schemas"] |= schema.pop("$defs") | {model.__name__: schema}
        description["paths"]["/plan"]["post"]["requestBody"] = _plan_request_body()
        return description

    return openapi


def _plan_request_body() -> dict[str, Any]:
    examples = {
        name: {"summary": summary,
               "value": json.loads((EXAMPLES_DIR / f"{name}.json").read_text("utf-8"))}
        for name, summary in EXAMPLES.items()
    }
    content = {"schema": {"$ref": SCHEMA_REF.format(model="PlanRequest")}, "examples": examples}
    return {"required": True, "content": {"application/json": content}}
