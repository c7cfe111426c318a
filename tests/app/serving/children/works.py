"""What those are asked to do that plan."""

import os
import threading
from collections.abc import Callable
from typing import Any

from app.schemas.errors import InputError, InvalidRequestError
from app.serving.children.line import Line

ShouldStop = Callable[[], bool]


def opened(line: Line) -> Line:
    """Return what all work is done with."""
    return line


def refused(line: Line) -> Line:
    """Have nothing that work could be done with."""
    raise ValueError("no policy")


def doubled(line: Line, number: int, should_stop: ShouldStop) -> int:
    """Double a number."""
    return 2 * number


def process(line: Line, should_stop: ShouldStop) -> int:
    """Return who does it."""
    return os.getpid()


def die(line: Line, number: int, should_stop: ShouldStop) -> None:
    """End this process."""
    os.kill(os.getpid(), number)


def wait(line: Line, should_stop: ShouldStop) -> str:
    """Wait until told to stop."""
    line.tell("begun", None)
    while not should_stop():
        threading.Event().wait(0.005)
    return "stopped"


def go_on(line: Line, should_stop: ShouldStop) -> None:
    """Hear nothing of stopping."""
    threading.Event().wait(60)


def ask(line: Line, number: int, should_stop: ShouldStop) -> Any:
    """Ask the other process something, and tell it of the answer."""
    answer = line.ask("half", number)
    line.tell("answer", answer)
    return answer


def find_wrong(line: Line, should_stop: ShouldStop) -> None:
    """Find something wrong with a request."""
    raise InvalidRequestError([InputError(code="NO_DEPOT", path="$.depots", message="None.")])


def fail(line: Line, should_stop: ShouldStop) -> None:
    """Fail in a way that can't be sent."""
    class OwnError(Exception):
        """Known to nobody else."""

    raise OwnError("oh no")
