"""The service's own database: one SQLite file, or PostgreSQL by a setting."""

import fcntl
import os
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Any

from psycopg.errors import UndefinedColumn, UndefinedTable
from sqlalchemy import URL, Connection, Engine, create_engine, event, make_url, text
from sqlalchemy.exc import ArgumentError, DBAPIError, InterfaceError, OperationalError
from sqlalchemy.exc import TimeoutError as PoolTimeoutError
from sqlalchemy.pool import ConnectionPoolEntry

from app.database.files import DatabaseFile
from app.database.settings import DatabaseSettings

FILE_NAME = "tandem.db"

BUSY_SECONDS = 10
"""How long a write to SQLite waits for another process's."""

CONNECT_SECONDS = 5
"""How long PostgreSQL may take to accept a connection."""


KEPT_OPEN = 20
"""Connections that stay open: for all threads that wait for the database, as those beyond are
opened anew each time, one after another."""


class Purpose(Enum):
    """What one process does at a time, by the key of PostgreSQL's advisory lock for it.

    Any numbers, but the same everywhere.
    """

    CHANGING_TABLES = 7_236_101
    ADMITTING_JOBS = 7_236_102
    KEEPING_PLANS = 7_236_103


def database_url(settings: DatabaseSettings) -> URL:
    """Return the URL that the settings state, or that of a file in the data folder.

    Raises
    ------
    ValueError
        If the URL can't be read.
    """
    if settings.url is None:
        return URL.create("sqlite", database=str(settings.data_dir / FILE_NAME))
    try:
        url = make_url(settings.url.get_secret_value())
    except ArgumentError:
        # Without the cause, which repeats the URL and so the password.
        raise ValueError("TANDEM_DATABASE_URL: this is no database URL") from None
    if url.drivername in ("postgres", "postgresql"):
        url = url.set(drivername="postgresql+psycopg")
    return url


def make_engine(settings: DatabaseSettings) -> Engine:
    """Return a pool of connections to the database; makes the data folder if it is needed."""
    url = database_url(settings)
    if settings.url is None:
        settings.data_dir.mkdir(mode=0o700, parents=True, exist_ok=True)
    if url.get_backend_name() == "sqlite":
        _keep_to_owner(Path(url.database or ""), is_ours=settings.url is None)
        file = DatabaseFile(Path(url.database or ""))
        engine = create_engine(url, creator=file.connect, pool_size=KEPT_OPEN)
        folder = Path(url.database or "").parent
        event.listen(engine, "connect", partial(_set_up_sqlite, folder))
        file.watch(engine)
        return engine
    return create_engine(url, pool_pre_ping=True, pool_size=KEPT_OPEN,
                         connect_args={"connect_timeout": CONNECT_SECONDS})


def close_for_good(engine: Engine) -> None:
    """Close all connections, those in use as soon as their threads give them back. In place.

    A pool that is disposed of keeps the latter open until nobody knows it any longer.
    """
    event.listen(engine, "checkin", _close)
    engine.dispose()


def _close(_: Any, record: ConnectionPoolEntry) -> None:
    record.invalidate()


@contextmanager
def alone(engine: Engine, purpose: Purpose) -> Iterator[Connection]:
    """Yield a transaction beside which no other process has one for the same purpose."""
    with engine.begin() as connection:
        if engine.dialect.name == "postgresql":
            connection.execute(text("SELECT pg_advisory_xact_lock(:key)"), {"key": purpose.value})
        elif engine.dialect.name == "sqlite":
            connection.exec_driver_sql("BEGIN IMMEDIATE")
        yield connection


def is_outage(error: BaseException) -> bool:
    """Tell whether an error means that the database can't be reached, or not now."""
    if is_misfit(error):
        return False
    if isinstance(error, OperationalError | InterfaceError | PoolTimeoutError):
        return True
    return isinstance(error, DBAPIError) and error.connection_invalidated


def is_misfit(error: BaseException) -> bool:
    """Tell whether an error means that a table or a column isn't there."""
    if not isinstance(error, DBAPIError):
        return False
    if isinstance(error.orig, sqlite3.OperationalError):
        return any(words in str(error.orig) for words in _NOT_THERE)
    return isinstance(error.orig, UndefinedTable | UndefinedColumn)


_NOT_THERE = ("no such column", "no such table", "has no column named")
"""SQLite's words, which come with a code that stands for all faults of statements."""


def _keep_to_owner(file: Path, is_ours: bool) -> None:
    """Let no other user read a file that is made here: it has customers' addresses. In place.

    SQLite gives the files beside it the same permissions. One of our own, which earlier versions
    left open to others, is closed too; how somebody else's is shared is theirs to say.
    """
    try:
        os.close(os.open(file, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600))
    except FileExistsError:
        if is_ours:
            for each in (file, *file.parent.glob(f"{file.name}-*")):
                with suppress(FileNotFoundError, PermissionError):
                    each.chmod(0o600)


def _set_up_sqlite(folder: Path, connection: Any, _: object) -> None:
    """Let readers and a writer work side by side."""
    cursor = connection.cursor()
    cursor.execute(f"PRAGMA busy_timeout = {1000 * BUSY_SECONDS}")
    # Of several that change the mode of a new file at once, SQLite lets none wait but one fail.
    with _alone(folder):
        cursor.execute("PRAGMA journal_mode = WAL")
    cursor.execute("PRAGMA synchronous = NORMAL")
    cursor.execute("PRAGMA foreign_keys = ON")
    cursor.close()


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Keep out all other threads and processes that come here for the same folder."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)
