"""Bodies about kept plans -> what is kept."""

from math import inf
from typing import Any

import msgspec
from pydantic import ValidationError

from app.records.kept.rows import Content
from app.records.kept.schemas import KeptPlanInput
from app.requests.refusal import require_json
from app.schemas.errors import InvalidRequestError, schema_error

NOTHING = msgspec.Raw(b"null")

_ALIKE: dict[bytes, Any] = {b"{": {}, b"[": [], b'"': "", b"t": True, b"f": False, b"n": None}
"""Values by how they begin; all others are numbers."""

Fields = dict[str, msgspec.Raw]


def read_content(body: bytes) -> Content:
    """Return the plan that a body has.

    Request and plan are kept as they are, what this version doesn't know of them included, and
    never made into objects, which would take many times their length.

    Raises
    ------
    NotJsonError, InvalidRequestError
        If it has none.
    """
    require_json(body)
    # What is told of a value's type is how it begins.
    value = msgspec.Raw(body.strip())
    parts = _checked(value)
    stated = _fields(value)
    content = b"".join((b'{"request":', stated["request"], b',"plan":',
                        stated.get("plan", NOTHING), b"}"))
    return Content(parts.name, parts.note, msgspec.json.format(content, indent=-1),
                   len(_entries(_fields(stated["request"])["customers"])),
                   None if parts.plan is None else parts.plan.cost.total)


def _checked(body: msgspec.Raw) -> KeptPlanInput:
    """Return what is read of a body, its long lists empty; raises as `read_content` does."""
    outline = _outline(body, {
        "name": _text, "note": _text,
        "request": lambda request: _outline(request, {}),
        "plan": lambda plan: _outline(plan, {
            "cost": lambda cost: _outline(cost, {"total": _number})}),
    })
    try:
        return KeptPlanInput.model_validate(outline)
    except ValidationError as error:
        raise InvalidRequestError([schema_error(details) for details in error.errors()]) from None


def _outline(value: msgspec.Raw, read: dict[str, Any]) -> Any:
    """Return an object of which some fields are read, and others are but of the same type."""
    if _begin(value) != b"{":
        return _alike(value)
    return {name: read.get(name, _alike)(inner) for name, inner in _fields(value).items()}


def _begin(value: msgspec.Raw) -> bytes:
    return bytes(memoryview(value)[:1])


def _alike(value: msgspec.Raw) -> Any:
    """Return something of the same type."""
    return _ALIKE.get(_begin(value), 0)


def _text(value: msgspec.Raw) -> Any:
    """Return a text; of all else something of the same type."""
    return msgspec.json.decode(value) if _begin(value) == b'"' else _alike(value)


def _number(value: msgspec.Raw) -> Any:
    """Return a number; of all else something of the same type."""
    if _begin(value) in _ALIKE:
        return _alike(value)
    try:
        return msgspec.json.decode(value, type=float)
    except msgspec.ValidationError:  # beyond all floats
        return inf


def _fields(value: msgspec.Raw) -> Fields:
    return msgspec.json.decode(value, type=Fields)


def _entries(value: msgspec.Raw) -> list[msgspec.Raw]:
    return msgspec.json.decode(value, type=list[msgspec.Raw])
