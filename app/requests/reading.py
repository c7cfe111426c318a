"""Bytes -> a valid `PlanRequest`, or every error of the request at once."""

from collections.abc import Collection, Sequence
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails, from_json, to_json

from app.requests.bounds import UNBOUNDED, Bounds, bound_errors, leg_errors
from app.requests.draft import Draft
from app.requests.ends import added_names, stated_errors
from app.requests.forecast_validation import forecast_errors
from app.requests.refusal import MAX_COUNTED_ERRORS, MAX_SEARCHED_BYTES, require_readable
from app.requests.validation import semantic_errors
from app.schemas.airspace import AirspaceInput
from app.schemas.customer import CustomerInput
from app.schemas.day import Day, DayOfBody
from app.schemas.errors import (
    InputError, InvalidRequestError, NotJsonError, RequestError, schema_errors,
)
from app.schemas.hints import with_hints
from app.schemas.launch_site import LaunchSiteInput
from app.schemas.request import (
    DepotInput,
    MatrixInput,
    OptionsInput,
    PlanRequest,
    ReplanInput,
)
from app.schemas.times import read_body
from app.schemas.vehicle import VehicleTypeInput

Section = TypeVar("Section", bound=BaseModel)
Parts = set[tuple[str | int, ...]]


def read_request(body: bytes, policies: Collection[str] | None,
                 bounds: Bounds = UNBOUNDED) -> PlanRequest:
    """Return the request that `body` holds.

    Parameters
    ----------
    body
        JSON.
    policies
        Those that may be asked for; None allows any.
    bounds
        How large the request may be.

    Raises
    ------
    NotJsonError
        If `body` is not JSON.
    InvalidRequestError
        With every error found, if it is not a valid request.
    """
    require_readable(body, PlanRequest)
    try:
        request = read_body(PlanRequest, body)
    except ValidationError as error:
        raise _refusal(error, body, policies, bounds) from error
    errors = request_errors(request, policies, bounds)
    if errors:
        raise InvalidRequestError(errors)
    return request


def request_errors(request: PlanRequest, policies: Collection[str] | None,
                   bounds: Bounds) -> list[InputError]:
    """Return every error of a request that fits the schema."""
    draft = _whole_draft(request)
    errors = [*semantic_errors(draft, policies), *bound_errors(draft, bounds)]
    errors = errors or [*leg_errors(request, bounds), *forecast_errors(request, draft)]
    return stated_errors(request, errors) if errors and draft.added else errors


def read_json(body: bytes) -> Any:
    """Return the JSON value that `body` holds.

    Raises
    ------
    NotJsonError
        If `body` is not JSON.
    """
    try:
        return from_json(body, allow_inf_nan=False)
    except ValueError as error:
        raise NotJsonError(f"The body is not JSON, {error}: send one JSON object.") from error


def read_model(body: bytes, kind: type[Section], day: DayOfBody | None = None) -> Section:
    """Return what a body states that is no problem to be planned; `day` is its own if not stated.

    Raises
    ------
    NotJsonError
        If it isn't JSON.
    InvalidRequestError
        With every error, if it states something else than `kind`.
    """
    require_readable(body, kind)
    try:
        return read_body(kind, body, day)
    except ValidationError as error:
        # An error holds what was sent, which of a long body would take much memory.
        details = error.errors(include_url=False, include_input=len(body) <= MAX_SEARCHED_BYTES)
        if details[0]["type"] == "json_invalid":
            read_json(body)
        raise InvalidRequestError(with_hints(schema_errors(details), kind)) from error


def _refusal(error: ValidationError, body: bytes,
             policies: Collection[str] | None, bounds: Bounds) -> RequestError:
    """Return the refusal of a body that doesn't fit the schema, semantic errors included."""
    if error.error_count() > MAX_COUNTED_ERRORS:
        message = f"The request has {error.error_count()} errors: compare it with the schema."
        return InvalidRequestError([InputError(code="TOO_MANY_ERRORS", path="$", message=message)])
    details = error.errors(include_url=False)
    errors = schema_errors(details)
    if len(body) <= MAX_SEARCHED_BYTES or details[0]["type"] == "json_invalid":
        try:
            raw = read_json(body)
        except NotJsonError as not_json:
            return not_json
        if isinstance(raw, dict) and tells_day(details):
            draft = partial_draft(raw, details, DayOfBody(body))
            errors += [*semantic_errors(draft, policies), *bound_errors(draft, bounds)]
    return InvalidRequestError(with_hints(errors, PlanRequest))


def tells_day(details: Sequence[ErrorDetails]) -> bool:
    """Tell whether what is wrong leaves the day of a plan known, so that instants mean anything."""
    return not {("plan_start",), ("time_zone",)} & _broken_parts(details)


def _broken_parts(details: Sequence[ErrorDetails]) -> Parts:
    """Return the sections, and the entries of sections, that hold an error."""
    return {item["loc"][:2] for item in details}


def _whole_draft(request: PlanRequest) -> Draft:
    return Draft(
        coordinate_system=request.coordinate_system,
        planar_unit=request.planar_unit,
        depots=request.depots,
        customers=request.customers,
        fleet=request.fleet,
        matrices=request.matrices,
        matrices_known=True,
        airspace=request.airspace,
        options=request.options,
        replan=request.replan,
        planar_rounding=request.planar_rounding,
        load_dimensions=request.load_dimensions,
        day=(None if request.plan_start is None
             else Day.of(request.plan_start, request.time_zone)),
        incompatible_goods=request.incompatible_goods,
        launch_sites=request.launch_sites,
        fairness=request.fairness,
        relations=request.relations,
        delivery_of={name: each.named_ends()[-1][0] for each in request.shipments
                     for name, _ in each.named_ends()},
        shipment_ends=frozenset(end.id for each in request.shipments for end in each.ends()),
        added=frozenset(added_names(request)),
    )


def partial_draft(raw: dict[str, Any], details: Sequence[ErrorDetails], day: DayOfBody) -> Draft:
    """Return the well-formed parts of a request, by what is wrong with the others."""
    broken = _broken_parts(details)
    scale_known = not {("coordinate_system",), ("planar_unit",)} & broken
    return Draft(
        coordinate_system=raw.get("coordinate_system", "planar") if scale_known else None,
        planar_unit=raw.get("planar_unit", 1.0) if scale_known else 1.0,
        depots=_entries(raw, broken, "depots", DepotInput, day),
        customers=_customers(raw, broken, day),
        fleet=_entries(raw, broken, "fleet", VehicleTypeInput, day),
        matrices=_matrices(raw, broken),
        matrices_known=("matrices",) not in broken,
        airspace=_section(raw, broken, "airspace", AirspaceInput, day),
        options=_section(raw, broken, "options", OptionsInput, day),
        replan=(None if raw.get("replan") is None
                else _section(raw, broken, "replan", ReplanInput, day)),
        planar_rounding=raw.get("planar_rounding", "exact"),
        day=None if raw.get("plan_start") is None else day.day,
        launch_sites=(() if "launch_sites" not in raw else
                      _entries(raw, broken, "launch_sites", LaunchSiteInput, day)),
    )


def _customers(raw: dict[str, Any], broken: Parts,
               day: DayOfBody) -> list[CustomerInput | None] | None:
    """Return the entries of customers, and a None where others count as customers too."""
    entries = _entries(raw, broken, "customers", CustomerInput, day)
    if entries is not None and (raw.get("shipments") or any(
            each is not None and each.alternatives for each in entries)):
        entries.append(None)
    return entries


def _entries(raw: dict[str, Any], broken: Parts, name: str,
             kind: type[Section], day: DayOfBody) -> list[Section | None] | None:
    """Return the entries of a list, None for broken ones, or None if the list is."""
    if (name,) in broken:
        return None
    return [None if (name, index) in broken else read_body(kind, to_json(value), day)
            for index, value in enumerate(raw[name])]


def _section(raw: dict[str, Any], broken: Parts, name: str, kind: type[Section],
             day: DayOfBody) -> Section | None:
    if any(part[0] == name for part in broken):
        return None
    return read_body(kind, to_json(raw.get(name, {})), day)


def _matrices(raw: dict[str, Any], broken: Parts) -> dict[str, MatrixInput | None] | None:
    if ("matrices",) in broken or raw.get("matrices") is None:
        return None
    return {name: None if ("matrices", name) in broken
            else MatrixInput.model_validate_json(to_json(value))
            for name, value in raw["matrices"].items()}
