"""The rules that the tree's layout follows: who may import whom, and how long things may be."""

import ast
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from model.compiled import SOURCES
from tests.conftest import complete

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("app", "model", "training", "benchmarks", "examples", "tests")
FORBIDDEN = {
    "model": ("app", "training", "benchmarks", "tests"),
    "app": ("training", "benchmarks", "tests"),
    "training": ("app", "benchmarks", "tests"),
    "benchmarks": ("tests",),
}

SEARCH = tuple(f"search/{name}" for name in (
    "layout", "world", "draw", "block", "routes", "lean", "refresh", "edit", "evaluate",
    "ruin", "state", "retype", "scan", "splitting", "insertion", "places", "recreate", "exchange",
    "line", "resplit", "savings", "translate", "heat", "limits", "sharing", "anneal", "construct",
    "starts", "improve",
))
REPLANNING = tuple(f"replanning/{name}" for name in (
    "amend", "kept", "workers", "remainder", "handover"))
MODEL_ORDER = (
    "compiled", "problem", "alarm", "solution", "past", "timing", "metrics", "rules", "past_rules",
    "check", "attempt", "explain", *REPLANNING,
    "rows", "pausing", "travel", "wind", "obstacles", "visibility", "detours", "ways", "airspace",
    "instance", "schedule", "cost", "meeting", "transition",
    "simulator", "tokens", "prospects", "features", "parts", "rolling", "extract", *SEARCH,
    "policy", "policy_pointer", "policy_attention", "decode", "warming", "planner", "replan",
)
"""Each file of `model` imports only files to the left of its name."""

CHECKER = ("past", "timing", "metrics", "rules", "past_rules", "check", "attempt", "explain")
SIMULATION = ("compiled", "alarm", "rows", "instance", "schedule", "cost", "meeting", "transition",
              "simulator", "tokens", "prospects", "features", "parts", "rolling", "extract")
INTERPRETED = {"solution"}
"""Imported beside compiled functions, but nothing of it is compiled into them."""
ASKING = {"warming", "planner"}
"""Compile nothing themselves, but ask what is compiled."""

MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 40

UNFINISHED = "TO" "DO"


def sources(*packages: str) -> list[Path]:
    """Return the Python files of packages, in order."""
    return sorted(path for package in packages for path in (ROOT / package).rglob("*.py"))


def name_of(path: Path) -> str:
    """Return a path as the tests' reports name it."""
    return path.relative_to(ROOT).as_posix()


def imported_modules(path: Path) -> Iterator[str]:
    """Yield the dotted names that a file imports anywhere, `from a import b` as `a` and `a.b`."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{name_of(path)} has a relative import"
            yield node.module or ""
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def imported_packages(path: Path) -> set[str]:
    """Return the top-level packages that a file imports."""
    return {module.split(".")[0] for module in imported_modules(path)}


def imported_siblings(name: str) -> set[str]:
    """Return the files of `model` that one of them imports."""
    modules = set(imported_modules(ROOT / "model" / f"{name}.py"))
    return {file for file in MODEL_ORDER
            if f"model.{file.replace('/', '.')}" in modules}


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
             if not name_of(path).startswith("model/policy")
             and any(module.startswith(("torch", "model.policy"))
                     for module in imported_modules(path))]
    assert users == []


def test_serving_loads_no_torch() -> None:
    script = "import sys, app.main, app.cli; print('torch' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, check=True, text=True,
                          stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert done.stdout == "False\n"


def test_every_file_of_model_has_its_place() -> None:
    files = {path.relative_to(ROOT / "model").with_suffix("").as_posix()
             for path in sources("model") if path.stem != "__init__"}
    assert files == set(MODEL_ORDER)


@pytest.mark.parametrize("name", MODEL_ORDER)
def test_model_files_import_only_files_before_them(name: str) -> None:
    assert imported_siblings(name) <= set(MODEL_ORDER[:MODEL_ORDER.index(name)])


@pytest.mark.parametrize("name", CHECKER)
def test_checker_shares_no_code_with_simulation_and_search(name: str) -> None:
    assert imported_siblings(name) & {*SIMULATION, *SEARCH} == set()


@pytest.mark.parametrize("name", SIMULATION + SEARCH)
def test_simulation_and_search_share_no_code_with_the_checker(name: str) -> None:
    assert imported_siblings(name) & set(CHECKER) == set()


def test_compiled_code_is_filed_under_all_its_sources() -> None:
    users = {name for name in MODEL_ORDER if "compiled" in imported_siblings(name)} - ASKING
    needed = users.union({"compiled"}, *(imported_siblings(name) for name in users)) - INTERPRETED
    assert set(SOURCES) == needed


def test_only_one_file_imports_the_compiler() -> None:
    importers = [name_of(path) for path in sources("app", "model", "training")
                 if "numba" in imported_packages(path)]
    assert importers == ["model/compiled.py"]


@pytest.mark.parametrize("path", sources(*PACKAGES), ids=name_of)
def test_file_is_short(path: Path) -> None:
    assert len(path.read_text().splitlines()) <= MAX_FILE_LINES


@pytest.mark.parametrize("path", sources(*PACKAGES), ids=name_of)
def test_functions_are_short(path: Path) -> None:
    functions = (node for node in ast.walk(ast.parse(path.read_text()))
                 if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef))
    long = {function.name: code_lines(function) for function in functions
            if code_lines(function) > MAX_FUNCTION_LINES}
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


@pytest.mark.parametrize("path", sources(*PACKAGES), ids=name_of)
def test_nothing_is_left_for_later(path: Path) -> None:
    assert UNFINISHED not in path.read_text()
