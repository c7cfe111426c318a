"""Connections to the database for jobs, which lose nothing and notice dead peers."""

from typing import Any

from sqlalchemy import Engine, create_engine, event

from app.database.connections import CONNECT_SECONDS, database_url, make_engine
from app.database.settings import DatabaseSettings

POOL_SIZE = 20

POSTGRESQL = {
    "connect_timeout": CONNECT_SECONDS,
    "keepalives_idle": 10,
    "keepalives_interval": 5,
    "keepalives_count": 3,
    # A process that freezes within a transaction must not hold its locks for ever.
    "options": "-c idle_in_transaction_session_timeout=60000",
}
"""Parameters of libpq, in seconds where they are times."""


def connect(settings: DatabaseSettings) -> Engine:
    """Return a pool of connections to the database that the settings name."""
    url = database_url(settings)
    if url.get_backend_name() == "sqlite":
        engine = make_engine(settings)
        event.listen(engine, "connect", _make_durable)
        return engine
    return create_engine(url, pool_pre_ping=True, pool_size=POOL_SIZE, max_overflow=POOL_SIZE,
                         connect_args=POSTGRESQL)


def _make_durable(connection: Any, _: object) -> None:
    """Write each commit to disk, so that an accepted job survives a power cut too. In place."""
    # Transactions take the lock for writing when they begin, else two could deadlock.
    connection.isolation_level = "IMMEDIATE"
    connection.execute("PRAGMA synchronous = FULL")
    connection.execute("PRAGMA busy_timeout = 30000")
