"""The engine's C interface, `tandem.h`, read as it is: functions, structs and their layout."""

import hashlib
import io
import os
import re
import sys
from contextlib import suppress
from functools import cache
from importlib.util import cache_from_source
from pathlib import Path
from typing import Any, cast

import _cffi_backend
import numpy as np

_HERE = Path(__file__).parent

_NUMBERS = {"double": np.float64, "float": np.float32, "_Bool": np.bool_, "int64_t": np.int64,
            "uint64_t": np.uint64, "int32_t": np.int32, "uint32_t": np.uint32, "int": np.int32,
            "int8_t": np.int8, "uint8_t": np.uint8}

MOST_AXES = 5
"""Of arrays that the engine takes."""


def header() -> Path:
    """Return where the header lies: beside the library once installed, else with its source."""
    installed = _HERE / "tandem.h"
    return installed if installed.exists() else _HERE.parents[1] / "engine/include/tandem.h"


@cache
def interface() -> Any:
    """Return what cffi knows from the header.

    To read C takes longer than to load modules: what was read is kept with them, as Python keeps
    what it compiled.
    """
    read = hashlib.sha256(f"{_cffi_backend.__version__}\n{header().read_text()}".encode())
    mark = f"# {read.hexdigest()}\n"
    kept = Path(cache_from_source(str(_HERE / "tandem.py"))).with_suffix(".ffi")
    source = kept.read_text() if kept.exists() else ""
    if not source.startswith(mark):
        source = mark + _compiled()
        if not sys.dont_write_bytecode:
            with suppress(OSError):  # as where others have installed it
                _write(kept, source)
    module: dict[str, Any] = {}
    exec(source, module)
    return module["ffi"]


def declared() -> Any:
    """Return what cffi reads the header as, for others to include."""
    import cffi

    ffi = cffi.FFI()
    ffi.cdef(_declarations(header().read_text()))
    return ffi


def _compiled() -> str:
    """Return the module that cffi makes of the header."""
    from cffi.recompiler import make_py_source

    written = io.StringIO()
    make_py_source(declared(), "tandem", written)
    return written.getvalue()


def _write(path: Path, text: str) -> None:
    """Write a file that others may read meanwhile."""
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(f"{path.name}.{os.getpid()}")
    unfinished.write_text(text)
    unfinished.replace(path)


def name_of(kind: Any) -> str:
    """Return what a type is called in the header."""
    return str(kind.cname.removeprefix("struct "))


def pointer_to(name: str) -> Any:
    """Return the type of pointers to what has a name: a struct of the header's, or a number."""
    return _pointers()[name]


@cache
def _pointers() -> dict[str, Any]:
    """Return the types of pointers to all that has a name, read at once.

    To read one type, cffi reads the names of all.
    """
    ffi = interface()
    names = (*ffi.list_types()[0], *_NUMBERS, "uintptr_t")
    read = ffi.typeof(f"void (*)({', '.join(f'{name} *' for name in names)})")
    return dict(zip(names, read.args, strict=True))


def _declarations(text: str) -> str:
    """Return a C header without what C++ alone reads, and as the preprocessor leaves it."""
    text = re.sub(r"^#ifdef __cplusplus$.*?^#endif$", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"^#(?:.*\\\n)*.*$", "", text, flags=re.MULTILINE)
    return re.sub(r"\bTANDEM_ROWS\((\w+), ([\w ]+)\);", lambda found: "".join(
        f"typedef struct {found[1]}_{axes}d {{ {found[2]}* data; int64_t shape[{axes}]; }} "
        f"{found[1]}_{axes}d;" for axes in range(1, MOST_AXES + 1)), text)


def dtype_of(name: str) -> np.dtype[Any]:
    """Return NumPy's type of a C struct of numbers, `tandem_node` for example, or of a number."""
    return dtype_of_type(pointer_to(name).item)


@cache
def dtype_of_type(kind: Any) -> np.dtype[Any]:
    """Return NumPy's type of one that cffi knows.

    Raises
    ------
    TypeError
        If it points to others, or C lays it out otherwise.
    """
    if kind.kind == "primitive":
        return np.dtype(_NUMBERS[kind.cname])
    if not is_row(kind):
        raise TypeError(f"{name_of(kind)} is no row of numbers")
    row = np.dtype([_field(name, field.type) for name, field in kind.fields], align=True)
    if [row.fields[name][1] for name, _ in kind.fields] != [  # type: ignore[index]
            field.offset for _, field in kind.fields]:
        raise TypeError(f"{name_of(kind)} is laid out otherwise")
    return cast("np.dtype[Any]", np.dtype((np.record, row)))


def is_row(kind: Any) -> bool:
    """Tell whether a type is a struct of nothing but numbers."""
    return kind.kind == "struct" and not is_opaque(kind) and all(
        field.type.kind == "primitive"
        or (field.type.kind == "array" and field.type.item.kind == "primitive")
        for _, field in kind.fields)


def is_opaque(kind: Any) -> bool:
    """Tell whether a type is a struct of which the engine alone knows what it holds."""
    if kind.kind != "struct":
        return False
    try:
        return not interface().sizeof(kind)
    except interface().error:
        return True


@cache
def is_laid_out_as(rows: np.dtype[Any], others: np.dtype[Any]) -> bool:
    """Tell whether two types of rows have the same fields, whatever has no place in memory."""
    return rows.itemsize == others.itemsize and _places(rows) == _places(others)


def _places(rows: np.dtype[Any]) -> dict[str, Any]:
    return {name: field[:2] for name, field in (rows.fields or {}).items() if field[0].itemsize}


def _field(name: str, kind: Any) -> tuple[Any, ...]:
    if kind.kind == "array":
        return name, dtype_of_type(kind.item), (kind.length,)
    return name, dtype_of_type(kind)
