"""Memory that large requests used stays with the process, and is looked through seldom."""

import ctypes
import gc
import platform

M_TRIM_THRESHOLD, M_MMAP_MAX, M_ARENA_MAX = -1, -4, -8
"""Parameters of glibc's `mallopt`, by `malloc.h`."""


COLLECTING = 100_000, 20, 20
"""Objects until the youngest are looked through for circles, and how often until older ones are."""


def collect_seldom() -> None:
    """Have Python look for circles of objects seldom. In place.

    Requests and replies are objects by the million, without circles: to look through them again and
    again while they are made took two thirds of the time that reading 100,000 customers takes.
    """
    gc.set_threshold(*COLLECTING)


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
