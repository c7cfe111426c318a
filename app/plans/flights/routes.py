"""The endpoint of flights, and what it has in common with others that send them."""

from typing import Any

from fastapi import APIRouter, Request, Response

from app.plans.flights import answering
from app.plans.flights.files import WRITERS, ZIP, FlightFile
from app.plans.routes import CHECK_ERROR_RESPONSES, Plans
from app.schemas.flights import FlightsRequest
from app.schemas.openapi import json_body
from app.serving.access.guard import Plan
from app.serving.load.abandoned import Planning
from app.serving.load.bodies import Body

router = APIRouter()

EXAMPLES = {"flights": "A drone that flies around a zone, as QGroundControl reads it"}

FLIGHTS: dict[int | str, dict[str, Any]] = {200: {
    "description": "The flights: a file, or a ZIP of several. `Content-Disposition` names it.",
    "content": {media_type: {"schema": {"type": "object" if media_type.endswith("json")
                                        else "string"}}
                for media_type in (*(writer.media_type for writer in WRITERS.values()), ZIP)}}}


@router.post("/flights", summary="Write flights for their controllers", tags=["planning"],
             response_class=Response, responses={**CHECK_ERROR_RESPONSES, **FLIGHTS},
             openapi_extra=json_body(FlightsRequest, EXAMPLES))
async def flights(request: Request, principal: Plan, planning: Planning, body: Body,
                  plans: Plans) -> Response:
    """Return a plan's flights as a file that flight controllers read; no permission to fly."""
    return sent(await plans.answer(planning, request, answering.flights, body))


def sent(file: FlightFile) -> Response:
    """Return a file to be saved under its name."""
    return Response(file.content, media_type=file.media_type, headers={
        "Content-Disposition": f'attachment; filename="{file.name}"'})
