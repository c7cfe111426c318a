"""The API's own description, with examples that run as they stand."""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any, cast

from fastapi import FastAPI, Request
from fastapi.routing import APIRoute
from pydantic import BaseModel
from pydantic.json_schema import JsonSchemaMode, models_json_schema

from app.schemas.errors import MEDIA_TYPE, ProblemDocument

SCHEMA_REF = "#/components/schemas/{model}"

BODY = "requestBody"

EXAMPLES_DIR = Path(__file__).parent / "examples"

EXAMPLES = {
    "smallest": "Two customers, one truck, all else by default",
    "berlin": "Forty places in Berlin, two vans with a drone each, a no-fly area",
    "drones": "Trucks with a drone each, time windows and a shift",
    "hubs": "Drones that fly from two hubs by themselves, beside a truck",
    "launch_sites": "A truck stops for its drone alone, at a pier, and comes back to customers",
    "table1": "The paper's hundred customers, four trucks with a drone each",
    "hetero_day": "A heterogeneous fleet on several trips within working hours",
    "city_day": "A city: true addresses, rush hours, a no-fly area, wind",
    "clocks": "Times of day, a currency and units, on a day of 23 hours",
    "permits": "Drones by a published rule, in wind by the hour",
    "choosy": "Several windows, a price of leaving out, customers who name vehicles",
    "roads": "Helsinki's centre by car: on roads if the service has any, else as the crow flies",
    "zones": "Zones as authorities publish them: by height, by hour, one that is cleared",
    "replan": "A truck is under way: an order has come in, another was cancelled",
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
        (503, "The service is starting, stopping or busy, the process that planned died, or roads "
              "don't answer: try again after `Retry-After` seconds."),
    )
}
TAGS = [
    {"name": "planning", "description": "Plans within seconds."},
    {"name": "jobs", "description": "Long plans, comparisons and sweeps in the background."},
    {"name": "kept plans", "description": "Plans that are kept by name, and shared by links."},
    {"name": "drivers", "description": "Plans on the road: links for drivers, and what they tell."},
    {"name": "days", "description": "Days as they happen: events, and a plan after each."},
    {"name": "operations", "description": "For those who run the service."},
]
REFUSALS = {
    "400": "There is a key in the URL, or the request can't be read.",
    "401": "There is no valid API key.",
    "403": "The API key lacks the scope, or a page of another origin asks.",
    "421": "The service is not called by this name, and access is open.",
    "429": "A rate limit or a share of the open jobs is used up, or too many keys were wrong: try "
    "again after `Retry-After` seconds.",
    "503": "The service is busy, or about to stop: try again after `Retry-After` seconds.",
}
"""What every endpoint that needs a key may answer before it looks at a request."""

BODY_REFUSALS = {"408": "The body took too long to arrive."}
"""What those with a body may answer beside."""


def operation_id(route: APIRoute) -> str:
    """Name an operation as its function: generated clients call their functions so."""
    return route.name


def json_body(model: type[BaseModel], examples: Mapping[str, str] = {}) -> dict[str, Any]:
    """Return `openapi_extra` of an endpoint that reads its body itself.

    Endpoints do so for speed and for all errors at once; FastAPI then doesn't know the schema.

    Parameters
    ----------
    model
        What the body must be.
    examples
        Names of files in `app/schemas/examples` and what they show.
    """
    _taken.add(model)
    # FastAPI asks it for its items alone, when somebody asks for the description.
    return cast("dict[str, Any]", _JsonBody(model, examples))


_taken: set[type[BaseModel]] = set()
"""What endpoints take that read their bodies themselves."""


_told: set[type[BaseModel]] = set()
"""What events tell."""


class _JsonBody(Mapping[str, Any]):
    """What `json_body` returns, made anew whenever it is looked at: most processes never do."""

    def __init__(self, model: type[BaseModel], examples: Mapping[str, str]) -> None:
        self._model = model
        self._examples = examples

    def __getitem__(self, key: str) -> Any:
        if key != BODY:
            raise KeyError(key)
        content: dict[str, Any] = {
            "schema": {"$ref": SCHEMA_REF.format(model=self._model.__name__)}}
        if self._examples:
            content["examples"] = {
                name: {"summary": summary,
                       "value": json.loads((EXAMPLES_DIR / f"{name}.json").read_text("utf-8"))}
                for name, summary in self._examples.items()
            }
        return {"required": True, "content": {"application/json": content}}

    def __iter__(self) -> Iterator[str]:
        return iter((BODY,))

    def __len__(self) -> int:
        return 1


@cache
def _schemas() -> dict[str, Any]:
    """Return the schemas of all bodies, and of problems, by name. Not to be changed.

    Together they take a second; one by one each would make again what it shares with others.
    """
    return _schemas_of({*_taken, ProblemDocument}, "validation")


def _schemas_of(models: Iterable[type[BaseModel]], mode: JsonSchemaMode) -> dict[str, Any]:
    _, made = models_json_schema(
        [(model, mode) for model in sorted(models, key=lambda each: each.__name__)],
        ref_template=SCHEMA_REF)
    return cast("dict[str, Any]", _without_none(made["$defs"]))


def _without_none(value: Any) -> Any:
    """Return a schema without the defaults that are null, as FastAPI writes its own."""
    if isinstance(value, dict):
        return {key: _without_none(inner) for key, inner in value.items() if inner is not None}
    return [_without_none(inner) for inner in value] if isinstance(value, list) else value


def problems(*statuses: int, **described: str) -> dict[int | str, dict[str, Any]]:
    """Return the problems that an endpoint may answer with.

    Parameters
    ----------
    statuses
        Those that mean what they usually do.
    described
        Others, such as `_404`, with what they mean.
    """
    content = ERROR_RESPONSES[422]["content"]
    own: dict[int | str, dict[str, Any]] = {
        int(status[1:]): {"description": text, "content": content}
        for status, text in described.items()}
    return {status: ERROR_RESPONSES[status] for status in statuses} | own


def event_stream(**events: type[BaseModel]) -> dict[str, Any]:
    """Return the content of a reply of server-sent events: what `data` of each event is.

    Its schema is that of an event, as programs read it: OpenAPI 3.1 has no word for a stream.
    """
    _told.update(events.values())
    data = {"type": "string", "contentMediaType": "application/json", "contentSchema": {
        "anyOf": [{"$ref": SCHEMA_REF.format(model=model.__name__)} for model in events.values()]}}
    return {"text/event-stream": {"schema": {
        "type": "object",
        "description": "One of the events that follow one another.",
        "properties": {"event": {"enum": list(events)}, "id": {"type": "string"}, "data": data},
        "required": ["event", "id", "data"],
    }}}


def describe(app: FastAPI) -> Callable[[], dict[str, Any]]:
    """Return the function that makes `app`'s description, bodies read by hand included."""
    describe_endpoints = app.openapi

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is not None:
            return app.openapi_schema
        description = describe_endpoints()
        schemas = description["components"]["schemas"]
        description["components"]["schemas"] = (
            _schemas_of(_told, "serialization") | schemas | _schemas())
        _add_refusals(description)
        return description

    return openapi


def allowed_methods(request: Request) -> dict[str, str]:
    """Return the header that lists what a known path takes; Starlette lists one endpoint's."""
    route = request.scope.get("route")
    operations = request.app.openapi()["paths"].get(getattr(route, "path", None), {})
    return {"Allow": ", ".join(method.upper() for method in operations)} if operations else {}


def _add_refusals(description: dict[str, Any]) -> None:
    """Document how endpoints that need a key turn requests away. In place."""
    content = {MEDIA_TYPE: {"schema": {"$ref": SCHEMA_REF.format(model="ProblemDocument")}}}
    for operations in description["paths"].values():
        for operation in operations.values():
            if "security" not in operation:
                continue
            refusals = REFUSALS | (BODY_REFUSALS if BODY in operation else {})
            for status, reason in refusals.items():
                operation["responses"].setdefault(
                    status, {"description": reason, "content": content})

