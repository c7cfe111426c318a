"""Endpoints of kept plans."""

import re
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Header, Path, Query, Request, Response, Security
from fastapi.security import APIKeyHeader

from app.records.days.memory import DayMemory
from app.records.days.runner import memory_of
from app.records.kept import live, replies
from app.records.kept.desk import KeptDesk
from app.records.kept.errors import UnknownLinkError
from app.records.kept.reading import read_content
from app.records.kept.rows import KeptRow, Precondition
from app.records.kept.schemas import (
    KeptPlanChange, KeptPlanInput, KeptPlanListReply, KeptPlanReply, KeptPlanSummary, LinkListReply,
    NewLinkReply, SharedPlanReply,
)
from app.records.kept.store import KeptStore
from app.requests.paging import cursor_of, read_cursor
from app.requests.reading import read_model
from app.schemas.openapi import json_body, problems
from app.serving.access.guard import Guard, Plan
from app.serving.load.bodies import Body

router = APIRouter(tags=["kept plans"])

MAX_PAGE = 500

ID_PATTERN = "^[A-Za-z0-9_-]{1,64}$"

UNAVAILABLE = "The database can't be reached: try again soon."
UNKNOWN = "There is no such plan, or it is another's."
CHANGED = "The plan isn't the one that `If-Match` or `If-None-Match` says."
VERSION_NEEDED = "There is such a plan, and no `If-Match` says that it is known."
NO_ROOM = "As many plans or bytes are kept as may be."
PARAMETERS = "A parameter or the body is not valid."

LISTED = problems(_422=PARAMETERS, _503=UNAVAILABLE)
FOUND = LISTED | problems(_404=UNKNOWN)
NO_DAY = problems(_404="There is no such day, or it is another's.")
CHANGEABLE = problems(400, 413) | LISTED | problems(_412=CHANGED, _428=VERSION_NEEDED)
KEPT: dict[int | str, dict[str, Any]] = {
    201: {"model": KeptPlanSummary, "description": "The plan is new."},
    **CHANGEABLE, **NO_DAY, **problems(_409=NO_ROOM)}
DELETED = FOUND | problems(_412=CHANGED)

PlanId = Annotated[str, Path(
    pattern=ID_PATTERN, description="Id of the plan: letters, digits, `-` and `_`, such as a UUID. "
    "Its owner chooses it, so that what is sent again makes no second plan.")]
LinkId = Annotated[str, Path(pattern="^[0-9a-f]{12}$", description="Id of the link.")]
IfMatch = Annotated[str | None, Header(
    alias="If-Match", max_length=1000, description="`ETag` of the version that is to be changed; "
    "`*`: whatever is there.")]
IfNoneMatch = Annotated[str | None, Header(
    alias="If-None-Match", pattern=r"^\*$", description="`*`: only if there is none of this id.")]

SHARE_TOKEN = APIKeyHeader(name="X-Share-Token", scheme_name="ShareToken", auto_error=False,
                           description="Token of a link, which shows one plan.")

_TAG = re.compile(r'(W/)?"([^"]*)"')


async def get_desk(request: Request) -> KeptDesk:
    """Return where to turn to about kept plans."""
    desk: KeptDesk = request.app.state.kept
    return desk


async def get_memory(request: Request) -> DayMemory:
    """Return how days stood last."""
    return memory_of(request.app.state.days)


Desk = Annotated[KeptDesk, Depends(get_desk)]
Memory = Annotated[DayMemory, Depends(get_memory)]


@router.get("/plans", summary="List kept plans", response_model=KeptPlanListReply,
            responses=LISTED)
async def list_kept_plans(
    principal: Plan, desk: Desk,
    limit: Annotated[int, Query(ge=1, le=MAX_PAGE, description="Most plans of a page.")] = 50,
    cursor: Annotated[str | None, Query(max_length=200, description="`next` of the page before. "
                                        "Left out: the first page.")] = None,
) -> Response:
    """Return the caller's plans without their content, those changed last first."""
    before = None if cursor is None else read_cursor(cursor, _is_plan_id)
    rows, room = await desk.ask(
        lambda store: (store.page(principal.key_id, limit + 1, before), store.room))
    more = cursor_of(rows[limit - 1].changed_at, rows[limit - 1].id) if len(rows) > limit else None
    return _json(replies.page(rows[:limit], more, room))


@router.put("/plans/{plan_id}", summary="Keep a plan", response_model=KeptPlanSummary,
            responses=KEPT, openapi_extra=json_body(KeptPlanInput))
async def keep_plan(plan_id: PlanId, principal: Plan, desk: Desk, body: Body, memory: Memory,
                    if_match: IfMatch = None, if_none_match: IfNoneMatch = None) -> Response:
    """Keep a problem and its plan, or a day's, new or in place of a version that is known."""
    known = _precondition(if_match, if_none_match)

    def keep(store: KeptStore) -> tuple[KeptRow, bool]:
        content = live.content_of(store, memory, principal.key_id, read_content(body.content))
        return store.write(principal.key_id, plan_id, content, known)

    (row, is_new), room = await desk.ask(lambda store: (keep(store), store.room))
    location = {"Location": f"/plans/{row.id}"} if is_new else {}
    return _json(replies.summary(row, room), 201 if is_new else 200, {**_tag(row), **location})


@router.get("/plans/{plan_id}", summary="Read a kept plan", response_model=KeptPlanReply,
            responses=FOUND)
async def read_kept_plan(plan_id: PlanId, principal: Plan, desk: Desk,
                         memory: Memory) -> Response:
    """Return a plan with its content."""
    (row, body), room = await desk.ask(lambda store: (
        live.read(store, memory, store.read(principal.key_id, plan_id)), store.room))
    return _json(replies.whole(row, body, room), headers=_tag(row))


@router.patch("/plans/{plan_id}", summary="Rename a kept plan", response_model=KeptPlanSummary,
              responses=CHANGEABLE | FOUND, openapi_extra=json_body(KeptPlanChange))
async def rename_kept_plan(plan_id: PlanId, principal: Plan, desk: Desk, body: Body,
                           if_match: IfMatch = None) -> Response:
    """Give a plan another name or note."""
    known = _precondition(if_match, None)

    def rename(store: KeptStore) -> KeptRow:
        change = read_model(body.content, KeptPlanChange)
        return store.rename(principal.key_id, plan_id, change.name, change.note, known)

    row, room = await desk.ask(lambda store: (rename(store), store.room))
    return _json(replies.summary(row, room), headers=_tag(row))


@router.delete("/plans/{plan_id}", summary="Delete a kept plan", status_code=204,
               response_class=Response, responses=DELETED)
async def delete_kept_plan(plan_id: PlanId, principal: Plan, desk: Desk,
                           if_match: IfMatch = None) -> Response:
    """Delete a plan with the links to it, for good; without `If-Match` whatever it is."""
    known = _precondition(if_match, None)
    await desk.ask(lambda store: store.remove(principal.key_id, plan_id, known))
    return Response(status_code=204)


@router.post("/plans/{plan_id}/links", summary="Share a kept plan", status_code=201,
             response_model=NewLinkReply, responses=FOUND | problems(
                 _409="The plan has as many links as may be."))
async def share_plan(plan_id: PlanId, principal: Plan, desk: Desk) -> Response:
    """Make a link by which anybody who has it sees the plan, as it is then, without a key."""
    link, token = await desk.ask(lambda store: store.add_link(principal.key_id, plan_id))
    return _json(replies.new_link(link, token), 201)


@router.get("/plans/{plan_id}/links", summary="List the links of a kept plan",
            response_model=LinkListReply, responses=FOUND)
async def list_plan_links(plan_id: PlanId, principal: Plan, desk: Desk) -> Response:
    """Return the links by which a plan is shared, without their tokens."""
    links = await desk.ask(lambda store: store.links(principal.key_id, plan_id))
    return _json(replies.links(links))


@router.delete("/plans/{plan_id}/links/{link_id}", summary="End a link", status_code=204,
               response_class=Response, responses=LISTED | problems(
                   _404="There is no such link, or it is another's."))
async def end_link(plan_id: PlanId, link_id: LinkId, principal: Plan, desk: Desk) -> Response:
    """Have a link show nothing to anybody any more."""
    await desk.ask(lambda store: store.remove_link(principal.key_id, plan_id, link_id))
    return Response(status_code=204)


@router.get("/shared-plan", summary="See a shared plan", response_model=SharedPlanReply,
            responses=problems(_404="No plan is shared by this token.", _503=UNAVAILABLE))
async def see_shared_plan(
    request: Request, desk: Desk, memory: Memory,
    token: Annotated[str | None, Security(SHARE_TOKEN)] = None,
) -> Response:
    """Return the plan that a link shows. No key is needed, and nothing can be changed by it."""
    try:
        row, body = await desk.ask(
            lambda store: live.read(store, memory, store.shared(token or "")))
    except UnknownLinkError:
        guard: Guard = request.app.state.guard
        guard.count_wrong_token(request)
        raise
    return _json(replies.shared(row, body))


def _json(content: bytes, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    return Response(content, status, headers, media_type="application/json")


def _tag(row: KeptRow) -> dict[str, str]:
    return {"ETag": f'"{row.version}"'}


def _is_plan_id(text: str) -> bool:
    return re.fullmatch(ID_PATTERN, text) is not None


def _precondition(if_match: str | None, if_none_match: str | None) -> Precondition:
    """Return what a client says that it knows; weak tags are none of ours."""
    if if_match is None:
        return Precondition(must_be_new=if_none_match is not None)
    if if_match.strip() == "*":
        return Precondition(any_version=True, must_be_new=if_none_match is not None)
    strong = frozenset(tag for weak, tag in _TAG.findall(if_match) if not weak)
    # What is no tag at all fits no version either.
    return Precondition(strong or frozenset({""}), must_be_new=if_none_match is not None)
