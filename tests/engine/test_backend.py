"""What the package is built with is what there is, else what PyPI has."""

import importlib.util
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture
def backend() -> ModuleType:
    """Return the file by which pip builds the package."""
    spec = importlib.util.spec_from_file_location("backend", ROOT / "engine/backend.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def have(monkeypatch: pytest.MonkeyPatch, backend: ModuleType, folder: Path, *names: str) -> None:
    """Let there be these programs alone."""
    for name in names:
        (folder / name).write_text("#!/bin/sh\n")
        (folder / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(folder))
    monkeypatch.delenv("CXX", raising=False)
    monkeypatch.setattr(sys, "executable", str(folder / "python"))
    monkeypatch.setattr(backend, "BUILD", folder / "build")


def test_nothing_is_asked_for_that_is_there(
        monkeypatch: pytest.MonkeyPatch, backend: ModuleType, tmp_path: Path) -> None:
    have(monkeypatch, backend, tmp_path, "cmake", "ninja", "clang++")
    assert backend.requires() == []


def test_what_is_missing_comes_from_pypi(
        monkeypatch: pytest.MonkeyPatch, backend: ModuleType, tmp_path: Path) -> None:
    have(monkeypatch, backend, tmp_path, "ninja")
    assert backend.requires() == ["cmake>=3.20", backend.SPARE_COMPILER]


def test_a_compiler_that_is_named_is_taken(
        monkeypatch: pytest.MonkeyPatch, backend: ModuleType, tmp_path: Path) -> None:
    have(monkeypatch, backend, tmp_path, "cmake", "ninja")
    monkeypatch.setenv("CXX", "c++-17")
    assert backend.requires() == []


def test_where_there_is_no_compiler_pythons_is_run(
        monkeypatch: pytest.MonkeyPatch, backend: ModuleType, tmp_path: Path) -> None:
    have(monkeypatch, backend, tmp_path)
    (tmp_path / "python").write_text('#!/bin/sh\necho "$@"\n')
    (tmp_path / "python").chmod(0o755)
    monkeypatch.setenv("CXX", "")
    backend.choose_compiler()
    told = subprocess.run([backend.os.environ["CXX"], "-c", "a b.cpp"], check=True, text=True,
                          capture_output=True)
    assert told.stdout == "-m ziglang c++ -fno-sanitize=undefined -c a b.cpp\n"


def test_what_is_installed_to_build_is_told() -> None:
    told = subprocess.run([sys.executable, ROOT / "engine/backend.py", "requires"], check=True,
                          text=True, capture_output=True)
    assert told.stdout.startswith("scikit-build-core")


def test_what_built_so_far_builds_on_while_it_is_there(backend: ModuleType, tmp_path: Path) -> None:
    ninja = tmp_path / "ninja"
    ninja.touch()
    assert backend.before(tmp_path, "ninja") is None
    (tmp_path / "CMakeCache.txt").write_text(
        f"//Program\nCMAKE_MAKE_PROGRAM:FILEPATH={ninja}\n"
        f"CMAKE_COMMAND:INTERNAL={tmp_path}/gone/cmake\n")
    assert backend.before(tmp_path, "ninja") == str(ninja)
    assert backend.before(tmp_path, "cmake") is None
