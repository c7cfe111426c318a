"""API keys: made at random, shown once, kept as hashes."""

import time
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Literal

from sqlalchemy import Engine, insert, select, update

from app.database.migrations.running import upgrade
from app.database.tables import KEYS
from app.serving.access.tokens import NO_DIGEST, TokenKind, is_token

Scope = Literal["plan", "jobs", "admin"]
SCOPES: tuple[Scope, ...] = ("plan", "jobs", "admin")

KEY = TokenKind()

LAST_USED_STEP = 600
"""Seconds by which the time of the last use may be too old; noting each use would cost a write."""


@dataclass(frozen=True)
class StoredKey:
    """What is known of a key. Times in whole seconds since 1970."""

    id: str
    name: str
    digest: bytes  # see `app.serving.access.tokens`
    scopes: frozenset[Scope]
    created_at: int
    revoked_at: int | None = None
    last_used_at: int | None = None  # up to LAST_USED_STEP too early


Keys = Mapping[str, StoredKey]
"""Keys by id."""

_NOBODY = StoredKey("", "", NO_DIGEST, frozenset(), 0, revoked_at=0)
"""Compared with where there is no key of the id presented."""


class KeyStore:
    """The keys in the service's database, whose tables are made at the first use."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self._is_prepared = False

    def create(self, name: str, scopes: Collection[Scope]) -> str:
        """Add a key and return it: it can't be read again. In place.

        Raises
        ------
        ValueError
            If there is no scope.
        """
        if not scopes:
            raise ValueError("scopes: a key needs at least one")
        key = KEY.make()
        row = {"id": key.id, "name": name, "digest": key.digest, "created_at": int(time.time()),
               "scopes": " ".join(scope for scope in SCOPES if scope in scopes)}
        with self._prepared().begin() as connection:
            connection.execute(insert(KEYS).values(row))
        return key.text

    def load(self) -> Keys:
        """Return all keys, the oldest first, revoked ones included."""
        order = select(KEYS).order_by(KEYS.c.created_at, KEYS.c.id)
        with self._prepared().connect() as connection:
            rows = connection.execute(order).mappings().all()
        return {row["id"]: StoredKey(**{**row, "scopes": frozenset(row["scopes"].split())})
                for row in rows}

    def revoke(self, key_id: str) -> bool:
        """Revoke a key for good; False if there is none that is valid. In place."""
        change = (update(KEYS).where(KEYS.c.id == key_id, KEYS.c.revoked_at.is_(None))
                  .values(revoked_at=int(time.time())))
        with self._prepared().begin() as connection:
            return connection.execute(change).rowcount == 1

    def note_use(self, key_id: str) -> None:
        """Note that a key was used now. In place."""
        change = update(KEYS).where(KEYS.c.id == key_id).values(last_used_at=int(time.time()))
        with self._prepared().begin() as connection:
            connection.execute(change)

    def _prepared(self) -> Engine:
        """Return the database, brought to this version.

        Raises
        ------
        SchemaError
            If that can't be done.
        """
        if not self._is_prepared:
            upgrade(self._engine)
            self._is_prepared = True
        return self._engine


def find_key(keys: Keys, presented: str) -> StoredKey | None:
    """Return the valid key that was presented, or None.

    How long this takes tells nothing, see `is_token`.
    """
    stored = keys.get(KEY.id_of(presented), _NOBODY)
    return stored if is_token(presented, stored.digest) and stored.revoked_at is None else None
