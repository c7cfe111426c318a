"""Kept plans -> replies as JSON (see `app.records.kept.schemas`)."""

from typing import Any

from pydantic_core import to_json

from app.records.kept.rows import KeptRoom, KeptRow, LinkRow
from app.schemas.instants import instant_of
from app.serving.access.tokens import NewToken

CONSOLE_PATH = "/#shared="
"""Where the console shows a plan, the token behind it: browsers send it to nobody."""


def summary(row: KeptRow, room: KeptRoom) -> bytes:
    """Return a plan without its content."""
    return to_json(_summary(row, room))


def whole(row: KeptRow, body: bytes, room: KeptRoom) -> bytes:
    """Return a plan with its content, which is JSON already."""
    return _joined(_summary(row, room), body)


def page(rows: list[KeptRow], more: str | None, room: KeptRoom) -> bytes:
    """Return plans without their content, and where the next page begins."""
    return to_json({"plans": [_summary(row, room) for row in rows], "next": more})


def new_link(link: LinkRow, token: NewToken) -> bytes:
    """Return a link that was just made."""
    return to_json({**_link(link), "token": token.text, "path": CONSOLE_PATH + token.text})


def links(rows: list[LinkRow]) -> bytes:
    """Return the links of a plan."""
    return to_json({"links": [_link(row) for row in rows]})


def shared(row: KeptRow, body: bytes) -> bytes:
    """Return a plan as a link shows it: nothing of whose it is."""
    return _joined({"name": row.name, "note": row.note, "changed_at": instant_of(row.changed_at),
                    "is_live": row.day is not None}, body)


def _summary(row: KeptRow, room: KeptRoom) -> dict[str, Any]:
    ends = None if room.expiry is None else instant_of(row.changed_at + room.expiry)
    return {"id": row.id, "name": row.name, "note": row.note, "version": row.version,
            "created_at": instant_of(row.created_at), "changed_at": instant_of(row.changed_at),
            "expires_at": ends, "bytes": row.bytes, "customers": row.customers, "cost": row.cost,
            "links": row.links, "day": row.day}


def _link(row: LinkRow) -> dict[str, Any]:
    return {"id": row.id, "created_at": instant_of(row.created_at)}


def _joined(head: dict[str, Any], body: bytes) -> bytes:
    """Return one JSON object of two, the second of which needn't be read for that."""
    return to_json(head)[:-1] + b"," + body[1:]
