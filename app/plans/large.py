"""Has the search for computed legs, and for legs that don't fit 32 bits, compiled beside, so that
few wait for it and nobody loads it who has no such problem."""

import logging
import os
import subprocess
import sys
import threading
from concurrent.futures import Future, ThreadPoolExecutor

from app.load import with_parent
from model.kernel.compiled import compiled_folder
from model.problem import Problem
from model.search.compiling import COMPILE_LARGE, COMPUTED, compile_large, is_compiled, parts_for

logger = logging.getLogger(__name__)


class LargeSearch:
    """The search for problems whose legs are computed or long. Safe to use from several threads."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._executor = ThreadPoolExecutor(1, thread_name_prefix="large")
        self._compiling: Future[None] | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._is_loaded = False  # where nothing is kept
        self._has_stopped = False

    def serves(self, problem: Problem) -> bool:
        """Tell whether the search for a problem is compiled; have that done if not. In place."""
        if self._is_loaded or _all_compiled():
            return True
        (part,) = parts_for(problem)
        if part not in COMPUTED or is_compiled(part):
            return True
        self.compile()
        return False

    def compile(self) -> None:
        """Have all compiled, unless that is done or going on. In place."""
        with self._lock:
            is_going_on = self._compiling is not None and not self._compiling.done()
            if not (is_going_on or self._has_stopped or _all_compiled()):
                self._compiling = self._executor.submit(self._compile)

    def stop(self) -> None:
        """Compile no more. In place."""
        with self._lock:
            self._has_stopped = True
            if self._process is not None:
                self._process.kill()
        self._executor.shutdown(wait=False, cancel_futures=True)

    def _compile(self) -> None:
        """Compile all, in a process beside if what that comes to can be kept. In place."""
        if compiled_folder() is None:
            compile_large()
            self._is_loaded = True
            return
        command = [sys.executable, "-I", "-S", with_parent.__file__, str(os.getpid()),
                   sys.executable, "-c", COMPILE_LARGE]
        with self._lock:
            if self._has_stopped:
                return
            self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL,
                                             stdout=subprocess.DEVNULL)
        logger.info("compiling the search for more than a few thousand customers, beside")
        code = self._process.wait()
        logger.info("compiled the search for more than a few thousand customers"
                    if code == 0 else "compiling the search for many customers ended with %d", code)


def _all_compiled() -> bool:
    return all(is_compiled(part) for part in COMPUTED)
