"""Calls of the engine's functions.

    call("tandem_anneal", data, searcher, turns, order)

Named tuples of arrays are packed as the C structs that the function takes, by the names of their
fields; rows are pointed to, and so are arrays of numbers where C takes a pointer to one. Pointers
at the end of what C takes that no argument is given for are results, and are returned. What the
engine owns is given by a `Handle`. Nothing is copied, and other threads go on while the engine
runs.
"""

import hashlib
import os
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from model.engine.header import (
    dtype_of, dtype_of_type, header, interface, is_opaque, is_row, name_of, pointer_to,
)
from model.engine.packing import Packed, address_of, number_of, packed

__all__ = ["EndedError", "call", "dtype_of", "function", "packed", "path_of_library"]


class EndedError(Exception):
    """Work was told to end before there was anything to show for it."""


Convert = Callable[[Any], Any]
"""Makes an argument what cffi takes. Raises a TypeError that names it."""

_ERRORS = {-1: MemoryError, -2: RuntimeError, -3: EndedError}


def call(name: str, *args: Any) -> Any:
    """Call a function of the engine.

    Parameters
    ----------
    name
        As in `tandem.h`.
    args
        Numbers, rows, arrays, named tuples of arrays, or what `packed` made of these. They are
        kept alive until the function returns.

    Returns
    -------
    None, the result or a tuple of results that no argument was given for: numbers, or rows.

    Raises
    ------
    ImportError
        If the library is missing, or was built from another header.
    TypeError
        If an argument isn't what the function takes; names its field.
    MemoryError, RuntimeError
        If the function fails.
    EndedError
        If nobody wants any more what it was doing.
    """
    entry, converts, results = _function(name)
    if len(args) > len(converts):
        raise TypeError(f"{name} takes {len(converts)} arguments, not {len(args)}")
    given = [convert(value) for convert, value in zip(converts, args, strict=False)]
    if len(args) == len(converts):
        _check(name, entry(*given))
        return None
    missing = results[len(args):]
    if any(dtype is None for dtype in missing):
        raise TypeError(f"{name} takes {len(converts)} arguments, not {len(args)}")
    rows = [np.zeros(1, dtype) for dtype in missing]
    _check(name, entry(*given, *(convert(row) for convert, row in zip(
        converts[len(args):], rows, strict=True))))
    found = tuple(row[0] if row.dtype.names else row.item() for row in rows)
    return found[0] if len(found) == 1 else found


def function(name: str) -> Any:
    """Return a function of the engine as cffi knows it."""
    return getattr(_library(), name)


def path_of_library() -> Path:
    """Return the file that is loaded: beside this one, or another that a developer names."""
    if named := os.environ.get("TANDEM_ENGINE_LIBRARY"):
        return Path(named)
    return Path(__file__).with_name(f"libtandem.{'dylib' if sys.platform == 'darwin' else 'so'}")


@cache
def _library() -> Any:
    path = path_of_library()
    if not path.exists():
        raise ImportError(f"the engine isn't built: there is no {path}. In the project's folder, "
                          "run 'make engine', or install the project by pip")
    ffi = interface()
    library = ffi.dlopen(str(path))
    digest = ffi.new(pointer_to("uint64_t"))
    library.tandem_header(digest)
    if digest[0] != int(hashlib.sha256(header().read_bytes()).hexdigest()[:16], 16):
        raise ImportError(f"{path} was built from another tandem.h than {header()}. Build it again "
                          "by 'make engine', or install the project by pip")
    return library


@cache
def _function(name: str) -> tuple[Any, list[Convert], list[np.dtype[Any] | None]]:
    """Return a function, what converts its arguments, and which of them it may write results to."""
    found = function(name)
    kinds = interface().typeof(found).args
    converts = [_conversion(kind, f"{name}, argument {number}")
                for number, kind in enumerate(kinds, start=1)]
    return found, converts, [_result(kind) for kind in kinds]


def _result(kind: Any) -> np.dtype[Any] | None:
    """Return the type of what a pointer points to, if that is numbers."""
    if kind.kind == "pointer" and (kind.item.kind == "primitive" or is_row(kind.item)):
        return dtype_of_type(kind.item)
    return None


def _conversion(kind: Any, path: str) -> Convert:
    """Return what makes an argument of a type what cffi takes."""
    if kind.kind == "primitive":
        return number_of(kind, path)
    if (dtype := _result(kind)) is not None:
        address, cast = address_of(dtype, path), interface().cast
        return lambda value: cast(kind, address(value))
    if kind.kind != "pointer":
        raise TypeError(f"{path}: structs are given by pointers")
    if is_opaque(kind.item) or kind.item.kind == "pointer":
        # Whose type cffi checks.
        return lambda value: getattr(value, "pointer", value)

    def pack(value: Any) -> Any:
        if isinstance(value, interface().CData):
            return value
        if type(value) is not Packed:
            try:
                return Packed(value, kind).pointer
            except TypeError as error:
                raise TypeError(f"{path}: {error}") from None
        if value.kind is not kind.item:
            raise TypeError(f"{path}: {name_of(kind.item)} was expected, not {name_of(value.kind)}")
        return value.pointer

    return pack


def _check(name: str, code: Any) -> None:
    if code:
        raise _ERRORS.get(code, RuntimeError)(f"{name} failed with code {code}")
