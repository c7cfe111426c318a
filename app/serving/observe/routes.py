"""The endpoint that Prometheus reads."""

from fastapi import APIRouter, Request, Response, Security

from app.serving.access.guard import require
from app.serving.settings import Settings


def metrics_router(settings: Settings) -> APIRouter:
    """Return `GET /metrics`, for keys with the scope `admin` unless it is to be open."""
    guards = [] if settings.metrics_open else [Security(require, scopes=["admin"])]
    router = APIRouter(tags=["operations"], dependencies=guards)

    # A plain function, as jobs are counted in the database.
    @router.get("/metrics", summary="Read metrics", response_class=Response, responses={200: {
        "description": "All metrics in a text format of Prometheus.",
        "content": {"text/plain": {"schema": {"type": "string"}}}}})
    def metrics(request: Request) -> Response:
        """Return all metrics, of all processes of this service on this machine."""
        accept = request.headers.get("accept", "")
        content, media_type = request.app.state.metrics.render(accept)
        return Response(content, headers={"Content-Type": media_type})

    return router
