"""Functions of the engine are called with what they take, and failures are told."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from model.engine import library
from model.engine.header import header
from model.engine.library import call, packed
from model.engine.nearest import cells_of

POINTS = np.array([[0.0, 0.0], [3.0, 0.0], [1.0, 0.0]])


def nearest(cells: object) -> list[list[int]]:
    """Return which points are nearest to each, by the engine."""
    found = np.full((3, 2), -1, np.int32)
    assert call("tandem_write_nearest_in", cells, 0, 3, found) is None
    return found.tolist()


def test_what_is_packed_is_taken_as_what_it_was() -> None:
    cells = cells_of(POINTS)
    assert nearest(packed(cells)) == nearest(cells) == [[2, 1], [2, 0], [0, 1]]


def test_results_are_returned() -> None:
    assert call("tandem_header") > 2**32


def test_results_may_be_written_where_they_are_asked_for() -> None:
    digest = np.zeros(1, np.uint64)
    assert call("tandem_header", digest) is None
    assert digest[0] == call("tandem_header")


@pytest.mark.parametrize(("args", "error"), [
    ((cells_of(POINTS), 0), "takes 4 arguments, not 2"),
    ((cells_of(POINTS), 0, 3, np.zeros((3, 2), np.int32), 5), "takes 4 arguments, not 5"),
    ((cells_of(POINTS), "first", 3, np.zeros((3, 2), np.int32)), "argument 2: int64_t"),
    ((cells_of(POINTS), 0, 3, np.zeros((3, 2))), r"tandem_i32_2d: an array of int32.*float64"),
    ((np.zeros(3), 0, 3, np.zeros((3, 2), np.int32)), "tandem_cells: fields low, high"),
    ((packed(np.zeros((3, 2), np.int32), "tandem_i32_2d"), 0, 3, np.zeros((3, 2), np.int32)),
     "argument 1: tandem_cells was expected, not tandem_i32_2d"),
])
def test_other_arguments_are_refused(args: tuple[object, ...], error: str) -> None:
    with pytest.raises(TypeError, match=error):
        call("tandem_write_nearest_in", *args)


@pytest.mark.parametrize(("code", "error"), [(-1, MemoryError), (-2, RuntimeError)])
def test_failures_are_raised(monkeypatch: pytest.MonkeyPatch, code: int,
                             error: type[Exception]) -> None:
    monkeypatch.setattr(library, "_function", lambda name: (lambda *_: code, [], []))
    with pytest.raises(error, match=f"tandem_any failed with code {code}"):
        call("tandem_any")


def test_unknown_functions_are_told() -> None:
    with pytest.raises(AttributeError, match="tandem_unknown"):
        call("tandem_unknown")


def script(text: str, **environment: str) -> "subprocess.CompletedProcess[str]":
    """Run Python with another library."""
    return subprocess.run(
        [sys.executable, "-c", text], check=False, text=True, capture_output=True,
        cwd=Path(__file__).parents[3], env={"PYTHONPATH": ".", **environment})


def test_a_library_that_is_missing_is_told_with_how_to_build_it(tmp_path: Path) -> None:
    done = script("from model.engine.library import call; call('tandem_header')",
                  TANDEM_ENGINE_LIBRARY=str(tmp_path / "none.so"))
    assert "ImportError: the engine isn't built" in done.stderr
    assert "make engine" in done.stderr


def test_a_library_built_from_another_header_is_refused(tmp_path: Path) -> None:
    (tmp_path / "tandem.h").write_text(header().read_text() + "\n/* More. */\n")
    done = script("from pathlib import Path; from model.engine import library;"
                  f"library.header = lambda: Path({str(tmp_path / 'tandem.h')!r});"
                  "library.call('tandem_header')")
    assert "built from another tandem.h" in done.stderr
