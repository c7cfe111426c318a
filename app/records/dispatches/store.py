"""Dispatches in the database."""

import zlib
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from typing import Any

from pydantic import TypeAdapter
from sqlalchemy import ColumnElement, Connection, Engine, case, delete, func, insert, select, update

from app.database.tables import DAYS, EVENTS, LINKS, PROOFS
from app.plans.flights.flight import Flight
from app.records.clock import now_ms
from app.records.dispatches.rows import (
    PLAN_SEEN, DayRow, EventRow, ToldRow, VehicleLinkRow,
)
from app.records.dispatches.schemas import StepReply
from app.requests.plan_reading import parse_plan
from app.schemas.plan import PlanInput

FAST = 1
"""zlib's level."""

STEPS = TypeAdapter(list[StepReply])
FLIGHTS = TypeAdapter(list[Flight])

Flown = Mapping[str, Sequence[Flight]]
"""Flights by the vehicle from which they are flown."""


@dataclass(frozen=True)
class VehicleWork:
    """What vehicles do by another plan of their day."""

    steps: Sequence[tuple[VehicleLinkRow, Sequence[StepReply]]]  # that links have from now on
    links: Sequence[tuple[VehicleLinkRow, Sequence[StepReply]]]  # of vehicles that had none
    flown: Flown


BATCH = 200
"""Dispatches deleted at a time."""

# A plan that is gone on from is read by what decides; lines and words aren't needed twice.
_SHOWN = {"geometry": True, "info": True, "load": True, "lateness": True}
LEFT_OUT: dict[str, Any] = {
    **dict.fromkeys(("cost", "summary", "solver", "energy_models", "hubs", "rules", "replan",
                     "legs", "warnings"), True),
    "routes": {"__all__": {"trips": {"__all__": {
        "stops": {"__all__": {**_SHOWN, "waiting": True}},
        "sorties": {"__all__": {"recovery_geometry": True, "customers": {"__all__": _SHOWN}}},
    }}}},
    "unassigned": {"__all__": {"reasons": True}},
}
"""What is left out of plans that are kept."""

_DISPATCH = [DAYS.c[each.name] for each in fields(DayRow)]
_LINK = [column for column in LINKS.c if column.name not in ("steps", "flights")]
_EVENT = [EVENTS.c[name] for name in ("id", "step", "outcome", "time", "reason", "number")]


class DispatchStore:
    """The dispatches of all processes that share a database."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine

    def add(self, dispatch: DayRow, plan: PlanInput,
            links: Sequence[tuple[VehicleLinkRow, Sequence[StepReply]]], flown: Flown,
            refuse: Callable[[int], None]) -> None:
        """Keep a dispatch unless `refuse` raises, told how many its client has open. In place."""
        open_ones = (select(func.count()).select_from(DAYS)
                     .where(DAYS.c.client == dispatch.client,
                            DAYS.c.ends_at > now_ms()))
        with self._engine.begin() as connection:
            refuse(connection.scalar(open_ones) or 0)
            connection.execute(insert(DAYS).values(
                **asdict(dispatch), plan=_packed_plan(plan)))
            for link, steps in links:
                _add_link(connection, link, _packed_work(steps, flown.get(link.vehicle)))

    def find(self, dispatch: str) -> DayRow | None:
        """Return a dispatch."""
        statement = select(*_DISPATCH).where(DAYS.c.id == dispatch)
        with self._engine.connect() as connection:
            row = connection.execute(statement).mappings().first()
        return None if row is None else DayRow(**row)

    def page(self, owner: str, limit: int) -> list[DayRow]:
        """Return an owner's dispatches, the youngest first."""
        statement = (select(*_DISPATCH).where(DAYS.c.owner == owner)
                     .order_by(DAYS.c.created_at.desc(), DAYS.c.id).limit(limit))
        with self._engine.connect() as connection:
            return [DayRow(**row) for row in connection.execute(statement).mappings()]

    def plan(self, dispatch: str) -> PlanInput:
        """Return the plan of a dispatch that there is; nobody drives if there is none yet."""
        with self._engine.connect() as connection:
            content = connection.scalar(
                select(DAYS.c.plan).where(DAYS.c.id == dispatch))
        return parse_plan(zlib.decompress(content) if content else b'{"routes": []}')

    def link(self, link: str) -> tuple[VehicleLinkRow, DayRow] | None:
        """Return a link and the dispatch that it is of."""
        with self._engine.connect() as connection:
            row = connection.execute(select(*_LINK).where(LINKS.c.id == link)).mappings().first()
        found = None if row is None else VehicleLinkRow(**row)
        dispatch = None if found is None else self.find(found.dispatch)
        return None if found is None or dispatch is None else (found, dispatch)

    def links(self, dispatch: str) -> list[VehicleLinkRow]:
        """Return each vehicle's youngest link, in the plan's order."""
        statement = (select(*_LINK).where(LINKS.c.dispatch == dispatch)
                     .order_by(LINKS.c.position, LINKS.c.revoked_at.is_(None)))
        with self._engine.connect() as connection:
            rows = [VehicleLinkRow(**row) for row in connection.execute(statement).mappings()]
        return list({row.position: row for row in rows}.values())

    def steps(self, link: str) -> list[StepReply]:
        """Return the steps of a link that there is."""
        with self._engine.connect() as connection:
            content = connection.scalar(select(LINKS.c.steps).where(LINKS.c.id == link))
        return STEPS.validate_json(zlib.decompress(content or b""))

    def steps_by_vehicle(self, dispatch: str) -> dict[str, list[StepReply]]:
        """Return the steps of all vehicles of a dispatch."""
        statement = (select(LINKS.c.vehicle, LINKS.c.steps).where(LINKS.c.dispatch == dispatch)
                     .order_by(LINKS.c.revoked_at.is_(None)))
        with self._engine.connect() as connection:
            return {vehicle: STEPS.validate_json(zlib.decompress(content))
                    for vehicle, content in connection.execute(statement)}

    def flights(self, link: str) -> list[Flight]:
        """Return the flights of the drones of a link that there is."""
        with self._engine.connect() as connection:
            content = connection.scalar(select(LINKS.c.flights).where(LINKS.c.id == link))
        return [] if content is None else FLIGHTS.validate_json(zlib.decompress(content))

    def replace_link(self, former: VehicleLinkRow, link: VehicleLinkRow) -> None:
        """Put a link in place of another, which is revoked. In place."""
        with self._engine.begin() as connection:
            work = connection.execute(select(LINKS.c.steps, LINKS.c.flights).where(
                LINKS.c.id == former.id)).mappings().one()
            _revoke(connection, [former.id])
            _add_link(connection, link, work)

    def change(self, dispatch: str, plan: PlanInput, work: VehicleWork) -> None:
        """Put another plan in a dispatch's place. In place."""
        with self._engine.begin() as connection:
            connection.execute(update(DAYS).where(DAYS.c.id == dispatch)
                               .values(plan=_packed_plan(plan)))
            put_work(connection, dispatch, work)

    def revoke(self, links: Collection[str]) -> None:
        """Let links open nothing any more. In place."""
        with self._engine.begin() as connection:
            _revoke(connection, links)

    def end(self, dispatch: str) -> None:
        """End a dispatch now, unless it has ended. In place."""
        now = now_ms()
        with self._engine.begin() as connection:
            connection.execute(update(DAYS).values(ends_at=now).where(
                DAYS.c.id == dispatch, DAYS.c.ends_at > now))

    def note_opening(self, link: str) -> None:
        """Note when a link was opened first. In place."""
        with self._engine.begin() as connection:
            connection.execute(update(LINKS).values(opened_at=now_ms()).where(
                LINKS.c.id == link, LINKS.c.opened_at.is_(None)))

    def add_events(self, link: VehicleLinkRow, events: Sequence[ToldRow],
                   refuse: Callable[[int], None]) -> None:
        """Keep events that aren't there yet, in order, unless `refuse` raises. In place.

        `refuse` is told how many the link would have told.
        """
        origin = str(link.position)
        mine = (EVENTS.c.day == link.dispatch, EVENTS.c.origin == origin)
        with self._engine.begin() as connection:
            revision = revision_of(connection, DAYS.c.id == link.dispatch) or 0
            there = set(connection.scalars(select(EVENTS.c.id).where(*mine)))
            new = {event.id: event for event in events if event.id not in there}
            refuse(len(there) + len(new))
            if new:
                add_events(connection, link.dispatch, revision, origin, list(new.values()))

    def seen(self, dispatch: str) -> dict[str, int]:
        """Return when each vehicle's driver last saw what is new, milliseconds since 1970."""
        statement = (select(EVENTS.c.vehicle, func.max(EVENTS.c.time)).group_by(EVENTS.c.vehicle)
                     .where(EVENTS.c.day == dispatch, EVENTS.c.kind == PLAN_SEEN))
        with self._engine.connect() as connection:
            return dict(connection.execute(statement).all())

    def events(self, dispatch: str) -> dict[str, list[EventRow]]:
        """Return what was told of steps, by vehicle."""
        statement = (select(EVENTS.c.vehicle, *_EVENT)
                     .where(EVENTS.c.day == dispatch, EVENTS.c.step.is_not(None))
                     .order_by(EVENTS.c.number))
        found: dict[str, list[EventRow]] = {}
        with self._engine.connect() as connection:
            for vehicle, *row in connection.execute(statement):
                found.setdefault(vehicle, []).append(EventRow(*row))
        return found


def revision_of(connection: Connection, day: ColumnElement[bool]) -> int | None:
    """Return the number of a day's last event, to which no other adds meanwhile; None: no such day.

    It is written: SQLite keeps others away from what is written alone.
    """
    return connection.scalar(
        update(DAYS).where(day).values(revision=DAYS.c.revision).returning(DAYS.c.revision))


def log_events(connection: Connection, day: str, revision: int, origin: str,
               events: Sequence[ToldRow]) -> None:
    """Write events behind the last of a day, whose revision is then to be raised. In place."""
    received_at = now_ms()
    connection.execute(insert(EVENTS), [
        {**asdict(event), "day": day, "origin": origin, "number": number,
         "received_at": received_at} for number, event in enumerate(events, revision + 1)])


def add_events(connection: Connection, day: str, revision: int, origin: str,
               events: Sequence[ToldRow]) -> None:
    """Keep events that follow the last of a day, and are to be planned for. In place."""
    log_events(connection, day, revision, origin, events)
    last = revision + len(events)
    planned = {} if all(event.kind == PLAN_SEEN for event in events) else {
        "asked": case((DAYS.c.request.is_not(None), last), else_=0)}
    connection.execute(update(DAYS).where(DAYS.c.id == day).values(revision=last, **planned))


def put_work(connection: Connection, dispatch: str, work: VehicleWork) -> None:
    """Have links tell what their vehicles do by another plan. In place."""
    for link, listed in work.steps:
        connection.execute(update(LINKS).where(LINKS.c.id == link.id).values(
            name=link.name, **_packed_work(listed, work.flown.get(link.vehicle))))
    for new, listed in work.links:
        _add_link(connection, new, _packed_work(listed, work.flown.get(new.vehicle)))


def delete_expired(engine: Engine) -> None:
    """Delete all that is kept of dispatches that expired. In place."""
    expired = select(DAYS.c.id).where(DAYS.c.expires_at <= now_ms()).limit(BATCH)
    while True:
        with engine.begin() as connection:
            ids = list(connection.scalars(expired))
            for table, column in ((EVENTS, EVENTS.c.day), (LINKS, LINKS.c.dispatch),
                                  (PROOFS, PROOFS.c.day),
                                  (DAYS, DAYS.c.id)):
                connection.execute(delete(table).where(column.in_(ids)))
        if len(ids) < BATCH:
            return


def _packed_plan(plan: PlanInput) -> bytes:
    content = plan.model_dump_json(exclude=LEFT_OUT, exclude_none=True)
    return zlib.compress(content.encode(), FAST)


def _packed_work(steps: Sequence[StepReply],
                 flights: Sequence[Flight] | None) -> dict[str, bytes | None]:
    """Return the columns of a link that tell what its vehicle does."""
    return {"steps": zlib.compress(STEPS.dump_json(list(steps)), FAST),
            "flights": zlib.compress(FLIGHTS.dump_json(list(flights)), FAST) if flights else None}


def _add_link(connection: Connection, link: VehicleLinkRow, work: Mapping[Any, Any]) -> None:
    connection.execute(insert(LINKS).values(**asdict(link), **work))


def _revoke(connection: Connection, links: Collection[str]) -> None:
    connection.execute(update(LINKS).values(revoked_at=now_ms()).where(
        LINKS.c.id.in_(links), LINKS.c.revoked_at.is_(None)))
