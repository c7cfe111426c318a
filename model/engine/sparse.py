"""Large arrays of which little is written, in as little memory."""

import math
import mmap
import sys
from contextlib import suppress

import numpy as np
from numpy.typing import DTypeLike

from model.engine.records import Records

HUGE = 2**22
"""Bytes from which on numpy asks for huge pages, of which the first number written to takes two
megabytes."""

NO_RESERVE = getattr(mmap, "MAP_NORESERVE", 0x4000) if sys.platform == "linux" else 0
"""Says that rows may be longer than the memory there is, since hardly any are written; Python has a
name for it from 3.13 on."""


def sparse_rows(shape: tuple[int, ...], kind: DTypeLike) -> Records:
    """Return zeros, of which each small page takes memory once something is written there."""
    size = math.prod(shape) * np.dtype(kind).itemsize
    if size < HUGE:
        return np.zeros(shape, kind)
    memory = mmap.mmap(-1, size, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS | NO_RESERVE)
    with suppress(OSError):  # from kernels that know of no huge pages
        memory.madvise(mmap.MADV_NOHUGEPAGE)
    return np.frombuffer(memory, kind).reshape(shape)
