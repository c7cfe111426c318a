"""Starts and stops what plans days."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from app.database.connections import close_for_good
from app.database.durable import connect
from app.plans import answers
from app.plans.desk import PlanDesk
from app.records.days.runner import DayRunner
from app.records.jobs.desk import JobDesk
from app.serving.load.received import ReceivedBody
from app.serving.settings import Settings


@contextmanager
def running_days(settings: Settings, planning: PlanDesk,
                 jobs: JobDesk) -> Iterator[DayRunner | None]:
    """Yield who plans days until the block ends; None: those that answer do."""
    if settings.role == "worker":
        yield None
        return

    def plan(body: bytes, should_stop: Callable[[], bool]) -> bytes:
        received = ReceivedBody(body, time.perf_counter())
        return bytes(planning.do(answers.plan, received, should_stop=should_stop))

    def quote(body: bytes) -> bytes:
        received = ReceivedBody(body, time.perf_counter())
        return bytes(planning.do(answers.quote, received, should_stop=lambda: False))

    engine = connect(settings.database)
    runner = DayRunner(engine, plan, settings, planning.roads, lambda: jobs.database.is_prepared,
                       quote, jobs.queues.add_webhook)
    runner.start()
    try:
        yield runner
    finally:
        runner.stop()
        close_for_good(engine)
