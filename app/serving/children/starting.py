"""How those begin that plan: as processes of their own, or as threads where a planner is given."""

import logging.config
import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from multiprocessing import forkserver
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from app.serving.children.child import Child
from app.serving.children.line import Line
from app.serving.load.memory import collect_seldom, giving_back, keep_memory

OpenPlace = Callable[[Line], Any]
"""Makes what all work is done with. Processes get it pickled."""

KILLED_FIRST = 500
"""By how much sooner than others Linux ends a process that plans where memory lacks: of 1,000."""


PRELOADED = ("app.plans.answers", "app.plans.flights.answering", "app.formats.vroom.answering",
             "app.records.jobs.order")
"""All that those need that plan."""


def have_server(preloaded: Sequence[str] = PRELOADED) -> None:
    """Have a server begin to import what those need that plan, while this process goes on.

    They are forked from it, which is why they are there in milliseconds and have most of their
    memory in common. It has no threads and knows nothing of this process, whose threads could not
    be forked.
    """
    multiprocessing.get_context("forkserver").set_forkserver_preload([*preloaded])
    forkserver.ensure_running()


def processes(open_place: OpenPlace, logs: dict[str, Any],
              preloaded: Sequence[str] = PRELOADED) -> Callable[[], Child]:
    """Return what starts a process that plans.

    Parameters
    ----------
    logs
        Configuration of loggers.
    preloaded
        Modules that all of them need.
    """
    have_server(preloaded)
    context = multiprocessing.get_context("forkserver")

    def start() -> Child:
        ours, theirs = context.Pipe()
        process = context.Process(target=_run, args=(theirs, open_place, logs),
                                  name="tandem-planner")
        process.start()
        theirs.close()
        return Child(ours, process)

    return start


def threads(open_place: OpenPlace) -> Callable[[], Child]:
    """Return what starts a thread that plans, in this process."""
    def start() -> Child:
        ours, theirs = multiprocessing.Pipe()
        threading.Thread(target=_work, args=(theirs, open_place, lambda: None), daemon=True,
                         name="planner").start()
        return Child(ours)

    return start


def _run(connection: Connection, open_place: OpenPlace, logs: dict[str, Any]) -> None:
    """Plan in this process until nobody is at the other end."""
    # Whoever ends the service ends it by this one's parent, which lets plans come to an end.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)
    if sys.platform == "linux":
        with suppress(OSError):
            Path("/proc/self/oom_score_adj").write_text(str(KILLED_FIRST), "ascii")
    keep_memory()
    collect_seldom()
    logging.config.dictConfig(logs)
    _work(connection, open_place, lambda: os._exit(0))


def _work(connection: Connection, open_place: OpenPlace, hang_up: Callable[[], None]) -> None:
    line = Line(connection)
    try:
        place = open_place(line)
    except Exception as error:  # for whoever waits until this one takes work
        line.refuse(error)
        return
    with giving_back(lambda: line.is_busy):
        line.serve(place, hang_up)
