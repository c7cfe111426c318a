"""The web application: loads the planner, maps errors to replies."""

import json
import logging
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from functools import cache, partial
from http import HTTPStatus
from importlib.metadata import version

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi_offline import FastAPIOffline
from starlette.exceptions import HTTPException
from starlette.middleware.gzip import GZipMiddleware
from starlette.requests import ClientDisconnect
from starlette.routing import Route

from app.console.guide import mount_guide
from app.console.routes import mount_console
from app.formats.sheets.lookups import new_lookups
from app.formats.sheets.lookups import router as addresses_router
from app.formats.sheets.routes import router as sheets_router
from app.formats.vroom.routes import router as vroom_router
from app.maps.roads.asked import KnownRoads, answers_of
from app.maps.roads.opening import extracts_of, opened_roads
from app.maps.roads.roads import Roads
from app.maps.streets.gallery import Gallery
from app.maps.streets.routes import router as streets_router
from app.plans.desk import CHECKED_AT_ONCE, PlanDesk
from app.plans.flights.routes import router as flights_router
from app.plans.pictures.routes import router as pictures_router
from app.plans.routes import router as plans_router
from app.plans.workplace import opened, opened_with
from app.records.days.routes import router as days_router
from app.records.days.runner import AT_ONCE
from app.records.days.pages import mount_customers_page
from app.records.days.running import running_days
from app.records.days.webhooks import message_of
from app.records.dispatches.pages import mount_drivers_page
from app.records.dispatches.routes import router as dispatches_router
from app.records.dispatches.store import delete_expired
from app.records.jobs.gate import WorkerGate
from app.records.jobs.routes import router as jobs_router
from app.records.jobs.setup import running_jobs
from app.records.kept.desk import keeping_plans
from app.records.kept.routes import router as kept_router
from app.requests.bounds import Bounds
from app.schemas.errors import InvalidRequestError, RequestError, problem_response, schema_error
from app.schemas.openapi import TAGS, allowed_methods, describe, operation_id
from app.serving.access.gate import KeyScrubber
from app.serving.access.setup import control_access, guarding
from app.serving.children.pool import Pool
from app.serving.children.starting import processes, threads
from app.serving.health import router as health_router
from app.serving.load.memory import giving_back
from app.serving.load.setup import is_asked, prepare_for_load
from app.serving.observe.logs import log_config
from app.serving.observe.observer import Observer
from app.serving.observe.routes import metrics_router
from app.serving.settings import Settings
from app.serving.texts import LEAST_COMPRESSED, Text
from model.planner import PlanCheckError, Planner

logger = logging.getLogger(__name__)

PACKAGE = "tandem-planner"
"""Whose version is the service's."""

RETRY_SECONDS = 5

READY_AT_START = 8
"""How many get ready at the start at most; where there are many cores, others do when needed."""

QUICK = 4
"""The level at which plans are compressed: a tenth larger than at 9, in a quarter of the time."""

BESIDE = CHECKED_AT_ONCE + 1 + AT_ONCE
"""How many may plan beside what settings count: jobs' requests are checked, suspects begin alone,
and days are planned."""


def create_app(settings: Settings | None = None, planner: Planner | None = None) -> FastAPI:
    """Return the application.

    Parameters
    ----------
    settings
        How to run; None reads them from the environment.
    planner
        Used in place of the one that the settings name, by threads of this process.
    """
    settings = settings or Settings()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        with _running(app, settings, planner, observer), shutdown.listening(settings.drain_seconds):
            yield
        observer.stop()

    observer = Observer(settings, version(PACKAGE))
    app = FastAPIOffline(title="Tandem", version=version(PACKAGE), lifespan=lifespan,
                         telemetry=observer.telemetry, openapi_tags=TAGS,
                         generate_unique_id_function=operation_id,
                         description="Plans deliveries for trucks that carry drones. "
                         "The [guide](guide/) tells of rules, clients and errors.")
    app.state.settings = settings
    drawn = [] if settings.role == "worker" else extracts_of(settings)
    app.state.gallery = Gallery(drawn, settings.data_dir / "streets")
    app.state.lookups = new_lookups()
    observer.enter(app)
    shutdown = prepare_for_load(app, settings)
    for router in (plans_router, flights_router, pictures_router, health_router, jobs_router,
                   dispatches_router, days_router, kept_router, vroom_router, sheets_router,
                   addresses_router, streets_router, metrics_router(settings)):
        app.include_router(router)
    _map_errors(app)
    mount_drivers_page(app)
    mount_customers_page(app)
    mount_console(app)
    mount_guide(app)
    app.openapi = describe(app)  # type: ignore[method-assign]
    _mount_description(app)
    app.add_middleware(GZipMiddleware, minimum_size=LEAST_COMPRESSED, compresslevel=QUICK)
    control_access(app, settings)
    if settings.role == "worker":
        app.add_middleware(WorkerGate)
    observer.surround(app)
    app.add_middleware(KeyScrubber)
    return app


def _mount_description(app: FastAPI) -> None:
    """Serve the API's description, half a megabyte, to who doesn't have it yet. In place."""

    @cache
    def text() -> Text:
        return Text(json.dumps(app.openapi(), separators=(",", ":")).encode(), "application/json")

    def reply(request: Request) -> Response:
        return text().reply(request.headers, {"Cache-Control": "no-cache"})

    app.router.routes.insert(0, Route(str(app.openapi_url), reply, include_in_schema=False))


@contextmanager
def _running(app: FastAPI, settings: Settings, planner: Planner | None,
             observer: Observer) -> Iterator[None]:
    """Have all run that answers requests: its state has what they turn to."""
    with opened_roads(settings) as roads, guarding(settings) as app.state.guard:
        roads.start()
        app.state.addresses = roads.addresses
        with _planning(settings, planner, roads, observer) as app.state.plans:
            jobs = running_jobs(settings, app.state.plans, observer.metrics, observer.record_plan,
                                [delete_expired], partial(message_of, base=settings.public_url))
            app.state.gallery.start()
            with (keeping_plans(settings) as app.state.kept, jobs as app.state.jobs,
                  running_days(settings, app.state.plans, app.state.jobs) as app.state.days,
                  giving_back(lambda: is_asked(app))):
                yield
            app.state.gallery.stop()


@contextmanager
def _planning(settings: Settings, planner: Planner | None, roads: Roads,
              observer: Observer) -> Iterator[PlanDesk]:
    """Yield who has plans made; as many get ready for that as plans may be made at once."""
    known = KnownRoads.of(roads)
    if planner is None:
        logs = log_config(settings.log_format, settings.log_level)
        start = processes(partial(opened, settings, known), logs)
    else:
        start = threads(partial(opened_with, planner, settings, known))
    at_once = settings.max_concurrent_plans if settings.role != "worker" else 0
    slots = settings.job_slots if settings.role != "api" else 0
    pool = Pool(start, at_once + slots + BESIDE, answers_of(roads), observer.metrics.count_death)
    try:
        pool.warm(min(at_once or slots, READY_AT_START))
        yield PlanDesk(pool, settings.policies if planner is None else planner.policies,
                       Bounds.of_plans(settings), roads, observer.metrics, observer.record_plan)
    finally:
        pool.close()


def _map_errors(app: FastAPI) -> None:
    """Have errors answered by problem documents. In place."""
    app.add_exception_handler(RequestError, _request_error)
    app.add_exception_handler(RequestValidationError, _wrong_parameters)
    app.add_exception_handler(HTTPException, _http_error)
    app.add_exception_handler(ClientDisconnect, _client_gone)
    app.add_exception_handler(PlanCheckError, _plan_withheld)
    app.add_exception_handler(Exception, _internal_error)


async def _request_error(request: Request, error: Exception) -> Response:
    if not isinstance(error, RequestError):
        raise error
    if error.refusal is not None:
        request.app.state.metrics.count_refusal(error.refusal)
    retry = {"Retry-After": str(RETRY_SECONDS)} if error.status == 503 else {}
    return problem_response(error.status, error.name, error.title, str(error), error.errors,
                            {**retry, **error.headers})


async def _wrong_parameters(request: Request, error: Exception) -> Response:
    if not isinstance(error, RequestValidationError):
        raise error
    return await _request_error(request, InvalidRequestError([
        schema_error(details).model_copy(update={"path": ".".join(map(str, details["loc"]))})
        for details in error.errors()]))


async def _http_error(request: Request, error: Exception) -> Response:
    if not isinstance(error, HTTPException):
        raise error
    title = HTTPStatus(error.status_code).phrase
    headers = dict(error.headers or {})
    if error.status_code == HTTPStatus.METHOD_NOT_ALLOWED:
        headers |= allowed_methods(request)
    return problem_response(error.status_code, title.lower().replace(" ", "-"), title,
                            f"{request.method} {request.url.path}: {error.detail}.",
                            headers=headers)


async def _client_gone(request: Request, error: Exception) -> Response:
    return problem_response(400, "incomplete-body", "The body is incomplete",
                            "The connection closed before the whole body was sent.")


async def _plan_withheld(request: Request, error: Exception) -> Response:
    logger.error("plan withheld: %s", error)
    return problem_response(500, "internal-error", "Internal error",
                            "The plan found breaks a rule, so it is withheld.")


async def _internal_error(request: Request, error: Exception) -> Response:
    return problem_response(500, "internal-error", "Internal error",
                            "The request could not be answered.")
