"""Customers' page at `/visit/`, and the endpoint that it asks, by the token of a link alone."""

from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, FastAPI, Request, Response, Security
from fastapi.security import HTTPAuthorizationCredentials, HTTPBearer

from app.records.days.customers import read_visit
from app.records.days.schemas import VisitStatusReply
from app.records.dispatches.errors import UnknownVehicleLinkError
from app.records.dispatches.pages import DriveFiles
from app.records.prepared import Database
from app.schemas.openapi import problems
from app.serving.access.guard import Guard

STATIC_DIR = Path(__file__).parent / "static"

MAX_TOKEN = 1_000
"""Characters of a token that are read: more than any has."""

router = APIRouter(tags=["days"])

LINK = HTTPBearer(scheme_name="CustomerLink", auto_error=False,
                  description="The token of a customer's link: what stands behind its `#`.")

REFUSED = problems(
    _401="There is no such link, or none was sent.",
    _410="Its day is over, or the order was cancelled.",
    _429="The link asks too often, or too many wrong ones came from this address.",
    _503="The database can't be reached: try again soon.")


@router.get("/visit/order", summary="Read when who comes", response_model=VisitStatusReply,
            responses=REFUSED)
async def customer_visit(
    request: Request, database: Database,
    presented: Annotated[HTTPAuthorizationCredentials | None, Security(LINK)],
) -> Response:
    """Return what the customer of a link may know of its order, and nothing of any other."""
    guard: Guard = request.app.state.guard
    token = presented.credentials[:MAX_TOKEN] if presented else ""
    guard.limits.take_of_driver(request, token)
    try:
        reply = await database.reach(lambda engine: read_visit(engine, token))
    except UnknownVehicleLinkError:
        guard.count_wrong_token(request)
        raise
    return Response(reply.model_dump_json(), media_type="application/json")


def mount_customers_page(app: FastAPI) -> None:
    """Serve customers' page. In place."""
    app.include_router(router)
    app.mount("/visit", DriveFiles(directory=STATIC_DIR, html=True), name="visit")
