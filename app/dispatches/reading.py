"""Bodies -> what they state."""

from typing import TypeVar

from pydantic import BaseModel, ValidationError

from app.errors import InvalidRequestError, schema_error
from app.requests.reading import read_json

Kind = TypeVar("Kind", bound=BaseModel)


def read_model(body: bytes, kind: type[Kind]) -> Kind:
    """Return what a body states.

    Raises
    ------
    NotJsonError
        If it isn't JSON.
    InvalidRequestError
        With every error, if it states something else than `kind`.
    """
    try:
        return kind.model_validate_json(body)
    except ValidationError as error:
        read_json(body)
        details = error.errors(include_url=False)
        raise InvalidRequestError([schema_error(item) for item in details]) from error
