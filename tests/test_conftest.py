"""Tests are run again exactly where the machine may be to blame, all by one of two targets, and
none ends others' loops.
"""

import re
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.conftest import (
    STALL, TRIES, complete, pytest_collection_modifyitems, pytest_pyfunc_call,
)

ROOT = Path(__file__).resolve().parents[1]


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


class Case:
    """A case of a test, as far as it is looked at."""

    def __init__(self, nodeid: str, few: int | None) -> None:
        self.nodeid = self.name = nodeid
        self.marks: dict[str, Any] = {} if few is None else {
            "thorough_after": SimpleNamespace(args=(few,))}

    def get_closest_marker(self, name: str) -> Any:
        return self.marks.get(name)

    def add_marker(self, mark: pytest.MarkDecorator) -> None:
        self.marks[mark.name] = mark


def test_cases_after_the_first_few_are_thorough_where_a_test_says_so() -> None:
    cases: Any = [*(Case(f"test_a[{number}]", 2) for number in range(4)),
                  *(Case(f"test_b[{number}]", None) for number in range(4)),
                  *(Case(f"test_c[{number}]", 1) for number in range(2))]
    pytest_collection_modifyitems(cases)
    assert [case.nodeid for case in cases if "thorough" in case.marks] == [
        "test_a[2]", "test_a[3]", "test_c[1]"]


def test_what_make_test_leaves_out_is_run_by_make_test_studies() -> None:
    recipes = dict(re.findall(r"^(test[a-z-]*):.*\n((?:\t.+\n)+)",
                              (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE))
    kept, = recipes["test"].splitlines()
    marked, studies = recipes["test-studies"].splitlines()
    assert kept.replace('"not thorough"', "thorough") == marked
    assert kept.endswith(" $(STUDIES:%=--ignore=%)")
    assert studies == "\t$(PYTEST) $(STUDIES)"


def test_coroutines_are_run_where_no_browser_has_its_loop() -> None:
    async def outer() -> int:
        return complete(inner())

    async def inner() -> int:
        return 42

    assert complete(outer()) == 42
    by_themselves = [path.name for path in Path(__file__).parent.rglob("*.py")
                     if "asyncio.run" + "(" in path.read_text("utf-8")]
    assert by_themselves == []
