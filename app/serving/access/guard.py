"""Who asks: a key with the scope that an endpoint needs, or anybody where access is open."""

import asyncio
import logging
import time
from dataclasses import dataclass
from types import MappingProxyType
from typing import Annotated

from fastapi import Request, Security
from fastapi.security import APIKeyHeader, HTTPAuthorizationCredentials, HTTPBearer, SecurityScopes
from sqlalchemy.exc import SQLAlchemyError

from app.database.connections import is_misfit
from app.database.migrations.running import SchemaError
from app.schemas.errors import RequestError
from app.serving.access.keys import (
    LAST_USED_STEP, SCOPES, Keys, KeyStore, Scope, StoredKey, find_key,
)
from app.serving.access.limits import RequestCounter, client_address

logger = logging.getLogger(__name__)

REFRESH_SECONDS = 1.0
"""Age from which on the keys in memory are read again: how long a revoked key may go on working."""

STALE_SECONDS = 60.0
"""Age up to which keys in memory are trusted while the database can't be read."""

PATIENCE = 0.5
"""Seconds that requests wait for keys to be read, before they make do with those in memory."""

_COUNTED = frozenset({"POST", "PUT", "PATCH"})
"""Methods whose requests have a rate."""

BEARER = HTTPBearer(auto_error=False, description="An API key: `Authorization: Bearer tdm_...`.")
KEY_HEADER = APIKeyHeader(name="X-API-Key", auto_error=False,
                          description="An API key, for clients that can't set `Authorization`.")


@dataclass(frozen=True)
class Principal:
    """Who asks, and what they may do."""

    key_id: str
    scopes: frozenset[Scope]
    client: str  # whose share of what is limited it takes: the key's, or that of an address


ANYBODY = "anonymous"
"""Id in place of a key's where access is open."""


class UnauthorizedError(RequestError, status=401, name="unauthorized", refusal="access"):
    """There is no valid key; which of all reasons it is, isn't told."""

    title = "A valid API key is needed"
    always = "Send a valid API key as 'Authorization: Bearer <key>' or as 'X-API-Key: <key>'."
    headers = MappingProxyType({"WWW-Authenticate": 'Bearer realm="tandem"'})


class ForbiddenError(RequestError, status=403, name="forbidden", refusal="access"):
    """The key is valid, but not for this."""

    title = "The API key may not do this"


class KeysUnreadableError(RequestError, status=503, name="keys-unreadable", refusal="access"):
    """The database with the keys has not answered for long."""

    title = "API keys can't be checked now"


class Guard:
    """Lets requests in by their key.

    Parameters
    ----------
    store
        The keys; None where access is open.
    limits
        How often anybody may ask, and fail.
    """

    def __init__(self, store: KeyStore | None, limits: RequestCounter) -> None:
        self._store = store
        self.limits = limits
        self._keys: Keys = {}
        self._read_at = -float("inf")
        self._tried_at = -float("inf")
        self._reading: asyncio.Task[None] | None = None
        self._trouble = "they were not read yet"
        self._noted: dict[str, float] = {}

    async def admit(self, request: Request, presented: str, needed: frozenset[Scope]) -> Principal:
        """Return who sent `request`.

        Parameters
        ----------
        presented
            The key that came with it; empty if none did.
        needed
            Scopes that the key must have.

        Raises
        ------
        UnauthorizedError
            If no valid key came with it.
        ForbiddenError
            If the key lacks one of the scopes in `needed`.
        TooManyRequestsError
            If keys were wrong too often, or the key was used too often.
        KeysUnreadableError
            If there is no telling which keys are valid.
        """
        if self._store is None:
            principal = Principal(ANYBODY, frozenset(SCOPES), client_address(request))
        else:
            principal = await self._identify(request, presented, self._store)
        if missing := needed - principal.scopes:
            raise ForbiddenError(f"The key lacks the scope {' and '.join(sorted(missing))}: use a "
                                 "key that was created with it.")
        # Logs name the key by its id.
        request.state.key_id = principal.key_id
        if request.method in _COUNTED:
            self.limits.take(request, principal.client, needed)
        return principal

    def count_wrong_token(self, request: Request) -> None:
        """Count a token that opens nothing as a wrong key; raises if there were too many."""
        self.limits.count_failure(client_address(request))

    async def trouble(self) -> str | None:
        """Return why keys can't be checked now; None: they can, or none are needed."""
        if self._store is None or time.monotonic() - self._read_at < STALE_SECONDS / 2:
            return None
        try:
            await self._refresh(self._store)
        except KeysUnreadableError as error:
            return str(error)
        # Whoever comes next with a key made meanwhile is let in at once, as if nobody had asked.
        self._read_at -= REFRESH_SECONDS
        self._tried_at -= REFRESH_SECONDS
        return None

    async def still_admits(self, principal: Principal) -> bool:
        """Tell whether the key of whoever was let in is valid still, as far as can be told."""
        if self._store is None:
            return True
        try:
            await self._refresh(self._store)
        except KeysUnreadableError:
            return False
        key = self._keys.get(principal.key_id)
        return key is not None and key.revoked_at is None

    async def _identify(self, request: Request, presented: str, store: KeyStore) -> Principal:
        await self._refresh(store)
        key = find_key(self._keys, presented)
        if key is None:
            # Only wrong keys are slowed down: whoever shares the address of somebody who guesses
            # is let in all the same, and 256 random bits can't be guessed anyway.
            self.limits.count_failure(client_address(request))
            raise UnauthorizedError
        await self._note_use(store, key)
        return Principal(key.id, key.scopes, key.id)

    async def _refresh(self, store: KeyStore) -> None:
        """Read the keys again if that is due, once for all that wait. In place."""
        now = time.monotonic()
        if now - self._read_at <= REFRESH_SECONDS:
            return
        is_reading = self._reading is not None and not self._reading.done()
        if not is_reading and now - self._tried_at > REFRESH_SECONDS:
            self._tried_at = now
            self._reading = asyncio.create_task(self._read(store))
        if self._reading is not None:
            await asyncio.wait({self._reading}, timeout=max(0.0, self._tried_at + PATIENCE - now))
        if time.monotonic() - self._read_at > STALE_SECONDS:
            raise KeysUnreadableError(f"The API keys can't be read ({self._trouble}): try again "
                                      "soon.")

    async def _read(self, store: KeyStore) -> None:
        began = time.monotonic()
        try:
            self._keys = await asyncio.to_thread(store.load)
            self._read_at = began
        except SchemaError as error:
            self._trouble = str(error)
        except SQLAlchemyError as error:
            # The class alone goes to the log: messages may repeat the URL, and so its password.
            self._trouble = ("the database's tables don't fit" if is_misfit(error)
                             else "the database can't be reached")
            logger.error("keys can't be read: %s", type(error).__name__)

    async def _note_use(self, store: KeyStore, key: StoredKey) -> None:
        """Note the use of a key, unless that was done a short while ago. In place."""
        now = time.time()
        last = max(key.last_used_at or 0, self._noted.get(key.id, 0))
        if now - last < LAST_USED_STEP:
            return
        self._noted[key.id] = now
        try:
            await asyncio.to_thread(store.note_use, key.id)
        except SQLAlchemyError as error:
            logger.warning("the use of a key can't be noted: %s", type(error).__name__)


async def require(
    request: Request, security: SecurityScopes,
    bearer: Annotated[HTTPAuthorizationCredentials | None, Security(BEARER)],
    header: Annotated[str | None, Security(KEY_HEADER)],
) -> Principal:
    """Return who asks; refuse whoever lacks a key with the scopes that the endpoint needs."""
    guard: Guard = request.app.state.guard
    stated = {key.strip() for key in (bearer.credentials if bearer else "", header or "") if key}
    # Two keys that differ leave open who asks.
    presented = stated.pop() if len(stated) == 1 else ""
    return await guard.admit(request, presented, frozenset(security.scopes))  # type: ignore[arg-type]


Plan = Annotated[Principal, Security(require, scopes=["plan"])]
Jobs = Annotated[Principal, Security(require, scopes=["jobs"])]
Admin = Annotated[Principal, Security(require, scopes=["admin"])]
