"""Endpoints of jobs."""

from typing import Annotated, Any

from fastapi import APIRouter, Depends, Header, Path, Query, Request, Response
from pydantic_core import to_json
from sse_starlette import EventSourceResponse

from app.plans import answers
from app.plans.explaining import Subject
from app.plans.flights.answering import fly_planned
from app.plans.flights.routes import FLIGHTS, sent
from app.plans.routes import Plans
from app.records.jobs.desk import JobDesk
from app.records.jobs.events import events, while_admitted
from app.records.jobs.replies import summary
from app.records.jobs.rows import JobRow
from app.records.jobs.schemas import (
    CompareRequest, JobListReply, JobReply, JobSummaryReply, Kind, ProgressEvent, State,
    SweepRequest,
)
from app.records.jobs.service import JobService, Submission, is_job_id
from app.records.jobs.webhook import check_url
from app.requests.paging import cursor_of, read_cursor
from app.schemas.explain import ExplainOptions, ExplainReply
from app.schemas.flights import (
    FORMAT_TEXT, PER_TEXT, FlightFormat, Per, WpmlInput, wpml_asked,
)
from app.schemas.limits import MAX_TIME_LIMIT
from app.schemas.openapi import EXAMPLES, event_stream, json_body, problems
from app.schemas.request import PlanRequest
from app.serving.access.guard import Guard, Jobs, Principal
from app.serving.load.abandoned import Planning, watching
from app.serving.load.bodies import Body
from app.serving.load.received import ReceivedBody

router = APIRouter(tags=["jobs"])

HEARTBEAT = 10
"""Seconds between two signs of life where nothing changes, so that proxies keep a stream open."""

MAX_PAGE = 500

UNAVAILABLE = "The database can't be reached, or too many jobs wait: try again soon."
UNKNOWN = "There is no such job, or it is another's."
PARAMETERS = "A parameter is not valid."
KEY_OR_BODY = "The request is not valid, every error is listed; or the `Idempotency-Key` belongs " \
              "to another request."

SUBMITTED: dict[int | str, dict[str, Any]] = {
    200: {"model": JobReply, "description": "The job that this request had made before, "
          "by its `Idempotency-Key`."},
    **problems(400, 413, _422=KEY_OR_BODY, _503=UNAVAILABLE),
}
FOUND = problems(_404=UNKNOWN, _422=PARAMETERS, _503=UNAVAILABLE)

PICTURE: dict[int | str, dict[str, Any]] = {
    200: {"description": "The plan as a picture: a map, and a timeline under it.",
          "content": {"image/svg+xml": {"schema": {"type": "string"}}}},
    **FOUND, **problems(_409="The job has no plan, or none yet, or several."),
}

EXPLAINED: dict[int | str, dict[str, Any]] = {
    **FOUND, **problems(500, _409="The job has no plan, or none yet, or several.")}

WRITTEN: dict[int | str, dict[str, Any]] = {
    **FLIGHTS, **problems(_404=UNKNOWN, _409="The job has no plan, or none yet, or several.",
                          _422="A parameter is not valid, or the plan has no flights that the "
                          "format can tell.", _503=UNAVAILABLE)}

JobId = Annotated[str, Path(max_length=36, description="Id of the job.")]
IdempotencyKey = Annotated[str | None, Header(
    alias="Idempotency-Key", min_length=1, max_length=255,
    description="Any text that is this request's own, such as a UUID: sent again with it, the "
    "request makes no second job.")]
Webhook = Annotated[str | None, Query(
    description="URL that is called by POST when the job has ended, signed as Standard Webhooks "
    "has it. A call that fails is repeated for some hours.")]


async def get_desk(request: Request) -> JobDesk:
    """Return where to turn to about this application's jobs."""
    desk: JobDesk = request.app.state.jobs
    return desk


Desk = Annotated[JobDesk, Depends(get_desk)]


@router.post("/jobs", summary="Plan deliveries as a job", status_code=202,
             response_model=JobReply, responses=SUBMITTED,
             openapi_extra=json_body(PlanRequest, EXAMPLES))
async def submit_plan(request: Request, principal: Jobs, desk: Desk, body: Body,
                      key: IdempotencyKey = None, webhook: Webhook = None) -> Response:
    """Accept a request of `POST /plan`, with a longer time limit, to be planned in its turn."""
    return await _submit(request, desk, _submission("plan", body, principal, key, webhook))


@router.post("/compare", summary="Compare fleets", status_code=202,
             response_model=JobReply, responses=SUBMITTED,
             openapi_extra=json_body(CompareRequest))
async def submit_compare(request: Request, principal: Jobs, desk: Desk, body: Body,
                         key: IdempotencyKey = None, webhook: Webhook = None) -> Response:
    """Accept a job that plans the same customers with each of several fleets."""
    return await _submit(request, desk, _submission("compare", body, principal, key, webhook))


@router.post("/sweep", summary="Sweep over values", status_code=202,
             response_model=JobReply, responses=SUBMITTED,
             openapi_extra=json_body(SweepRequest))
async def submit_sweep(request: Request, principal: Jobs, desk: Desk, body: Body,
                       key: IdempotencyKey = None, webhook: Webhook = None) -> Response:
    """Accept a job that plans a request with each combination of some fields' values."""
    return await _submit(request, desk, _submission("sweep", body, principal, key, webhook))


@router.get("/jobs", summary="List jobs", response_model=JobListReply,
            responses=problems(_422=PARAMETERS, _503=UNAVAILABLE))
async def list_jobs(
    principal: Jobs, desk: Desk,
    limit: Annotated[int, Query(ge=1, le=MAX_PAGE, description="Most jobs of a page.")] = 50,
    cursor: Annotated[str | None, Query(max_length=200, description="`next` of the page before. "
                                        "Left out: the first page.")] = None,
    state: Annotated[State | None, Query(description="Only jobs in this state.")] = None,
) -> Response:
    """Return the caller's jobs without their results, the youngest first."""
    before = None if cursor is None else read_cursor(cursor, is_job_id)
    rows = await desk.ask(
        lambda service: service.page(principal.key_id, limit + 1, before, state))
    page = {"jobs": [summary(row) for row in rows[:limit]],
            "next": (cursor_of(rows[limit - 1].created_at, rows[limit - 1].id)
                     if len(rows) > limit else None)}
    return Response(to_json(page), media_type="application/json")


@router.get("/jobs/{job_id}", summary="Read a job", response_model=JobReply, responses=FOUND)
async def read_job(job_id: JobId, principal: Jobs, desk: Desk) -> Response:
    """Return a job and its result; while it runs, the best plan so far."""
    content = await desk.ask(
        lambda service: service.reply(service.find(job_id, principal.key_id)))
    return Response(content, media_type="application/json")


@router.get("/jobs/{job_id}/events", summary="Follow a job", response_class=EventSourceResponse,
            responses={200: {
                "description": "Server-sent events. `progress`, each second and at each "
                "improvement: a `ProgressEvent`. `end`, once: the job as `GET /jobs` lists it.",
                "content": event_stream(progress=ProgressEvent, end=JobSummaryReply)}, **FOUND})
async def follow_job(
    request: Request, job_id: JobId, principal: Jobs, desk: Desk,
    last_event_id: Annotated[str | None, Header(
        alias="Last-Event-ID", max_length=40,
        description="Number of the last event received, after which to go on.")] = None,
) -> EventSourceResponse:
    """Stream what becomes of a job, until it is over or the key is revoked."""
    guard: Guard = request.app.state.guard
    row = await desk.ask(lambda service: service.find(job_id, principal.key_id))
    seen = int(last_event_id) if last_event_id and last_event_id.isdecimal() else 0
    stream = while_admitted(events(desk.watcher, row, seen),
                            lambda: guard.still_admits(principal))
    return EventSourceResponse(stream, ping=HEARTBEAT)


@router.get("/jobs/{job_id}/plan.svg", summary="See a job's plan", response_class=Response,
            responses=PICTURE)
async def draw_plan(job_id: JobId, principal: Jobs, desk: Desk) -> Response:
    """Return a picture of a job's best plan so far."""
    return Response(await desk.picture(job_id, principal.key_id), media_type="image/svg+xml")


@router.get("/jobs/{job_id}/explain", summary="Explain a job's plan",
            response_model=ExplainReply, responses=EXPLAINED)
async def explain_plan(
    request: Request, job_id: JobId, principal: Jobs, planning: Planning, desk: Desk,
    plans: Plans,
    customer: Annotated[str | None, Query(
        description="Id of the customer of whom it is asked why he is served where he is. Left "
        "out: of nobody.")] = None,
    shipment: Annotated[str | None, Query(
        description="Id of the shipment of which the same is asked.")] = None,
    drones: Annotated[bool, Query(
        description="Whether to tell what drones save: each sortie, and all in sum.")] = False,
    time_limit: Annotated[float, Query(
        gt=0, le=MAX_TIME_LIMIT, description="Seconds until the reply: what was not tried by then "
        "is not in it.")] = 1.0,
) -> Response:
    """Return the same as `POST /explain` of a job's best plan so far."""
    wanted, plan = await desk.ask(lambda jobs: jobs.plan(job_id, principal.key_id))
    reply = await plans.answer(
        planning, request, answers.explain_planned, wanted, plan, Subject(customer, shipment),
        drones, ExplainOptions(time_limit=time_limit))
    return Response(reply, media_type="application/json")


@router.get("/jobs/{job_id}/flights", summary="Write a job's flights", response_class=Response,
            responses=WRITTEN)
async def write_flights(
    request: Request, job_id: JobId, principal: Jobs, planning: Planning, desk: Desk,
    file_format: Annotated[FlightFormat, Query(alias="format", description=FORMAT_TEXT)],
    plans: Plans,
    wpml: Annotated[WpmlInput, Depends(wpml_asked)],
    per: Annotated[Per, Query(description=PER_TEXT)] = "sortie",
) -> Response:
    """Return the same as `POST /flights` of a job's best plan so far."""
    wanted, plan = await desk.ask(lambda jobs: jobs.plan(job_id, principal.key_id))
    return sent(await plans.answer(planning, request, fly_planned, wanted, plan,
                                   file_format, per, wpml))


@router.delete("/jobs/{job_id}", summary="Stop a job", response_model=JobReply, responses=FOUND)
async def stop_job(job_id: JobId, principal: Jobs, desk: Desk) -> Response:
    """Stop a job that waits or runs, keep its best plan so far, and return it."""
    content = await desk.ask(
        lambda service: service.reply(service.cancel(job_id, principal.key_id)))
    return Response(content, media_type="application/json")


def _submission(kind: Kind, body: ReceivedBody, principal: Principal, key: str | None,
                webhook: str | None) -> Submission:
    return Submission(kind, body.content, principal.key_id, principal.client, key, webhook)


async def _submit(request: Request, desk: JobDesk, submission: Submission) -> Response:
    """Accept a job, or find the one that the same request made before."""
    if submission.webhook is not None:
        check_url(submission.webhook, request.app.state.settings)

    async with watching(request) as should_stop:
        def submit(service: JobService) -> tuple[JobRow, bool, bytes]:
            row, is_new = service.submit(submission, should_stop)
            return row, is_new, service.reply(row)

        row, is_new, content = await desk.ask(submit)
    if is_new:
        request.app.state.metrics.count_submitted_job(submission.kind)
    return Response(content, 202 if is_new else 200, {"Location": f"/jobs/{row.id}"},
                    media_type="application/json")
