"""Days in the database."""

import zlib
from collections.abc import Callable, Collection, Sequence
from dataclasses import asdict, fields, replace

from pydantic_core import from_json, to_json
from sqlalchemy import ColumnElement, Connection, Engine, func, insert, select, text, update

from app.database.tables import DAYS, EVENTS
from app.records.clock import now_ms
from app.records.days.errors import DayTakenError
from app.records.days.rows import Begun, DayTerms, LoggedEvent
from app.records.dispatches.rows import DayRow, ToldRow
from app.records.dispatches.store import (
    FAST, VehicleWork, add_events, log_events, put_work, revision_of,
)

BY_SERVICE, BY_CLIENT = "service", ""
"""Origins of events that no driver told."""

_DAY = [DAYS.c[each.name] for each in fields(DayRow)]
_EVENT = [EVENTS.c[each.name] for each in fields(LoggedEvent)]


class DayStore:
    """The days of all processes that share a database."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine

    def add(self, day: DayRow, begun: Begun, refuse: Callable[[int], None]) -> DayRow:
        """Keep a day unless `refuse` raises, told how many its client has open; return it.

        One by its name, begun by the same request, is returned in its place.

        Raises
        ------
        DayTakenError
            If its owner began another by its name.
        """
        open_ones = (select(func.count()).select_from(DAYS)
                     .where(DAYS.c.client == day.client, DAYS.c.ends_at > now_ms()))
        request = to_json({"problem": begun.problem, "terms": asdict(begun.terms)})
        with self._engine.begin() as connection:
            if day.name is not None:
                there = _found(connection, day.owner, day.name)
                if there is not None:
                    if not _begun(connection, there.id).is_same(begun):
                        raise DayTakenError
                    return there
            refuse(connection.scalar(open_ones) or 0)
            first = replace(day, revision=1, asked=1)
            connection.execute(insert(DAYS).values(
                **asdict(first), plan=b"", request=zlib.compress(request, FAST)))
            add_events(connection, day.id, 0, BY_SERVICE,
                       [ToldRow("begun", "day.begun", now_ms())])
            return first

    def find(self, owner: str, name: str) -> DayRow | None:
        """Return an owner's day by its id, or the name that its client gave it."""
        with self._engine.connect() as connection:
            return _found(connection, owner, name)

    def begun(self, day: str) -> Begun:
        """Return with what a day began."""
        with self._engine.connect() as connection:
            return _begun(connection, day)

    def plan(self, day: str) -> bytes | None:
        """Return a day's plan as JSON, times in seconds; None: there is none yet."""
        with self._engine.connect() as connection:
            content = connection.scalar(select(DAYS.c.plan).where(DAYS.c.id == day))
        return zlib.decompress(content) if content else None

    def log(self, day: str, after: int = 0) -> list[LoggedEvent]:
        """Return a day's events behind the one of a number."""
        statement = (select(*_EVENT).where(EVENTS.c.day == day, EVENTS.c.number > after)
                     .order_by(EVENTS.c.number))
        with self._engine.connect() as connection:
            return [LoggedEvent(*row) for row in connection.execute(statement)]

    def append(self, day: str, events: Sequence[ToldRow], refuse: Callable[[int, int], None],
               origin: str = BY_CLIENT) -> None:
        """Keep events that aren't there yet, unless `refuse` raises. In place.

        `refuse` is told how many the day has, and how many would be new; not if none would.
        """
        names = [event.id for event in events]
        with self._engine.begin() as connection:
            revision = revision_of(connection, DAYS.c.id == day) or 0
            there = _numbers(connection, day, names, origin)
            new = {event.id: event for event in events if event.id not in there}
            if new:
                refuse(revision, len(new))
                add_events(connection, day, revision, origin, list(new.values()))

    def numbers(self, day: str, names: Collection[str]) -> dict[str, int]:
        """Return the numbers of events that clients told, by name."""
        with self._engine.connect() as connection:
            return _numbers(connection, day, names)

    def planned_by(self, now: int) -> dict[str, int]:
        """Return when days began that are planned and not over, in milliseconds since 1970."""
        statement = select(DAYS.c.id, DAYS.c.plan_start).where(
            DAYS.c.request.is_not(None), DAYS.c.plan_number > 0, DAYS.c.plan_start <= now,
            DAYS.c.ends_at > now)
        with self._engine.connect() as connection:
            return dict(connection.execute(statement).all())

    def planned_at(self, day: str) -> int:
        """Return the time by which a day's last plan was made, in milliseconds since 1970."""
        statement = select(func.max(EVENTS.c.time)).where(
            EVENTS.c.day == day, EVENTS.c.kind == "plan.changed")
        with self._engine.connect() as connection:
            return connection.scalar(statement) or 0

    def claim(self, by: str, seconds: float) -> DayRow | None:
        """Return a day whose plan doesn't count with all that was told, to be planned by one.

        It is that one's for some seconds. In place.
        """
        now = now_ms()
        free = DAYS.c.lease_until.is_(None) | (DAYS.c.lease_until <= now)
        waits = (text("asked > planned"), free)
        with self._engine.connect() as connection:
            # Whoever looks in vain has written nothing.
            days = list(connection.scalars(select(DAYS.c.id).where(*waits).limit(20)))
        for day in days:
            with self._engine.begin() as connection:
                taken = connection.execute(update(DAYS).where(DAYS.c.id == day, *waits).values(
                    lease_until=now + round(seconds * 1000), lease_by=by))
                if taken.rowcount:
                    return _one(connection, DAYS.c.id == day)
        return None

    def renew(self, day: str, by: str, seconds: float) -> None:
        """Keep a day that was claimed for some more seconds. In place."""
        with self._engine.begin() as connection:
            connection.execute(update(DAYS).where(DAYS.c.id == day, DAYS.c.lease_by == by).values(
                lease_until=now_ms() + round(seconds * 1000)))

    def find_any(self, day: str) -> DayRow | None:
        """Return a day by its id alone, whoever's it is."""
        with self._engine.connect() as connection:
            return _one(connection, (DAYS.c.id == day) & DAYS.c.request.is_not(None))

    def publish(self, day: DayRow, by: str, reply: bytes, work: VehicleWork,
                told: Sequence[ToldRow], also: Callable[[Connection], None]) -> bool:
        """Put a plan in place of the one before, with what follows from it. In place.

        `also` is called in the same transaction.

        Returns
        -------
        Whether it counts: not if another has taken the day meanwhile.
        """
        content = zlib.compress(reply, FAST)
        with self._engine.begin() as connection:
            revision = _held(connection, day.id, by)
            if revision is None:
                return False
            log_events(connection, day.id, revision, BY_SERVICE, told)
            also(connection)
            put_work(connection, day.id, work)
            connection.execute(update(DAYS).where(DAYS.c.id == day.id).values(
                plan=content, planned=day.asked, plan_number=DAYS.c.plan_number + 1,
                revision=revision + len(told), failure=None, lease_until=None, lease_by=None,
                ends_at=day.ends_at, expires_at=day.expires_at))
        return True

    def keep_plan(self, day: DayRow, by: str, why: str | None = None) -> None:
        """Leave the plan as it is: it counts with what was told, or `why` not. In place."""
        with self._engine.begin() as connection:
            if _held(connection, day.id, by) is not None:
                connection.execute(update(DAYS).where(DAYS.c.id == day.id).values(
                    planned=day.asked, failure=why, lease_until=None, lease_by=None))


def _found(connection: Connection, owner: str, name: str) -> DayRow | None:
    return _one(connection, (DAYS.c.owner == owner) & DAYS.c.request.is_not(None)
                & ((DAYS.c.id == name) | (DAYS.c.name == name)))


def _one(connection: Connection, which: ColumnElement[bool]) -> DayRow | None:
    row = connection.execute(select(*_DAY).where(which)).first()
    return None if row is None else DayRow(*row)


def _begun(connection: Connection, day: str) -> Begun:
    packed = connection.scalar(select(DAYS.c.request).where(DAYS.c.id == day))
    content = from_json(zlib.decompress(packed or b""))
    return Begun(content["problem"], DayTerms(**content["terms"]))


def _held(connection: Connection, day: str, by: str) -> int | None:
    """Return the number of the last event of a day that a process holds; None: it doesn't.

    No other adds to it meanwhile.
    """
    return revision_of(connection, (DAYS.c.id == day) & (DAYS.c.lease_by == by))


def _numbers(connection: Connection, day: str, names: Collection[str],
             origin: str = BY_CLIENT) -> dict[str, int]:
    return dict(connection.execute(select(EVENTS.c.id, EVENTS.c.number).where(
        EVENTS.c.day == day, EVENTS.c.origin == origin, EVENTS.c.id.in_(names))).all())
