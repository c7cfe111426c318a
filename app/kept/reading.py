"""Bodies about kept plans -> what is kept."""

from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import from_json, to_json

from app.errors import InvalidRequestError, NotJsonError, schema_error
from app.kept.rows import Content
from app.kept.schemas import KeptPlanChange, KeptPlanInput

Model = TypeVar("Model", bound=BaseModel)


def read_content(body: bytes) -> Content:
    """Return the plan that a body has.

    Request and plan are kept as they are, what this version doesn't know of them included.

    Raises
    ------
    NotJsonError, InvalidRequestError
        If it has none.
    """
    data = _json(body)
    parts = _checked(KeptPlanInput, data)
    plan = data.get("plan")
    return Content(parts.name, parts.note, to_json({"request": data["request"], "plan": plan}),
                   len(parts.request.customers),
                   None if parts.plan is None else parts.plan.cost.total)


def read_change(body: bytes) -> KeptPlanChange:
    """Return what a body has changed; raises as `read_content` does."""
    return _checked(KeptPlanChange, _json(body))


def _json(body: bytes) -> Any:
    try:
        return from_json(body, allow_inf_nan=False)
    except ValueError as error:
        raise NotJsonError(f"The body can't be read as JSON: {error}.") from None


def _checked(model: type[Model], data: Any) -> Model:
    try:
        return model.model_validate(data)
    except ValidationError as error:
        raise InvalidRequestError([schema_error(details) for details in error.errors()]) from None
