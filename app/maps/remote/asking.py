"""Asking servers: several questions at a time, again after faults, never for too long."""

import asyncio
import logging
import math
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from typing import TYPE_CHECKING, Generic, TypeVar

from circuitbreaker import CircuitBreaker
from tenacity import (
    AsyncRetrying, RetryCallState, retry_if_exception_type, stop_after_attempt, stop_any,
    stop_before_delay, wait_random_exponential,
)

from app.maps.remote.errors import SourceError, SourceKind, SourceUnavailableError
from app.maps.remote.servers import Server

if TYPE_CHECKING:
    import httpx

logger = logging.getLogger(__name__)

Answer = TypeVar("Answer")
Refusal = Callable[[int, bytes], SourceError]
"""Says what a status from 400 on and its body mean."""

ShouldStop = Callable[[], bool]
"""Tells that nobody waits for the answer any more."""

POLL = 0.05
"""Seconds between looks at whether the caller wants to stop."""

ATTEMPTS = 4
"""How often a question is asked at most."""

LONGEST_WAIT = 5.0
"""Most seconds between attempts, if the server doesn't ask for more."""

PATIENT = 1.0
"""Seconds after which silence says something of the server; callers may have less time."""

STATE_SECONDS, STATE_PATIENCE = 60.0, 2.0
"""How long a server's map is taken for the same, and how long we wait to be told."""

MAX_REFUSAL_BYTES = 65_536
"""Longest answer to be read where it isn't the one asked for."""

BUSY = frozenset({408, 425, 429, 500, 502, 503, 504})
"""Statuses after which the same question may be answered."""

DENIED = frozenset({401, 402, 403, 405, 407})
"""Statuses that tell of a wrong setting."""


class _TransientError(Exception):
    """What asking again may mend, and the seconds for which the server asks to be left alone."""

    def __init__(self, cause: str, pause: float = 0.0) -> None:
        super().__init__(cause)
        self.pause = pause


@dataclass(frozen=True)
class RemoteCall(Generic[Answer]):
    """One request of a server, and how to read what it answers.

    Parameters
    ----------
    path
        With its query.
    read
        Makes an answer of a body, or raises the source's error.
    max_bytes
        Longest body that is no nonsense.
    body
        JSON to post; none: nothing is posted.
    refused
        Makes an answer of a refusal, or raises it.
    """

    path: str
    read: Callable[[bytes], Answer]
    max_bytes: int
    body: bytes | None = None
    refused: Callable[[SourceError], Answer] | None = None


class _Round:
    """Questions asked together, some at a time; once one has failed no other is sent."""

    def __init__(self, at_once: int, client: "httpx.AsyncClient") -> None:
        self.gate = asyncio.Semaphore(at_once)
        self.client = client  # by which all are sent, even if it is being closed meanwhile
        self.has_failed = False
        self.trouble = ""  # of the last attempt after which a question is asked again

    def note(self, state: RetryCallState) -> None:
        """Note why a question is asked again. In place."""
        self.trouble = str(state.outcome.exception()) if state.outcome else ""

    async def begin(self) -> None:
        """Wait for ever if one has failed: whoever asks ends all others when it is told so."""
        if self.has_failed:
            await asyncio.get_running_loop().create_future()


class RemoteServer:
    """Asks one server. Connections are kept; threads may share it.

    Parameters
    ----------
    kind
        What the server is called, and the errors to fail with.
    refusal
        Says what a refusal means.
    turn
        Takes a turn to ask, and tells in how many seconds it comes. None: turns come at once.
    """

    def __init__(self, server: Server, kind: SourceKind, refusal: Refusal,
                 turn: Callable[[], float] | None = None) -> None:
        self._server = server
        self._kind = kind
        self._refusal = refusal
        self._turn = turn
        self._backoff = wait_random_exponential(server.first_wait, LONGEST_WAIT)
        self._breaker = CircuitBreaker(server.failures, server.rest, _counts)
        self._lock = threading.Lock()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._client: httpx.AsyncClient | None = None
        self._state = -math.inf, ""

    def ask(self, questions: Sequence[RemoteCall[Answer]], until: float,
            should_stop: ShouldStop = lambda: False,
            told: Callable[[int, Answer], None] = lambda place, answer: None) -> list[Answer]:
        """Return the answers to all questions, in their order.

        Each answer is `told` as it comes, even if others don't.

        Raises
        ------
        SourceError
            If one isn't answered, or not in time.
        """
        if self._breaker.opened:
            raise self._kind.unavailable(f"The {self._kind.name} failed again and again: it is "
                                         "left alone for some seconds.")
        with self._breaker:
            return self._asked(questions, until, should_stop, told)

    def _asked(self, questions: Sequence[RemoteCall[Answer]], until: float,
               should_stop: ShouldStop, told: Callable[[int, Answer], None]) -> list[Answer]:
        began = time.perf_counter()
        together, pending = self._sent(questions, until)
        answers: dict[int, Answer] = {}
        try:
            while pending:
                if should_stop():
                    raise self._kind.stopped("The work was stopped before there was an answer.")
                left = until - time.perf_counter()
                if left <= 0:
                    raise self._late(until - began, together.trouble)
                done = wait(pending, min(left, POLL), FIRST_COMPLETED).done
                # What came with a failure is told before that ends all.
                for future in sorted(done, key=_has_failed):
                    place = pending.pop(future)
                    if future.cancelled():
                        raise self._kind.unavailable(
                            f"The {self._kind.name} isn't asked any more.")
                    answers[place] = _answer(questions[place], future.result())
                    told(place, answers[place])
        finally:
            for future in pending:
                future.cancel()
        return [answers[place] for place in range(len(questions))]

    def state(self, question: RemoteCall[str]) -> str:
        """Return what the server says of its map, for some time the same; empty if it doesn't."""
        asked, state = self._state
        if time.perf_counter() - asked > STATE_SECONDS:
            try:
                state = self.ask([question], time.perf_counter() + STATE_PATIENCE)[0]
            except SourceError:
                return ""
            self._state = time.perf_counter(), state
        return state

    def _sent(self, questions: Sequence[RemoteCall[Answer]],
              until: float) -> tuple[_Round, dict[Future[bytes | SourceError], int]]:
        """Have questions asked; return them by their places.

        The loop that sends has a thread of its own: no look-up of a name, however long it takes,
        keeps a caller beyond its time. Whoever closes comes before all of them or ends all.
        """
        import httpx  # not before it is needed, as `require_address` has it

        with self._lock:
            if self._loop is None or self._client is None:
                self._loop = asyncio.new_event_loop()
                self._client = httpx.AsyncClient(
                    base_url=self._server.url, headers=dict(self._server.sent), timeout=None,
                    trust_env=False, follow_redirects=False)
                threading.Thread(target=_run, args=(self._loop,), name="asking",
                                 daemon=True).start()
            together = _Round(self._server.at_once, self._client)
            return together, {
                asyncio.run_coroutine_threadsafe(self._outcome(question, together, until),
                                                 self._loop): place
                for place, question in enumerate(questions)}

    async def _outcome(self, question: RemoteCall[Answer], together: _Round,
                       until: float) -> bytes | SourceError:
        """Return a question's answer, or why there is none."""
        async with together.gate:
            await together.begin()
            outcome = await self._asked_again(question, together, until)
            together.has_failed |= isinstance(outcome, Exception) and question.refused is None
            return outcome

    async def _asked_again(self, question: RemoteCall[Answer], together: _Round,
                           until: float) -> bytes | SourceError:
        """Return a question's answer after some attempts, or why there is none."""
        left = max(until - time.perf_counter(), 0.0)
        attempts = AsyncRetrying(
            retry=retry_if_exception_type(_TransientError), reraise=True, wait=self._pause,
            before_sleep=together.note,
            stop=stop_any(stop_after_attempt(ATTEMPTS), stop_before_delay(left)))
        try:
            return await attempts(self._attempted, question, together.client)
        except _TransientError as error:
            logger.warning("A %s failed: %s", self._kind.name, error)
            return self._kind.unavailable(f"The {self._kind.name} failed: {error}.")
        except SourceError as error:
            logger.warning("A %s answered in vain: %s", self._kind.name, error)
            return error

    def _pause(self, state: RetryCallState) -> float:
        """Return the seconds until the next attempt: as the server says, and not at once."""
        failure = state.outcome.exception() if state.outcome else None
        stated = failure.pause if isinstance(failure, _TransientError) else 0.0
        return max(stated, self._backoff(state))

    async def _attempted(self, question: RemoteCall[Answer], client: "httpx.AsyncClient") -> bytes:
        import httpx

        if self._turn is not None:
            await asyncio.sleep(await asyncio.to_thread(self._turn))
        try:
            async with asyncio.timeout(self._server.patience):
                return await self._got(question, client)
        except TimeoutError as error:
            raise _TransientError(f"no answer in {self._server.patience:g} s") from error
        except httpx.RequestError as error:
            raise _TransientError(type(error).__name__) from error

    async def _got(self, question: RemoteCall[Answer], client: "httpx.AsyncClient") -> bytes:
        method = "GET" if question.body is None else "POST"
        headers = {} if question.body is None else {"Content-Type": "application/json"}
        async with client.stream(method, question.path, content=question.body,
                                 headers=headers) as response:
            status = response.status_code
            if status in BUSY:
                raise _TransientError(f"status {status}", _retry_after(response))
            body = bytearray()
            most = question.max_bytes if status == 200 else MAX_REFUSAL_BYTES
            async for part in response.aiter_bytes():
                body += part
                if len(body) > most:
                    raise self._kind.answer(
                        f"The {self._kind.name} answered more than can be right.")
        if status != 200:
            raise self._refused(status, bytes(body))
        return bytes(body)

    def _refused(self, status: int, body: bytes) -> SourceError:
        if 400 <= status < 500 and status not in DENIED:
            return self._refusal(status, body)
        return self._kind.unavailable(f"The {self._kind.name} answered with status {status}.")

    def _late(self, waited: float, trouble: str) -> SourceUnavailableError:
        if trouble:
            return self._kind.unavailable(f"The {self._kind.name} failed: {trouble}.")
        error = self._kind.unavailable(f"The {self._kind.name} didn't answer in time.")
        error.counts, error.is_late = waited >= PATIENT, True
        return error

    def close(self) -> None:
        """Close connections. They open again if anything else is asked."""
        with self._lock:
            loop, client, self._loop, self._client = self._loop, self._client, None, None
        if loop is not None and client is not None:
            asyncio.run_coroutine_threadsafe(_ended(client), loop).result()
            loop.call_soon_threadsafe(loop.stop)


def _has_failed(future: Future[bytes | SourceError]) -> bool:
    return future.cancelled() or isinstance(future.result(), SourceError)


def _answer(question: RemoteCall[Answer], outcome: bytes | SourceError) -> Answer:
    if isinstance(outcome, bytes):
        return question.read(outcome)
    if question.refused is not None:
        return question.refused(outcome)
    raise outcome


async def _ended(client: "httpx.AsyncClient") -> None:
    """End what is being asked, and close connections."""
    others = asyncio.all_tasks() - {asyncio.current_task()}
    for task in others:
        task.cancel()
    await asyncio.gather(*others, return_exceptions=True)
    await client.aclose()
    # Sockets are closed by what the loop does next.
    await asyncio.sleep(0)


def _run(loop: asyncio.AbstractEventLoop) -> None:
    try:
        loop.run_forever()
    finally:
        loop.close()


def _counts(kind: type[BaseException], error: BaseException) -> bool:
    """Tell whether an error says that the server is down."""
    return isinstance(error, SourceUnavailableError) and error.counts


def _retry_after(response: "httpx.Response") -> float:
    """Return the seconds of a `Retry-After`, 0 without one that can be read."""
    stated = response.headers.get("Retry-After", "").strip()
    if stated.isdigit():
        return float(stated)
    try:
        return (parsedate_to_datetime(stated) - datetime.now(UTC)).total_seconds()
    except (ValueError, TypeError):
        return 0.0
