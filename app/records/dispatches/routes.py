"""Endpoints for those who send plans out."""

from typing import Annotated

from fastapi import APIRouter, Path, Query, Request, Response
from pydantic import BaseModel
from sqlalchemy import Engine

from app.plans.checking import read_about_plan
from app.records.dispatches.doubts import Answers
from app.records.dispatches.proofs import Part, picture_of, proofs_of
from app.records.dispatches.replies import dispatch_reply, summary
from app.records.dispatches.schemas import (
    DispatchListReply, DispatchOptions, DispatchReply, DispatchRequest, GoingOnReply, ProofsReply,
)
from app.records.dispatches.service import DispatchService, Followed
from app.records.dispatches.store import DispatchStore
from app.records.jobs.routes import Desk, JobId
from app.records.prepared import Database
from app.requests.bounds import Bounds
from app.requests.plan_reading import parse_plan
from app.requests.reading import read_model
from app.schemas.check import PlannedProblem
from app.schemas.openapi import json_body, problems
from app.schemas.plan import MAX_INSTANT
from app.serving.access.guard import Jobs
from app.serving.load.bodies import Body

router = APIRouter(tags=["drivers"])

MAX_LISTED = 500

MOST_ANSWERS = 1000
"""Customers of whom it is said whether they were served; an address has no room for more."""

UNAVAILABLE = "The database can't be reached: try again soon."
UNKNOWN = "There is no such dispatch or link, or it is another's."
TOO_MANY = "A rate limit is used up, or too many of your plans are on the road."

FOUND = problems(_404=UNKNOWN, _422="A parameter is not valid.", _503=UNAVAILABLE)
SENT = problems(400, 413, 422, _429=TOO_MANY, _503=UNAVAILABLE)
SENT_FROM_JOB = SENT | problems(_404="There is no such job, or it is another's.",
                                _409="The job has no plan, or none yet, or several.")

DispatchId = Annotated[str, Path(max_length=36, description="Id of the dispatch.")]
LinkId = Annotated[str, Path(max_length=12, description="Id of the link.")]


@router.post("/dispatches", summary="Send a plan to its drivers", status_code=201,
             response_model=DispatchReply, responses=SENT,
             openapi_extra=json_body(DispatchRequest))
async def dispatch_plan(request: Request, principal: Jobs, database: Database,
                        body: Body) -> Response:
    """Keep a plan and make a link for each of its vehicles, which is told this once."""
    bounds = Bounds.of_plans(request.app.state.settings)
    followed = await database.reach(lambda engine: _service(request, engine).create(
        read_about_plan(body.content, bounds, DispatchRequest), principal.key_id,
        principal.client))
    return _told(request, followed, 201)


@router.post("/jobs/{job_id}/dispatches", summary="Send a job's plan to its drivers",
             status_code=201, response_model=DispatchReply, responses=SENT_FROM_JOB,
             openapi_extra=json_body(DispatchOptions))
async def dispatch_job(request: Request, job_id: JobId, principal: Jobs, desk: Desk,
                       database: Database, body: Body) -> Response:
    """Do the same as `POST /dispatches` with a job's best plan so far."""
    options, (problem, plan) = await desk.ask(lambda jobs: (
        read_model(body.content, DispatchOptions), jobs.plan(job_id, principal.key_id)))
    wanted = DispatchRequest.model_construct(
        problem=problem, plan=parse_plan(plan), plan_start=options.plan_start,
        time_zone=options.time_zone)
    followed = await database.reach(lambda engine: _service(request, engine).create(
        wanted, principal.key_id, principal.client))
    return _told(request, followed, 201)


@router.get("/dispatches", summary="List plans on the road", response_model=DispatchListReply,
            responses=problems(_422="A parameter is not valid.", _503=UNAVAILABLE))
async def list_dispatches(
    request: Request, principal: Jobs, database: Database,
    limit: Annotated[int, Query(ge=1, le=MAX_LISTED, description="Most that are listed.")] = 50,
) -> Response:
    """Return the caller's dispatches without their links, the youngest first."""
    rows = await database.reach(lambda engine: _service(request, engine).page(
        principal.key_id, limit))
    return _json(DispatchListReply(dispatches=[summary(row) for row in rows]))


@router.get("/dispatches/{dispatch_id}", summary="Follow a plan on the road",
            response_model=DispatchReply, responses=FOUND)
async def follow_dispatch(request: Request, dispatch_id: DispatchId, principal: Jobs,
                          database: Database) -> Response:
    """Return how far each vehicle is, by what its driver told."""
    return _told(request, await database.reach(lambda engine: _service(request, engine).follow(
        dispatch_id, principal.key_id)))


@router.post("/dispatches/{dispatch_id}/plan", summary="Change a plan on the road",
             response_model=DispatchReply, openapi_extra=json_body(PlannedProblem),
             responses=SENT | problems(_404=UNKNOWN, _409="The dispatch has ended."))
async def change_dispatch(request: Request, dispatch_id: DispatchId, principal: Jobs,
                          database: Database, body: Body) -> Response:
    """Put another plan of the day in its place: vehicles keep their links and what was told."""
    bounds = Bounds.of_plans(request.app.state.settings)
    return _told(request, await database.reach(lambda engine: _service(request, engine).change(
        dispatch_id, read_about_plan(body.content, bounds, PlannedProblem), principal.key_id)))


@router.get("/dispatches/{dispatch_id}/replan", summary="Plan on from what drivers told",
            response_model=GoingOnReply, responses=FOUND)
async def go_on(
    request: Request, dispatch_id: DispatchId, principal: Jobs, database: Database,
    now: Annotated[float | None, Query(
        ge=0, le=MAX_INSTANT, description="From when on, in seconds since plan start. Left out: "
        "now.")] = None,
    served: Annotated[list[str] | None, Query(
        max_length=MOST_ANSWERS, description="Customers of `doubtful` who were served.")] = None,
    unserved: Annotated[list[str] | None, Query(
        max_length=MOST_ANSWERS, description="Customers of `doubtful` who were not.")] = None,
) -> Response:
    """Return `replan` for a request of `POST /plan`: what was served, by whom and when."""
    answers = Answers(frozenset(served or ()), frozenset(unserved or ()))
    return _json(await database.reach(lambda engine: _service(request, engine).going_on(
        dispatch_id, principal.key_id, now, answers)))


@router.get("/dispatches/{dispatch_id}/proofs", summary="List proofs of delivery",
            response_model=ProofsReply, responses=FOUND)
async def list_proofs(request: Request, dispatch_id: DispatchId, principal: Jobs,
                      database: Database) -> Response:
    """Return what drivers sent of those who took it, without pictures."""
    return _json(await database.reach(lambda engine: ProofsReply(proofs=proofs_of(
        engine, _service(request, engine).find(dispatch_id, principal.key_id)))))


@router.get("/dispatches/{dispatch_id}/proofs/{vehicle}/{proof}/{part}", summary="Get a picture",
            response_class=Response, responses={
                200: {"description": "The picture.", "content": {"image/jpeg": {},
                                                                 "image/png": {}}},
                **problems(_404="There is no such picture, or it is another's.",
                           _422="A parameter is not valid.", _503=UNAVAILABLE)})
async def get_proof(
    request: Request, dispatch_id: DispatchId, principal: Jobs, database: Database,
    vehicle: Annotated[str, Path(max_length=200, description="Id of the vehicle.")],
    proof: Annotated[str, Path(max_length=36, description="Name of the proof.")],
    part: Annotated[Part, Path(description="Which of its pictures.")],
) -> Response:
    """Return a photo or a signature as the phone sent it."""
    picture, kind = await database.reach(lambda engine: picture_of(
        engine, _service(request, engine).find(dispatch_id, principal.key_id), vehicle, proof,
        part))
    return Response(picture, media_type=kind)


@router.post("/dispatches/{dispatch_id}/links/{link_id}", summary="Make a new link for a vehicle",
             status_code=201, response_model=DispatchReply,
             responses=FOUND | problems(_409="The dispatch has ended."))
async def renew_link(request: Request, dispatch_id: DispatchId, link_id: LinkId, principal: Jobs,
                     database: Database) -> Response:
    """Put another link in place of one, such as one that was lost; the former is revoked."""
    return _told(request, await database.reach(lambda engine: _service(request, engine).renew(
        dispatch_id, link_id, principal.key_id)), 201)


@router.delete("/dispatches/{dispatch_id}/links/{link_id}", summary="Revoke a link",
               response_model=DispatchReply, responses=FOUND)
async def revoke_link(request: Request, dispatch_id: DispatchId, link_id: LinkId,
                      principal: Jobs, database: Database) -> Response:
    """Let a link open nothing any more, from now on."""
    return _told(request, await database.reach(lambda engine: _service(request, engine).revoke(
        dispatch_id, link_id, principal.key_id)))


@router.delete("/dispatches/{dispatch_id}", summary="End a plan's day",
               response_model=DispatchReply, responses=FOUND)
async def end_dispatch(request: Request, dispatch_id: DispatchId, principal: Jobs,
                       database: Database) -> Response:
    """Let all its links open nothing any more; what drivers told is kept until it expires."""
    return _told(request, await database.reach(lambda engine: _service(request, engine).end(
        dispatch_id, principal.key_id)))


def _service(request: Request, engine: Engine) -> DispatchService:
    return DispatchService(DispatchStore(engine), request.app.state.settings,
                           request.app.state.plans.roads)


def _told(request: Request, followed: Followed, status: int = 200) -> Response:
    base = request.app.state.settings.public_url or str(request.base_url)
    headers = {"Location": f"/dispatches/{followed.dispatch.id}"} if status == 201 else {}
    return _json(dispatch_reply(followed, base), status, headers)


def _json(reply: BaseModel, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    return Response(reply.model_dump_json(), status, headers, media_type="application/json")
