"""Endpoints of days."""

import asyncio
from collections.abc import AsyncGenerator
from contextlib import suppress
from functools import partial
from typing import Annotated, Any

from fastapi import APIRouter, Header, Path, Query, Request, Response
from pydantic import BaseModel
from pydantic_core import from_json, to_json
from sqlalchemy import Engine
from sse_starlette import EventSourceResponse, ServerSentEvent

from app.plans import answers
from app.plans.routes import Plans
from app.records.days.errors import DayMovedError, SlotTakenError
from app.records.days.events import DayEventsRequest
from app.records.days.fold import KINDS
from app.records.days.runner import DayRunner, memory_of
from app.records.days.schemas import (
    AcceptRequest, CustomerLinksReply, DayEventsReply, DayPlanReply, DayReply, DayRequest,
    LoggedReply,
)
from app.records.days.service import DayService, logged
from app.records.days.store import DayStore
from app.records.dispatches.rows import DayRow
from app.records.dispatches.store import DispatchStore
from app.records.jobs.events import while_admitted
from app.records.prepared import Database, PreparedDatabase
from app.requests.bounds import Bounds
from app.schemas.day import Times
from app.schemas.openapi import event_stream, json_body, problems
from app.schemas.quote import OrderAsked, QuoteReply
from app.serving.access.guard import Guard, Jobs
from app.serving.load.abandoned import Planning
from app.serving.load.bodies import Body
from app.serving.load.received import ReceivedBody

router = APIRouter(tags=["days"])

LOOK = 0.2
"""Seconds between two looks for what happened, for each who follows."""

HEARTBEAT = 15
"""Seconds after which a stream says that it is alive."""

UNAVAILABLE = "The database can't be reached: try again soon."
FOUND = problems(_404="There is no such day, or it is another's.",
                 _422="A parameter is not valid.", _503=UNAVAILABLE)
BEGUN = problems(400, 413, 422, _409="Another day has this name.",
                 _429="A rate limit is used up, or too many of your days are open.",
                 _503=UNAVAILABLE)
TOLD = problems(400, 413, 422, _404="There is no such day, or it is another's.",
                _409="The day is over, or full.", _503=UNAVAILABLE)

QUOTED = TOLD | problems(_409="The day is over, or has no plan yet.")

ASKED_AGAIN = 20
"""How often it is asked whether a slot can still be kept, where something is told meanwhile."""

Token = Annotated[str, Path(max_length=20_000, description="That of the quote.")]
DayId = Annotated[str, Path(max_length=64, description="Id of the day.")]


@router.post("/days", summary="Begin a day", status_code=201, response_model=DayReply,
             responses=BEGUN, openapi_extra=json_body(DayRequest))
async def begin_day(request: Request, principal: Jobs, database: Database,
                    body: Body) -> Response:
    """Keep a day, which is planned at once and after each of its events."""
    def begin(engine: Engine) -> DayReply:
        service = _service(request, engine)
        row = service.begin(body.content, principal.key_id, principal.client)
        return service.read(row.id, principal.key_id)

    reply = await database.reach(begin)
    _hurry(request)
    return _json(reply, 201, {"Location": f"/days/{reply.id}"})


@router.get("/days/{day_id}", summary="Read how a day stands", response_model=DayReply,
            responses=FOUND)
async def read_day_state(request: Request, day_id: DayId, principal: Jobs,
                         database: Database) -> Response:
    """Return its orders, its vehicles, and whether the plan counts with all that was told."""
    return _json(await database.reach(
        lambda engine: _service(request, engine).read(day_id, principal.key_id)))


@router.post("/days/{day_id}/events", summary="Tell what happened", status_code=202,
             response_model=DayEventsReply, responses=TOLD,
             openapi_extra=json_body(DayEventsRequest))
async def tell_day(request: Request, day_id: DayId, principal: Jobs, database: Database,
                   body: Body) -> Response:
    """Keep events, all or none; those that were told before count once. A plan follows."""
    reply = await database.reach(lambda engine: _service(request, engine).tell(
        day_id, principal.key_id, body.content))
    _hurry(request)
    return _json(reply, 202)


@router.post("/days/{day_id}/quote", summary="Price slots for an order of a day",
             response_model=QuoteReply, responses=QUOTED, openapi_extra=json_body(OrderAsked))
async def quote_day(request: Request, day_id: DayId, principal: Jobs, database: Database,
                    planning: Planning, plans: Plans, body: Body) -> Response:
    """Return for each slot whether the day can keep it and its cost, and a token to accept one."""
    asked = await database.reach(lambda engine: _service(request, engine).asked_of(
        day_id, principal.key_id, body.content))
    reply = await plans.answer(planning, request, answers.quote_day,
                               ReceivedBody(asked.body, body.received_at), asked.waiting)
    quoted = await database.reach(lambda engine: _service(request, engine).quoted(
        day_id, principal.key_id, body.content, reply))
    return Response(to_json(quoted), media_type="application/json")


@router.post("/days/{day_id}/quotes/{token}/accept", summary="Accept a slot", status_code=202,
             response_model=DayEventsReply, openapi_extra=json_body(AcceptRequest),
             responses=TOLD | problems(
                 _409="The slot can't be kept any more, or the day is over, or full.",
                 _410="The quote has lapsed."))
async def accept_quote(request: Request, day_id: DayId, token: Token, principal: Jobs,
                       database: Database, planning: Planning, plans: Plans,
                       body: Body) -> Response:
    """Have the order count, if the slot can still be kept; accepted again, it counts once."""
    for _ in range(ASKED_AGAIN):
        asked = await database.reach(lambda engine: _service(request, engine).asked_again(
            day_id, principal.key_id, token, body.content))
        if isinstance(asked, DayEventsReply):
            return _json(asked, 202)
        # Others may have accepted theirs meanwhile, and vehicles have departed.
        reply = await plans.answer(planning, request, answers.quote_day,
                                   ReceivedBody(asked.body, body.received_at), asked.waiting)
        if from_json(reply)["best"] is None:
            break
        accept = partial(lambda revision, engine: _service(request, engine).accept(
            day_id, principal.key_id, token, body.content, revision), asked.revision)
        with suppress(DayMovedError):
            taken = await database.reach(accept)
            _hurry(request)
            return _json(taken, 202)
    raise SlotTakenError


@router.get("/days/{day_id}/links", summary="Get customers' links",
            response_model=CustomerLinksReply, responses=FOUND)
async def customer_links(request: Request, day_id: DayId, principal: Jobs,
                         database: Database) -> Response:
    """Return a link for each order, which opens a page that tells its customer when who comes."""
    base = request.app.state.settings.public_url or str(request.base_url)
    return _json(await database.reach(
        lambda engine: _service(request, engine).links(day_id, principal.key_id, base)))


@router.get("/days/{day_id}/plan", summary="Read a day's plan", response_model=DayPlanReply,
            responses=FOUND | problems(_409="There is no plan yet."))
async def read_day_plan(
    request: Request, day_id: DayId, principal: Jobs, database: Database,
    times: Annotated[Times | None, Query(
        description="How instants are told. Left out: as the day's problem asks.")] = None,
) -> Response:
    """Return the plan that counts now: what has happened, and what is to be done."""
    reply = await database.reach(lambda engine: _service(request, engine).plan(
        day_id, principal.key_id, times))
    return Response(to_json(reply), media_type="application/json")


@router.get("/days/{day_id}/problem", summary="Read a day's problem", response_model=dict[str, Any],
            responses=FOUND)
async def read_day_problem(request: Request, day_id: DayId, principal: Jobs,
                           database: Database) -> Response:
    """Return what the day began with, and all orders that its plan has or that are waiting."""
    return Response(to_json(await database.reach(
        lambda engine: _service(request, engine).problem(day_id, principal.key_id))),
        media_type="application/json")


@router.get("/days/{day_id}/events", summary="Follow a day", response_class=EventSourceResponse,
            responses={200: {"description": "Server-sent events, each of its kind.",
                             "content": event_stream(**dict.fromkeys(KINDS, LoggedReply))},
                       **FOUND})
async def follow_day(
    request: Request, day_id: DayId, principal: Jobs, database: Database,
    last_event_id: Annotated[str | None, Header(
        alias="Last-Event-ID", max_length=40,
        description="Number of the last event received, after which to go on.")] = None,
    after: Annotated[int, Query(ge=0, description="The same, for who can't send headers.")] = 0,
) -> EventSourceResponse:
    """Stream all that happens, from the beginning or behind the last event received."""
    guard: Guard = request.app.state.guard
    row = await database.reach(
        lambda engine: _service(request, engine).find(day_id, principal.key_id))
    seen = int(last_event_id) if last_event_id and last_event_id.isdecimal() else after
    return EventSourceResponse(
        while_admitted(_events(database, row, seen), lambda: guard.still_admits(principal)),
        ping=HEARTBEAT)


async def _events(database: PreparedDatabase, row: DayRow,
                  seen: int) -> AsyncGenerator[ServerSentEvent]:
    while True:
        log = partial(lambda after, engine: DayStore(engine).log(row.id, after), seen)
        for event in await database.reach(log):
            yield ServerSentEvent(logged(row, event).model_dump_json(), event=event.kind,
                                  id=str(event.number))
            seen = event.number
        await asyncio.sleep(LOOK)


def _service(request: Request, engine: Engine) -> DayService:
    settings = request.app.state.settings
    return DayService(DayStore(engine), DispatchStore(engine), settings, Bounds.of_plans(settings),
                      request.app.state.plans.policies,
                      memory_of(request.app.state.days))


def _hurry(request: Request) -> None:
    runner: DayRunner | None = request.app.state.days
    if runner is not None:
        runner.hurry()


def _json(reply: BaseModel, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    return Response(reply.model_dump_json(), status, headers, media_type="application/json")
