"""A process that plans, and the work that it does, as the one sees it that it plans for."""

import threading
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any

from asgi_correlation_id import correlation_id

from app.serving.children.errors import EndedUnexpectedlyError, told
from app.serving.children.line import ANSWERED, ASKED, READY, REFUSED, STOP, TOLD, WORK

START_SECONDS = 300.0
"""How long one may take to get ready on a machine that is busy."""

END_SECONDS = 10.0
"""How long one may take to end that has nobody to work for."""

Answers = Mapping[str, Callable[..., Any]]
"""What is asked -> who answers; the last argument tells whether to stop."""

Listeners = Mapping[str, Callable[[Any], None]]
"""What is told -> who listens."""


class Child:
    """One that plans.

    Parameters
    ----------
    connection
        To it.
    process
        The process; None: a thread of this one.
    """

    def __init__(self, connection: Connection, process: BaseProcess | None = None) -> None:
        self.connection = connection
        self._process = process
        self._sending = threading.Lock()

    def get_ready(self) -> None:
        """Wait until it takes work.

        Raises
        ------
        Exception
            Whatever hinders it.
        """
        try:
            if not self.connection.poll(START_SECONDS):
                raise EndedUnexpectedlyError
            kind, *rest = self.connection.recv()
        except (EOFError, OSError) as error:
            raise EndedUnexpectedlyError from error
        if kind != READY:
            raise rest[0].again()

    @property
    def is_alive(self) -> bool:
        """Tell whether it is there: one that has no work says nothing but that it has ended."""
        return not self.connection.closed and not self.connection.poll(0)

    def send(self, *message: Any) -> None:
        """Say something, unless nobody hears it: that is told by what comes back. In place."""
        with self._sending, suppress(OSError):
            self.connection.send(message)

    def end(self) -> int | None:
        """End it, and return how it ended: minus the signal's number, as a rule. In place."""
        self.connection.close()
        if self._process is None:
            return None
        self._process.join(END_SECONDS)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()
        return self._process.exitcode


class Call:
    """A piece of work under way.

    Parameters
    ----------
    child
        Who does it.
    answers, listeners
        Who answers what is asked meanwhile, and who is told of it.
    give_back
        Called once it is over, with whether the child is still there.
    """

    def __init__(self, child: Child, answers: Answers, listeners: Listeners,
                 give_back: Callable[[Child, bool], None]) -> None:
        self._child = child
        self._answers = answers
        self._listeners = listeners
        self._give_back = give_back
        self._lock = threading.Lock()
        self._is_over = False
        self._result: Any = None
        self._error: BaseException | None = None

    def begin(self, function: Callable[..., Any], args: tuple[Any, ...]) -> None:
        """Have it begin. In place."""
        self._child.send(WORK, function, args, correlation_id.get())

    def wait(self, seconds: float, should_stop: Callable[[], bool] = lambda: False,
             is_enough: Callable[[], bool] = lambda: False) -> bool:
        """Listen for some time, or until it is enough; tell whether the work is over. In place.

        Parameters
        ----------
        should_stop
            Tells who answers questions whether to end that.
        """
        until = time.monotonic() + seconds
        while not self._is_over and not is_enough():
            try:
                if not self._child.connection.poll(max(0.0, until - time.monotonic())):
                    break
                kind, *rest = self._child.connection.recv()
            except (EOFError, OSError):
                self._end(None, EndedUnexpectedlyError(), is_alive=False)
                break
            self._take(kind, rest, should_stop)
        return self._is_over

    def stop(self) -> None:
        """Have it end with what there is. In place."""
        with self._lock:
            if not self._is_over:
                self._child.send(STOP)

    def drop(self) -> None:
        """Have nobody work on it any more. In place."""
        if not self._is_over:
            self._end(None, EndedUnexpectedlyError(), is_alive=False)

    def result(self) -> Any:
        """Return what came of it.

        Raises
        ------
        Exception
            Whatever ended it; `EndedUnexpectedlyError`: the child died.
        """
        if self._error is not None:
            raise self._error
        return self._result

    def _take(self, kind: str, rest: list[Any], should_stop: Callable[[], bool]) -> None:
        if kind == TOLD:
            name, value = rest
            self._listeners[name](value)
        elif kind == ASKED:
            name, args = rest
            self._answer(name, args, should_stop)
        elif kind == ANSWERED:
            self._end(rest[0], None)
        else:
            self._end(None, rest[0].again())

    def _answer(self, name: str, args: tuple[Any, ...], should_stop: Callable[[], bool]) -> None:
        try:
            reply = (ANSWERED, self._answers[name](*args, should_stop))
        except Exception as error:  # for whoever asked
            reply = (REFUSED, told(error))
        self._child.send(*reply)

    def _end(self, result: Any, error: BaseException | None, is_alive: bool = True) -> None:
        with self._lock:
            self._is_over = True
        self._result, self._error = result, error
        self._give_back(self._child, is_alive)
