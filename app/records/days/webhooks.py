"""What a day's webhook is told: what follows from a plan, a message for each kind of news."""

from pydantic_core import to_json
from sqlalchemy import Engine

from app.records.days.customers import address_of
from app.records.days.fold import Data
from app.records.days.rows import LoggedEvent
from app.records.days.service import logged
from app.records.days.store import BY_SERVICE, DayStore
from app.records.dispatches.instants import instant
from app.records.jobs.webhook import Message


def message_of(engine: Engine, name: str, base: str | None = None) -> Message | None:
    """Return a message by its name; None: its day is no more, or has no webhook.

    What is told of an order has its customer's link, if `base` is the service's address.
    """
    _, day, number, kind = name.split(":")
    store = DayStore(engine)
    row = store.find_any(day)
    if row is None:
        return None
    begun = store.begun(day)
    url = begun.terms.webhook
    events = [event for event in store.log(day) if event.origin == BY_SERVICE
              and event.kind == kind and event.id.startswith(f"{number}:")]
    if url is None or not events:
        return None

    def told(event: LoggedEvent) -> Data:
        reply = logged(row, event).model_dump(mode="json", exclude_none=True)
        if base is not None and "order" in event.about:
            reply["about"] |= {"link": address_of(base, begun, day, event.about["order"])}
        return reply

    body = {"type": kind, "timestamp": instant(events[0].time), "data": {
        "day": row.told_name, "plan_number": int(number),
        "events": list(map(told, events))}}
    return Message(url, f"msg_{day}_{number}_{kind}", to_json(body).decode())
