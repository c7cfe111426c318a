"""The engine's rules, asked one by one by functions of `engine/tests/rules.h`."""

import fcntl
import re
import shutil
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

import cffi
import numpy as np

from model.engine.header import interface
from model.engine.packing import Packed, packed

ENGINE = Path(__file__).parents[3] / "engine"
BUILD = ENGINE.parent / "build/tests"


def built(target: str) -> Path:
    """Build what stands in `engine/tests`, one process at a time, and return the file."""
    ninja = ["-G", "Ninja"] if shutil.which("ninja") else []
    BUILD.mkdir(parents=True, exist_ok=True)
    with (BUILD / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        for command in (["cmake", "-S", ENGINE, "-B", BUILD, "-DTANDEM_IN_PLACE=OFF", *ninja],
                        ["cmake", "--build", BUILD, "--target", target]):
            done = subprocess.run(command, text=True, capture_output=True, check=False)
            if done.returncode:
                raise RuntimeError(done.stdout + done.stderr)
    return next(path for path in (BUILD / "tests").iterdir()
                if path.stem in {target, f"lib{target}"} and path.is_file())


@cache
def _library() -> tuple[Any, Any]:
    ffi = cffi.FFI()
    ffi.include(interface())
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
