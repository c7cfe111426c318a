"""Named tuples of arrays as the C structs that the engine takes: addresses, shapes and numbers."""

import operator
import re
import struct
from collections.abc import Callable
from functools import cache
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

from model.engine.header import (
    dtype_of_type, interface, is_laid_out_as, is_row, name_of, pointer_to,
)


class Numbers(list[Any]):
    """Numbers that stand for a value in memory, and what else they point to."""

    def __init__(self) -> None:
        """Begin with none."""
        super().__init__()
        self.kept: list[bytes] = []


Encode = Callable[[Any, Numbers], None]
"""Appends the numbers that stand for a value in memory. Raises a TypeError that names the field."""

LEGS = "tandem_legs"
"""Stated as one array, or computed from a table, points and laws."""

_FORMATS = {"double": "d", "float": "f", "_Bool": "?", "int64_t": "q", "uint64_t": "Q",
            "int32_t": "i", "uint32_t": "I", "int": "i", "int8_t": "b", "uint8_t": "B"}
_CONVERSIONS: dict[str, Callable[[Any], Any]] = {"d": float, "f": float, "?": bool}


class Packed:
    """A value as the C struct that functions take, packed once for several calls.

    Keeps all alive that it points to. What is in arrays may change, which arrays they are can't.
    """

    __slots__ = ("_value", "kind", "pointer")

    def __init__(self, value: Any, pointer: Any) -> None:
        """Pack a value as the C struct that a type of pointers points to."""
        layout, encode = _packing(pointer.item)
        numbers = Numbers()
        encode(value, numbers)
        self.kind = pointer.item
        written = _Written(layout.pack(*numbers))
        written.kept = numbers.kept
        self.pointer = interface().from_buffer(pointer, written)
        self._value = value


class _Written(bytes):
    """A struct in memory, and what it points to beside arrays."""

    kept: list[bytes]


def packed(value: Any, name: str = "") -> Packed:
    """Pack a named tuple of arrays once, to be given to several calls.

    Parameters
    ----------
    value
        A `ProblemData`, for example.
    name
        Of the C struct; without, that of the value's class.
    """
    return Packed(value, pointer_to(name or struct_name(type(value))))


def struct_name(kind: type) -> str:
    """Return the C struct that belongs to a class: `tandem_step_weights` to `StepWeights`."""
    return "tandem_" + re.sub(r"(?<!^)(?=[A-Z])", "_", kind.__name__).lower()


def is_view(kind: Any) -> bool:
    """Tell whether a type is that of an array: where it begins, and its shape."""
    return kind.kind == "struct" and [name for name, _ in kind.fields] == ["data", "shape"]


def number_of(kind: Any, path: str) -> Callable[[Any], Any]:
    """Return what makes a Python number one of C's."""
    convert = _CONVERSIONS.get(_FORMATS[kind.cname], operator.index)

    def number(value: Any) -> Any:
        try:
            return convert(value)
        except (TypeError, ValueError):
            raise TypeError(f"{path}: {kind.cname} was expected, not {_told(value)}") from None

    return number


def address_of(dtype: np.dtype[Any], path: str) -> Callable[[Any], Any]:
    """Return what tells where a row stands in memory, or an array of such rows."""
    from_buffer = interface().from_buffer

    def address(value: Any) -> Any:
        try:
            if value.dtype == dtype or is_laid_out_as(value.dtype, dtype):
                return from_buffer(value)
        except (AttributeError, ValueError):
            pass
        raise TypeError(f"{path}: a row of {_shown(dtype)} was expected, not {_told(value)}")

    return address


@cache
def _packing(kind: Any) -> tuple[struct.Struct, Encode]:
    plan = _plan(kind, name_of(kind))
    return struct.Struct("=" + plan.format), plan.encode


class _Plan(NamedTuple):
    """How a type lies in memory."""

    format: str  # as `struct` reads it, without padding of its own
    encode: Encode


def _plan(kind: Any, path: str) -> _Plan:
    """Return how values of a type are packed, which errors call by a path of fields."""
    if kind.kind == "primitive":
        return _Plan(_FORMATS[kind.cname], _number(kind, path))
    if is_view(kind):
        (_, data), (_, shape) = kind.fields
        if data.type.item.kind == "struct" and not is_row(data.type.item):
            return _Plan("Qq", _structs(data.type.item))
        return _Plan(f"Q{shape.type.length}q",
                     _array(dtype_of_type(data.type.item), shape.type.length, path))
    if kind.kind != "struct":
        raise TypeError(f"{path}: arrays and pointers are not part of others")
    plans = {name: _plan(field.type, f"{path}.{name}") for name, field in kind.fields}
    return _Plan(_with_gaps(kind, [plan.format for plan in plans.values()]),
                 (_legs if name_of(kind) == LEGS else _fields)(plans, path))


def _with_gaps(kind: Any, formats: list[str]) -> str:
    """Return the format of a struct whose fields have these, as the compiler lays them out."""
    whole, end = "", 0
    for (_, field), form in zip(kind.fields, formats, strict=True):
        whole += f"{field.offset - end}x{form}"
        end = field.offset + struct.calcsize("=" + form)
    return f"{whole}{interface().sizeof(kind) - end}x"


def _number(kind: Any, path: str) -> Encode:
    number = number_of(kind, path)

    def encode(value: Any, numbers: Numbers) -> None:
        numbers.append(number(value))

    return encode


def _array(dtype: np.dtype[Any], dimensions: int, path: str) -> Encode:
    from_buffer, cast = interface().from_buffer, interface().cast
    integer = pointer_to("uintptr_t").item

    def encode(value: Any, numbers: Numbers) -> None:
        try:
            if value.ndim == dimensions and (value.dtype is dtype or value.dtype == dtype
                                             or is_laid_out_as(value.dtype, dtype)):
                numbers.append(int(cast(integer, from_buffer(value))))
                numbers.extend(value.shape)
                return
        except (AttributeError, ValueError):
            pass
        raise TypeError(f"{path}: an array of {_shown(dtype)}, of {dimensions} dimensions and row "
                        f"by row, was expected, not {_told(value)}")

    return encode


def _structs(kind: Any) -> Encode:
    """Return how a list of structs of arrays is encoded, which are laid out one behind another."""
    layout, encode_each = _packing(kind)
    from_buffer, cast = interface().from_buffer, interface().cast
    integer = pointer_to("uintptr_t").item

    def encode(value: Any, numbers: Numbers) -> None:
        rows = []
        for each in value:
            row = Numbers()
            encode_each(each, row)
            rows.append(layout.pack(*row))
        numbers.kept.append(b"".join(rows))
        numbers.extend((int(cast(integer, from_buffer(numbers.kept[-1]))), len(value)))

    return encode


def _fields(plans: dict[str, _Plan], path: str) -> Encode:
    encoders = [plan.encode for plan in plans.values()]
    known: set[type] = set()
    read = operator.attrgetter(*plans)

    def check(kind: type) -> None:
        if set(getattr(kind, "_fields", ())) != set(plans):
            raise TypeError(f"{path}: fields {', '.join(plans)} were expected, not a "
                            f"{kind.__name__} of {', '.join(getattr(kind, '_fields', ()))}")
        known.add(kind)

    def encode(value: Any, numbers: Numbers) -> None:
        if type(value) not in known:
            check(type(value))
        for encode_field, field in zip(encoders, read(value), strict=True):
            encode_field(field, numbers)

    return encode


def _legs(plans: dict[str, _Plan], path: str) -> Encode:
    computed = _fields({name: plan for name, plan in plans.items() if name != "stated"}, path)
    stated = plans["stated"].encode
    nothing = {name: struct.unpack("=" + plan.format, bytes(struct.calcsize("=" + plan.format)))
               for name, plan in plans.items()}
    not_stated = nothing.pop("stated")
    not_computed = list(chain.from_iterable(nothing.values()))

    def encode(value: Any, numbers: Numbers) -> None:
        if isinstance(value, np.ndarray):
            stated(value, numbers)
            numbers.extend(not_computed)
        else:
            numbers.extend(not_stated)
            computed(value, numbers)

    return encode


def _shown(dtype: np.dtype[Any]) -> str:
    return f"rows ({', '.join(dtype.names)})" if dtype.names else dtype.name


def _told(value: Any) -> str:
    if isinstance(value, np.ndarray):
        order = "" if value.flags.c_contiguous else ", not row by row"
        return f"one of {_shown(value.dtype)} and shape {value.shape}{order}"
    return f"{value!r:.80}"
