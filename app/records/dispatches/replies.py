"""Dispatches -> replies."""

from app.records.clock import now_ms
from app.records.dispatches.instants import instant
from app.records.dispatches.links import address_of, qr_of
from app.records.dispatches.rows import DayRow
from app.records.dispatches.schemas import (
    BREAKDOWN, DispatchReply, DispatchSummary, DriverLinkReply, LinkState,
)
from app.records.dispatches.service import Followed, LinkStanding
from app.records.dispatches.standing import standing_reply


def summary(row: DayRow) -> DispatchSummary:
    """Return a dispatch without its links."""
    return DispatchSummary(
        id=row.id, created_at=instant(row.created_at), time_zone=row.time_zone, day=row.day,
        plan_start=instant(row.plan_start, row.zone_offset),
        ends_at=instant(row.ends_at, row.zone_offset), expires_at=instant(row.expires_at))


def dispatch_reply(followed: Followed, base: str) -> DispatchReply:
    """Return a dispatch; `base` is the address of the service, of which links are made."""
    row = followed.dispatch
    return DispatchReply(
        **dict(summary(row)),
        links=[_link_reply(followed, link, base, row.ends_at <= now_ms())
               for link in followed.links])


def _link_reply(followed: Followed, known: LinkStanding, base: str,
                is_over: bool) -> DriverLinkReply:
    link = known.link
    state: LinkState = "over" if is_over else "open"
    if link.revoked_at is not None:
        state = "revoked"
    token = followed.tokens.get(link.id)
    address = None if token is None else address_of(base, token.text)
    told = standing_reply(known.standing, known.steps)
    steps = [step for step in told if step.id != BREAKDOWN]
    count = sum(step.state == "failed" for step in steps)
    return DriverLinkReply(
        id=link.id, vehicle=link.vehicle, name=link.name or link.vehicle, state=state, url=address,
        qr=None if address is None else qr_of(address),
        opened_at=None if link.opened_at is None else instant(link.opened_at),
        seen_at=None if known.seen_at is None else instant(known.seen_at),
        told_at=None if known.told_at is None else instant(known.told_at),
        steps=len(known.steps), done=len(steps) - count, failed=count, standing=told,
        next=next((step.id for step in known.steps if step.id not in known.standing), None))
