"""Endpoints."""

from collections.abc import AsyncIterator
from typing import Annotated

from fastapi import APIRouter, Depends, Request, Response
from fastapi.responses import JSONResponse

from app.access.guard import Plan
from app.load.abandoned import Planning
from app.load.bodies import Bodies
from app.plans.checking import answer_check
from app.plans.service import PlanService, ReceivedBody
from app.requests.bounds import Bounds
from app.schemas.check import CheckReply, CheckRequest
from app.schemas.openapi import ERROR_RESPONSES, EXAMPLES, json_body
from app.schemas.request import PlanRequest
from app.schemas.response import LivenessReply, PlanReply, ReadinessReply

router = APIRouter()

CHECK_EXAMPLES = {"check": "A plan whose truck is too full, and too late at its second customer"}
CHECK_ERROR_RESPONSES = {status: response for status, response in ERROR_RESPONSES.items()
                         if status != 500}
"""A plan of whatever kind is an answer."""


async def read_body(request: Request) -> AsyncIterator[ReceivedBody]:
    """Read the body, as far as it stays within the limits."""
    bodies: Bodies = request.app.state.bodies
    async with bodies.read(request) as body:
        yield body


def get_service(request: Request) -> PlanService:
    """Return the service that this application runs."""
    service: PlanService = request.app.state.service
    return service


Service = Annotated[PlanService, Depends(get_service)]
Body = Annotated[ReceivedBody, Depends(read_body)]


@router.post("/plan", summary="Plan deliveries", tags=["planning"], response_model=PlanReply,
             responses=ERROR_RESPONSES, openapi_extra=json_body(PlanRequest, EXAMPLES))
async def plan(request: Request, principal: Plan, planning: Planning, body: Body,
               service: Service) -> Response:
    """Return routes, costs and load rates; customers that can't be served stay unassigned."""
    reply = await planning.run(request, lambda should_stop: service.plan(body, should_stop))
    return Response(reply, media_type="application/json")


@router.post("/check", summary="Judge a plan", tags=["planning"], response_model=CheckReply,
             responses=CHECK_ERROR_RESPONSES, openapi_extra=json_body(CheckRequest, CHECK_EXAMPLES))
async def check(request: Request, principal: Plan, planning: Planning, body: Body) -> Response:
    """Return every rule that a plan breaks, and its true cost by term."""
    bounds = Bounds.of_plans(request.app.state.settings)
    reply = await planning.run(
        request, lambda should_stop: answer_check(body.content, bounds, should_stop))
    return Response(reply, media_type="application/json")


@router.get("/health/live", summary="Is the process alive?", tags=["operations"],
            response_model=LivenessReply)
async def live() -> dict[str, str]:
    """Answer as long as the process runs."""
    return {"status": "live"}


@router.get("/health/ready", summary="Can it plan now?", tags=["operations"],
            response_model=ReadinessReply, responses={503: {
                "model": ReadinessReply, "description": "The service is starting or stopping, or "
                "its database is not as it has to be."}})
async def ready(request: Request, service: Service) -> JSONResponse:
    """Answer 200 while plans can be computed and jobs taken, 503 before and after."""
    if request.app.state.shutdown.has_begun:
        return JSONResponse({"status": "stopping", "detail": "this process is about to end"}, 503)
    readiness = service.readiness()
    if readiness.is_ready:
        if request.app.state.jobs.is_preparing:
            detail = "the database is being prepared"
            return JSONResponse({"status": "starting", "detail": detail}, 503)
        trouble = await request.app.state.jobs.misfit() or await request.app.state.guard.trouble()
        if trouble is not None:
            return JSONResponse({"status": "unavailable", "detail": trouble}, 503)
    content = {"status": "ready" if readiness.is_ready else "starting", "detail": readiness.detail,
               "progress": readiness.progress}
    return JSONResponse(content, 200 if readiness.is_ready else 503)
