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

Raw = msgspec.Raw | msgspec.UnsetType


class _Stated(msgspec.Struct):
    request: msgspec.Raw = NOTHING
    plan: msgspec.Raw = NOTHING


class _Customers(msgspec.Struct):
    customers: msgspec.Raw


class _Body(msgspec.Struct, forbid_unknown_fields=True):
    name: Raw = msgspec.UNSET
    note: Raw = msgspec.UNSET
    request: Raw = msgspec.UNSET
    plan: Raw = msgspec.UNSET
    day: Raw = msgspec.UNSET


class _Request(msgspec.Struct):
    depots: Raw = msgspec.UNSET
    customers: Raw = msgspec.UNSET
    fleet: Raw = msgspec.UNSET


class _Plan(msgspec.Struct):
    cost: Raw = msgspec.UNSET
    routes: Raw = msgspec.UNSET


class _Cost(msgspec.Struct):
    total: Raw = msgspec.UNSET


def read_content(body: bytes) -> Content:
    """Return the plan that a body has.

    Request and plan are kept as they are, what this version doesn't know of them included, and
    never made into objects, which would take many times their length. Of a day there are none yet.

    Raises
    ------
    NotJsonError, InvalidRequestError
        If it has none.
    """
    require_json(body)
    # What is told of a value's type is how it begins.
    value = msgspec.Raw(body.strip())
    parts = _checked(value)
    if parts.day is not None:
        return Content(parts.name, parts.note, b"", 0, None, parts.day)
    stated = msgspec.json.decode(value, type=_Stated)
    content = b"".join((b'{"request":', stated.request, b',"plan":', stated.plan, b"}"))
    customers = msgspec.json.decode(stated.request, type=_Customers).customers
    return Content(parts.name, parts.note, msgspec.json.format(content, indent=-1),
                   len(_entries(customers)),
                   None if parts.plan is None else parts.plan.cost.total)


def _checked(body: msgspec.Raw) -> KeptPlanInput:
    """Return what is read of a body, its long lists empty; raises as `read_content` does."""
    try:
        outline = _outline(body, _Body, {
            "name": _text, "note": _text, "day": _text,
            "request": lambda request: _outline(request, _Request, {}),
            "plan": lambda plan: _outline(plan, _Plan, {
                "cost": lambda cost: _outline(cost, _Cost, {"total": _number})})})
    except msgspec.ValidationError as error:
        # An object may have millions of fields that aren't known, of which one is told.
        name = str(error).split("`")[1]
        raise InvalidRequestError([schema_error(
            {"type": "extra_forbidden", "loc": (name,), "msg": "", "input": None})]) from None
    try:
        return KeptPlanInput.model_validate(outline)
    except ValidationError as error:
        raise InvalidRequestError([schema_error(details) for details in error.errors()]) from None


def _outline(value: msgspec.Raw, kind: type[msgspec.Struct], read: dict[str, Any]) -> Any:
    """Return the known fields of an object, of which some are read, others but of the same type."""
    if _begin(value) != b"{":
        return _alike(value)
    stated = msgspec.json.decode(value, type=kind)
    return {name: read.get(name, _alike)(inner) for name in kind.__struct_fields__
            if (inner := getattr(stated, name)) is not msgspec.UNSET}


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


def _entries(value: msgspec.Raw) -> list[msgspec.Raw]:
    return msgspec.json.decode(value, type=list[msgspec.Raw])
