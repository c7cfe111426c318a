"""What a schema allows at each place of a body, as arrays that compiled code walks through."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from app.requests.scan import (
    ANYTHING, ARRAY, BOOLEAN, FNV_FACTOR, FNV_START, FRACTION, INTEGER, NO_SHAPE, NOTHING,
    NULL, OBJECT, STRING, Shapes,
)

ANY_KIND = 127

UNBOUNDED = 2**62
MAX_KEYS = 63
"""Most fields of an object; each has a bit of a word."""

LONG = 2000
"""Arrays of numbers that may have more entries are validated up to the first that is wrong."""

_KINDS: dict[str | None, int] = {
    "object": OBJECT, "array": ARRAY, "string": STRING, "integer": INTEGER,
    "number": INTEGER | FRACTION, "boolean": BOOLEAN, "null": NULL}

Schema = Mapping[str, Any]
Number = TypeVar("Number", bound=np.generic)


@dataclass
class _Shape:
    kinds: int = 0
    lowest: float = -np.inf
    highest: float = np.inf
    shortest: int = 0
    longest: int = UNBOUNDED
    most: int = UNBOUNDED
    fewest: int = 0
    entry: int = NO_SHAPE
    is_row: bool = False
    required: frozenset[str] = frozenset()
    keys: dict[str, int] = field(default_factory=dict)


@cache
def shapes_of(model: type[BaseModel]) -> Shapes:
    """Return the shapes that a model allows."""
    schema = model.model_json_schema(by_alias=True)
    collector = _Collector(schema.get("$defs", {}))
    root = collector.collect(schema)
    shapes = [*collector.shapes, _Shape(entry=root)]
    keys = [list(shape.keys.items()) for shape in shapes]
    def column(name: str, kind: type[Number]) -> NDArray[Number]:
        return np.array([getattr(shape, name) for shape in shapes], kind)

    return Shapes(
        column("kinds", np.int64), column("lowest", np.float64), column("highest", np.float64),
        column("shortest", np.int64), column("longest", np.int64), column("most", np.int64),
        column("fewest", np.int64), column("entry", np.int64), column("is_row", np.bool_),
        required=np.array([sum(1 << list(shape.keys).index(name) for name in shape.required)
                           for shape in shapes], np.int64),
        first_key=np.cumsum([0, *map(len, keys)], dtype=np.int64),
        key_hash=np.array([hash_of(name.encode()) for some in keys for name, _ in some],
                          np.uint64),
        key_shape=np.array([shape for some in keys for _, shape in some], np.int64))


def hash_of(name: bytes) -> int:
    """Return the FNV-1a hash of a name, as compiled code computes it."""
    value = FNV_START
    for byte in name:
        value = ((value ^ byte) * FNV_FACTOR) % 2**64
    return value


class _Collector:
    """Numbers the shapes of a JSON schema as pydantic writes it."""

    def __init__(self, definitions: Mapping[str, Schema]) -> None:
        self._definitions = definitions
        self._numbers: dict[str, int] = {}
        self.shapes = [_Shape(), _Shape(kinds=ANY_KIND, entry=ANYTHING)]

    def collect(self, schema: Schema) -> int:
        """Return the number of the shape that a schema describes, a new one if need be."""
        name = schema.get("$ref")
        if name in self._numbers:
            return self._numbers[name]
        if not schema.keys() & {"$ref", "anyOf", "oneOf", "type"}:
            return ANYTHING
        shape = _Shape()
        self.shapes.append(shape)
        number = len(self.shapes) - 1
        if name is not None:
            self._numbers[name] = number
        for alternative in self._alternatives(schema):
            self._allow(shape, alternative)
        return number

    def _alternatives(self, schema: Schema) -> Iterator[Schema]:
        if "$ref" in schema:
            yield from self._alternatives(self._definitions[schema["$ref"].rpartition("/")[2]])
        elif schema.keys() & {"anyOf", "oneOf"}:
            for alternative in schema.get("anyOf") or schema["oneOf"]:
                yield from self._alternatives(alternative)
        else:
            yield schema

    def _allow(self, shape: _Shape, schema: Schema) -> None:
        """Let a shape be what an alternative describes, too. In place."""
        if "type" not in schema:
            shape.kinds, shape.entry = ANY_KIND, ANYTHING
            return
        kind = _KINDS[schema["type"]]
        shape.kinds |= kind
        if kind == OBJECT:
            self._allow_object(shape, schema)
        elif kind == ARRAY:
            shape.most = schema.get("maxItems", UNBOUNDED)
            shape.fewest = schema.get("minItems", 0)
            # The entries of a tuple are alike here.
            entries = schema.get("items") or schema.get("prefixItems", [{}])[0]
            shape.entry = self.collect(entries)
            if _KINDS.get(entries.get("type")) in (INTEGER, INTEGER | FRACTION):
                shape.is_row = shape.most > LONG
        elif kind == STRING:
            texts = schema.get("enum", [schema["const"]] if "const" in schema else [])
            shape.shortest = min(map(len, texts), default=schema.get("minLength", 0))
            shape.longest = max(map(len, texts), default=schema.get("maxLength", UNBOUNDED))
            shape.keys |= dict.fromkeys(texts, NOTHING)
        elif kind & INTEGER:
            shape.lowest = schema.get("minimum", -np.inf)
            shape.highest = schema.get("maximum", np.inf)

    def _allow_object(self, shape: _Shape, schema: Schema) -> None:
        shape.keys |= {name: self.collect(inner)
                       for name, inner in schema.get("properties", {}).items()}
        shape.required = frozenset(schema.get("required", ()))
        if len(shape.keys) > MAX_KEYS:
            raise ValueError(f"{schema.get('title')}: more than {MAX_KEYS} fields")
        free = schema.get("additionalProperties", True)
        if free:
            shape.entry = ANYTHING if free is True else self.collect(free)
            shape.most = schema.get("maxProperties", UNBOUNDED)
