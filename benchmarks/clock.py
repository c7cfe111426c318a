"""The clock that budgets are measured by."""

import time

from model.engine.alarm import Alarm


def count_processor_time() -> None:
    """Let all budgets of this process be of its processor time.

    On one thread, that is the only clock that what else a machine does leaves alone.
    """
    time.perf_counter = time.process_time
    Alarm.clock = time.CLOCK_PROCESS_CPUTIME_ID
