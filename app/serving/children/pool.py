"""A kept pool of those that plan.

Those of `concurrent.futures` and `loky` give up all work at the death of one process; here each
has a line of its own, whose end tells who died and what it was doing.
"""

import atexit
import logging
import threading
import time
from collections.abc import Callable
from types import MappingProxyType
from typing import Any

from app.serving.children.child import Answers, Call, Child, Listeners
from app.serving.children.errors import EndedUnexpectedlyError

logger = logging.getLogger(__name__)

LOOK = 0.01
"""Seconds between two looks whether work is to end, or one that plans is free."""

STOP_SECONDS = 30.0
"""Seconds after which one is ended that was told to stop and goes on."""

LONGEST_WAIT = 60.0
"""Seconds after which whoever waits for one that is free is refused."""


class Pool:
    """Some that plan.

    Parameters
    ----------
    start
        Starts one.
    most
        How many there may be.
    answers
        Who answers what they ask.
    on_death
        Called when one died, with what it was doing.
    """

    def __init__(self, start: Callable[[], Child], most: int,
                 answers: Answers = MappingProxyType({}),
                 on_death: Callable[[str], None] = lambda _: None) -> None:
        self._start = start
        self._most = most
        self._answers = answers
        self._on_death = on_death
        self._changed = threading.Condition()
        self._idle: list[Child] = []
        self._busy: set[Child] = set()
        self._count = 0
        self._is_open = True
        atexit.register(self.close)

    def warm(self, count: int) -> None:
        """Have so many get ready; return when the first is. In place.

        Raises
        ------
        Exception
            Whatever hinders it.
        """
        with self._changed:
            self._count += 1
        self._put(self._new())
        for _ in range(count - 1):
            self._replace()

    def do(self, function: Callable[..., Any], args: tuple[Any, ...],
           should_stop: Callable[[], bool], listeners: Listeners = MappingProxyType({})) -> Any:
        """Have work done, and return its result.

        Parameters
        ----------
        function
            Of a module; gets what all work is done with, `args`, and what tells whether to stop.
        should_stop
            Tells whether it is to end with what there is.

        Raises
        ------
        EndedUnexpectedlyError
            If the one died that did it, or none is free.
        Exception
            Whatever the function raised.
        """
        call = self.begin(function, args, should_stop, "request", listeners)
        try:
            until: float | None = None
            while not call.wait(LOOK, should_stop):
                if until is None and should_stop():
                    until = time.monotonic() + STOP_SECONDS
                    call.stop()
                if until is not None and time.monotonic() > until:
                    logger.error("a process that plans did not stop: it is ended")
                    break
        finally:
            call.drop()
        return call.result()

    def begin(self, function: Callable[..., Any], args: tuple[Any, ...],
              should_stop: Callable[[], bool], what: str,
              listeners: Listeners = MappingProxyType({})) -> Call:
        """Have work begin, once one is free; arguments and errors are those of `do`. In place.

        Parameters
        ----------
        what
            It is, for those who count deaths.
        """
        child = self._free(should_stop)
        call = Call(child, self._answers, listeners,
                    lambda child, is_alive: self._give_back(child, is_alive, what))
        try:
            call.begin(function, args)
        except BaseException:  # arguments that can't be sent
            call.drop()
            raise
        return call

    def close(self) -> None:
        """End all of them. In place."""
        atexit.unregister(self.close)
        with self._changed:
            self._is_open = False
            left = [*self._idle, *self._busy]
            self._idle.clear()
        for child in left:
            child.end()

    def _free(self, should_stop: Callable[[], bool]) -> Child:
        """Return one that is free, a new one if there may be more. In place."""
        until = time.monotonic() + LONGEST_WAIT
        while True:
            with self._changed:
                while self._idle:
                    child = self._idle.pop()
                    if child.is_alive:
                        self._busy.add(child)
                        return child
                    self._count -= 1
                    self._bury(child, "nothing")
                if self._count < self._most:
                    self._count += 1
                    break
                self._changed.wait(LOOK)
            if should_stop() or time.monotonic() > until or not self._is_open:
                raise EndedUnexpectedlyError("No process that plans is free: try again soon.")
        child = self._new()
        with self._changed:
            self._busy.add(child)
        return child

    def _new(self) -> Child:
        """Return one that takes work, and is counted already. In place."""
        child = None
        try:
            child = self._start()
            child.get_ready()
        except BaseException as error:
            with self._changed:
                self._count -= 1
            if child is not None:
                child.end()
            if isinstance(error, EOFError | OSError):
                raise EndedUnexpectedlyError("No process that plans can be started: try again "
                                             "soon.") from error
            raise
        return child

    def _put(self, child: Child) -> None:
        with self._changed:
            self._busy.discard(child)
            if self._is_open:
                self._idle.append(child)
                self._changed.notify()
                return
        child.end()

    def _give_back(self, child: Child, is_alive: bool, what: str) -> None:
        if is_alive:
            self._put(child)
            return
        with self._changed:
            self._busy.discard(child)
            self._count -= 1
        self._bury(child, what)
        self._replace()

    def _replace(self) -> None:
        """Have another get ready meanwhile. In place."""
        threading.Thread(target=self._add, name="planner-starter", daemon=True).start()

    def _add(self) -> None:
        with self._changed:
            if not self._is_open or self._count >= self._most:
                return
            self._count += 1
        try:
            self._put(self._new())
        except Exception:  # whoever needs one tries again, and hears of it
            logger.exception("a process that plans could not be started")

    def _bury(self, child: Child, what: str) -> None:
        """Let go of one that is gone, and tell of it. In place."""
        code = child.end()
        if not self._is_open or not code:
            return
        logger.error("a process that plans ended with code %d; it was doing: %s", code, what)
        self._on_death(what)
