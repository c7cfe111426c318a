"""What a schema allows, as types that msgspec reads by: far quicker than pydantic, and up to the
first value that is wrong.

They refuse nothing that the schema takes. What validators of the models' own forbid is left to
these.
"""

from collections.abc import Iterator, Mapping
from functools import cache
from itertools import count
from typing import Annotated, Any, Literal, Union

import msgspec
from msgspec import Meta, Struct, defstruct
from pydantic import BaseModel

MAX_LOOSE = 400_000
"""Most values in what may be anything."""

LONG = 2000
"""Arrays of numbers that may have more entries are validated up to the first that is wrong."""

_KINDS = ("object", "array", "string", "number", "boolean", "null")
_NUMBERS = ("integer", "number")

Schema = Mapping[str, Any]


class Loose:
    """What may be anything."""


class LooseList(Loose):
    """An array of that."""


class LooseMap(Loose):
    """An object of that, with few entries."""

    most: int


class NumberRow:
    """An array of numbers, of which there may be very many: each is read, looked at and let go."""

    entries: Any


def read_shape(body: bytes, model: type[BaseModel]) -> None:
    """Read a body by the shape of a model, without making anything of it.

    Raises
    ------
    msgspec.ValidationError
        At the first value that doesn't fit.
    """
    msgspec.json.decode(body, type=shape_of(model), dec_hook=_look_at)


@cache
def shape_of(model: type[BaseModel]) -> Any:
    """Return the type of all that a model's schema allows, and more."""
    schema = model.model_json_schema(by_alias=True)
    return _Builder(schema.get("$defs", {})).shape(schema)


def _look_at(kind: type, value: object) -> object:
    """Look at a value that msgspec knows no type for, and let it go.

    Raises
    ------
    ValueError
        If it is none of the kind.
    """
    if issubclass(kind, NumberRow):
        try:
            msgspec.convert(value, kind.entries)
        except msgspec.ValidationError as error:
            raise ValueError(str(error).partition(" - at ")[0]) from None
    elif kind is LooseList and not isinstance(value, list):
        raise ValueError("Expected `array`")
    elif issubclass(kind, LooseMap):
        if not isinstance(value, dict):
            raise ValueError("Expected `object`")
        if len(value) > kind.most:
            raise ValueError(f"Expected `object` of length <= {kind.most}")
    if issubclass(kind, Loose) and isinstance(value, dict | list) and _size(value) > MAX_LOOSE:
        raise ValueError(f"There are more than {MAX_LOOSE} values")
    return kind()


def _size(value: object) -> int:
    """Return how many values there are in a value, or more than are looked at."""
    size, left = 0, [value]
    while left and size <= MAX_LOOSE:
        inner = left.pop()
        entries = (inner.values() if isinstance(inner, dict)
                   else inner if isinstance(inner, list) else ())
        size += 1 + len(entries)
        left += [entry for entry in entries if type(entry) in (dict, list)]
    return size


class _Builder:
    """Makes types of a JSON schema as pydantic writes it."""

    def __init__(self, definitions: Mapping[str, Schema]) -> None:
        self._definitions = definitions
        self._made: dict[str, Any] = {}
        self._numbers = count()

    def shape(self, schema: Schema) -> Any:
        """Return the type that holds all that a schema allows."""
        name = schema.get("$ref")
        if name is None:
            return self._either(list(self._alternatives(schema)))
        if name not in self._made:
            self._made[name] = self._either(list(self._alternatives(schema)))
        return self._made[name]

    def _alternatives(self, schema: Schema) -> Iterator[Schema]:
        if "$ref" in schema:
            yield from self._alternatives(self._definitions[schema["$ref"].rpartition("/")[2]])
        elif schema.keys() & {"anyOf", "oneOf"}:
            for alternative in schema.get("anyOf") or schema["oneOf"]:
                yield from self._alternatives(alternative)
        else:
            yield schema

    def _either(self, alternatives: list[Schema]) -> Any:
        """Return the type of any of some alternatives, those of one kind taken together."""
        if any("type" not in each for each in alternatives):
            return Loose
        parts = []
        for kind in _KINDS:
            of_kind = [each for each in alternatives
                       if ("number" if each["type"] in _NUMBERS else each["type"]) == kind]
            if of_kind:
                parts.append(getattr(self, f"_{kind}")(of_kind))
        if Loose in parts or (len(set(parts) - {None}) > 1 and any(map(_is_loose, parts))):
            return Loose
        if len(set(parts) - {None}) > 1:
            # To msgspec, rows are something of their own, which may be that or nothing.
            parts = [part.entries if _is_row(part) else part for part in parts]
        return Union[tuple(parts)]  # noqa: UP007

    def _object(self, some: list[Schema]) -> Any:
        fields: dict[str, list[Schema]] = {}
        for each in some:
            for name, inner in each.get("properties", {}).items():
                fields.setdefault(name, []).append(inner)
        for each in some:
            if "properties" in each and each.get("additionalProperties", True) is True:
                # To those that pass over what they don't know, it may be anything.
                for name in fields.keys() - each["properties"].keys():
                    fields[name].append({})
        free = [each.get("additionalProperties", True) for each in some]
        if not fields:
            entries = [each for each in free if isinstance(each, Mapping)]
            most = _largest([each.get("maxProperties") for each in some])
            entry = self.shape({"anyOf": entries}) if len(entries) == len(free) else Loose
            if entry is Loose:
                return type("FewEntries", (LooseMap,),
                            {"most": MAX_LOOSE if most is None else most})
            return Annotated[dict[str, entry],  # type: ignore[valid-type]
                             Meta(max_length=most)]
        required = frozenset.intersection(*(frozenset(each.get("required", ())) for each in some))
        return self._struct({name: self.shape({"anyOf": inner}) for name, inner in fields.items()},
                            required, closed=not any(free))

    def _struct(self, fields: Mapping[str, Any], required: frozenset[str],
                closed: bool) -> type[Struct]:
        """Return the type of objects with some fields; nothing else if they are `closed`."""
        names = {f"field_{index}": name for index, name in enumerate(fields)}
        return defstruct(
            f"Shape{next(self._numbers)}",
            [(field, fields[name]) if name in required
             else (field, fields[name] | msgspec.UnsetType, msgspec.UNSET)
             for field, name in names.items()],
            rename=names, forbid_unknown_fields=closed, kw_only=True, gc=False)

    def _array(self, some: list[Schema]) -> Any:
        entries = [entry for each in some
                   for entry in [*each.get("prefixItems", ()), each.get("items")]
                   if isinstance(entry, Mapping)]
        most = _largest([each.get("maxItems") for each in some])
        entry = self.shape({"anyOf": entries}) if entries else Loose
        if _is_loose(entry):
            return LooseList
        listed = Annotated[list[entry], Meta(  # type: ignore[valid-type]
            min_length=min(each.get("minItems", 0) for each in some), max_length=most)]
        if (most is None or most > LONG) and entries and all(
                each.get("type") in _NUMBERS for each in entries):
            return type("NumberRow", (NumberRow,), {"entries": listed})
        return listed

    def _string(self, some: list[Schema]) -> Any:
        texts = [text for each in some
                 for text in each.get("enum", [each["const"]] if "const" in each else ())]
        if texts and all(each.keys() & {"enum", "const"} for each in some):
            return Literal[tuple(texts)]
        return Annotated[str, Meta(
            min_length=min(each.get("minLength", 0) for each in some),
            max_length=_largest([each.get("maxLength") for each in some]))]

    def _number(self, some: list[Schema]) -> Any:
        least: list[Any] = [each.get("minimum") for each in some]
        return Annotated[float, Meta(
            ge=None if None in least else min(least),
            le=_largest([each.get("maximum") for each in some]))]

    def _boolean(self, _: list[Schema]) -> Any:
        return bool

    def _null(self, _: list[Schema]) -> Any:
        return None


def _is_loose(part: Any) -> bool:
    return isinstance(part, type) and issubclass(part, Loose)


def _is_row(part: Any) -> bool:
    return isinstance(part, type) and issubclass(part, NumberRow)


def _largest(bounds: list[Any]) -> Any:
    """Return the largest of some bounds, None if one of them is none."""
    return None if None in bounds else max(bounds)
