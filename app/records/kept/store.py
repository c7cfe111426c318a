"""Kept plans in the database: each change is made on condition that its client knows the last."""

import secrets
import zlib
from typing import Any

from sqlalchemy import (
    ColumnElement, Connection, Engine, Select, and_, delete, func, insert, select, tuple_, update,
)

from app.database.connections import Purpose, alone
from app.database.migrations.running import upgrade
from app.database.tables import KEPT_PLAN_BODIES, KEPT_PLANS, PLAN_LINKS
from app.records.clock import now_ms
from app.records.kept.errors import (
    ChangedError, NoRoomError, UnknownLinkError, UnknownPlanError, VersionNeededError,
)
from app.records.kept.rows import Content, KeptRoom, KeptRow, LinkRow, Precondition
from app.serving.access.tokens import NO_DIGEST, NewToken, TokenKind, is_token

SHARE = TokenKind("share")

VERSION_BYTES = 8

MAX_LINKS = 20
"""Most links of one plan."""


class KeptStore:
    """The kept plans of all processes that share a database.

    Parameters
    ----------
    engine
        Connections to the database.
    room
        How much may be kept.
    """

    def __init__(self, engine: Engine, room: KeptRoom) -> None:
        self.engine = engine
        self.room = room

    def prepare(self) -> None:
        """Make the tables, or bring them to this version; raises as `upgrade` does. In place."""
        upgrade(self.engine)
        with self.engine.begin() as connection:
            self._forget_expired(connection)

    def find(self, owner: str, plan_id: str) -> KeptRow:
        """Return a plan without its content.

        Raises
        ------
        UnknownPlanError
            If the owner has none of that id.
        """
        with self.engine.connect() as connection:
            return self._existing(connection, owner, plan_id)

    def read(self, owner: str, plan_id: str) -> tuple[KeptRow, bytes]:
        """Return a plan and its content as JSON; raises as `find` does."""
        with self.engine.connect() as connection:
            row = self._existing(connection, owner, plan_id)
            return row, _body(connection, owner, plan_id)

    def page(self, owner: str, limit: int, before: tuple[int, str] | None) -> list[KeptRow]:
        """Return plans of one owner, those changed last first.

        Parameters
        ----------
        owner
            Whose plans.
        limit
            How many at most.
        before
            `changed_at` and id of the plan after which to begin; None: with the first.
        """
        query = self._rows().where(KEPT_PLANS.c.owner == owner)
        if before is not None:
            query = query.where(tuple_(KEPT_PLANS.c.changed_at, KEPT_PLANS.c.id)
                                < tuple_(*before))
        query = query.order_by(KEPT_PLANS.c.changed_at.desc(), KEPT_PLANS.c.id.desc()).limit(limit)
        with self.engine.connect() as connection:
            return [KeptRow(**row) for row in connection.execute(query).mappings()]

    def write(self, owner: str, plan_id: str, content: Content,
              known: Precondition) -> tuple[KeptRow, bool]:
        """Keep a plan in place of the one of its id, if there is one. In place.

        What is there already, word for word, is no change whatever the client knows of: the reply
        to an earlier attempt may have been lost.

        Returns
        -------
        The plan, and whether it is new.

        Raises
        ------
        ChangedError, VersionNeededError
            If the client doesn't know what it would overwrite.
        NoRoomError
            If as much is kept for the owner as may be.
        """
        packed = zlib.compress(content.body)
        with alone(self.engine, Purpose.KEEPING_PLANS) as connection:
            self._forget_expired(connection)
            row = self._find(connection, owner, plan_id)
            if row is not None and _is_same(connection, row, content):
                return row, False
            _check(row, known)
            self._check_room(connection, owner, content, row)
            _put(connection, owner, plan_id, content, row is not None)
            _put_body(connection, owner, plan_id, packed)
            return self._existing(connection, owner, plan_id), row is None

    def rename(self, owner: str, plan_id: str, name: str | None, note: str | None,
               known: Precondition) -> KeptRow:
        """Give a plan another name or note; None: as it was. In place.

        Raises
        ------
        UnknownPlanError, ChangedError, VersionNeededError
            If there is none, or not the one that the client knows.
        """
        with alone(self.engine, Purpose.KEEPING_PLANS) as connection:
            row = self._existing(connection, owner, plan_id)
            _check(row, known)
            changes = {"name": row.name if name is None else name,
                       "note": row.note if note is None else note,
                       "version": _new_version(), "changed_at": now_ms()}
            connection.execute(update(KEPT_PLANS).where(_is(owner, plan_id)).values(changes))
            return self._existing(connection, owner, plan_id)

    def remove(self, owner: str, plan_id: str, known: Precondition) -> None:
        """Delete a plan with its links; without a version too. In place.

        Raises
        ------
        UnknownPlanError, ChangedError
            If there is none, or not the one that the client knows.
        """
        with alone(self.engine, Purpose.KEEPING_PLANS) as connection:
            row = self._existing(connection, owner, plan_id)
            if known.needs_one:
                _check(row, known)
            _forget(connection, [(owner, plan_id)])

    def add_link(self, owner: str, plan_id: str) -> tuple[LinkRow, NewToken]:
        """Make a link to a plan and return it with its token, which is told only now. In place.

        Raises
        ------
        UnknownPlanError
            If there is no such plan.
        NoRoomError
            If it has as many as may be.
        """
        token = SHARE.make()
        with alone(self.engine, Purpose.KEEPING_PLANS) as connection:
            row = self._existing(connection, owner, plan_id)
            if row.links >= MAX_LINKS:
                raise NoRoomError(f"The plan has {MAX_LINKS} links already: end one first.")
            link = LinkRow(token.id, owner, plan_id, token.digest, now_ms())
            connection.execute(insert(PLAN_LINKS).values(vars(link)))
        return link, token

    def links(self, owner: str, plan_id: str) -> list[LinkRow]:
        """Return the links of a plan, the oldest first; raises as `find` does."""
        query = (select(PLAN_LINKS).where(_links(owner, plan_id))
                 .order_by(PLAN_LINKS.c.created_at, PLAN_LINKS.c.id))
        with self.engine.connect() as connection:
            self._existing(connection, owner, plan_id)
            return [LinkRow(**row) for row in connection.execute(query).mappings()]

    def remove_link(self, owner: str, plan_id: str, link_id: str) -> None:
        """End a link. In place.

        Raises
        ------
        UnknownLinkError
            If the plan has none of that id.
        """
        change = delete(PLAN_LINKS).where(_links(owner, plan_id), PLAN_LINKS.c.id == link_id)
        with self.engine.begin() as connection:
            if connection.execute(change).rowcount != 1:
                raise UnknownLinkError

    def shared(self, presented: str) -> tuple[KeptRow, bytes]:
        """Return the plan that a token shows, and its content as JSON.

        Raises
        ------
        UnknownLinkError
            If it shows none.
        """
        query = select(PLAN_LINKS).where(PLAN_LINKS.c.id == SHARE.id_of(presented))
        with self.engine.connect() as connection:
            found = connection.execute(query).mappings().first()
            link = None if found is None else LinkRow(**found)
            if not is_token(presented, NO_DIGEST if link is None else link.digest) or link is None:
                raise UnknownLinkError
            row = self._find(connection, link.owner, link.plan)
            if row is None:
                raise UnknownLinkError
            return row, _body(connection, link.owner, link.plan)

    def _existing(self, connection: Connection, owner: str, plan_id: str) -> KeptRow:
        row = self._find(connection, owner, plan_id)
        if row is None:
            raise UnknownPlanError(plan_id)
        return row

    def _find(self, connection: Connection, owner: str, plan_id: str) -> KeptRow | None:
        row = connection.execute(self._rows().where(_is(owner, plan_id))).mappings().first()
        return None if row is None else KeptRow(**row)

    def _rows(self) -> Select[Any]:
        """Return the query for plans that haven't expired."""
        links = (select(func.count()).select_from(PLAN_LINKS)
                 .where(_links(KEPT_PLANS.c.owner, KEPT_PLANS.c.id)).scalar_subquery())
        query = select(KEPT_PLANS, links.label("links"))
        if self.room.expiry is not None:
            query = query.where(KEPT_PLANS.c.changed_at >= now_ms() - self.room.expiry)
        return query

    def _check_room(self, connection: Connection, owner: str, content: Content,
                    row: KeptRow | None) -> None:
        plans, size = connection.execute(
            select(func.count(), func.coalesce(func.sum(KEPT_PLANS.c.bytes), 0))
            .where(KEPT_PLANS.c.owner == owner)).one()
        if row is None and plans >= self.room.plans:
            raise NoRoomError(f"{plans} plans are kept, and no more may be "
                              "(TANDEM_MAX_KEPT_PLANS): delete some that aren't needed.")
        size += len(content.body) - (row.bytes if row else 0)
        if size > self.room.bytes:
            raise NoRoomError(f"All plans would take {size} bytes, and {self.room.bytes} may be "
                              "kept (TANDEM_MAX_KEPT_BYTES): delete some that aren't needed.")

    def _forget_expired(self, connection: Connection) -> None:
        """Delete all plans, whoever has them, that nobody changed for long. In place."""
        if self.room.expiry is None:
            return
        old = select(KEPT_PLANS.c.owner, KEPT_PLANS.c.id).where(
            KEPT_PLANS.c.changed_at < now_ms() - self.room.expiry)
        _forget(connection, [tuple(row) for row in connection.execute(old)])


def _is(owner: str, plan_id: str) -> ColumnElement[bool]:
    return and_(KEPT_PLANS.c.owner == owner, KEPT_PLANS.c.id == plan_id)


def _links(owner: Any, plan_id: Any) -> ColumnElement[bool]:
    return and_(PLAN_LINKS.c.owner == owner, PLAN_LINKS.c.plan == plan_id)


def _new_version() -> str:
    """Return a version that no plan had before, also none of the same id that was deleted."""
    return secrets.token_hex(VERSION_BYTES)


def _check(row: KeptRow | None, known: Precondition) -> None:
    if row is None:
        if known.needs_one:
            raise ChangedError("The plan was deleted meanwhile: send it without 'If-Match' to "
                               "keep it anew.")
        return
    if known.must_be_new or (known.versions and row.version not in known.versions):
        raise ChangedError("It isn't the version that you know: read it again, then send its ETag "
                           "as 'If-Match', or keep yours under another id.")
    if not known.needs_one:
        raise VersionNeededError


def _is_same(connection: Connection, row: KeptRow, content: Content) -> bool:
    if (row.name, row.note, row.day) != (content.name, content.note, content.day):
        return False
    # A day's has another body at each attempt.
    return content.day is not None or (
        row.bytes == len(content.body) and _body(connection, row.owner, row.id) == content.body)


def _put(connection: Connection, owner: str, plan_id: str, content: Content,
         is_there: bool) -> None:
    at = now_ms()
    values = {"name": content.name, "note": content.note, "version": _new_version(),
              "changed_at": at, "bytes": len(content.body), "customers": content.customers,
              "cost": content.cost, "day": content.day}
    if is_there:
        connection.execute(update(KEPT_PLANS).where(_is(owner, plan_id)).values(values))
    else:
        connection.execute(insert(KEPT_PLANS).values(
            owner=owner, id=plan_id, created_at=at, **values))


def _put_body(connection: Connection, owner: str, plan_id: str, packed: bytes) -> None:
    connection.execute(delete(KEPT_PLAN_BODIES).where(_has_body(owner, plan_id)))
    connection.execute(insert(KEPT_PLAN_BODIES).values(owner=owner, plan=plan_id, body=packed))


def _has_body(owner: str, plan_id: str) -> ColumnElement[bool]:
    return and_(KEPT_PLAN_BODIES.c.owner == owner, KEPT_PLAN_BODIES.c.plan == plan_id)


def _body(connection: Connection, owner: str, plan_id: str) -> bytes:
    packed = connection.scalar(select(KEPT_PLAN_BODIES.c.body).where(_has_body(owner, plan_id)))
    if packed is None:
        # Deleted between two statements.
        raise UnknownPlanError(plan_id)
    return zlib.decompress(packed)


def _forget(connection: Connection, plans: list[tuple[str, str]]) -> None:
    """Delete plans with all that belongs to them. In place."""
    for owner, plan_id in plans:
        connection.execute(delete(PLAN_LINKS).where(_links(owner, plan_id)))
        connection.execute(delete(KEPT_PLAN_BODIES).where(_has_body(owner, plan_id)))
        connection.execute(delete(KEPT_PLANS).where(_is(owner, plan_id)))
