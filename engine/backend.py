"""Builds the package and the guide: scikit-build-core, a compiler from PyPI where there is none.

Whoever builds for himself (`pip install --editable .`, or `make engine`) gets the library beside
the Python that loads it, in machine code for the processor at hand, from `build/engine`: after a
change only what changed is compiled. A wheel holds what all processors of a family run.

    python engine/backend.py             builds the library in place
    python engine/backend.py guide       builds the guide in place, from `docs/`
    python engine/backend.py tests       builds what tests of the engine run, in `build/tests`
    python engine/backend.py requires    tells what must be installed to build the library here
    python engine/backend.py guidance    tells what must be installed to build the guide
    python engine/backend.py spare       tells which compiler it takes where there is none
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
BUILD = ROOT / "build"
GUIDE = ROOT / "app/console/built_guide"

COMPILERS = ("c++", "g++", "clang++")
SPARE_COMPILER = "ziglang==0.17.1"
BUILDERS = {"cmake": "cmake>=3.20", "ninja": "ninja>=1.11"}
"""Programs, and the packages that have them."""

CACHED = {"cmake": "CMAKE_COMMAND", "ninja": "CMAKE_MAKE_PROGRAM"}
"""How CMake notes which of them built in a folder."""

GUIDE_BUILDER = "zensical==0.0.73"

ZIG = """#!/bin/sh
exec '{python}' -m ziglang c++ -fno-sanitize=undefined "$@"
"""
"""Without traps at what is undefined, which would need their own library."""

Settings = dict[str, Any] | None


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    """Return what a wheel is built with, beside what `pyproject.toml` names."""
    from scikit_build_core import build

    return [*build.get_requires_for_build_wheel(config_settings), *spare_compiler(), GUIDE_BUILDER]


def get_requires_for_build_editable(config_settings: Settings = None) -> list[str]:
    """Return what library and guide are built with in place."""
    return [*requires(), GUIDE_BUILDER]


def get_requires_for_build_sdist(config_settings: Settings = None) -> list[str]:
    """Return what sources are packed with."""
    from scikit_build_core import build

    return build.get_requires_for_build_sdist(config_settings)


def build_sdist(sdist_directory: str, config_settings: Settings = None) -> str:
    """Pack the sources."""
    from scikit_build_core import build

    return build.build_sdist(sdist_directory, config_settings)


def prepare_metadata_for_build_wheel(metadata_directory: str,
                                     config_settings: Settings = None) -> str:
    """Write what is said of a wheel, without building one."""
    from scikit_build_core import build

    return build.prepare_metadata_for_build_wheel(metadata_directory, config_settings)


def prepare_metadata_for_build_editable(metadata_directory: str,
                                        config_settings: Settings = None) -> str:
    """Write what is said of an editable wheel, without building one."""
    from scikit_build_core import build

    return build.prepare_metadata_for_build_editable(metadata_directory, config_settings)


def build_wheel(wheel_directory: str, config_settings: Settings = None,
                metadata_directory: str | None = None) -> str:
    """Build a wheel that holds the library and the guide."""
    from scikit_build_core import build

    choose_compiler()
    build_guide()
    return build.build_wheel(wheel_directory, config_settings, metadata_directory)


def build_editable(wheel_directory: str, config_settings: Settings = None,
                   metadata_directory: str | None = None) -> str:
    """Build library and guide in place, and a wheel that leads there.

    The guide where what it is built with is there: a plan needs none.
    """
    from scikit_build_core import build

    build_in_place()
    if importlib.util.find_spec("zensical"):
        build_guide()
    return build.build_editable(wheel_directory, config_settings, metadata_directory)


def requires() -> list[str]:
    """Return what must be installed to build the library here."""
    return [package for name, package in BUILDERS.items()
            if program(name) is None] + spare_compiler()


def spare_compiler() -> list[str]:
    """Return the package of a compiler if there is none."""
    return [] if compiler() else [SPARE_COMPILER]


def compiler() -> str | None:
    """Return the compiler that the environment names, or the first that is on the path."""
    return os.environ.get("CXX") or next(filter(shutil.which, COMPILERS), None)


def program(name: str) -> str | None:
    """Return where a program is that is on the path, or installed beside Python."""
    return shutil.which(name) or shutil.which(name, path=str(Path(sys.executable).parent))


def before(folder: Path, name: str) -> str | None:
    """Return what built in a folder so far, if it is there yet: with another, all is built anew."""
    cache = folder / "CMakeCache.txt"
    if not cache.exists():
        return None
    lines = (line.partition("=") for line in cache.read_text("utf-8").splitlines())
    return next((path for entry, _, path in lines
                 if entry.startswith(CACHED[name] + ":") and Path(path).exists()), None)


def choose_compiler() -> None:
    """Let CMake find a compiler where there is none on the path. In place: the environment."""
    if compiler():
        return
    wrapper = BUILD / "zig/c++"
    wrapper.parent.mkdir(parents=True, exist_ok=True)
    wrapper.write_text(ZIG.format(python=sys.executable))
    wrapper.chmod(0o755)
    os.environ["CXX"] = str(wrapper)


def build_in_place() -> None:
    """Build the library in place, or what of it changed since."""
    build("engine")


def build_guide() -> None:
    """Build the guide in place; a link that leads nowhere is an error."""
    # Else pages that are gone stay.
    shutil.rmtree(GUIDE, ignore_errors=True)
    run([sys.executable, "-m", "zensical", "build", "--strict"])


def build_tests() -> None:
    """Build the engine's own tests, and the library by which others ask for its rules."""
    build("tests", "engine_tests", "tandem_rules")


def build(name: str, *targets: str) -> None:
    """Build targets, or what of them changed since, in a folder of that name."""
    folder = BUILD / (name if compiler() else f"{name}-zig")
    choose_compiler()
    cmake, ninja = (before(folder, name) or program(name) or name for name in BUILDERS)
    # Both may be elsewhere than last time: pip has them in a folder for each build.
    subprocess.run([cmake, "-S", ROOT / "engine", "-B", folder, "-G", "Ninja",
                    f"-DCMAKE_MAKE_PROGRAM={ninja}"], check=True, stdout=subprocess.DEVNULL)
    run([ninja, "-C", str(folder), *targets])


def run(command: list[str]) -> None:
    """Run a command in the project's folder, silently unless it fails."""
    done = subprocess.run(command, cwd=ROOT, check=False, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stdout + done.stderr)


def print_requires() -> None:
    """Print what must be installed to build the library here, a line each."""
    with (ROOT / "pyproject.toml").open("rb") as file:
        print(*tomllib.load(file)["build-system"]["requires"], *requires(), sep="\n")


def print_guidance() -> None:
    """Print what must be installed to build the guide."""
    print(GUIDE_BUILDER)


def print_spare() -> None:
    """Print the package of the compiler that is taken where there is none."""
    print(SPARE_COMPILER)


def main(arguments: list[str]) -> None:
    """Build in place or for tests, or tell what that needs."""
    tasks = {(): build_in_place, ("guide",): build_guide, ("tests",): build_tests,
             ("requires",): print_requires, ("guidance",): print_guidance,
             ("spare",): print_spare}
    tasks[tuple(arguments)]()


if __name__ == "__main__":
    main(sys.argv[1:])
