"""The engine's rules, asked one by one by functions of `engine/tests/rules.h`."""

import fcntl
import re
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import cffi
import numpy as np

from model.engine.header import declared
from model.engine.packing import Packed, packed

ENGINE = Path(__file__).parents[3] / "engine"
BUILD = ENGINE.parent / "build"


def built(target: str) -> Path:
    """Build what stands in `engine/tests`, one process at a time, and return a file of it."""
    BUILD.mkdir(exist_ok=True)
    with (BUILD / "tests.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = subprocess.run([sys.executable, ENGINE / "backend.py", "tests"], text=True,
                              capture_output=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stdout + done.stderr)
    files = [*BUILD.glob(f"tests*/{target}"), *BUILD.glob(f"tests*/lib{target}.*")]
    return max(files, key=lambda file: file.stat().st_mtime)


@cache
def _library() -> tuple[Any, Any]:
    ffi = cffi.FFI()
    ffi.include(declared())
    text = (ENGINE / "tests/rules.h").read_text()
    text = re.sub(r"^#ifdef __cplusplus$.*?^#endif$", "", text, flags=re.MULTILINE | re.DOTALL)
    ffi.cdef(re.sub(r"^#.*$", "", text, flags=re.MULTILINE))
    return ffi, ffi.dlopen(str(built("tandem_rules")))


def asked(name: str, count: int, *args: Any) -> tuple[int, ...]:
    """Return so many integers that a function finds; arrays and rows are given by address."""
    found = np.zeros(count, np.int64)
    write(name, *args, found)
    return tuple(found.tolist())


def write(name: str, *args: Any) -> None:
    """Call a function that writes to an array. In place."""
    ffi, library = _library()
    function = getattr(library, name)
    kinds = ffi.typeof(function).args

    def given(kind: Any, value: Any) -> Any:
        if kind.kind == "primitive":
            return value
        return ffi.cast(kind, value.pointer if type(value) is Packed else ffi.from_buffer(value))

    function(*(given(kind, value) for kind, value in zip(kinds, args, strict=True)))


def legs_of(legs: Any) -> Packed:
    """Return legs as functions take them."""
    return packed(legs, "tandem_legs")
