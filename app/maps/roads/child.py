"""`osrm-routed` as a child of this process: started, watched and started again."""

import logging
import os
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

from app.maps.roads.engine import RoadsUnavailableError
from app.serving.load import with_parent

logger = logging.getLogger(__name__)

HOST = "127.0.0.1"

FIRST_WAIT, LONGEST_WAIT = 0.1, 30.0
"""Seconds before a child that ended is started again: doubled each time that it ends soon."""

LONG_LIFE = 60.0
"""Seconds that a child has to live for its end not to count as one of a row."""

START_SECONDS = 120.0
"""Most that a child may take until it answers; a large map is read from a disk."""

POLLING, LOOK = 0.005, 0.05

ENDING = 0.3
"""Seconds from a connection that broke until its watcher knows that a child ended."""

STOP_SECONDS = 5.0

MAX_TABLE, MAX_ROUTE = 100_000, 10_000
"""Places of a question to the child: we ask, so OSRM's own limits are in nobody's interest."""


class RoutingChild:
    """Answers from one build, until it is stopped.

    Parameters
    ----------
    routed
        `osrm-routed`.
    data
        What the files of the build begin with.
    threads
        Questions that it answers at once.
    """

    def __init__(self, routed: Path, data: Path, threads: int,
                 first_wait: float = FIRST_WAIT) -> None:
        self._routed = routed
        self._data = data
        self._threads = threads
        self._first_wait = first_wait
        self._lock = threading.Lock()
        self._watcher: threading.Thread | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._stopping = threading.Event()
        self._answering = threading.Event()
        self._url = ""
        self._starts = 0
        self._problem = "it hasn't started"

    @property
    def starts(self) -> int:
        """How many times it was started."""
        return self._starts

    @property
    def pid(self) -> int | None:
        """The process, if there is one."""
        return None if self._process is None else self._process.pid

    def start(self) -> None:
        """Start it in the background, unless it is. In place."""
        with self._lock:
            if self._watcher is None and not self._stopping.is_set():
                # It ends with the thread that started it, so that has to live as long as we do.
                self._watcher = threading.Thread(target=self._watch, name="roads-child",
                                                 daemon=True)
                self._watcher.start()

    def stop(self) -> None:
        """End it. In place."""
        with self._lock:
            self._stopping.set()
            process, watcher = self._process, self._watcher
        if process is not None:
            process.kill()
        if watcher is not None:
            watcher.join(STOP_SECONDS)

    def url(self, until: float, should_stop: Callable[[], bool] = lambda: False) -> str:
        """Return where it answers, having started it if need be.

        Raises
        ------
        RoadsUnavailableError
            If it doesn't answer by then, on `time.perf_counter`.
        """
        self.start()
        while not (self._answering.wait(LOOK) and self._lives):
            if time.perf_counter() >= until or should_stop() or self._stopping.is_set():
                raise RoadsUnavailableError(f"The roads aren't ready: {self._problem}.")
            self._stopping.wait(POLLING)
        return self._url

    def has_ended_since(self, starts: int) -> bool:
        """Tell whether it ended after it was started so many times; it may be about to."""
        until = time.monotonic() + ENDING
        while self._starts == starts and self._lives and time.monotonic() < until:
            self._stopping.wait(POLLING)
        return self._starts != starts or not self._lives

    @property
    def _lives(self) -> bool:
        """Tell whether it hasn't ended, as far as its watcher knows."""
        return self._process is not None and self._process.returncode is None

    def _watch(self) -> None:
        wait = self._first_wait
        while not self._stopping.is_set():
            began = time.monotonic()
            self._live()
            self._answering.clear()
            if self._stopping.is_set():
                return
            wait = self._first_wait if time.monotonic() - began > LONG_LIFE else wait
            logger.warning("osrm-routed ended: %s; started again in %.1f s", self._problem, wait)
            self._stopping.wait(wait)
            wait = min(2 * wait, LONGEST_WAIT)

    def _live(self) -> None:
        """Start it and wait for its end. In place."""
        port = _free_port()
        try:
            process = self._begin(port)
        except OSError as error:
            self._problem = str(error)
            return
        if process is None:
            return
        if self._comes_to_answer(process, port):
            self._url = f"http://{HOST}:{port}"
            self._answering.set()
        code = process.wait()
        self._problem = f"it ended with {code}"

    def _begin(self, port: int) -> "subprocess.Popen[bytes] | None":
        command = [sys.executable, "-I", "-S", with_parent.__file__, str(os.getpid()),
                   str(self._routed), str(self._data), "--ip", HOST, "--port", str(port),
                   "--threads", str(self._threads), "--mmap", "--verbosity", "ERROR",
                   "--max-table-size", str(MAX_TABLE), "--max-viaroute-size", str(MAX_ROUTE)]
        with self._lock:
            if self._stopping.is_set():
                return None
            self._starts += 1
            self._problem = "it is starting"
            self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL,
                                             stdout=subprocess.DEVNULL)
            return self._process

    def _comes_to_answer(self, process: "subprocess.Popen[bytes]", port: int) -> bool:
        until = time.monotonic() + START_SECONDS
        while process.poll() is None and not self._stopping.is_set():
            try:
                socket.create_connection((HOST, port), timeout=1.0).close()
                return True
            except OSError:
                if time.monotonic() > until:
                    process.kill()
                time.sleep(POLLING)
        return False


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind((HOST, 0))
        port: int = probe.getsockname()[1]
        return port
