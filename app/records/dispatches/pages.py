"""Drivers' page at `/drive/`, and the two endpoints that it asks, by the token of a link alone."""

import hashlib
import re
from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Depends, FastAPI, Query, Request, Response, Security
from fastapi.security import HTTPAuthorizationCredentials, HTTPBearer
from fastapi.staticfiles import StaticFiles
from starlette.types import Scope

from app.plans.flights.files import FORMAT_ASKED, flight_file
from app.plans.flights.routes import FLIGHTS, sent
from app.records.dispatches.driving import read_day, read_flights, tell
from app.records.dispatches.errors import UnknownVehicleLinkError
from app.records.dispatches.links import DRIVER_TOKENS
from app.records.dispatches.proofs import ProofInput, keep_proof
from app.records.dispatches.schemas import DriverDay, EventsReply, EventsRequest, ProofsReply
from app.records.dispatches.store import DispatchStore
from app.records.prepared import Database
from app.requests.reading import read_model
from app.schemas.flights import (
    FORMAT_TEXT, PER_TEXT, FlightFormat, Per, WpmlInput, wpml_asked,
)
from app.schemas.openapi import json_body, problems
from app.serving.access.guard import Guard
from app.serving.load.bodies import Body

STATIC_DIR = Path(__file__).parent / "static"
CONSOLE_DIR = Path(__file__).parents[2] / "console" / "static"
WORKER = "sw.js"

POLICY = "; ".join((
    "default-src 'none'", "script-src 'self'", "style-src 'self'", "img-src 'self' data:",
    "connect-src 'self'", "manifest-src 'self'", "worker-src 'self'", "base-uri 'none'",
    "form-action 'none'", "frame-ancestors 'none'",
))
"""What drivers' page may do: less than the console."""

HEADERS = {"Content-Security-Policy": POLICY, "Cache-Control": "no-cache"}

router = APIRouter(tags=["drivers"])

LINK = HTTPBearer(scheme_name="DriverLink", auto_error=False,
                  description="The token of a driver's link: what stands behind its `#`.")

REFUSED = problems(
    _401="There is no such link, or none was sent.",
    _410="The link was revoked, or its day is over.",
    _429="The link asks too often, or too many wrong ones came from this address.",
    _503="The database can't be reached: try again soon.")
TOLD = REFUSED | problems(400, 413, 422, _409="The link has told too much.")


async def link_token(
    request: Request,
    presented: Annotated[HTTPAuthorizationCredentials | None, Security(LINK)],
) -> str:
    """Return the token that came with a request; refuse what looks like none."""
    guard: Guard = request.app.state.guard
    token = presented.credentials if presented else ""
    link = DRIVER_TOKENS.id_of(token)
    if not link:
        raise _unknown(request)
    # Logs name the link by its id.
    request.state.key_id = f"drive:{link}"
    guard.limits.take_of_driver(request, link)
    return token


Token = Annotated[str, Security(link_token)]


@router.get("/drive/day", summary="Read a vehicle's day", response_model=DriverDay,
            responses=REFUSED)
async def driver_day(request: Request, token: Token, database: Database) -> Response:
    """Return the day of the vehicle that the link is for, and nothing of any other."""
    try:
        day = await database.reach(lambda engine: read_day(DispatchStore(engine), token))
    except UnknownVehicleLinkError:
        raise _unknown(request) from None
    return Response(day.model_dump_json(), media_type="application/json")


@router.get("/drive/flights", summary="Write a vehicle's flights", response_class=Response,
            responses={**FLIGHTS, **REFUSED, **problems(
                _422="A parameter is not valid, or there is nothing that the format can tell.")})
async def driver_flights(
    request: Request, token: Token, database: Database,
    file_format: Annotated[FlightFormat, Query(alias="format", description=FORMAT_TEXT)],
    wpml: Annotated[WpmlInput, Depends(wpml_asked)],
    per: Annotated[Per, Query(description=PER_TEXT)] = "sortie",
) -> Response:
    """Return the flights of the vehicle's drones as `POST /flights` does; no permission to fly."""
    try:
        flights = await database.reach(lambda engine: read_flights(DispatchStore(engine), token))
    except UnknownVehicleLinkError:
        raise _unknown(request) from None
    return sent(flight_file(flights, file_format, per, FORMAT_ASKED, wpml))


@router.post("/drive/events", summary="Tell of a vehicle's day", response_model=EventsReply,
             responses=TOLD, openapi_extra=json_body(EventsRequest))
async def driver_events(request: Request, token: Token, database: Database, body: Body) -> Response:
    """Keep what a driver tells; what was told before counts once."""
    try:
        reply = await database.reach(lambda engine: tell(
            DispatchStore(engine), token, read_model(body.content, EventsRequest)))
    except UnknownVehicleLinkError:
        raise _unknown(request) from None
    return Response(reply.model_dump_json(), media_type="application/json")


@router.post("/drive/proofs", summary="Send a proof of delivery", response_model=ProofsReply,
             responses=TOLD, openapi_extra=json_body(ProofInput))
async def driver_proof(request: Request, token: Token, database: Database, body: Body) -> Response:
    """Keep who took it, a photo and a signature with the stop; one sent again counts once."""
    try:
        proofs = await database.reach(lambda engine: keep_proof(
            engine, token, read_model(body.content, ProofInput)))
    except UnknownVehicleLinkError:
        raise _unknown(request) from None
    return Response(ProofsReply(proofs=proofs).model_dump_json(), media_type="application/json")


def _unknown(request: Request) -> UnknownVehicleLinkError:
    """Count a wrong token and return how it is refused; raises if there were too many."""
    guard: Guard = request.app.state.guard
    guard.count_wrong_token(request)
    return UnknownVehicleLinkError()


class DriveFiles(StaticFiles):
    """The page and what belongs to it, with a policy of its own."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        response = await super().get_response(path, scope)
        response.headers.update(HEADERS)
        return response


def mount_drivers_page(app: FastAPI) -> None:
    """Serve drivers' page. In place."""
    app.include_router(router)
    script = _worker()

    async def worker() -> Response:
        return Response(script, headers=HEADERS, media_type="text/javascript")

    app.add_api_route(f"/drive/{WORKER}", worker, include_in_schema=False)
    app.mount("/drive", DriveFiles(directory=STATIC_DIR, html=True), name="drive")


def _worker() -> str:
    """Return the service worker, which differs whenever any file does: then phones fetch all."""
    digest = hashlib.sha256()
    script = (STATIC_DIR / WORKER).read_text("utf-8")
    own = sorted(path for path in STATIC_DIR.rglob("*") if path.is_file())
    shared = [CONSOLE_DIR / name for name in re.findall(r"'\.\./console/(.+)'", script)]
    for file in [*own, *shared]:
        digest.update(file.read_bytes())
    return f"const VERSION = '{digest.hexdigest()[:16]}';\n{script}"
