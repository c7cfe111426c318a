"""Endpoints."""

import time
from typing import Annotated

from fastapi import APIRouter, Depends, Request, Response
from fastapi.responses import HTMLResponse, JSONResponse

from app.errors import BodyTooLargeError
from app.openapi import ERROR_RESPONSES
from app.schemas_response import PlanReply
from app.service import PlanService, ReceivedBody

router = APIRouter()

HOME = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Tandem</title>
<body style="font-family: sans-serif; margin: 3em; max-width: 40em">
<h1>Tandem</h1>
<p>Plans deliveries for trucks that carry drones.</p>
<ul><li><a href="docs">Try it</a>: the API with examples to run</li>
<li><a href="redoc">Read it</a>: the same as a reference</li>
<li><a href="health/ready">Is it ready?</a></li></ul>
"""

async def read_body(request: Request) -> ReceivedBody:
    """Read the body, as far as it stays within the limit."""
    limit: int = request.app.state.settings.max_body_bytes
    too_large = BodyTooLargeError(f"The body has more than {limit} bytes: send less at a time.")
    stated = request.headers.get("content-length", "0")
    if stated.isdigit() and int(stated) > limit:
        raise too_large
    content = bytearray()
    async for chunk in request.stream():
        content += chunk
        if len(content) > limit:
            raise too_large
    return ReceivedBody(bytes(content), time.perf_counter())


def get_service(request: Request) -> PlanService:
    """Return the service that this application runs."""
    service: PlanService = request.app.state.service
    return service


Service = Annotated[PlanService, Depends(get_service)]
Body = Annotated[ReceivedBody, Depends(read_body)]


@router.post("/plan", summary="Plan deliveries", response_model=PlanReply,
             responses=ERROR_RESPONSES)
def plan(body: Body, service: Service) -> Response:
    """Return routes, costs and load rates; customers that can't be served stay unassigned."""
    return Response(service.plan(body), media_type="application/json")


@router.get("/health/live", summary="Is the process alive?")
async def live() -> dict[str, str]:
    """Answer as long as the process runs."""
    return {"status": "live"}


@router.get("/health/ready", summary="Can it plan now?",
            responses={503: {"description": "The service is starting."}})
async def ready(service: Service) -> JSONResponse:
    """Answer 200 once plans can be computed, 503 before."""
    readiness = service.readiness()
    content = {"status": "ready" if readiness.is_ready else "starting", "detail": readiness.detail}
    return JSONResponse(content, 200 if readiness.is_ready else 503)


@router.get("/", response_class=HTMLResponse, include_in_schema=False)
async def home() -> str:
    """Say what to open."""
    return HOME
