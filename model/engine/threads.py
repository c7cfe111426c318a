"""Tasks on several threads, of which the caller's is one: it has no others to wait for."""

from collections.abc import Callable, Sequence
from threading import Lock, Thread
from typing import TypeVar

Result = TypeVar("Result")


def side_by_side(tasks: Sequence[Callable[[], Result]], num_threads: int) -> list[Result]:
    """Do tasks, which begin in their order, and return what each returns.

    Raises what the first that fails raises, when those that had begun are done.
    """
    results: dict[int, Result] = {}
    errors: list[BaseException] = []
    numbers, lock = iter(range(len(tasks))), Lock()

    def work() -> None:
        while not errors:
            with lock:
                number = next(numbers, None)
            if number is None:
                return
            try:
                results[number] = tasks[number]()
            except BaseException as error:
                errors.append(error)

    others = [Thread(target=work) for _ in range(min(num_threads, len(tasks)) - 1)]
    for thread in others:
        thread.start()
    work()
    for thread in others:
        thread.join()
    if errors:
        raise errors[0]
    return [results[number] for number in range(len(tasks))]
