"""The web application: loads the planner, maps errors to replies."""

import logging
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from http import HTTPStatus

import anyio.to_thread
from fastapi import FastAPI, Request, Response
from fastapi_offline import FastAPIOffline
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect

from app.errors import RequestError, problem_response
from app.openapi import describe
from app.routes import router
from app.service import PlanService
from app.settings import Settings
from model.planner import PlanCheckError, Planner, load_planner

logger = logging.getLogger(__name__)

RETRY_SECONDS = 5


def create_app(settings: Settings | None = None, planner: Planner | None = None) -> FastAPI:
    """Return the application.

    Parameters
    ----------
    settings
        How to run; None reads them from the environment.
    planner
        Used in place of the one that the settings name.
    """
    settings = settings or Settings()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        anyio.to_thread.current_default_thread_limiter().total_tokens = (
            settings.max_concurrent_plans)
        service = PlanService(planner or load_planner(settings.weights_dir, settings.policies),
                              settings.search_threads)
        service.start()
        app.state.service = service
        yield
        service.stop()

    app = FastAPIOffline(title="Tandem", version="0.1.0", lifespan=lifespan,
                         description="Plans deliveries for trucks that carry drones.")
    app.state.settings = settings
    app.include_router(router)
    app.add_exception_handler(RequestError, _request_error)
    app.add_exception_handler(HTTPException, _http_error)
    app.add_exception_handler(ClientDisconnect, _client_gone)
    app.add_exception_handler(PlanCheckError, _plan_withheld)
    app.add_exception_handler(Exception, _internal_error)
    app.openapi = describe(app)  # type: ignore[method-assign]
    return app


async def _request_error(request: Request, error: Exception) -> Response:
    if not isinstance(error, RequestError):
        raise error
    headers = {"Retry-After": str(RETRY_SECONDS)} if error.status == 503 else None
    return problem_response(error.status, error.name, error.title, str(error), error.errors,
                            headers)


async def _http_error(request: Request, error: Exception) -> Response:
    if not isinstance(error, HTTPException):
        raise error
    title = HTTPStatus(error.status_code).phrase
    return problem_response(error.status_code, title.lower().replace(" ", "-"), title,
                            f"{request.method} {request.url.path}: {error.detail}.",
                            headers=error.headers)


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
