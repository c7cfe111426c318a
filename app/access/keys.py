"""API keys: made at random, shown once, kept as hashes."""

import hashlib
import hmac
import re
import secrets
import time
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Literal

from sqlalchemy import Engine, insert, select, update

from app.database.migrations.running import upgrade
from app.database.tables import KEYS

Scope = Literal["plan", "jobs", "admin"]
SCOPES: tuple[Scope, ...] = ("plan", "jobs", "admin")

PREFIX = "tdm_"
"""What every key begins with, so that people and scanners for secrets know it."""

ID_BYTES, SECRET_BYTES = 6, 32

LAST_USED_STEP = 600
"""Seconds by which the time of the last use may be too old; noting each use would cost a write."""

_KEY = re.compile(rf"{PREFIX}([0-9a-f]{{{2 * ID_BYTES}}})_[0-9a-f]{{{2 * SECRET_BYTES}}}")


@dataclass(frozen=True)
class StoredKey:
    """What is known of a key. Times in whole seconds since 1970."""

    id: str
    name: str
    digest: bytes  # SHA-256 of the whole key; 256 random bits need no slow hash
    scopes: frozenset[Scope]
    created_at: int
    revoked_at: int | None = None
    last_used_at: int | None = None  # up to LAST_USED_STEP too early


Keys = Mapping[str, StoredKey]
"""Keys by id."""

_NOBODY = StoredKey("", "", bytes(32), frozenset(), 0, revoked_at=0)
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
        key_id = secrets.token_hex(ID_BYTES)
        key = f"{PREFIX}{key_id}_{secrets.token_hex(SECRET_BYTES)}"
        row = {"id": key_id, "name": name, "digest": _digest(key), "created_at": int(time.time()),
               "scopes": " ".join(scope for scope in SCOPES if scope in scopes)}
        with self._prepared().begin() as connection:
            connection.execute(insert(KEYS).values(row))
        return key

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

    Whatever is presented is hashed whole and compared with one digest in constant time, so how
    long this takes tells neither how much of a key is right nor whether its id exists.
    """
    matched = _KEY.fullmatch(presented)
    stored = keys.get(matched[1] if matched else "", _NOBODY)
    is_right = hmac.compare_digest(_digest(presented), stored.digest)
    return stored if is_right and stored.revoked_at is None else None


def _digest(key: str) -> bytes:
    return hashlib.sha256(key.encode()).digest()
