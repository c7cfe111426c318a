"""Tasks are done on as many threads as are asked for."""

import threading
from functools import partial

import pytest

from model.engine.threads import side_by_side


@pytest.mark.parametrize("num_threads", [1, 2, 3, 20])
def test_results_are_those_of_each_task_in_their_order(num_threads: int) -> None:
    assert side_by_side([partial(pow, number, 2) for number in range(9)], num_threads) == [
        number**2 for number in range(9)]
    assert side_by_side([], num_threads) == []


def test_tasks_are_done_at_the_same_time_in_the_callers_thread_too() -> None:
    both, seen = threading.Barrier(2, timeout=60), set()

    def meet() -> None:
        both.wait()
        seen.add(threading.current_thread())

    side_by_side([meet, meet], 2)
    assert len(seen) == 2
    assert threading.current_thread() in seen


def test_what_fails_is_raised_when_all_that_had_begun_are_done() -> None:
    begun, done = threading.Event(), []

    def fail() -> None:
        begun.wait(60)
        raise ValueError("of no use")

    def go_on() -> None:
        begun.set()
        done.append(True)

    with pytest.raises(ValueError, match="of no use"):
        side_by_side([fail, go_on], 2)
    assert done == [True]


def test_nothing_begins_after_a_failure() -> None:
    def fail() -> None:
        raise ValueError("of no use")

    with pytest.raises(ValueError, match="of no use"):
        side_by_side([fail, pytest.fail], 1)
