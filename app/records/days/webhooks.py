"""What a day's webhook is told: what follows from a plan, a message for each kind of news."""

from pydantic_core import to_json
from sqlalchemy import Engine

from app.records.days.service import logged
from app.records.days.store import BY_SERVICE, DayStore
from app.records.dispatches.instants import instant
from app.records.jobs.webhook import Message


def message_of(engine: Engine, name: str) -> Message | None:
    """Return a message by its name; None: its day is no more, or has no webhook."""
    _, day, number, kind = name.split(":")
    store = DayStore(engine)
    row = store.find_any(day)
    if row is None:
        return None
    url = store.begun(day).terms.webhook
    events = [event for event in store.log(day) if event.origin == BY_SERVICE
              and event.kind == kind and event.id.startswith(f"{number}:")]
    if url is None or not events:
        return None
    body = {"type": kind, "timestamp": instant(events[0].time), "data": {
        "day": row.told_name, "plan_number": int(number),
        "events": [logged(row, event).model_dump(mode="json", exclude_none=True)
                   for event in events]}}
    return Message(url, f"msg_{day}_{number}_{kind}", to_json(body).decode())
