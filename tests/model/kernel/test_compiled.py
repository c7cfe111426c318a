import os
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from model.kernel.compiled import SOURCES, fingerprint, first_to_compile, is_cold

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """A folder with a copy of every file that takes part in compilation."""
    for name in SOURCES:
        target = tmp_path / f"{name}.py"
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / "model" / f"{name}.py", target)
    return tmp_path


def folder_seen_from(root: Path, **environment: str) -> str:
    """Return what a new process names as the folder of compiled code."""
    script = "from model.kernel.compiled import compiled_folder; print(compiled_folder())"
    done = subprocess.run([sys.executable, "-B", "-c", script], cwd=root, capture_output=True,
                          check=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(root), **environment})
    return done.stdout.strip()


def test_same_sources_have_the_same_fingerprint(source: Path) -> None:
    assert fingerprint(source) == fingerprint(ROOT / "model")


@pytest.mark.parametrize("name", SOURCES)
def test_change_in_any_source_changes_the_fingerprint(source: Path, name: str) -> None:
    before = fingerprint(source)
    with (source / f"{name}.py").open("a") as file:
        file.write("\n")
    assert fingerprint(source) != before


def test_chosen_folder_holds_the_compiled_code(tmp_path: Path) -> None:
    name = f"compiled-{fingerprint(ROOT / 'model')}"
    seen = folder_seen_from(ROOT, NUMBA_CACHE_DIR=str(tmp_path / "cache"))
    assert Path(seen) == tmp_path / "cache" / name
    assert Path(seen).is_dir()


def test_folder_is_cold_until_it_holds_all_that_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("model.kernel.compiled.compiled_folder", lambda: tmp_path)
    assert is_cold(["one", "other"])
    with first_to_compile(["one"]) as is_first:
        assert is_first
    assert not is_cold(["one"])
    assert is_cold(["one", "other"])


def test_one_of_several_compiles_and_the_others_find_it_done(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("model.kernel.compiled.compiled_folder", lambda: tmp_path)

    def come() -> bool:
        with first_to_compile(["all"]) as is_first:
            if is_first:
                time.sleep(0.2)
            return is_first

    with ThreadPoolExecutor(3) as pool:
        told = [pool.submit(come) for _ in range(3)]
    assert sorted(answer.result() for answer in told) == [False, False, True]
    assert not come()


def test_parts_that_have_none_in_common_are_compiled_side_by_side(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("model.kernel.compiled.compiled_folder", lambda: tmp_path)

    def come() -> bool:
        with first_to_compile(["third"]) as is_first:
            return is_first

    with first_to_compile(["one", "other"]) as is_first, ThreadPoolExecutor(1) as pool:
        assert is_first
        assert pool.submit(come).result(timeout=10)


def test_where_one_has_died_the_next_compiles(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("model.kernel.compiled.compiled_folder", lambda: tmp_path)
    with pytest.raises(RuntimeError), first_to_compile(["all"]):
        raise RuntimeError
    with first_to_compile(["all"]) as is_first:
        assert is_first


def test_user_cache_serves_where_the_source_cannot_be_written(tmp_path: Path) -> None:
    package = tmp_path / "model"
    shutil.copytree(ROOT / "model", package, ignore=shutil.ignore_patterns("__pycache__"))
    (package / "__pycache__").write_text("in the way of a folder")
    seen = folder_seen_from(tmp_path, NUMBA_CACHE_DIR="", XDG_CACHE_HOME=str(tmp_path / "user"))
    assert Path(seen).parent == tmp_path / "user" / "tandem-planner"


def test_code_is_found_wherever_the_source_lies(tmp_path: Path) -> None:
    script = (
        "import numpy as np; from model.kernel.clock import arrival_by_profile as one;"
        "times, factors = np.zeros(1, np.int64), np.ones(2, np.int64);"
        "one(times, factors, 0, 1, 0); print(sum(one.stats.cache_hits.values()))")
    for place, hits in (("here", "0"), ("there", "1")):
        package = tmp_path / place / "model"
        shutil.copytree(ROOT / "model", package, ignore=shutil.ignore_patterns("__pycache__"))
        done = subprocess.run(
            [sys.executable, "-B", "-c", script], cwd=package.parent, capture_output=True,
            check=True, text=True, env={**os.environ, "PYTHONPATH": str(package.parent),
                                        "NUMBA_CACHE_DIR": str(tmp_path / "code")})
        assert done.stdout.strip() == hits


def test_what_others_are_linked_from_is_read_when_one_is(tmp_path: Path) -> None:
    script = (
        "import numba, numpy as np; from model.kernel.clock import arrival_by_profile as one;"
        "given = np.array([5]), np.array([3, 4]), 2, 9, 0;"
        "alone = one(*given); library = next(iter(one.overloads.values())).library;"
        "waits = library.linkable is not None;"
        "other = numba.njit(lambda *given: one(*given));"
        "print(waits, other(*given) == alone, library.linkable is None)")
    for waits in (False, True):
        done = subprocess.run(
            [sys.executable, "-B", "-c", script], cwd=ROOT, capture_output=True, check=True,
            text=True, env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)})
        assert done.stdout.strip() == f"{waits} True True"


def test_nothing_is_kept_where_no_folder_can_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    assert folder_seen_from(ROOT, NUMBA_CACHE_DIR=str(tmp_path / "file")) == "None"
