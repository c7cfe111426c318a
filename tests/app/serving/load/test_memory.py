"""Tests of `app.serving.load.memory`."""

import platform
import subprocess
import sys

import pytest


pytestmark = pytest.mark.slow

PROGRAM = """
import resource, threading
import numpy as np
from app.serving.load.memory import keep_memory

def faults():
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    np.ones(12_500_000)
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before

def run():
    faults()
    print(min(faults() for _ in range(3)))

if {keeps}:
    assert keep_memory()
thread = threading.Thread(target=run)
thread.start()
thread.join()
"""


def _faults(keeps: bool) -> int:
    """Return how many pages a thread's later arrays of 100 MB fetch from the system, each."""
    run = subprocess.run([sys.executable, "-c", PROGRAM.format(keeps=keeps)],
                         capture_output=True, text=True, check=True)
    return int(run.stdout)


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="other C libraries can't be told")
def test_memory_is_fetched_from_the_system_once() -> None:
    assert _faults(keeps=True) <= 5 < 40 <= _faults(keeps=False)


IDLE = """
import threading, time
from app.serving.load import memory

memory.IDLE, memory.LOOK = 0.1, 0.01
assert memory.keep_memory()
busy = threading.Event()
busy.set()
before = memory.resident()
with memory.giving_back(busy.is_set):
    held = [bytearray(100_000) for _ in range(4000)]
    small = [str(number) * 20 for number in range(500_000)]
    del held, small
    time.sleep(0.5)
    kept = memory.resident() - before
    busy.clear()
    until = time.monotonic() + 180
    while memory.resident() - before > 1.5 * memory.KEPT and time.monotonic() < until:
        time.sleep(0.01)
    print(kept, memory.resident() - before, memory.KEPT)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="other C libraries can't be told")
def test_an_idle_process_gives_memory_back_and_a_busy_one_keeps_it() -> None:
    run = subprocess.run([sys.executable, "-c", IDLE], capture_output=True, text=True, check=True)
    while_busy, once_idle, kept = map(int, run.stdout.split())
    assert while_busy > 300 * 2**20
    assert once_idle <= 1.5 * kept
