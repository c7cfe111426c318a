"""Prepares an application for more load than it can bear."""

import multiprocessing

from anyio import CapacityLimiter
from fastapi import FastAPI

from app.serving.load.abandoned import WaitingTurns
from app.serving.load.admission import Admission
from app.serving.load.bodies import Bodies
from app.serving.load.readings import new_readings
from app.serving.load.shutdown import Shutdown, ShutdownGate
from app.serving.settings import Settings


def is_asked(app: FastAPI) -> bool:
    """Tell whether an application has requests that take much memory."""
    state = app.state
    return (state.turns.are_waited_for or state.bodies.buffered > 0
            or state.readings.admission.running > 0)


def prepare_for_load(app: FastAPI, settings: Settings) -> Shutdown:
    """Give an application its queue, its reader of bodies and its gate; return how it ends.

    In place: they are `turns`, `readings` and `bodies` of its state.
    """
    state = app.state
    state.shutdown = Shutdown()
    state.bodies = Bodies(settings.max_body_bytes, settings.max_body_seconds,
                          settings.max_buffered_bytes)
    admission = Admission(settings.max_concurrent_plans, settings.max_queued_plans,
                          settings.max_queue_seconds)
    # Threads of their own, so that no other endpoint's use of threads delays a plan.
    state.turns = WaitingTurns(admission, CapacityLimiter(settings.max_concurrent_plans),
                               state.shutdown, state.metrics,
                               shares_port=multiprocessing.parent_process() is not None)
    state.readings = new_readings()
    app.add_middleware(ShutdownGate, shutdown=state.shutdown)
    return state.shutdown
