"""Endpoints that tell whoever runs the service how this process is."""

from fastapi import APIRouter, Request
from fastapi.responses import JSONResponse

from app.schemas.response import LivenessReply, ReadinessReply

router = APIRouter(tags=["operations"])


@router.get("/health/live", summary="Is the process alive?",
            response_model=LivenessReply)
async def live() -> dict[str, str]:
    """Answer as long as the process runs."""
    return {"status": "live"}


@router.get("/health/ready", summary="Can it plan now?",
            response_model=ReadinessReply, responses={503: {
                "model": ReadinessReply, "description": "The service is starting or stopping, or "
                "its database is not as it has to be."}})
async def ready(request: Request) -> JSONResponse:
    """Answer 200 while plans can be computed and jobs taken, 503 before and after."""
    if request.app.state.shutdown.has_begun:
        return JSONResponse({"status": "stopping", "detail": "this process is about to end"}, 503)
    database = request.app.state.jobs.database
    if database.is_preparing:
        detail = "the database is being prepared"
        return JSONResponse({"status": "starting", "detail": detail}, 503)
    trouble = await database.misfit() or await request.app.state.guard.trouble()
    if trouble is not None:
        return JSONResponse({"status": "unavailable", "detail": trouble}, 503)
    return JSONResponse({"status": "ready", "detail": "ready"})
