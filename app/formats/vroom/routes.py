"""The endpoint."""

import logging
from typing import Any

from fastapi import APIRouter, Request, Response

from app.formats.vroom.answering import answer_there
from app.formats.vroom.errors import INTERNAL, VroomError, VroomErrorReply
from app.formats.vroom.schemas import VroomRequest
from app.formats.vroom.schemas_response import VroomReply
from app.plans.routes import Plans
from app.schemas.errors import MEDIA_TYPE
from app.schemas.openapi import SCHEMA_REF, json_body
from app.serving.access.guard import Plan
from app.serving.load.abandoned import Planning
from app.serving.load.bodies import Body
from model.planner import PlanCheckError

logger = logging.getLogger(__name__)

router = APIRouter()

EXAMPLES = {
    "vroom_matrix": "Jobs and vehicles as VROOM takes them, with a matrix of durations",
    "vroom_city": "The same by longitude and latitude, with time windows, skills and amounts",
}
ERROR_RESPONSES: dict[int | str, dict[str, Any]] = {
    status: {
        "model": VroomErrorReply,
        "description": description,
        "content": {MEDIA_TYPE: {"schema": {"$ref": SCHEMA_REF.format(model="ProblemDocument")}}},
    }
    for status, description in (
        (400, "Code 2: the request is not valid, or asks for what can't be planned here. A problem "
              "document if it was refused unread."),
        (413, "Code 4: there are too many jobs or vehicles. A problem document if the body is too "
              "large."),
        (500, "Code 1: the solution found broke a rule, so it is withheld. Code 3: roads lead to "
              "no place, or don't answer. A problem document if anything else failed."),
    )
}


@router.post("/vroom", summary="Plan a VROOM request", tags=["planning"],
             response_model=VroomReply, responses=ERROR_RESPONSES,
             openapi_extra=json_body(VroomRequest, EXAMPLES))
async def vroom(request: Request, principal: Plan, planning: Planning, body: Body,
                plans: Plans) -> Response:
    """Take what VROOM takes, and answer as it does; what can't be planned is refused by name."""
    try:
        reply = await plans.answer(planning, request, answer_there, body)
    except VroomError as error:
        return error.response()
    except PlanCheckError as error:
        logger.error("plan withheld: %s", error)
        withheld = VroomError(INTERNAL, "The solution found breaks a rule, so it is withheld.")
        return withheld.response()
    return Response(reply, media_type="application/json")
