"""What tests ask of the service about plans, and what they make of its replies."""

import json
from typing import Any

import httpx

from app.schemas.check import CheckReply
from app.schemas.openapi import EXAMPLES_DIR
from app.schemas.response import PlanReply

Request = dict[str, Any]


def documented(name: str) -> Request:
    """Return a documented example."""
    request: Request = json.loads((EXAMPLES_DIR / f"{name}.json").read_text("utf-8"))
    return request


def planned(client: httpx.Client, request: Request) -> dict[str, Any]:
    """Return the service's plan, which fits its description."""
    reply = client.post("/plan", json=request)
    assert reply.status_code == 200, reply.text
    plan: dict[str, Any] = reply.json()
    PlanReply.model_validate(plan)
    return plan


def planned_and_judged(client: httpx.Client, request: Request) -> dict[str, Any]:
    """Return the service's plan, which it has to find feasible at the same cost."""
    plan = planned(client, request)
    verdict = judged(client, request, plan)
    assert (verdict["violations"], verdict["cost"]) == ([], plan["cost"])
    assert verdict["summary"] == plan["summary"]
    return plan


def judged(client: httpx.Client, problem: Request, plan: object) -> dict[str, Any]:
    """Return the service's judgement."""
    reply = client.post("/check", json={"problem": problem, "plan": plan})
    assert reply.status_code == 200, reply.text
    verdict: dict[str, Any] = reply.json()
    CheckReply.model_validate(verdict)
    return verdict


def refused(client: httpx.Client, body: object, path: str = "/check") -> list[tuple[str, str]]:
    """Return the code and path of every error of a refused request."""
    reply = client.post(path, json=body)
    assert reply.status_code == 422, reply.text
    assert reply.headers["content-type"] == "application/problem+json"
    return [(error["code"], error["path"]) for error in reply.json()["errors"]]
