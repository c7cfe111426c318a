"""The rules that the tree's layout follows: who may import whom, and how long things may be."""

import ast
from collections import defaultdict
from collections.abc import Callable
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("app", "model", "training", "benchmarks", "examples", "tests")
FORBIDDEN = {"model": {"app", "training", "tests"}, "app": {"training", "tests"},
             "training": {"app", "tests"}, "benchmarks": {"tests"}}

APP = (("schemas", "database"), ("serving",), ("maps",), ("requests", "console"), ("plans",),
       ("formats", "records"), ("main",), ("cli",))
"""Floors of `app`, each of which imports only those before it."""

MODEL = {
    "problem": "", "solution": "", "engine": "problem solution", "judge": "problem solution",
    "travel": "problem engine", "simulation": "problem engine",
    "policy": "problem solution engine simulation", "search": "problem solution engine",
    "together": "problem solution judge engine search",
    "counsel": "problem solution judge search",
    "planner": "problem solution judge engine policy search together",
    "replanning": "problem solution judge counsel planner",
    "dialects": "problem solution judge planner",
}
"""What each folder and file of `model` imports of the others."""

TORCH = ("torch", *(f"model.policy.{name}" for name in ("network", "attention", "pointer")))
BLOCKS = ("body", "orelse", "finalbody", "handlers", "cases")
"""Fields of a statement that hold statements."""

MAX_FILE_LINES, MAX_FUNCTION_LINES, MAX_ARROWS = 400, 40, 40


class Source(NamedTuple):
    """What is looked at of a file; all trees together take 350 MB, which slows later tests."""

    imports: frozenset[str]  # anywhere, `from a import b` as `a` and `a.b`
    classes: tuple[str, ...]
    functions: dict[str, int]  # lines of each but for its docstring


@cache
def sources() -> dict[str, Source]:
    """Return the packages' Python files by their dotted names."""
    paths = [path for package in PACKAGES for path in sorted((ROOT / package).rglob("*.py"))]
    return {".".join(path.relative_to(ROOT).with_suffix("").parts):
            read(path.read_text("utf-8")) for path in paths}


def read(text: str) -> Source:
    """Return what is looked at of a file, from its statements and those within others."""
    imports, classes, functions = set[str](), list[str](), dict[str, int]()
    statements: list[ast.AST] = [ast.parse(text)]
    for node in statements:
        statements += [inner for block in BLOCKS for inner in getattr(node, block, ())]
        if isinstance(node, ast.Import):
            imports |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            imports |= {f"{node.module}", *(f"{node.module}.{each.name}" for each in node.names)}
        elif isinstance(node, ast.ClassDef):
            classes.append(node.name)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            body = node.body[ast.get_docstring(node) is not None:] or node.body
            functions[f"{node.name}:{node.lineno}"] = (node.end_lineno or 0) - body[0].lineno
    return Source(frozenset(imports), tuple(classes), functions)


def imports(name: str) -> frozenset[str]:
    return sources()[name].imports


def arrows(package: str, part: Callable[[str], str]) -> dict[str, set[str]]:
    """Return the other parts, of which each file of a package has one, that each part imports."""
    files = {name for name in sources() if name.startswith(f"{package}.")}
    # A folder that gathers names of its files stands for these.
    meant = {name.removesuffix(".__init__"): imports(name) & files if name.endswith(".__init__")
             else {name} for name in files}
    found: dict[str, set[str]] = {part(name): set() for name in files & set(meant)}
    for name in files & set(meant):
        others = set().union(*(meant.get(module, set()) for module in imports(name)))
        found[part(name)] |= {part(other) for other in others} - {part(name)}
    return found


def room(name: str) -> str:
    return name.split(".")[1]


def folder(name: str) -> str:
    return name.rpartition(".")[0] if name.count(".") > 1 else name


def test_packages_import_along_the_arrows() -> None:
    for name in sources():
        package, packages = name.split(".")[0], {module.split(".")[0] for module in imports(name)}
        assert "None" not in packages, f"{name} has a relative import"
        assert packages.isdisjoint(FORBIDDEN.get(package, ())), name
        assert "benchmarks" not in packages or "benchmarks" in name.split(".")[:2], name


def test_only_policies_and_training_use_torch() -> None:
    assert [name for name in sources() if name.startswith(("app.", "model.")) and name not in TORCH
            and any(module.startswith(TORCH) for module in imports(name))] == []


def test_parts_of_model_import_along_the_arrows() -> None:
    found = arrows("model", room)
    assert found == {part: set(others.split()) for part, others in MODEL.items()}
    assert sum(map(len, found.values())) <= MAX_ARROWS


def test_rooms_of_app_import_only_those_on_floors_before_theirs() -> None:
    floors = {room: number for number, rooms in enumerate(APP) for room in rooms}
    found = arrows("app", room)
    assert set(found) == set(floors)
    assert all(floors[other] < floors[room] for room in found for other in found[room]), found


@pytest.mark.parametrize("package", ["app", "model"])
@pytest.mark.parametrize("part", [room, folder, str])
def test_there_are_no_circles(package: str, part: Callable[[str], str]) -> None:
    TopologicalSorter(arrows(package, part)).prepare()


def test_a_class_has_its_name_to_itself() -> None:
    homes = defaultdict[str, list[str]](list)
    for name, source in sources().items():
        for each in source.classes:
            if name.partition(".")[0] in {"app", "model", "training"} and not each.startswith("_"):
                homes[each].append(name)
    assert {name: files for name, files in homes.items() if len(files) > 1} == {}


def test_files_and_functions_are_short_and_finished() -> None:
    for name, source in sources().items():
        text = (ROOT / f"{name.replace('.', '/')}.py").read_text("utf-8")
        assert (text.count("\n") <= MAX_FILE_LINES, "TO" "DO" in text) == (True, False), name
        assert [each for each, lines in source.functions.items()
                if lines >= MAX_FUNCTION_LINES] == [], name
