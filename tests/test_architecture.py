"""The rules that the tree's layout follows: who may import whom, and how long things may be."""

import ast
import os
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.conftest import complete

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("app", "model", "training", "benchmarks", "examples", "tests")
FORBIDDEN = {
    "model": ("app", "training", "benchmarks", "tests"),
    "app": ("training", "benchmarks", "tests"),
    "training": ("app", "benchmarks", "tests"),
    "benchmarks": ("tests",),
}
APP = (
    ("schemas", "database"), ("serving",), ("maps",), ("requests", "console"), ("plans",),
    ("formats", "records"), ("main",), ("cli",),
)
"""Floors of `app`: a room imports only those on floors before its own."""

MODEL = {
    "problem": (),
    "solution": (),
    "judge": ("problem", "solution"),
    "engine": (),
    "kernel": ("problem", "engine"),
    "travel": ("problem", "engine", "kernel"),
    "simulation": ("problem", "solution", "engine", "kernel"),
    "policy": ("problem", "engine", "kernel", "simulation"),
    "search": ("problem", "solution", "engine", "kernel"),
    "together": ("problem", "solution", "judge", "kernel", "search"),
    "planner": ("problem", "solution", "judge", "kernel", "simulation", "policy", "search",
                "together"),
    "replanning": ("problem", "solution", "judge", "planner"),
    "dialects": ("problem", "solution", "judge", "planner"),
}
"""What each folder and file of `model` may import of the others."""
MOST_ARROWS = 40

MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 40

NETWORKS = ("model.policy.network", "model.policy.attention", "model.policy.pointer")
"""Files with PyTorch, for training alone."""

UNFINISHED = "TO" "DO"


def sources(*packages: str) -> list[Path]:
    """Return the Python files of packages, in order."""
    return sorted(path for package in packages for path in (ROOT / package).rglob("*.py"))


def name_of(path: Path) -> str:
    """Return a path as the tests' reports name it."""
    return path.relative_to(ROOT).as_posix()


class Contents(NamedTuple):
    """What these tests want to know of a file."""

    modules: frozenset[str]  # imported anywhere, `from a import b` as `a` and `a.b`
    lines: dict[str, int]  # of code, by function


@cache
def contents(path: Path) -> Contents:
    """Return what is imported and defined in a file, which is parsed once for all tests."""
    modules, lines = set[str](), dict[str, int]()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            modules |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{name_of(path)} has a relative import"
            modules |= {node.module or "", *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            lines[f"{node.lineno} {node.name}"] = code_lines(node)
    return Contents(frozenset(modules), lines)


def imported_packages(path: Path) -> set[str]:
    """Return the top-level packages that a file imports."""
    return {module.split(".")[0] for module in contents(path).modules}


@cache
def imported_files(package: str) -> dict[str, set[str]]:
    """Return the files of a package that each of them imports, by path without suffix.

    A folder that gathers names of its files stands for these.
    """
    files = {path.relative_to(ROOT / package).with_suffix("").as_posix(): path
             for path in sources(package) if path.stem != "__init__"}
    dotted = {f"{package}.{name.replace('/', '.')}": {name} for name in files}
    for path in sources(package):
        if path.stem == "__init__":
            gathered = [dotted[module] for module in contents(path).modules if module in dotted]
            dotted[".".join(path.parent.relative_to(ROOT).parts)] = set().union(*gathered)
    return {name: set().union(*(dotted.get(module, set()) for module in contents(path).modules))
            for name, path in files.items()}


def between(imports: dict[str, set[str]], part: Callable[[str], str]) -> dict[str, set[str]]:
    """Return the other parts, of which each file has one, that each part imports."""
    arrows: dict[str, set[str]] = {part(name): set() for name in imports}
    for name, others in imports.items():
        arrows[part(name)] |= {part(other) for other in others} - {part(name)}
    return arrows


def first_level(name: str) -> str:
    """Return the folder or file right below the package."""
    return name.split("/")[0]


def folder(name: str) -> str:
    """Return the folder that a file lies in; a file right below the package stands for itself."""
    return name.rpartition("/")[0] or name


def code_lines(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Return how many lines a function's body has, without its docstring."""
    body = function.body[ast.get_docstring(function) is not None:]
    return (function.end_lineno or 0) - body[0].lineno + 1 if body else 0


@pytest.mark.parametrize("package", FORBIDDEN)
def test_packages_import_along_the_arrows(package: str) -> None:
    crossings = {name_of(path): crossed for path in sources(package)
                 if (crossed := imported_packages(path) & set(FORBIDDEN[package]))}
    assert crossings == {}


def test_only_benchmarks_and_their_tests_import_benchmarks() -> None:
    importers = {path for path in sources(*PACKAGES) if "benchmarks" in imported_packages(path)}
    allowed = {ROOT / "benchmarks", ROOT / "tests" / "benchmarks"}
    assert [name_of(path) for path in importers if allowed.isdisjoint(path.parents)] == []


def test_only_policies_and_training_use_torch() -> None:
    users = [name_of(path) for path in sources("app", "model")
             if name_of(path)[:-3].replace("/", ".") not in NETWORKS
             and any(module.startswith(("torch", *NETWORKS))
                     for module in contents(path).modules)]
    assert users == []


def test_serving_loads_no_torch() -> None:
    script = "import sys, app.cli.planning, app.cli.serving; print('torch' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, check=True, text=True,
                          stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert done.stdout == "False\n"


def test_parts_of_model_import_along_the_arrows() -> None:
    arrows = between(imported_files("model"), first_level)
    assert arrows == {part: set(allowed) for part, allowed in MODEL.items()}
    assert sum(map(len, arrows.values())) <= MOST_ARROWS


def test_rooms_of_app_import_only_those_on_floors_before_theirs() -> None:
    arrows = between(imported_files("app"), first_level)
    assert set(arrows) == {room for floor in APP for room in floor}
    above = [(room, other) for number, floor in enumerate(APP) for room in floor
             for other in arrows[room] if not any(other in lower for lower in APP[:number])]
    assert above == []


@pytest.mark.parametrize("package", ["app", "model"])
@pytest.mark.parametrize("part", [first_level, folder, str], ids=["part", "folder", "file"])
def test_there_are_no_circles(package: str, part: Callable[[str], str]) -> None:
    TopologicalSorter(between(imported_files(package), part)).prepare()


def test_files_are_short() -> None:
    lines = {name_of(path): len(path.read_text().splitlines()) for path in sources(*PACKAGES)}
    assert {name: number for name, number in lines.items() if number > MAX_FILE_LINES} == {}


def test_functions_are_short() -> None:
    long = {name_of(path): function for path in sources(*PACKAGES)
            for function, lines in contents(path).lines.items() if lines > MAX_FUNCTION_LINES}
    assert long == {}


def test_coroutines_are_run_where_no_browser_has_its_loop() -> None:
    async def outer() -> int:
        return complete(inner())

    async def inner() -> int:
        return 42

    assert complete(outer()) == 42
    by_themselves = [name_of(path) for path in sources("tests") if "asyncio.run" + "(" in
                     path.read_text()]
    assert by_themselves == []


def test_nothing_is_left_for_later() -> None:
    assert [name_of(path) for path in sources(*PACKAGES)
            if UNFINISHED in path.read_text()] == []
