"""How far warming a planner has come."""

import threading
from pathlib import Path

import numpy as np
import pytest

from model import planner
from model.kernel import compiled
from model.kernel.compiled import Count, compiled_on_arrays, counting, inlined
from model.kernel.warming import MOST, UP_TO_LAST, Estimate, Warmth, telling
from model.planner import Planner
from tests.model.street import NO_POLICY


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return an empty folder for compiled code, and forget all functions."""
    monkeypatch.setattr(compiled, "compiled_folder", lambda: tmp_path)
    monkeypatch.setattr(compiled, "_TO_COMPILE", set())
    return tmp_path


def double(number: int) -> int:
    return 2 * number


def test_functions_are_counted_as_they_are_compiled(folder: Path) -> None:
    part = inlined(double)
    with counting() as count:
        @compiled_on_arrays
        def doubled(numbers: np.ndarray) -> int:
            return part(numbers[0])

        assert count.share() == 0
        assert doubled(np.array([21])) == 42
        assert count.share() == 1


def test_functions_that_another_process_compiled_are_counted(folder: Path) -> None:
    part = inlined(double)
    with counting():
        compiled_on_arrays(lambda numbers: part(numbers[0]))(np.array([21]))
    assert Count().share() == 1


def test_without_a_folder_a_process_counts_for_itself(
        folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compiled, "compiled_folder", lambda: None)
    function = compiled_on_arrays(double)
    with counting() as count:
        function(1)
    assert count.share() == 1
    assert Count().share() == 0


def test_estimate_goes_on_at_the_pace_so_far_and_never_falls() -> None:
    estimate = Estimate(now=100.0)
    assert estimate.share(0.0, 105.0) == 0
    assert estimate.share(0.5, 110.0) == pytest.approx(0.5 * UP_TO_LAST)
    told = estimate.share(0.5, 112.0)
    assert told == pytest.approx(0.6 * UP_TO_LAST)
    assert estimate.share(0.51, 112.1) >= told
    assert estimate.share(0.51, 10_000.0) == MOST


def test_stage_under_way_is_told_again() -> None:
    told: list[Warmth] = []
    again = threading.Event()

    def tell(warmth: Warmth) -> None:
        told.append(warmth)
        if len(told) == 3:
            again.set()

    with telling(tell) as warming:
        warming.enter("compiling this", decodes=True)
        assert again.wait(60)
    assert {(warmth.doing, warmth.decodes) for warmth in told[1:]} == {("compiling this", True)}


def test_planner_tells_that_it_decodes_before_the_search_is_compiled(
        monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[str] = []
    monkeypatch.setattr(planner, "compile_search", lambda _: done.append("search compiled"))
    monkeypatch.setattr(planner, "keep_loaded", lambda: None)
    monkeypatch.setattr(Planner, "plan", lambda *_: done.append("planned"))
    Planner(NO_POLICY).warm(lambda warmth: done.append("decodes" if warmth.decodes else "not yet"))
    assert done.index("planned") < done.index("decodes") < done.index("search compiled")
    assert "not yet" in done[:done.index("planned")]


