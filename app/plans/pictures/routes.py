"""Pictures for who asks for one."""

from collections.abc import Callable
from typing import Any

from fastapi import APIRouter, Request, Response

from app.plans.checking import read_about_plan
from app.plans.pictures.scene import DrawnPlan
from app.plans.routes import CHECK_ERROR_RESPONSES, CHECK_EXAMPLES, Plans
from app.plans.workplace import Workplace
from app.schemas.check import PlannedProblem
from app.schemas.openapi import json_body
from app.serving.access.guard import Plan
from app.serving.load.abandoned import Planning
from app.serving.load.bodies import Body
from app.serving.load.received import ReceivedBody

router = APIRouter()

EXAMPLES = {"check": CHECK_EXAMPLES["check"]}
PICTURE: dict[int | str, dict[str, Any]] = {
    200: {"description": "The plan as a picture: a map, and a timeline under it.",
          "content": {"image/svg+xml": {"schema": {"type": "string"}}}},
    **CHECK_ERROR_RESPONSES}


@router.post("/picture", summary="Draw a plan", tags=["planning"], response_class=Response,
             responses=PICTURE, openapi_extra=json_body(PlannedProblem, EXAMPLES))
async def picture(request: Request, principal: Plan, planning: Planning, body: Body,
                  plans: Plans) -> Response:
    """Return a plan as a picture; one that breaks rules is drawn with a note that it does."""
    reply = await plans.answer(planning, request, draw, body)
    return Response(reply, media_type="image/svg+xml")


def draw(place: Workplace, body: ReceivedBody, should_stop: Callable[[], bool]) -> bytes:
    """Answer `POST /picture` where plans are made."""
    # Imported here: who draws nothing needn't wait for matplotlib.
    from app.plans.pictures.drawing import draw_svg

    request = read_about_plan(body.content, place.bounds, PlannedProblem)
    return draw_svg(DrawnPlan.judged(request.problem, request.plan, place.service.roads))
