"""Memory that large requests used stays with the process while it is busy.

It is looked through seldom, and given back to the system once nobody asks for anything.
"""

import ctypes
import gc
import platform
import resource
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

M_TRIM_THRESHOLD, M_MMAP_MAX, M_ARENA_MAX = -1, -4, -8
"""Parameters of glibc's `mallopt`, by `malloc.h`."""


IDLE, LOOK = 10.0, 2.0
"""Seconds without work after which memory is given back, and between two looks."""

KEPT = 64 * 2**20
"""Bytes that stay with an idle process beside what is in use."""

COLLECTING = 100_000, 20, 20
"""Objects until the youngest are looked through for circles, and how often until older ones are."""


def collect_seldom() -> None:
    """Have Python look for circles of objects seldom. In place.

    Requests and replies are objects by the million, without circles: to look through them again and
    again while they are made took two thirds of the time that reading 100,000 customers takes.
    """
    gc.set_threshold(*COLLECTING)


@contextmanager
def loading() -> Iterator[None]:
    """Have Python look for no circles while modules are imported, nor among their objects later.

    To look took a third of the time that a command takes to start, and nothing was found.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


def keep_memory() -> bool:
    """Have the process keep the memory that it frees; tell whether it can.

    What is given back to the system is fetched again by the next request, page by page: 0.2 s a GB,
    and over a second on virtual machines that pass free pages on to their host. To be called before
    there are threads, which then share one arena: large blocks of others can't be kept.
    """
    if platform.libc_ver()[0] != "glibc":
        return False
    mallopt = ctypes.CDLL(None).mallopt
    return all(mallopt(parameter, value) for parameter, value in (
        (M_ARENA_MAX, 1), (M_MMAP_MAX, 0), (M_TRIM_THRESHOLD, -1)))


def give_back() -> None:
    """Give memory that is free back to the system, all but some. In place."""
    gc.collect()
    if platform.libc_ver()[0] == "glibc":
        ctypes.CDLL(None).malloc_trim(KEPT)


@contextmanager
def giving_back(is_busy: Callable[[], bool]) -> Iterator[None]:
    """Give memory back whenever the process was idle for a while after it grew, until the end."""
    done = threading.Event()
    thread = threading.Thread(target=_watch, args=(is_busy, done), name="memory", daemon=True)
    thread.start()
    try:
        yield
    finally:
        done.set()
        thread.join()


def _watch(is_busy: Callable[[], bool], done: threading.Event) -> None:
    idle, least = 0.0, resident()
    while not done.wait(LOOK):
        idle = 0.0 if is_busy() else idle + LOOK
        least = min(least, resident())
        if idle >= IDLE and resident() > least + KEPT:
            give_back()
            least = resident()


def resident() -> int:
    """Return the bytes of memory that this process has; 0 where the system doesn't say."""
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[1])
    except OSError:
        return 0
    return pages * resource.getpagesize()
