"""Endpoints of plans."""

from typing import Annotated

from fastapi import APIRouter, Depends, Request, Response

from app.plans import answers
from app.plans.desk import PlanDesk
from app.schemas.check import CheckReply, CheckRequest
from app.schemas.explain import ExplainReply, ExplainRequest
from app.schemas.fit import FitReply, FitRequest
from app.schemas.openapi import ERROR_RESPONSES, EXAMPLES, json_body
from app.schemas.quote import QuoteReply, QuoteRequest
from app.schemas.request import PlanRequest
from app.schemas.response import PlanReply, WarningsReply
from app.serving.access.guard import Plan
from app.serving.load.abandoned import Planning
from app.serving.load.bodies import Body
from app.serving.load.readings import Reading

router = APIRouter()

CHECK_EXAMPLES = {
    "check": "A plan whose truck is too full, and too late at its second customer",
    "check_untimed": "The same stops in another order, whose times are made",
}
FIT_EXAMPLES = {"fit": "Where a new order fits best"}
EXPLAIN_EXAMPLES = {"explain": "Why truck-1 serves B, and what a drone saves"}
CHECK_ERROR_RESPONSES = {status: response for status, response in ERROR_RESPONSES.items()
                         if status != 500}
"""A plan of whatever kind is an answer."""


async def get_desk(request: Request) -> PlanDesk:
    """Return who has plans made for this application."""
    desk: PlanDesk = request.app.state.plans
    return desk


Plans = Annotated[PlanDesk, Depends(get_desk)]


@router.post("/plan", summary="Plan deliveries", tags=["planning"], response_model=PlanReply,
             responses=ERROR_RESPONSES, openapi_extra=json_body(PlanRequest, EXAMPLES))
async def plan(request: Request, principal: Plan, planning: Planning, body: Body,
               plans: Plans) -> Response:
    """Return routes, costs and load rates; customers that can't be served stay unassigned."""
    reply = await plans.answer(planning, request, answers.plan, body)
    return Response(reply, media_type="application/json")


@router.post("/check", summary="Judge a plan", tags=["planning"], response_model=CheckReply,
             responses=CHECK_ERROR_RESPONSES, openapi_extra=json_body(CheckRequest, CHECK_EXAMPLES))
async def check(request: Request, principal: Plan, planning: Planning, body: Body,
                plans: Plans) -> Response:
    """Return every rule that a plan breaks, and its true cost by term."""
    reply = await plans.answer(planning, request, answers.check, body)
    return Response(reply, media_type="application/json")


@router.post("/warnings", summary="Look for what is hardly meant", tags=["planning"],
             response_model=WarningsReply, responses=CHECK_ERROR_RESPONSES,
             openapi_extra=json_body(PlanRequest, {"smallest": EXAMPLES["smallest"]}))
async def warnings(request: Request, principal: Plan, reading: Reading, body: Body,
                   plans: Plans) -> Response:
    """Return what looks wrong with a request, or its errors, without planning it."""
    reply = await reading.run(lambda: plans.warnings(body))
    return Response(reply, media_type="application/json")


@router.post("/explain", summary="Explain a plan", tags=["planning"], response_model=ExplainReply,
             responses=ERROR_RESPONSES,
             openapi_extra=json_body(ExplainRequest, EXPLAIN_EXAMPLES))
async def explain(request: Request, principal: Plan, planning: Planning, body: Body,
                  plans: Plans) -> Response:
    """Return what it would cost to serve a customer elsewhere, and what drones save."""
    reply = await plans.answer(planning, request, answers.explain, body)
    return Response(reply, media_type="application/json")


@router.post("/quote", summary="Price slots for an order", tags=["planning"],
             response_model=QuoteReply, responses=CHECK_ERROR_RESPONSES,
             openapi_extra=json_body(QuoteRequest))
async def quote(request: Request, principal: Plan, planning: Planning, body: Body,
                plans: Plans) -> Response:
    """Return for each slot of an order whether a plan can keep it, and what it costs more."""
    reply = await plans.answer(planning, request, answers.quote, body)
    return Response(reply, media_type="application/json")


@router.post("/fit", summary="Find a customer's best places", tags=["planning"],
             response_model=FitReply, responses=CHECK_ERROR_RESPONSES,
             openapi_extra=json_body(FitRequest, FIT_EXAMPLES))
async def fit(request: Request, principal: Plan, planning: Planning, body: Body,
              plans: Plans) -> Response:
    """Return the best places for a customer in a plan whose others stay, each with its price."""
    reply = await plans.answer(planning, request, answers.fit, body)
    return Response(reply, media_type="application/json")
