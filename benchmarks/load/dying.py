"""An engine that ends its process at problems of a certain size, for who looks what comes of it."""

import os
import subprocess
from pathlib import Path

from model.engine.header import header
from model.engine.library import path_of_library

DEADLY = 13
"""Customers of such a problem, as `engine/tests/dying.cpp` has it."""

SOURCE = Path(__file__).parents[2] / "engine" / "tests" / "dying.cpp"


def dying_engine(folder: Path) -> Path:
    """Build a library in a folder that stands before the engine, and return it.

    Raises
    ------
    CalledProcessError
        If it can't be compiled.
    """
    library, engine = folder / "libdying.so", path_of_library().resolve()
    subprocess.run([os.environ.get("CXX", "g++"), "-std=c++20", "-shared", "-fPIC", "-O1",
                    f"-I{header().parents[1]}", SOURCE, "-o", library, "-Wl,--no-as-needed",
                    engine, f"-Wl,-rpath,{engine.parent}", "-ldl"], check=True)
    return library
