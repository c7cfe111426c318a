"""The engine tells deadlines by the clock that Python states them by."""

import time

import pytest

from tests.engine.rules.asking import asked

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


def test_the_engines_clock_is_that_of_python() -> None:
    asked("steady_clock_at", 1)
    before = time.perf_counter_ns()
    between, = asked("steady_clock_at", 1)
    assert before <= between <= time.perf_counter_ns()
