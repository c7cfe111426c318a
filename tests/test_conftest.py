"""Tests are run again exactly where the machine may be to blame, and none ends others' loops."""

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.conftest import STALL, TRIES, complete, pytest_pyfunc_call


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch) -> Callable[..., int]:
    """Return a function that runs a test which fails some times, and tells how often it ran."""
    clock = {"now": 0.0}
    monkeypatch.setattr("tests.conftest.time", SimpleNamespace(
        perf_counter=lambda: clock["now"], process_time=lambda: 0.0))

    def run_it(failures: int, waits: float, marked: bool = True,
               error: type[Exception] = AssertionError) -> int:
        runs = 0

        def test(asked: dict[str, int]) -> None:
            nonlocal runs
            runs += 1
            asked["changed"] += 1
            clock["now"] += waits
            assert asked == {"changed": 1}
            if runs <= failures:
                raise error

        item: Any = SimpleNamespace(obj=test, funcargs={"asked": {"changed": 0}},
                                    get_closest_marker=lambda name: marked or None)
        assert pytest_pyfunc_call(item) is (True if marked else None)
        return runs

    return run_it


def test_a_test_that_passes_runs_once(run: Callable[..., int]) -> None:
    assert run(0, 10 * STALL) == 1


def test_a_test_that_fails_while_it_waits_runs_again_on_requests_as_they_were(
        run: Callable[..., int]) -> None:
    for error in (AssertionError, ValueError, TimeoutError):
        assert run(TRIES - 1, 10 * STALL, error=error) == TRIES


def test_a_test_that_fails_each_time_fails(run: Callable[..., int]) -> None:
    with pytest.raises(AssertionError):
        run(TRIES, 10 * STALL)


def test_a_test_that_fails_on_a_quiet_machine_fails_at_once(run: Callable[..., int]) -> None:
    with pytest.raises(AssertionError):
        run(1, STALL / 2)


def test_other_tests_are_left_to_pytest(run: Callable[..., int]) -> None:
    assert run(0, 0.0, marked=False) == 0


def test_coroutines_are_run_where_no_browser_has_its_loop() -> None:
    async def outer() -> int:
        return complete(inner())

    async def inner() -> int:
        return 42

    assert complete(outer()) == 42
    by_themselves = [path.name for path in Path(__file__).parent.rglob("*.py")
                     if "asyncio.run" + "(" in path.read_text("utf-8")]
    assert by_themselves == []
