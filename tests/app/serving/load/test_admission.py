"""Slots and the queue for them."""

import asyncio
import random
from collections.abc import Callable

import pytest

from app.serving.load.admission import Admission, OverloadedError
from tests.conftest import PATIENCE, complete

pytestmark = pytest.mark.slow


async def settle(condition: Callable[[], bool]) -> None:
    """Let other tasks run until a condition holds."""
    async with asyncio.timeout(PATIENCE):
        while not condition():
            await asyncio.sleep(0)


def test_what_finds_slots_and_queue_full_is_refused_at_once() -> None:
    async def scenario() -> None:
        admission = Admission(slots=1, queue=0, longest_wait=60)
        admission.refuse_if_full()
        await admission.acquire()
        with pytest.raises(OverloadedError, match="try again"):
            admission.refuse_if_full()
        with pytest.raises(OverloadedError, match="try again"):
            await admission.acquire()
        admission.release()
        admission.refuse_if_full()
        await admission.acquire()
        assert admission.running == 1

    complete(scenario())


def test_whoever_waits_too_long_is_refused() -> None:
    async def scenario() -> None:
        admission = Admission(slots=1, queue=1, longest_wait=0.01)
        await admission.acquire()
        with pytest.raises(OverloadedError, match=r"0\.01 s"):
            await admission.acquire()
        assert admission.waiting == 0
        admission.release()
        assert admission.running == 0

    complete(scenario())


def test_turn_that_comes_as_the_wait_ends_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    async def scenario() -> None:
        admission = Admission(slots=1, queue=1, longest_wait=60)
        await admission.acquire()
        waiting = asyncio.create_task(admission.acquire())
        await settle(lambda: admission.waiting == 1)
        # The wait is over before the loop goes on, so that both are there when it does.
        later = asyncio.get_running_loop().time() + 100
        monkeypatch.setattr(asyncio.get_running_loop(), "time", lambda: later)
        admission.release()
        await waiting
        assert (admission.running, admission.waiting) == (1, 0)

    complete(scenario())


def test_turns_come_in_order() -> None:
    async def scenario() -> None:
        admission = Admission(slots=1, queue=5, longest_wait=60)
        order: list[int] = []

        async def visit(number: int) -> None:
            await admission.acquire()
            order.append(number)
            admission.release()

        await admission.acquire()
        tasks = []
        for number in range(5):
            tasks.append(asyncio.create_task(visit(number)))
            await settle(lambda: admission.waiting == len(tasks))
        with pytest.raises(OverloadedError):
            admission.refuse_if_full()
        admission.release()
        await asyncio.gather(*tasks)
        assert order == [0, 1, 2, 3, 4]
        assert (admission.running, admission.waiting) == (0, 0)

    complete(scenario())


def test_whoever_is_cancelled_leaves_the_queue() -> None:
    async def scenario() -> None:
        admission = Admission(slots=1, queue=1, longest_wait=60)
        await admission.acquire()
        waiting = asyncio.create_task(admission.acquire())
        await settle(lambda: admission.waiting == 1)
        waiting.cancel()
        with pytest.raises(asyncio.CancelledError):
            await waiting
        assert admission.waiting == 0
        admission.release()
        assert admission.running == 0

    complete(scenario())


def test_slot_that_comes_while_its_waiter_is_cancelled_is_not_lost() -> None:
    async def scenario() -> None:
        admission = Admission(slots=1, queue=1, longest_wait=60)
        await admission.acquire()
        waiting = asyncio.create_task(admission.acquire())
        await settle(lambda: admission.waiting == 1)
        # Both happen before the waiter runs again.
        admission.release()
        waiting.cancel()
        with pytest.raises(asyncio.CancelledError):
            await waiting
        assert admission.running == 0

    complete(scenario())


def test_slot_passes_over_those_who_gave_up() -> None:
    async def scenario() -> None:
        admission = Admission(slots=1, queue=2, longest_wait=60)
        await admission.acquire()
        first, second = (asyncio.create_task(admission.acquire()) for _ in range(2))
        await settle(lambda: admission.waiting == 2)
        first.cancel()
        admission.release()
        await second
        assert first.cancelled() or await asyncio.wait({first})
        assert (admission.running, admission.waiting) == (1, 0)

    complete(scenario())


def test_no_more_than_the_slots_work_whatever_is_cancelled() -> None:
    async def scenario() -> None:
        admission = Admission(slots=3, queue=100, longest_wait=60)
        rng = random.Random(4)
        inside = most = 0

        async def work() -> None:
            nonlocal inside, most
            await admission.acquire()
            try:
                inside += 1
                most = max(most, inside)
                for _ in range(rng.randrange(4)):
                    await asyncio.sleep(0)
            finally:
                inside -= 1
                admission.release()

        for _ in range(100):
            tasks = [asyncio.create_task(work()) for _ in range(40)]
            for task in rng.sample(tasks, 15):
                for _ in range(rng.randrange(3)):
                    await asyncio.sleep(0)
                task.cancel()
            await asyncio.wait(tasks)
        assert most == 3
        assert (admission.running, admission.waiting) == (0, 0)

    complete(scenario())
