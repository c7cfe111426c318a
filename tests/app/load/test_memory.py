"""Tests of `app.load.memory`."""

import platform
import subprocess
import sys

import pytest

PROGRAM = """
import resource, threading
import numpy as np
from app.load.memory import keep_memory

def faults():
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    np.ones(12_500_000)
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before

def run():
    faults()
    print(faults())

if {keeps}:
    assert keep_memory()
thread = threading.Thread(target=run)
thread.start()
thread.join()
"""


def _faults(keeps: bool) -> int:
    """Return how many pages a thread's second array of 100 MB fetches from the system."""
    run = subprocess.run([sys.executable, "-c", PROGRAM.format(keeps=keeps)],
                         capture_output=True, text=True, check=True)
    return int(run.stdout)


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="other C libraries can't be told")
def test_memory_is_fetched_from_the_system_once() -> None:
    assert _faults(keeps=True) <= 5 < 40 <= _faults(keeps=False)
