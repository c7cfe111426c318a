"""The line between a process that plans and the one that it plans for, as the former sees it.

Messages are tuples that begin with what they are. A piece of work is a function of a module and
its arguments; while it is done, its result's parts may be told, and questions asked that only the
other process can answer, such as those about roads.
"""

import logging
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from queue import SimpleQueue
from typing import Any, Final

from asgi_correlation_id import correlation_id

from app.serving.children.errors import EndedUnexpectedlyError, told

logger = logging.getLogger(__name__)

WORK: Final = "work"
"""To the one that plans: a function, its arguments, and the id of the request behind it."""

STOP: Final = "stop"
"""To it: the work is to end, with what there is by then."""

ANSWERED, REFUSED = "answered", "refused"
"""To it: the answer to its question, or the error. From it: the result of its work, or the error.
"""

TOLD: Final = "told"
"""From it: a name and a value."""

ASKED: Final = "asked"
"""From it: a name and arguments."""

READY: Final = "ready"
"""From it: it takes work."""


class Line:
    """What a process that plans hears and says.

    Parameters
    ----------
    connection
        To the process that it plans for.
    """

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._sending = threading.Lock()
        self._asking = threading.Lock()
        self._work: SimpleQueue[tuple[Any, ...] | None] = SimpleQueue()
        self._answers: SimpleQueue[tuple[Any, ...]] = SimpleQueue()
        self._stop = threading.Event()
        self.is_busy = False

    def tell(self, name: str, value: object) -> None:
        """Tell something of the work; without any, nobody listens. In place."""
        if self.is_busy:
            self._send(TOLD, name, value)

    def ask(self, name: str, *args: Any) -> Any:
        """Return the answer to a question, which may be asked by any thread.

        Raises
        ------
        Exception
            Whatever the other process found instead.
        """
        with self._asking:
            self._send(ASKED, name, args)
            kind, found = self._answers.get()
        if kind == REFUSED:
            raise found.again()
        return found

    def serve(self, place: object, hang_up: Callable[[], None]) -> None:
        """Do work until nobody is at the other end, then `hang_up`. In place.

        Parameters
        ----------
        place
            What all work is done with, its first argument.
        """
        threading.Thread(target=self._listen, args=(hang_up,), name="line", daemon=True).start()
        self._send(READY)
        while (work := self._work.get()) is not None:
            function, args, request_id, stop = work
            correlation_id.set(request_id)
            self.is_busy = True
            try:
                reply = (ANSWERED, function(place, *args, stop.is_set))
            except Exception as error:  # for whoever waits: it ends this work, not the process
                reply = (REFUSED, told(error))
            self.is_busy = False
            self._send(*reply)

    def refuse(self, error: Exception) -> None:
        """Tell why no work can be taken. In place."""
        self._send(REFUSED, told(error))

    def _listen(self, hang_up: Callable[[], None]) -> None:
        try:
            while True:
                kind, *rest = self._connection.recv()
                if kind == WORK:
                    self._stop = threading.Event()
                    self._work.put((*rest, self._stop))
                elif kind == STOP:
                    self._stop.set()
                else:
                    self._answers.put((kind, *rest))
        except (EOFError, OSError):
            pass
        except Exception:  # of whatever can't be unpickled here: whoever waits would do so for ever
            logger.exception("Ended by a message that can't be read.")
        hang_up()
        # Only a thread is still here: what it does is of no use to anybody any more.
        self._stop.set()
        self._answers.put((REFUSED, told(EndedUnexpectedlyError())))
        self._work.put(None)

    def _send(self, *message: Any) -> None:
        with self._sending:
            try:
                self._connection.send(message)
            except OSError:
                self._work.put(None)
